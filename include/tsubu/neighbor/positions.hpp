// SPDX-License-Identifier: MIT
/// @file
/// point_positions: what lists of neighbours take positions from.
#pragma once

#include <concepts>     // std::convertible_to, std::floating_point
#include <cstddef>      // std::size_t
#include <tuple>        // std::tuple_size
#include <type_traits>  // std::remove_cvref_t
#include <utility>      // std::declval

namespace tsubu {
namespace detail {

template <class Position>
inline constexpr std::size_t dimension_of = 0;
template <class Position>
requires requires { std::tuple_size<Position>::value; }
inline constexpr std::size_t dimension_of<Position> = std::tuple_size<Position>::value;
template <class Number, std::size_t D>
inline constexpr std::size_t dimension_of<Number[D]> = D;

template <class Positions>
using position_in = std::remove_cvref_t<decltype(std::declval<const Positions&>()[std::size_t{}])>;
template <class Positions>
using number_of_position =
    std::remove_cvref_t<decltype(std::declval<const Positions&>()[std::size_t{}][std::size_t{}])>;

}  // namespace detail

/// Positions in 1, 2 or 3 dimensions: size() and x[i][k], float or double; x[i] is a std::array, an array or what else
/// has a std::tuple_size.
template <class Positions>
concept point_positions = requires(const Positions& x) {
    { x.size() } -> std::convertible_to<std::size_t>;
    requires std::floating_point<detail::number_of_position<Positions>>;
    requires detail::dimension_of<detail::position_in<Positions>>
    >= 1;
    requires detail::dimension_of<detail::position_in<Positions>>
    <= 3;
};

}  // namespace tsubu
