// SPDX-License-Identifier: MIT
/// @file
/// Numbers as error messages show them.
#pragma once

#include <charconv>  // std::to_chars
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

}  // namespace tsubu::detail
