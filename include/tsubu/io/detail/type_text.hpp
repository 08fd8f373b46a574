// SPDX-License-Identifier: MIT
/// @file
/// The type of a field in words that are the same on every machine: "float64[3]", "list of int32".
#pragma once

#include <tsubu/store/bonus_of.hpp>
#include <tsubu/store/list_of.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <string>       // std::string, std::to_string
#include <type_traits>  // std::is_floating_point_v, std::is_integral_v, std::is_signed_v, std::underlying_type_t

namespace tsubu::detail {

template <class Value>
struct type_text_of {
    [[nodiscard]] static std::string get() {
        if constexpr (std::is_same_v<Value, bool>)
            return "bool";
        else if constexpr (std::is_enum_v<Value>)
            return type_text_of<std::underlying_type_t<Value>>::get();
        else if constexpr (std::is_integral_v<Value>)
            return (std::is_signed_v<Value> ? "int" : "uint") + std::to_string(8 * sizeof(Value));
        else if constexpr (std::is_floating_point_v<Value>)
            return "float" + std::to_string(8 * sizeof(Value));
        else
            return "record of " + std::to_string(sizeof(Value)) + " bytes";
    }
};
template <class Value, std::size_t N>
struct type_text_of<std::array<Value, N>> {
    [[nodiscard]] static std::string get() { return type_text_of<Value>::get() + "[" + std::to_string(N) + "]"; }
};
template <class Element>
struct type_text_of<list_of<Element>> {
    [[nodiscard]] static std::string get() { return "list of " + type_text_of<Element>::get(); }
};
template <class Element>
struct type_text_of<bonus_of<Element>> {
    [[nodiscard]] static std::string get() { return "bonus of " + type_text_of<Element>::get(); }
};

}  // namespace tsubu::detail
