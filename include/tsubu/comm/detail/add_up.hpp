// SPDX-License-Identifier: MIT
/// @file
/// What a ghost has collected, added to the value of its owner.
#pragma once

#include <tsubu/store/field.hpp>

#include <cstddef>      // std::size_t
#include <type_traits>  // std::is_arithmetic_v

namespace tsubu::detail {

/// Component by component.
template <ghosts_add How, class Value>
constexpr void add_up(Value& to, const Value& from) noexcept {
    if constexpr (How == ghosts_add::nothing) {
        static_cast<void>(to);
        static_cast<void>(from);
    } else if constexpr (std::is_arithmetic_v<Value>) {
        if constexpr (How == ghosts_add::sum)
            to = static_cast<Value>(to + from);
        else if constexpr (How == ghosts_add::least)
            to = from < to ? from : to;
        else
            to = to < from ? from : to;
    } else {
        static_assert(requires(Value v) { v.size(); v[0]; },
                      "a field that ghosts add to is a number, or an array of numbers; else let ghosts_add be nothing");
        for (std::size_t k = 0; k < to.size(); ++k) add_up<How>(to[k], from[k]);
    }
}

}  // namespace tsubu::detail
