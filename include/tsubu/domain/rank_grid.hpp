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
#include <vector>     // std::vector

namespace tsubu {
namespace detail {

/// In increasing order. n is above 0.
[[nodiscard]] inline std::vector<std::size_t> divisors_of(std::size_t n) {
    std::vector<std::size_t> found;
    for (std::size_t d = 1; d <= n / d; ++d)
        if (n % d == 0) found.push_back(d);
    for (std::size_t k = found.size(); k-- > 0;)
        if (const auto other = n / found[k]; other != found[k]) found.push_back(other);
    return found;
}

}  // namespace detail

/// The factors p of the rank count, one per axis, that give the subdomains of a box the least surface: of all
/// factorisations the one with the least sum of the areas of a subdomain's faces; of equal ones that with most ranks
/// along the first axis. [D]
///
/// @param extents  edge lengths of the box, above 0, in any unit.
/// @throws input_error if ranks is 0, or an extent is not above 0 and finite.
/// Complexity: O(sqrt(ranks)), and one step for each pair of divisors.
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
        const auto divisors = detail::divisors_of(ranks);
        for (const auto first : divisors) {
            const auto rest = ranks / first;
            if constexpr (D == 2) {
                consider({first, rest});
            } else {
                for (const auto second : divisors)
                    if (rest % second == 0) consider({first, second, rest / second});
            }
        }
    }
    return best;
}

}  // namespace tsubu
