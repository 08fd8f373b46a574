// SPDX-License-Identifier: MIT
/// @file
/// What lists of neighbours ask of positions and reach, and refuse.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/interval.hpp>

#include <cmath>        // std::isnormal
#include <concepts>     // std::convertible_to, std::floating_point
#include <cstddef>      // std::size_t
#include <string>       // std::to_string
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
    requires detail::dimension_of<detail::position_in<Positions>> >= 1;
    requires detail::dimension_of<detail::position_in<Positions>> <= 3;
};

namespace detail {

/// @throws input_error, limit_error
template <class Real>
void check_list(const char* where, std::size_t count, std::size_t owned, double reach) {
    if (count > max_index_count)
        raise<limit_error>(where, std::to_string(count) + " particles on one rank",
                           "take more ranks: one has at most 2^31 - 1");
    if (owned > count)
        raise<input_error>(where, std::to_string(owned) + " owned particles of " + std::to_string(count),
                           "give the positions of the owned ones, then of the ghosts");
    if (!(reach > 0) || !is_finite(reach))
        raise<input_error>(where, "neighbours up to a distance of " + shown(reach),
                           "give a finite length above 0: the range of the forces, and a skin");
    const auto length = static_cast<Real>(reach);
    if (!std::isnormal(length * length))
        raise<input_error>(where,
                           "neighbours up to a distance of " + shown(reach) +
                               ", of which the square is no normal number",
                           "take a unit of length in which distances are nearer to 1");
}

}  // namespace detail
}  // namespace tsubu
