// SPDX-License-Identifier: MIT
/// @file
/// pair_reach: up to which distance two particles are neighbours.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::max
#include <concepts>   // std::convertible_to
#include <cstddef>    // std::size_t
#include <span>       // std::span
#include <utility>    // std::move

namespace tsubu {

/// Up to which distance two particles are neighbours.
///  1. greatest() is at least the distance of any pair [m];
///  2. sorted<Real>(origin, count)(a, b) is the square of the distance of particles origin[a] and origin[b] [m^2], and
///     depends on no order of the two.
template <class Reach>
concept pair_reach = requires(const Reach& reach, const index_t* origin) {
    { reach.greatest() } -> std::convertible_to<double>;
    { reach.template sorted<double>(origin, std::size_t{})(std::size_t{}, std::size_t{}) } -> std::convertible_to<double>;
};

/// The same distance for all pairs.
///
/// Concept: pair_reach. Choose it where particles are of one size. Do not where few are far larger than most: all
/// pairs are kept up to the distance of the largest then.
struct same_reach {
    double distance;  ///< [m]

    [[nodiscard]] double greatest() const noexcept { return distance; }
    template <class Real>
    [[nodiscard]] auto sorted(const index_t*, std::size_t) const noexcept {
        return [square = static_cast<Real>(distance) * static_cast<Real>(distance)](std::size_t, std::size_t) {
            return square;
        };
    }
};
static_assert(pair_reach<same_reach>);

/// The sum of the two radii and a skin.
///
/// Concept: pair_reach. Choose it where sizes differ. Do not where they do not: same_reach needs no radii.
/// @tparam Radius  the type of the radii
template <class Radius = double>
struct radii_reach {
    std::span<const Radius> radii;  ///< of all particles, owned and ghosts [m]
    double skin;                    ///< [m]

    [[nodiscard]] double greatest() const noexcept {
        Radius most = 0;
        for (const auto r : radii) most = (std::max)(most, r);
        return 2 * static_cast<double>(most) + skin;
    }
    template <class Real>
    [[nodiscard]] auto sorted(const index_t* origin, std::size_t count) const {
        buffer<Real> half(count, {});  // of the distance: a radius and half of the skin
        for (std::size_t a = 0; a < count; ++a)
            half[a] = static_cast<Real>(radii[static_cast<std::size_t>(origin[a])]) + static_cast<Real>(skin / 2);
        return [half = std::move(half)](std::size_t a, std::size_t b) {
            const auto sum = half[a] + half[b];
            return sum * sum;
        };
    }
};
static_assert(pair_reach<radii_reach<>>);

}  // namespace tsubu
