// SPDX-License-Identifier: MIT
#include <tsubu/io/text_source.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/io/detail/line_reader.hpp>
#include <tsubu/io/file_sink.hpp>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using tsubu::file_source;
using tsubu::memory_source;

namespace {

std::vector<std::string> lines_of(std::string_view text, std::size_t chunk) {
    tsubu::detail::line_reader<memory_source> lines(memory_source(text), chunk);
    std::vector<std::string> all;
    while (lines.next()) all.push_back(std::to_string(lines.number()) + ":" + std::string(lines.line()));
    return all;
}

}  // namespace

TEST_CASE("lines do not depend on where chunks end", "[io][text_source]") {
    const std::string text = "one\n\ntwo three\r\n  four # five\nsix";
    const std::vector<std::string> expected{"1:one", "2:", "3:two three", "4:  four # five", "5:six"};
    for (std::size_t chunk = 16; chunk < 60; ++chunk) {
        CAPTURE(chunk);
        CHECK(lines_of(text, chunk) == expected);
        CHECK(lines_of(text + "\n", chunk) == expected);
    }
    CHECK(lines_of("", 16).empty());
    CHECK(says(thrown<tsubu::input_error>([&] { lines_of(text, 15); }),
               "(memory), line 4 \"  four # five\"") == false);  // 15 characters fit, but not the end of their line
    CHECK(says(thrown<tsubu::input_error>([&] { lines_of(text, 9); }), "line 3 \"two three\": a line of more than 9"));
}

TEST_CASE("comments and blanks are told apart from content", "[io][text_source]") {
    tsubu::detail::line_reader<memory_source> lines(memory_source("# all\n \t\r\n\v Atoms\t # full # x \n#\nend"), 64);
    REQUIRE(lines.next_content());
    CHECK(lines.content() == "Atoms");
    CHECK(lines.comment() == "full # x");
    CHECK(lines.number() == 3);
    REQUIRE(lines.next_content());
    CHECK(lines.content() == "end");
    CHECK(lines.comment().empty());
    CHECK_FALSE(lines.next_content());
}

TEST_CASE("messages show what a file says without trusting it", "[io][text_source]") {
    CHECK(tsubu::detail::quoted("a\tb\x01\xff") == "\"a\tb??\"");
    CHECK(tsubu::detail::quoted(std::string(81, 'x')) == "\"" + std::string(80, 'x') + "...\"");
    CHECK(tsubu::detail::quoted(std::string(80, 'x')) == "\"" + std::string(80, 'x') + "\"");
}

TEST_CASE("a file that cannot be read says why", "[io][text_source]") {
    CHECK(says(thrown<tsubu::input_error>([] { file_source("/no/such/file"); }),
               "tsubu::file_source: /no/such/file: No such file"));
    CHECK(says(thrown<tsubu::input_error>([] {
                   file_source folder("/");
                   char text[8];
                   static_cast<void>(folder.read(text));
               }),
               "/: Is a directory"));
}

TEST_CASE("a file appears whole or not at all", "[io][file_sink]") {
    const std::string path = "tsubu_test_file_sink.txt";
    const auto content = [&] {
        std::string text(100, ' ');
        file_source file(path);
        text.resize(file.read(text));
        return text;
    };
    {
        tsubu::file_sink out(path);
        out("old");
        out.commit();
    }
    CHECK(content() == "old");
    {
        tsubu::file_sink out(path);
        out("new");
        CHECK(content() == "old");
    }  // without commit
    CHECK(content() == "old");
    CHECK(says(thrown<tsubu::input_error>([&] { file_source(path + ".part"); }), "No such file"));
    {
        tsubu::file_sink out(path);
        out("new");
        out("er");
        out.commit();
    }
    CHECK(content() == "newer");
    CHECK(file_source(path).size() == 5);
    static_cast<void>(std::remove(path.c_str()));
    CHECK(says(thrown<tsubu::input_error>([] { tsubu::file_sink("/no/such/folder/x"); }),
               "/no/such/folder/x cannot be made: No such file"));
}
