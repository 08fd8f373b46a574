// SPDX-License-Identifier: MIT
/// @file
/// halo_pattern: which ranks ghosts go to, in which steps; and the table of the models.
///
/// | pattern        | messages per step and rank             | choose it when                                        |
/// |----------------|----------------------------------------|-------------------------------------------------------|
/// | direct_pattern | one to each rank within the cutoff     | any decomposition; ghosts are to arrive in one step   |
/// | staged_pattern | two per axis, one axis after the other | bricks; messages are dear, and there are 26 neighbours |
#pragma once

#include <tsubu/comm/detail/frame.hpp>
#include <tsubu/comm/detail/near_part.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/lattice.hpp>

#include <algorithm>  // std::max
#include <array>      // std::array
#include <cmath>      // std::abs
#include <concepts>   // std::same_as
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu {

/// A rank that gets ghosts, as images of one shift, and which ones.
template <decomposition Parts>
struct halo_asker {
    rank_t rank;
    image_shift<Parts::dimension> shift;  ///< of the ghosts, from where their particles are here
    detail::near_part<Parts> near;        ///< which particles it wants: those near its subdomain
};
/// A round of messages. What may go are the groups from .. to - 1 of particles: group 0 are the owned ones, group k the
/// ghosts that have come in step k - 1.
template <decomposition Parts>
struct halo_step {
    std::size_t from = 0;
    std::size_t to = 1;
    std::vector<halo_asker<Parts>> askers{};  ///< who gets ghosts in this step
};

/// How ghosts reach those that ask for them.
///  1. plan(parts, rank, cutoff) has as many steps on all ranks; each step takes from groups that are there by then;
///  2. after all steps each rank has a ghost of every image that lies within the cutoff of its subdomain, but of its
///     own particles as they are, and each image once.
template <class Pattern, class Parts>
concept halo_pattern = decomposition<Parts> && requires(const Pattern& pattern, const Parts& parts, rank_t rank,
                                                        typename Parts::real_type cutoff) {
    { pattern.plan(parts, rank, cutoff) } -> std::same_as<std::vector<halo_step<Parts>>>;
};

/// Every ghost comes straight from its owner, in one step.
///
/// Concept:      halo_pattern, of any decomposition.
/// Cost:         a message to and from each rank within the cutoff: up to 26 for bricks larger than it. Ghosts are the
///               images within the cutoff, and no others.
/// Deterministic: yes.
/// Choose it when work is to go on while ghosts are on their way. Do not when messages are dear, and neighbours many.
struct direct_pattern {
    template <decomposition Parts>
    [[nodiscard]] std::vector<halo_step<Parts>> plan(const Parts& parts, rank_t rank,
                                                     typename Parts::real_type cutoff) const {
        halo_step<Parts> step;
        const auto here = parts.subdomain(rank);
        for (const auto& [other, shift] : parts.neighbors(rank, cutoff)) {
            // What is there, moved by shift, is near; so is what is here, moved back, near there.
            auto there = detail::opposite(shift);
            if constexpr (cyclic_box<typename Parts::box_type>) there = parts.whole().same_image(there);
            step.askers.push_back({other, there, {parts, cutoff, here, parts.subdomain(other), there}});
        }
        std::vector<halo_step<Parts>> steps;
        steps.push_back(std::move(step));
        return steps;
    }
};
static_assert(halo_pattern<direct_pattern, brick_decomposition<3>>);

namespace detail {

/// The bricks behind a decomposition, in coordinates of the cell.
template <std::size_t D, class Scalar, class Border>
[[nodiscard]] const auto& bricks_of(const brick_decomposition<D, Scalar, Border>& parts) noexcept {
    return parts;
}
template <class Box, std::size_t D, class Scalar, class Border>
[[nodiscard]] const auto& bricks_of(
    const cell_decomposition<Box, brick_decomposition<D, Scalar, Border>>& parts) noexcept {
    return parts.parts();
}

}  // namespace detail

/// Ghosts go along one axis after the other, to the next brick on either side; what has come along one axis goes on
/// along the next, and as many bricks far as the cutoff reaches.
///
/// Concept:      halo_pattern, of bricks in a domain or a triclinic_box, whose coordinates are not on a lattice.
/// Cost:         two messages to and from each rank and axis, or more if the cutoff is longer than a brick, one after
///               the other. Ghosts are the images within the cutoff along each axis: at the corners more than
///               direct_pattern has.
/// Deterministic: yes.
/// Choose it when messages are dear. Do not when there is work to be done while ghosts are on their way: all but those
///               of the first step wait for finish.
/// Source:       Plimpton 1995, "Fast parallel algorithms for short-range molecular dynamics", section 5,
///               doi:10.1006/jcph.1995.1039.
struct staged_pattern {
    template <decomposition Parts>
        requires(!cyclic_box<typename Parts::box_type> && !is_lattice<typename Parts::scalar_type> &&
                 requires(const Parts& parts) { detail::bricks_of(parts); })
    [[nodiscard]] std::vector<halo_step<Parts>> plan(const Parts& parts, rank_t rank,
                                                     typename Parts::real_type cutoff) const {
        const auto& bricks = detail::bricks_of(parts);
        const auto place = bricks.place(rank);
        const auto here = parts.subdomain(rank);
        std::vector<halo_step<Parts>> steps;
        for (std::size_t axis = 0; axis < Parts::dimension; ++axis) {
            const auto groups = steps.size() + 1;
            const auto reach = detail::near_part<Parts>::reach_of(parts, cutoff, here, here)[axis];
            bricks.whole().along(axis).real().check_reach("make_halo", reach);
            for (const bool upwards : {true, false})
                for (std::size_t hop = 0, hops = hops_along(bricks, axis, reach); hop < hops; ++hop) {
                    halo_step<Parts> step;
                    step.from = hop == 0 ? 0 : steps.size();  // all of before this axis, or what the last hop brought
                    step.to = hop == 0 ? groups : steps.size() + 1;
                    add_next(step, parts, bricks, place, axis, upwards, cutoff, here);
                    steps.push_back(std::move(step));
                }
        }
        return steps;
    }

private:
    template <class Parts, class Bricks, class Place, class Part>
    static void add_next(halo_step<Parts>& step, const Parts& parts, const Bricks& bricks, Place place,
                         std::size_t axis, bool upwards, typename Parts::real_type cutoff, const Part& here) {
        const auto count = bricks.along(axis).parts();
        image_shift<Parts::dimension> shift{};
        const bool is_last = upwards ? place[axis] + 1 == count : place[axis] == 0;
        if (is_last && !bricks.whole().along(axis).is_periodic()) return;
        if (is_last) shift[axis] = upwards ? -1 : 1;
        place[axis] = (place[axis] + (upwards ? 1 : count - 1)) % count;
        const auto next = bricks.rank_at(place);
        detail::near_part<Parts> near(parts, cutoff, here, parts.subdomain(next), shift);
        near.only_along(axis);
        step.askers.push_back({next, shift, near});
    }
    // How many bricks far the cutoff reaches from some brick, at most.
    template <class Bricks, class Real>
    [[nodiscard]] static std::size_t hops_along(const Bricks& bricks, std::size_t axis, Real reach) {
        const auto& along = bricks.whole().along(axis);
        const auto count = bricks.along(axis).parts();
        std::vector<Real> widths(count);
        for (std::size_t k = 0; k < count; ++k) {
            std::array<std::size_t, Bricks::dimension> place{};
            place[axis] = k;
            const auto part = bricks.subdomain(bricks.rank_at(place));
            widths[k] = part.hi()[axis] - part.lo()[axis];
        }
        const bool is_periodic = along.is_periodic();
        // However widths were rounded: a hop too many brings nothing, one too few loses ghosts.
        const Real slack = 8 * std::numeric_limits<Real>::epsilon() *
                           (std::abs(along.real().lo()) + std::abs(along.real().hi()));
        std::size_t most = 0;
        for (std::size_t first = 0; first < count; ++first) {
            // Bricks between `first` and the one that is reached take up room.
            std::size_t hops = 0;
            Real left = reach;
            for (auto at = first; left >= -slack && (is_periodic || at + 1 < count); ++hops) {
                at = (at + 1) % count;
                left -= widths[at];
            }
            most = (std::max)(most, hops);
        }
        return most;
    }
};
static_assert(halo_pattern<staged_pattern, brick_decomposition<3>>);

}  // namespace tsubu
