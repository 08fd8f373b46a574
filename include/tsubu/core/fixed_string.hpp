// SPDX-License-Identifier: MIT
/// @file
/// fixed_string: a text that can be a template argument.
#pragma once

#include <cstddef>      // std::size_t
#include <string_view>  // std::string_view

namespace tsubu {

/// The characters of a string literal, and its 0 at the end.
template <std::size_t N>
struct fixed_string {
    char text[N]{};

    constexpr fixed_string(const char (&literal)[N]) noexcept {
        for (std::size_t k = 0; k < N; ++k) text[k] = literal[k];
    }
    [[nodiscard]] constexpr std::string_view view() const noexcept { return {text, N - 1}; }
};

}  // namespace tsubu
