// SPDX-License-Identifier: MIT
/// @file
/// Which subdomains, and images of them, lie within a cutoff of one.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/neighbor_rank.hpp>

#include <algorithm>  // std::max, std::min
#include <array>      // std::array
#include <cmath>      // std::abs, std::floor
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <limits>   // std::numeric_limits
#include <vector>   // std::vector

namespace tsubu::detail {

/// The closed stretch [lo, hi] of one axis.
template <class Real>
struct stretch {
    Real lo;
    Real hi;
};

/// An image that reaches, and the gap that remains at least, however its ends were rounded [m].
template <class Real>
struct reaching_image {
    std::int64_t shift;
    Real gap;
};

/// @throws input_error if the cutoff is negative, infinite or NaN, or more than 2^20 periods of some axis.
template <class Real>
void check_cutoff(const char* where, Real cutoff, Real shortest_period) {
    if (!(cutoff >= 0) || !is_finite(cutoff))
        raise<input_error>(where, "the cutoff " + shown(cutoff), "give a finite length of at least 0");
    if (cutoff / shortest_period > static_cast<Real>(1 << 20))
        raise<input_error>(where, "the cutoff " + shown(cutoff) + " reaches over more than 2^20 periods of " +
                                      shown(shortest_period),
                           "take a smaller cutoff, or a larger box");
}

/// All shifts n with [other.lo + n L, other.hi + n L] within the cutoff of mine, in increasing order. Rounding may let in an
/// image that is a few units in the last place too far, and keeps out none.
template <class Real>
[[nodiscard]] std::vector<reaching_image<Real>> reaching_images(const axis<Real>& along, stretch<Real> mine,
                                                               stretch<Real> other, Real cutoff) {
    constexpr Real slack = 8 * std::numeric_limits<Real>::epsilon();
    std::vector<reaching_image<Real>> found;
    const auto try_shift = [&](std::int64_t n) {
        const auto moved = static_cast<Real>(n) * along.length();
        // Rounded the same way if mine and other change places and n its sign: neighbourhood is mutual.
        const Real below = (mine.lo - other.hi) - moved;
        const Real above = (other.lo - mine.hi) + moved;
        const Real size = (std::max)({std::abs(moved), std::abs(along.lo()), std::abs(along.hi())});
        const Real gap = (std::max)({below, above, slack * size}) - slack * size;
        if (gap <= cutoff) found.push_back({n, gap});
    };
    if (!along.is_periodic()) {
        try_shift(0);
        return found;
    }
    const auto most = static_cast<std::int64_t>(std::floor(cutoff / along.length())) + 2;
    for (std::int64_t n = -most; n <= most; ++n) try_shift(n);
    return found;
}

/// The ranks whose subdomains, or images of them, lie within the cutoff of that of `rank`, in increasing order of rank and
/// shift. box_of(rank) has one stretch per axis.
template <class Domain, class BoxOf>
[[nodiscard]] auto neighbors_within(const char* where, const Domain& whole, std::size_t ranks, std::size_t rank,
                                    typename Domain::real_type cutoff, BoxOf&& box_of) {
    using Real = typename Domain::real_type;
    constexpr std::size_t D = Domain::dimension;
    auto shortest_period = std::numeric_limits<Real>::infinity();
    for (std::size_t k = 0; k < D; ++k)
        if (whole.real_axis(k).is_periodic())
            shortest_period = (std::min)(shortest_period, whole.real_axis(k).length());
    check_cutoff(where, cutoff, shortest_period);
    const auto mine = box_of(rank);
    std::vector<neighbor_rank<D>> found;
    std::array<std::vector<reaching_image<Real>>, D> images;
    image_shift<D> shift{};
    for (std::size_t other = 0; other < ranks; ++other) {
        const auto theirs = box_of(other);
        for (std::size_t k = 0; k < D; ++k)
            images[k] = reaching_images(whole.real_axis(k), mine[k], theirs[k], cutoff);
        const auto combine = [&](auto&& self, std::size_t k, Real square) -> void {
            if (k == D) {
                if (other != rank || shift != image_shift<D>{}) found.push_back({other, shift});
                return;
            }
            for (const auto& image : images[k]) {
                const Real ratio = cutoff > 0 ? image.gap / cutoff : 0;
                const Real further = square + ratio * ratio;  // corners are farther than their axes
                if (further > 1 + 8 * std::numeric_limits<Real>::epsilon()) continue;
                shift[k] = image.shift;
                self(self, k + 1, further);
            }
        };
        combine(combine, 0, 0);
    }
    return found;  // by rank, and by shift along the first axis, then the next
}

}  // namespace tsubu::detail
