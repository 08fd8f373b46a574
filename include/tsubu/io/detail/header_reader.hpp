// SPDX-License-Identifier: MIT
/// @file
/// read_header: the lines of a LAMMPS data file before its first section.
#pragma once

#include <tsubu/io/detail/header_words.hpp>
#include <tsubu/io/detail/row.hpp>
#include <tsubu/io/lammps_header.hpp>
#include <tsubu/io/lammps_options.hpp>

#include <algorithm>    // std::replace
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <vector>       // std::vector

namespace tsubu::detail {

/// The words of a text, with one blank between them.
[[nodiscard]] inline std::string with_single_blanks(std::string_view text) {
    std::string words;
    for (const char c : text)
        if (!is_blank(c))
            words += c;
        else if (words.empty() || words.back() != ' ')
            words += ' ';
    return words;
}

/// Room that LAMMPS is asked to leave, which says nothing of particles.
[[nodiscard]] inline bool is_room_hint(std::string_view keyword) noexcept {
    return keyword.starts_with("extra ") && keyword.ends_with(" per atom");
}

/// Reads until the first line that begins with a letter, which is the line of the reader then, or to the end.
/// @return whether there is such a line.
template <class Lines>
[[nodiscard]] bool read_header(Lines& lines, lammps_header& header, unknown_lines unknown) {
    if (!lines.next()) lines.fail("the file is empty", "give a LAMMPS data file");
    header.title = std::string(trimmed(lines.line()));
    std::replace(header.title.begin(), header.title.end(), '\r', ' ');  // else some would see two lines in it
    std::vector<std::string> met;
    const auto has_met = [&](std::string_view keyword) {
        for (const auto& one : met)
            if (one == keyword) return true;
        return false;
    };
    bool is_at_section = false;
    while (lines.next_content()) {
        row<Lines> numbers(lines);
        if (numbers.is_at_word()) {
            is_at_section = true;
            break;
        }
        // The keyword begins at the first letter behind a blank; numbers may have letters within.
        auto keyword_at = numbers.rest();
        while (!keyword_at.empty() && !is_letter(keyword_at.front())) {
            while (!keyword_at.empty() && !is_blank(keyword_at.front())) keyword_at.remove_prefix(1);
            while (!keyword_at.empty() && is_blank(keyword_at.front())) keyword_at.remove_prefix(1);
        }
        const auto keyword = with_single_blanks(keyword_at);
        const auto expect_keyword = [&] {
            if (with_single_blanks(numbers.rest()) != keyword)
                numbers.fail(in_quotes(numbers.rest()) + " where " + in_quotes(keyword) + " was expected",
                             "give as many numbers as the line needs");
        };
        if (!keyword.empty()) {
            if (has_met(keyword)) numbers.fail("a second line of this kind", "leave one of them");
            met.push_back(keyword);
        }
        bool is_known = false;
        for (const auto& kind : counted_kinds) {
            auto& count = header.*kind.count;
            if (keyword == kind.rows) {
                count.rows = numbers.template next_from<std::int64_t>(0, "a number of rows");
                expect_keyword();
                is_known = true;
            } else if (keyword == kind.types) {
                count.types = numbers.template next_from<std::int32_t>(0, "a number of types");
                expect_keyword();
                is_known = true;
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (keyword != face_names[k]) continue;
            header.lo[k] = numbers.template next<double>("the lower face");
            header.hi[k] = numbers.template next<double>("the upper face");
            expect_keyword();
            if (!(header.lo[k] < header.hi[k])) numbers.fail("the faces are not in order", "give the lower one first");
            is_known = true;
        }
        if (keyword == "xy xz yz") {
            vec<3> tilt{};
            for (auto& one : tilt) one = numbers.template next<double>("a tilt");
            expect_keyword();
            header.tilt = tilt;
            is_known = true;
        }
        if (is_known || is_room_hint(keyword) || unknown == unknown_lines::skip) continue;
        numbers.fail("this is no line of a header",
                     "set lammps_read_options.unknown to unknown_lines::skip, or remove it");
    }
    for (const auto face : face_names)
        if (!has_met(face)) lines.fail("the header before it has no line " + in_quotes(face), "give the box");
    return is_at_section;
}

}  // namespace tsubu::detail
