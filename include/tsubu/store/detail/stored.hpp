// SPDX-License-Identifier: MIT
/// @file
/// What a store keeps for the value of a field.
#pragma once

#include <tsubu/store/bonus_of.hpp>
#include <tsubu/store/list_of.hpp>

#include <optional>     // std::optional
#include <tuple>        // std::tuple
#include <type_traits>  // std::remove_cv_t

namespace tsubu::detail {

/// What lies in memory for a field, the pool that its lists lie in, and what a particle_record holds of it.
template <class Value>
struct stored {
    using type = Value;
    using held = Value;
    using pool = std::tuple<>;
    static constexpr bool is_list = false;
    static constexpr bool is_bonus = false;
};
template <class Element>
struct stored<list_of<Element>> {
    using type = list_extent;
    using held = held_list<Element>;
    using pool = list_pool<Element>;
    static constexpr bool is_list = true;
    static constexpr bool is_bonus = false;
};
template <class Value>
struct stored<bonus_of<Value>> {
    using type = bonus_place;
    using held = std::optional<Value>;
    using pool = bonus_pool<Value>;
    static constexpr bool is_list = false;
    static constexpr bool is_bonus = true;
};

template <class Field>
using stored_of = stored<typename std::remove_cv_t<Field>::value_type>;

}  // namespace tsubu::detail
