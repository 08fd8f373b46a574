// SPDX-License-Identifier: MIT
/// @file
/// Refusals that several headers of the room share.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/interval.hpp>

#include <concepts>  // std::integral
#include <cstddef>   // std::size_t
#include <string>    // std::string
#include <utility>   // std::cmp_less

namespace tsubu::detail {

/// The rank as it counts here, of any integer type: MPI has int. @throws input_error if there is no such rank.
template <std::integral Rank>
[[nodiscard]] std::size_t checked_rank(const char* where, Rank rank, std::size_t ranks) {
    if (std::cmp_less(rank, 0) || std::cmp_greater_equal(rank, ranks))
        raise<input_error>(where, "rank " + std::to_string(rank) + " of " + std::to_string(ranks),
                           "ranks count from 0");
    return static_cast<std::size_t>(rank);
}

/// @throws input_error if the cutoff is negative, infinite or NaN.
template <class Real>
void check_cutoff(const char* where, Real cutoff) {
    if (!(cutoff >= 0) || !is_finite(cutoff))
        raise<input_error>(where, "the cutoff " + shown(cutoff), "give a finite length of at least 0");
}

/// As many as an int of MPI counts.
inline constexpr double most_ranks = 2147483647;

/// Calls make(); what it says of wrong input is told with the axis.
/// @throws input_error
template <class Make>
decltype(auto) with_axis(std::size_t k, const char* whose, Make&& make) {
    try {
        return make();
    } catch (const input_error& wrong) {
        throw input_error(std::string(wrong.what()) + " (axis " + std::to_string(k) + " of the " + whose + ")");
    }
}

}  // namespace tsubu::detail
