// SPDX-License-Identifier: MIT
/// @file
/// Numbers as error messages show them.
#pragma once

#include <tsubu/core/vec.hpp>

#include <charconv>  // std::to_chars
#include <cstddef>   // std::size_t
#include <string>    // std::string

namespace tsubu::detail {

/// The shortest text that reads back as the same number.
template <class Number>
requires requires(char* at, Number x) { std::to_chars(at, at, x); }
[[nodiscard]] std::string shown(Number x) {
    char text[64];  // no shortest form of a number is longer
    return {text, std::to_chars(text, text + sizeof(text), x).ptr};
}
/// A lattice coordinate, or whatever else wraps a number.
template <class Wrapper>
requires requires(Wrapper x) { shown(x.value); }
[[nodiscard]] std::string shown(Wrapper x) { return shown(x.value); }

/// A point: (1, 2, 3).
template <class Number, std::size_t D>
[[nodiscard]] std::string shown(const vec<D, Number>& x) {
    std::string text = "(";
    for (std::size_t k = 0; k < D; ++k) text += (k == 0 ? "" : ", ") + shown(x[k]);
    return text + ")";
}

}  // namespace tsubu::detail
