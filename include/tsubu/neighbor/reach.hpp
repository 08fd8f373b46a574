// SPDX-License-Identifier: MIT
/// @file
/// pair_reach: up to which distance two particles are neighbours; and the table of the shipped ones.
///
/// | reach       | cost of a pair                    | bytes | choose it when            |
/// |-------------|-----------------------------------|-------|---------------------------|
/// | same_reach  | a product, outside of loops       | 8     | particles are of one size |
/// | radii_reach | two loads, two sums and a product | 24    | sizes differ              |
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>  // std::max
#include <concepts>   // std::same_as, std::convertible_to
#include <cstddef>    // std::size_t
#include <span>       // std::span
#include <string>     // std::to_string

namespace tsubu {

/// Up to which distance two particles are neighbours. testing::check_pair_reach judges one of your own.
///  1. greatest(N) is at least the distance of any pair of particles 0 .. N-1 [m];
///  2. square<Real>(i, j) is the square of the distance of particles i and j [m^2]; it is that of j and i.
template <class Reach>
concept pair_reach = requires(const Reach& reach, index_t i) {
    { reach.greatest(std::size_t{}) } -> std::convertible_to<double>;
    { reach.template square<double>(i, i) }
    noexcept->std::same_as<double>;
    { reach.template square<float>(i, i) }
    noexcept->std::same_as<float>;
};

/// The same distance for all pairs.
///
/// Concept:        pair_reach.
/// Cost:           greatest O(1); square a product, which compilers move out of loops.
/// Bytes:          8, and none per particle.
/// Deterministic:  yes.
/// Choose it where particles are of one size.
/// Do not where    few are far larger than most: all pairs are kept up to the distance of the largest then.
struct same_reach {
    double distance;  ///< [m]

    [[nodiscard]] double greatest(std::size_t) const noexcept { return distance; }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real square(index_t, index_t) const noexcept {
        const auto length = static_cast<Real>(distance);
        return length * length;
    }
};
static_assert(pair_reach<same_reach>);

/// The sum of the two radii and a skin.
///
/// Concept:        pair_reach.
/// Cost:           greatest O(N), which looks at all radii; square a load of each radius, two sums and a product.
/// Bytes:          24, and none per particle: the radii are those of the particles.
/// Deterministic:  yes.
/// Choose it where sizes differ.
/// Do not where    they do not: same_reach needs no radii.
/// @tparam Radius  the type of the radii
template <class Radius = double>
struct radii_reach {
    std::span<const Radius> radii;  ///< of all particles, owned and ghosts [m]
    double skin;                    ///< at least 0 [m]

    /// @throws input_error if there are not as many radii, or one is no length of at least 0, or the skin is negative.
    [[nodiscard]] double greatest(std::size_t count) const {
        if (radii.size() < count)
            detail::raise<input_error>("radii_reach",
                                       std::to_string(radii.size()) + " radii of " + std::to_string(count) +
                                           " particles",
                                       "give those of the ghosts too");
        if (!(skin >= 0))
            detail::raise<input_error>("radii_reach", "a skin of " + detail::shown(skin) + " m", "give at least 0");
        Radius most = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (!(radii[i] >= 0) || !detail::is_finite(radii[i]))
                detail::raise<input_error>("radii_reach",
                                           "the radius of particle " + std::to_string(i) + " is " +
                                               detail::shown(radii[i]) + " m",
                                           "give a finite length of at least 0");
            most = (std::max)(most, radii[i]);
        }
        return 2 * static_cast<double>(most) + skin;
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real square(index_t i, index_t j) const noexcept {
        const auto sum = static_cast<Real>(radii[static_cast<std::size_t>(i)]) +
                         static_cast<Real>(radii[static_cast<std::size_t>(j)]) + static_cast<Real>(skin);
        return sum * sum;
    }
};
static_assert(pair_reach<radii_reach<>>);

}  // namespace tsubu
