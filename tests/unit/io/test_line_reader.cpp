// SPDX-License-Identifier: MIT
#include <tsubu/io/detail/line_reader.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/io/byte_source.hpp>

#include <string>
#include <string_view>
#include <vector>

using tsubu::memory_source;

namespace {

std::vector<std::string> lines_of(std::string_view text, std::size_t chunk) {
    tsubu::detail::line_reader<memory_source> lines(memory_source(text), chunk);
    std::vector<std::string> all;
    while (lines.next()) all.push_back(std::to_string(lines.number()) + ":" + std::string(lines.line()));
    return all;
}

}  // namespace

TEST_CASE("lines do not depend on where chunks end", "[io][line_reader]") {
    const std::string text = "one\n\ntwo three\r\n  four # five\nsix";
    const std::vector<std::string> expected{"1:one", "2:", "3:two three", "4:  four # five", "5:six"};
    for (std::size_t chunk = 0; chunk < 60; ++chunk) {
        CAPTURE(chunk);
        CHECK(lines_of(text, chunk) == expected);
        CHECK(lines_of(text + "\n", chunk) == expected);
    }
    CHECK(lines_of("", 16).empty());
}

TEST_CASE("a line may be longer than a chunk, but not endless", "[io][line_reader]") {
    const std::string longest(65536, 'x');
    for (const std::size_t chunk : {1U, 100U, 65536U}) {
        const auto lines = lines_of(longest.substr(1) + "\nend", chunk);
        REQUIRE(lines.size() == 2);
        CHECK(lines[0].size() == 2 + 65535);
        CHECK(lines[1] == "2:end");
        CHECK(says(thrown<tsubu::input_error>([&] { lines_of("a\n" + longest + "\nend", chunk); }),
                   "memory, line 2 \"" + std::string(80, 'x') + "...\": a line of more than 65536 characters"));
    }
    CHECK(lines_of(longest + "\nend", 65537).size() == 2);
}

TEST_CASE("an earlier line is told with its text", "[io][line_reader]") {
    for (const std::size_t chunk : {1U, 7U, 100U}) {
        tsubu::detail::line_reader<memory_source> lines(memory_source("one\n\nthree # 3\nfour\n"), chunk);
        while (lines.next()) {
        }
        CHECK(lines.number() == 4);
        CHECK(says(thrown<tsubu::input_error>([&] { lines.fail_at(3, "wrong", "mend it"); }),
                   "memory, line 3 \"three # 3\": wrong; mend it"));
        CHECK(says(thrown<tsubu::input_error>([&] { lines.fail_at(1, "wrong", "mend it"); }), "line 1 \"one\": wrong"));
    }
}

TEST_CASE("comments and blanks are told apart from content", "[io][line_reader]") {
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

TEST_CASE("messages show what a file says without trusting it", "[io][line_reader]") {
    CHECK(tsubu::detail::in_quotes("a\tb\x01\xff") == "\"a\tb??\"");
    CHECK(tsubu::detail::in_quotes(std::string(81, 'x')) == "\"" + std::string(80, 'x') + "...\"");
    CHECK(tsubu::detail::in_quotes(std::string(80, 'x')) == "\"" + std::string(80, 'x') + "\"");
}
