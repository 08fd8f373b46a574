// SPDX-License-Identifier: MIT
/// @file
/// Which subdomains, and images of them, lie within a cutoff of one.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/neighbor_rank.hpp>

#include <algorithm>  // std::max
#include <array>      // std::array
#include <cmath>      // std::abs, std::floor
#include <concepts>   // std::integral
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <limits>     // std::numeric_limits
#include <vector>     // std::vector

namespace tsubu::detail {

/// The closed stretch [lo, hi] of one axis.
template <class Real>
struct stretch {
    Real lo;
    Real hi;
};

/// An interval of an axis as a stretch in real units: to the first coordinate of the next part, or to the face.
template <class Scalar>
[[nodiscard]] auto real_stretch(const axis<Scalar>& along, const interval<Scalar>& part) noexcept {
    const bool is_last = part.last == along.inside().last;
    return stretch<typename axis<Scalar>::real_type>{along.to_real(part.first),
                                                     is_last ? along.real().hi() : along.to_real(after(part.last))};
}

/// An image that reaches, and the gap that remains at least, however its ends were rounded [m].
template <class Real>
struct reaching_image {
    std::int64_t shift;
    Real gap;
};

/// All shifts n with [other.lo + n L, other.hi + n L] within the reach of mine, in increasing order. Rounding may let
/// in an image that is a few units in the last place too far, and keeps out none.
/// @throws input_error as axis::check_reach.
template <class Real>
[[nodiscard]] std::vector<reaching_image<Real>> reaching_images(const char* where, const axis<Real>& along,
                                                                stretch<Real> mine, stretch<Real> other, Real reach) {
    constexpr Real slack = 8 * std::numeric_limits<Real>::epsilon();
    std::vector<reaching_image<Real>> found;
    const auto try_shift = [&](std::int64_t n) {
        const auto moved = static_cast<Real>(n) * along.length();
        // Rounded the same way if mine and other change places and n its sign: neighbourhood is mutual.
        const Real below = (mine.lo - other.hi) - moved;
        const Real above = (other.lo - mine.hi) + moved;
        const Real size = (std::max)({std::abs(moved), std::abs(along.lo()), std::abs(along.hi())});
        const Real gap = (std::max)({below, above, slack * size}) - slack * size;
        if (gap <= reach) found.push_back({n, gap});
    };
    if (!along.is_periodic()) {
        try_shift(0);
        return found;
    }
    along.check_reach(where, reach);
    const auto most = static_cast<std::int64_t>(std::floor(reach / along.length())) + 2;
    for (std::int64_t n = -most; n <= most; ++n) try_shift(n);
    return found;
}

/// The ranks whose parts of a cell, or images of them, lie near that of `rank`, in increasing order of rank and shift.
///
/// @param reach     reach(mine, theirs) is how near along each axis [D], for two subdomains.
/// @param is_round  the reach is the same length along all axes, which are at right angles: what is near along each of
///                  them may yet be too far across a corner.
template <class Domain, class Decomposition, std::integral Rank, class Reach>
[[nodiscard]] auto neighbors_within(const char* where, const Domain& cell, const Decomposition& parts, Rank which,
                                    Reach&& reach, bool is_round) {
    using Real = typename Domain::real_type;
    constexpr std::size_t D = Domain::dimension;
    // 128 MB of them, and a cutoff of 100 boxes in all directions; beyond it the unit of the cutoff is wrong.
    constexpr std::size_t most_neighbors = std::size_t{1} << 22;
    const auto refuse = [&] {
        raise<input_error>(where, "the cutoff reaches more than 2^22 images of ranks",
                           "take a smaller cutoff, or a larger box");
    };
    const auto rank = checked_rank(where, which, parts.ranks());
    const auto mine = parts.subdomain(rank);
    std::vector<neighbor_rank<D>> found;
    std::array<std::vector<reaching_image<Real>>, D> images;
    vec<D, Real> near{};
    image_shift<D> shift{};
    for (std::size_t other = 0; other < parts.ranks(); ++other) {
        const auto theirs = parts.subdomain(other);
        near = reach(mine, theirs);
        for (std::size_t k = 0; k < D; ++k)
            images[k] = reaching_images<Real>(where, cell.real_axis(k), {mine.lo()[k], mine.hi()[k]},
                                              {theirs.lo()[k], theirs.hi()[k]}, near[k]);
        double combinations = 1;  // of which a sphere takes half
        for (const auto& along : images) combinations *= static_cast<double>(along.size());
        if (combinations > 4.0 * most_neighbors) refuse();
        const auto combine = [&](auto&& self, std::size_t k, Real square) -> void {
            if (k == D) {
                if (other != rank || shift != image_shift<D>{}) found.push_back({static_cast<rank_t>(other), shift});
                if (found.size() > most_neighbors) refuse();
                return;
            }
            for (const auto& image : images[k]) {
                const Real ratio = near[k] > 0 && is_round ? image.gap / near[k] : 0;
                const Real further = square + ratio * ratio;
                if (further > 1 + 8 * std::numeric_limits<Real>::epsilon()) continue;
                shift[k] = image.shift;
                self(self, k + 1, further);
            }
        };
        combine(combine, 0, 0);
    }
    return found;  // by rank, and by shift along the first axis, then the next
}

/// The same in a box with right angles.
template <class Decomposition, std::integral Rank, class Real>
[[nodiscard]] auto neighbors_within(const char* where, const Decomposition& parts, Rank rank, Real cutoff) {
    check_cutoff(where, cutoff);
    vec<Decomposition::dimension, Real> reach{};
    reach.fill(cutoff);
    return neighbors_within(
        where, parts.whole(), parts, rank, [&](const auto&, const auto&) { return reach; }, true);
}

}  // namespace tsubu::detail
