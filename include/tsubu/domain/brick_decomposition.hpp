// SPDX-License-Identifier: MIT
/// @file
/// brick_decomposition: a grid of cuts along each axis.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/border.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/cuts.hpp>
#include <tsubu/domain/detail/each_point.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/detail/owners_of.hpp>
#include <tsubu/domain/detail/reach.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/neighbor_rank.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/domain/rank_grid.hpp>
#include <tsubu/domain/subdomain.hpp>

#include <algorithm>  // std::fill, std::min
#include <array>      // std::array
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int32_t
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::index_sequence, std::move
#include <vector>     // std::vector

namespace tsubu {

/// A grid of bricks, one per rank: rank = (m_x p_y + m_y) p_z + m_z at place m of a grid p.
///
///     tsubu::brick_decomposition<3> bricks(box, 12);   // grid of least surface
///     const auto rank = bricks.owner(x);
///
/// Concept:      decomposition; with padded in form only.
/// Cost:         owner O(D) for equal parts, O(D log ranks) in the worst case; of many points, one comparison per cut
///               and point up to 24 cuts; subdomain O(D); neighbors O(ranks) for cutoffs up to the box.
/// Deterministic: yes, the same on every machine.
/// Choose it when particles fill the box evenly, or are uneven along one axis. Do not when they are heaped up:
///               bisection_decomposition gives each rank equally many.
/// Source:       B2 to B5 as decided.
template <std::size_t D, class Scalar = double, border_policy<Scalar> Border = exact>
class brick_decomposition {
public:
    using box_type = domain<D, Scalar, Border>;
    using scalar_type = Scalar;
    using real_type = typename box_type::real_type;
    using position_type = typename box_type::position_type;
    static constexpr std::size_t dimension = D;

    /// Equal bricks, on the grid of least surface.
    /// @throws input_error if ranks is 0, or more than the scalar tells apart along some axis.
    brick_decomposition(const box_type& whole, std::size_t ranks)
        : brick_decomposition(whole, rank_grid<D>(ranks, lengths_of(whole))) {}
    /// Equal bricks on a given grid.
    /// @throws input_error if it has 0 parts along an axis, or more than the scalar tells apart.
    brick_decomposition(const box_type& whole, const std::array<std::size_t, D>& grid)
        : whole_(whole), cuts_(equal_cuts(whole, grid, std::make_index_sequence<D>{})) {
        check_ranks();
    }
    /// Given cuts, one table per axis. @throws input_error if one of them is of another axis.
    brick_decomposition(const box_type& whole, std::array<cuts<Scalar>, D> where)
        : whole_(whole), cuts_(std::move(where)) {
        for (std::size_t k = 0; k < D; ++k) {
            const auto given = cuts_[k].whole().inside();
            const auto own = whole.along(k).inside();
            if (!(given.first == own.first) || !(given.last == own.last))
                detail::raise<input_error>("brick_decomposition",
                                           "the cuts for axis " + std::to_string(k) + " are of an axis from " +
                                               detail::shown(given.first) + " to " + detail::shown(given.last),
                                           "make them with domain::along(k)");
        }
        check_ranks();
    }

