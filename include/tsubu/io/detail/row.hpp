// SPDX-License-Identifier: MIT
/// @file
/// row: the numbers of a line, read strictly.
#pragma once

#include <tsubu/io/detail/decimal.hpp>
#include <tsubu/io/detail/line_reader.hpp>

#include <cmath>         // std::isfinite
#include <concepts>      // std::floating_point
#include <cstddef>       // std::size_t
#include <cstdint>       // std::int64_t
#include <string>        // std::string
#include <string_view>   // std::string_view
#include <system_error>  // std::errc

namespace tsubu::detail {

[[nodiscard]] inline std::size_t count_words(std::string_view text) noexcept {
    std::size_t count = 0;
    bool is_within = false;
    for (const char c : text) {
        const bool blank = is_blank(c);
        count += !blank && !is_within ? 1U : 0U;
        is_within = !blank;
    }
    return count;
}

/// What a line of numbers says, from its beginning on; whatever is wrong is told with the line.
///
/// @tparam Lines  line_reader<...>; the row is its line, and ends when it goes on.
template <class Lines>
class row {
public:
    explicit row(const Lines& lines) noexcept
        : lines_(&lines), at_(lines.content().data()), end_(at_ + lines.content().size()) {}

    [[nodiscard]] bool is_at_end() const noexcept { return at_ == end_; }
    /// Whether what comes next begins with a letter.
    [[nodiscard]] bool is_at_word() const noexcept { return at_ != end_ && is_letter(*at_); }
    [[nodiscard]] std::string_view rest() const noexcept { return {at_, static_cast<std::size_t>(end_ - at_)}; }

    /// The next number: an integer, or a finite real one. @param what  what it is, for the message.
    template <class Number>
    [[nodiscard]] Number next(const char* what) {
        Number value{};
        const auto [stop, code] = read_number(at_, end_, lines_->readable_end(), value);
        if (code != std::errc{} || (stop != end_ && !is_blank(*stop)) || !is_finite(value)) [[unlikely]]
            refuse<Number>(what, code);
        at_ = stop;
        while (at_ != end_ && is_blank(*at_)) ++at_;
        return value;
    }
    /// An integer from `least` on. Ids of LAMMPS begin with 1.
    template <class Integer = std::int64_t>
    [[nodiscard]] Integer next_from(Integer least, const char* what) {
        const auto value = next<Integer>(what);
        if (value < least) [[unlikely]]
            fail(std::string(what) + " " + std::to_string(value), ("it begins with " + std::to_string(least)).c_str());
        return value;
    }
    /// Nothing may follow.
    void expect_end() const {
        if (!is_at_end()) [[unlikely]]
            fail(in_quotes(rest()) + " follows the last column", "is this another atom style?");
    }
    [[noreturn]] void fail(const std::string& reason, const char* remedy) const { lines_->fail(reason, remedy); }

private:
    template <class Number>
    [[nodiscard]] static bool is_finite(Number value) noexcept {
        if constexpr (std::floating_point<Number>) return std::isfinite(value);
        return true;
    }
    template <class Number>
    [[noreturn, gnu::cold, gnu::noinline]] void refuse(const char* what, std::errc code) const {
        if (is_at_end()) fail(std::string(what) + " is missing", "give all columns of the atom style and section");
        auto word = rest();
        for (std::size_t k = 0; k < word.size(); ++k)
            if (is_blank(word[k])) word = word.substr(0, k);
        const auto found = std::string(what) + " " + in_quotes(word);
        if (code == std::errc::result_out_of_range)
            fail(found + " is beyond what " + std::to_string(sizeof(Number) * 8) + " bits hold",
                 "give a number within range");
        if constexpr (std::floating_point<Number>)
            fail(found + " is no finite number", "write it like 1, -2.5 or 3e-7");
        else
            fail(found + " is no integer", "write it like 1 or -25");
    }

    const Lines* lines_;
    const char* at_;
    const char* end_;
};

}  // namespace tsubu::detail
