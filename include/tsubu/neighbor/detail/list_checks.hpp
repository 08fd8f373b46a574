// SPDX-License-Identifier: MIT
/// @file
/// What lists of neighbours refuse.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/interval.hpp>

#include <cmath>    // std::isnormal
#include <cstddef>  // std::size_t
#include <string>   // std::to_string

namespace tsubu::detail {

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

}  // namespace tsubu::detail
