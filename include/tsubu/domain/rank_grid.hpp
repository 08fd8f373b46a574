// SPDX-License-Identifier: MIT
/// @file
/// rank_grid: how many ranks along each axis.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>  // std::max
#include <array>      // std::array
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits

namespace tsubu {

/// The factors p of the rank count, one per axis, that give the subdomains of a box the least surface: of all
/// factorisations the one with the least sum of the areas of a subdomain's faces; of equal ones that with most ranks
/// along the first axis. [D]
///
/// @param extents  edge lengths of the box, above 0, in any unit.
/// @throws input_error if ranks is 0, or an extent is not above 0 and finite.
/// Complexity: O(ranks log log ranks), the sum of the divisors of ranks.
template <std::size_t D, class Real>
[[nodiscard]] std::array<std::size_t, D> rank_grid(std::size_t ranks, const vec<D, Real>& extents) {
    if (ranks == 0) detail::raise<input_error>("rank_grid", "0 ranks", "ask for at least 1");
    Real longest = 0;
    for (std::size_t k = 0; k < D; ++k) {
        if (!(extents[k] > 0) || !detail::is_finite(extents[k]))
            detail::raise<input_error>("rank_grid",
                                       "the extent " + detail::shown(extents[k]) + " of axis " + detail::shown(k),
                                       "give finite lengths above 0");
        longest = (std::max)(longest, extents[k]);
    }
    std::array<std::size_t, D> best{};
    Real least = 0;
    // Sums that ought to be equal differ by rounding, and by fused multiply-add.
    constexpr Real equal = 1 - 16 * std::numeric_limits<Real>::epsilon();
    const auto consider = [&](const std::array<std::size_t, D>& grid) {
        vec<D, Real> edge{};
        for (std::size_t k = 0; k < D; ++k) edge[k] = extents[k] / longest / static_cast<Real>(grid[k]);
        Real surface = 0;
        if constexpr (D == 2) surface = edge[0] + edge[1];
        if constexpr (D == 3) surface = edge[0] * edge[1] + edge[1] * edge[2] + edge[2] * edge[0];
        if (best[0] == 0 || surface < least * equal || (surface * equal <= least && grid > best)) {
            best = grid;
            least = surface;
        }
    };
    if constexpr (D == 1) {
        consider({ranks});
    } else {
        for (std::size_t first = 1; first <= ranks; ++first) {
            if (ranks % first != 0) continue;
            const auto rest = ranks / first;
            if constexpr (D == 2) {
                consider({first, rest});
            } else {
                for (std::size_t second = 1; second <= rest; ++second)
                    if (rest % second == 0) consider({first, second, rest / second});
            }
        }
    }
    return best;
}

}  // namespace tsubu