    [[nodiscard]] const box_type& whole() const noexcept { return whole_; }
    [[nodiscard]] const cuts<Scalar>& along(std::size_t k) const noexcept { return cuts_[k]; }
    [[nodiscard]] std::size_t ranks() const noexcept {
        std::size_t product = 1;
        for (const auto& axis_cuts : cuts_) product *= axis_cuts.parts();
        return product;
    }
    /// The place of a rank in the grid [D].
    [[nodiscard]] std::array<std::size_t, D> place(std::size_t rank) const noexcept {
        std::array<std::size_t, D> at{};
        for (std::size_t k = D; k-- > 0;) {
            at[k] = rank % cuts_[k].parts();
            rank /= cuts_[k].parts();
        }
        return at;
    }
    [[nodiscard]] rank_t rank_at(const std::array<std::size_t, D>& place) const noexcept {
        std::size_t rank = 0;
        for (std::size_t k = 0; k < D; ++k) rank = rank * cuts_[k].parts() + place[k];
        return static_cast<rank_t>(rank);
    }
    /// The rank of any finite point: beyond the faces, that of the nearest brick along each axis (B4). Precondition: no
    /// coordinate is NaN.
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept {
        std::array<std::size_t, D> at{};
        for (std::size_t k = 0; k < D; ++k) at[k] = cuts_[k].part_of(x[k]);
        return rank_at(at);
    }
    /// The same for each of many points. Precondition: no coordinate is NaN. @throws input_error if the lengths differ.
    void owner(const points<D, const Scalar>& x, std::span<rank_t> owners) const {
        detail::check_answers("brick_decomposition::owner", owners.size(), x.size());
        std::size_t cut_count = 0;
        for (const auto& axis_cuts : cuts_) cut_count += axis_cuts.parts() - 1;
        if (cut_count > few_cuts) return detail::owners_of("brick_decomposition::owner", *this, x, owners);
        // The part of a coordinate is the number of cuts at or below it: counted without a branch, in blocks that stay
        // in the first-level cache.
        constexpr std::size_t block = 1024;
        x.visit([&](auto at) {
            for (std::size_t begin = 0; begin < x.size(); begin += block) {
                const auto count = (std::min)(block, x.size() - begin);
                rank_t* const out = owners.data() + begin;
                std::fill(out, out + count, rank_t{0});
                std::size_t stride = 1;
                for (std::size_t k = D; k-- > 0; stride *= cuts_[k].parts())
                    for (std::size_t part = 1; part < cuts_[k].parts(); ++part)
                        detail::each_point(
                            count, out,
                            [ =, cut = detail::comparable(cuts_[k].begin(part)),
                              step = static_cast<rank_t>(stride) ](std::size_t i) __attribute__((always_inline)) {
                                return out[i] + (detail::comparable(at(begin + i, k)) >= cut ? step : 0);
                            });
            }
        });
    }
    /// @throws input_error if there is no such rank.
    template <std::integral Rank>
    [[nodiscard]] tsubu::subdomain<D, Scalar> subdomain(Rank which) const {
        const auto rank = detail::checked_rank("brick_decomposition::subdomain", which, ranks());
        const auto at = place(rank);
        std::array<interval<Scalar>, D> owned{};
        std::array<interval<Scalar>, D> extended{};
        vec<D, real_type> lo{};
        vec<D, real_type> hi{};
        for (std::size_t k = 0; k < D; ++k) {
            owned[k] = whole_.border().owned(cuts_[k], at[k]);
            extended[k] = whole_.border().owned_extended(cuts_[k], at[k]);
            const auto [from, to] = detail::real_stretch(whole_.along(k), cuts_[k].owned(at[k]));
            lo[k] = from;
            hi[k] = to;
        }
        return {owned, extended, lo, hi};
    }
    /// The ranks, and images of ranks, within a cutoff of one, itself included where an image of it is. Any cutoff:
    /// more than a brick, more than the box. @throws input_error if the cutoff is negative or not finite, or there is
    /// no such rank.
    template <std::integral Rank>
    [[nodiscard]] std::vector<neighbor_rank<D>> neighbors(Rank rank, real_type cutoff) const {
        return detail::neighbors_within("brick_decomposition::neighbors", *this, rank, cutoff);
    }

private:
    // A batched owner costs 1/30 ns per cut and point, a guessed one 10 to 30 ns per point, most of it branches that
    // were predicted wrong; with more cuts they come close in slow caches.
    static constexpr std::size_t few_cuts = 24;

    [[nodiscard]] static vec<D, real_type> lengths_of(const box_type& whole) noexcept {
        vec<D, real_type> lengths{};
        for (std::size_t k = 0; k < D; ++k) lengths[k] = whole.along(k).length();
        return lengths;
    }
    template <std::size_t... K>
    [[nodiscard]] static std::array<cuts<Scalar>, D> equal_cuts(const box_type& whole,
                                                                const std::array<std::size_t, D>& grid,
                                                                std::index_sequence<K...>) {
        const auto along = [&](std::size_t k) {
            return detail::with_axis(k, "bricks", [&] { return cuts<Scalar>(whole.along(k), grid[k]); });
        };
        return {along(K)...};
    }
    void check_ranks() const {
        double product = 1;
        for (const auto& axis_cuts : cuts_) product *= static_cast<double>(axis_cuts.parts());
        if (product > detail::most_ranks)
            detail::raise<input_error>("brick_decomposition", detail::shown(product) + " bricks",
                                       "make at most 2^31 - 1: no communicator has more ranks");
    }

    box_type whole_;
    std::array<cuts<Scalar>, D> cuts_;
};
static_assert(decomposition<brick_decomposition<3>> && decomposition<brick_decomposition<1, float>> &&
              decomposition<brick_decomposition<2, lattice<std::int32_t>>> &&
              decomposition<brick_decomposition<3, double, padded>>);

}  // namespace tsubu
