// SPDX-License-Identifier: MIT
/// @file
/// Decompositions that give every rank the same share of measured work.
///
/// | function       | decomposition            | choose it when                                                     |
/// |----------------|--------------------------|--------------------------------------------------------------------|
/// | balanced_bricks| brick_decomposition      | particles are uneven along single axes: a layer, a slope           |
/// | balanced_parts | bisection_decomposition  | they are uneven in other ways: a heap, a jet                       |
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cuts.hpp>

#include <algorithm>  // std::fill, std::max, std::min
#include <array>      // std::array
#include <cmath>      // std::isfinite
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <cstring>    // std::memcpy
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu {
namespace detail {

/// Weights in steps of a unit, so that sums depend neither on the order in which they are taken nor on the number of
/// ranks.
class counted_weights {
public:
    /// @throws on all ranks or none: input_error if a weight is negative or not finite, or there is not one for each.
    template <transport Transport>
    counted_weights(Transport& on, const char* where, std::span<const double> weights, std::size_t particles)
        : weights_(weights) {
        double greatest[] = {weights.empty() && particles != 0 ? 1.0 : 0.0};
        agreement<1> all(on.rank());
        all.attempt([&] {
            if (!weights.empty() && weights.size() != particles)
                raise<input_error>(where,
                                   std::to_string(weights.size()) + " weights for " + std::to_string(particles) +
                                       " particles",
                                   "give one for each owned particle, or none: then all are 1");
            for (std::size_t i = 0; i < weights.size(); ++i) {
                if (!(weights[i] >= 0) || !std::isfinite(weights[i]))
                    raise<input_error>(where, "weight " + shown(weights[i]) + " of the particle at index " +
                                                  std::to_string(i),
                                       "weights are finite, and at least 0");
                greatest[0] = (std::max)(greatest[0], weights[i]);
            }
        });
        all[0] = particles;
        on.reduce(all.words(), reduction::sum);
        all.settle(where);
        on.reduce(std::span<double>(greatest), reduction::greatest);
        // Of 2^63 in all, each particle may have as much as the heaviest.
        const auto particles_of_all = static_cast<double>((std::max)(all[0], std::uint64_t{1}));
        const auto most = static_cast<double>(std::uint64_t{1} << 62) / particles_of_all;
        scale_ = greatest[0] > 0 ? most / greatest[0] : 0;
    }
    [[nodiscard]] std::uint64_t operator[](std::size_t i) const noexcept {
        return static_cast<std::uint64_t>((weights_.empty() ? 1.0 : weights_[i]) * scale_);
    }

private:
    std::span<const double> weights_;
    double scale_ = 0;
};

/// The cuts along one axis that give each part the same weight, as near as cuts between bins can be.
///
/// Each round looks into the bin that a cut lies in, and divides it anew: 64 bins a round, until they are as narrow as
/// 2^-24 of the axis.
///
/// @param coordinate  coordinate(i) of particle i along the axis
template <class Scalar, class Coordinate, transport Transport>
[[nodiscard]] auto balanced_cuts(Transport& on, const axis<Scalar>& along, std::size_t parts, std::size_t particles,
                                 Coordinate&& coordinate, const counted_weights& weights) {
    using Real = typename axis<Scalar>::real_type;
    constexpr std::size_t bins = 64;
    constexpr int rounds = 4;  // 64^4 = 2^24
    struct cut {
        Real lo;
        Real hi;
        std::uint64_t below = 0;  // weight below lo
    };
    const Real first = along.real().lo();
    const Real last = along.real().hi();
    std::vector<cut> cuts(parts - 1, cut{first, last});
    std::uint64_t total = 0;
    std::vector<std::uint64_t> sums(cuts.size() * bins);
    for (int round = 0; round < rounds && !cuts.empty(); ++round) {
        std::fill(sums.begin(), sums.end(), 0);
        // All cuts share their first bins.
        const auto separate = round == 0 ? std::size_t{1} : cuts.size();
        for (std::size_t i = 0; i < particles; ++i) {
            const Real x = along.to_real(coordinate(i));
            for (std::size_t c = 0; c < separate; ++c) {
                if (x < cuts[c].lo || x >= cuts[c].hi) continue;
                const auto bin = static_cast<std::size_t>((x - cuts[c].lo) / (cuts[c].hi - cuts[c].lo) * Real{bins});
                sums[c * bins + (std::min)(bin, bins - 1)] += weights[i];
            }
        }
        on.reduce(std::span(sums).first(separate * bins), reduction::sum);
        if (round == 0)
            for (std::size_t b = 0; b < bins; ++b) total += sums[b];
        for (std::size_t c = 0; c < cuts.size(); ++c) {
            const auto* mine = sums.data() + (round == 0 ? 0 : c * bins);
            // floor(total (c + 1) / parts) without overflow
            const auto target = total / parts * (c + 1) + total % parts * (c + 1) / parts;
            std::size_t b = 0;
            while (b + 1 < bins && cuts[c].below + mine[b] < target) cuts[c].below += mine[b++];
            const Real width = (cuts[c].hi - cuts[c].lo) / Real{bins};
            const Real lo = cuts[c].lo + width * static_cast<Real>(b);
            cuts[c].hi = b + 1 == bins ? cuts[c].hi : cuts[c].lo + width * static_cast<Real>(b + 1);
            cuts[c].lo = lo;
        }
    }
    std::vector<Real> found;
    for (const auto& one : cuts) found.push_back(one.hi);
    return found;
}

/// Moves cuts apart until each part is at least so wide. Precondition: all of them have room.
template <class Real>
void widen(std::vector<Real>& cuts, Real lo, Real hi, Real least) noexcept {
    for (auto& cut : cuts) lo = cut = (std::max)(cut, lo + least);
    for (auto k = cuts.size(); k-- > 0;) hi = cuts[k] = (std::min)(cuts[k], hi - least);
}

}  // namespace detail

/// Bricks on a given grid whose slabs along each axis have the same work.
///
///     parts = tsubu::balanced_bricks(on, box, {4, 2, 1}, grains.owned()[tsubu::position<3>], seconds, cutoff);
///     tsubu::migrate(grains, parts, on);
///
/// The cuts follow from the particles and their weights alone, bit for bit whatever rank has them.
///
/// @param where      a box; the bricks are those of its cell: for a triclinic_box or a wedge, give them to
///                   cell_decomposition
/// @param grid       parts along each axis, on.ranks() in all [D]
/// @param positions  of the owned particles of this rank, inside the box [n]
/// @param weights    of each, such as its seconds or its contacts [n]; or none: then all are 1
/// @param least      width of a part along each axis, in units of the cell: at least the cutoff, if halos are not to
///                   reach over several ranks
/// @throws on all ranks: input_error if a weight is negative or not finite, there is not one for each, the grid has
///         not as many parts as there are ranks, or an axis has no room for so many parts of that width.
/// Complexity: four passes over the particles for each axis.
/// Collective: yes; the same box, grid and width on all ranks. Four reductions of 64 words per cut and axis.
template <transport Transport, class Box, class Positions>
[[nodiscard]] auto balanced_bricks(Transport& on, const Box& where, const std::array<std::size_t, Box::dimension>& grid,
                                   const Positions& positions, std::span<const double> weights = {},
                                   typename Box::real_type least = 0) {
    using Scalar = typename std::remove_cvref_t<decltype(where.cell())>::scalar_type;
    using Real = typename Box::real_type;
    constexpr auto D = Box::dimension;
    constexpr auto name = "balanced_bricks";
    const auto& cell = where.cell();
    std::size_t parts = 1;
    for (const auto count : grid) parts *= count;
    detail::check_ranks(name, parts, on.ranks());
    for (std::size_t k = 0; k < D; ++k) {
        const Real length = cell.along(k).real().length();
        if (!(least >= 0) || !(least * static_cast<Real>(grid[k]) <= length))
            detail::raise<input_error>(name,
                                       std::to_string(grid[k]) + " parts of a width of at least " +
                                           detail::shown(least) + " along axis " + std::to_string(k) +
                                           ", which is " + detail::shown(length) + " long",
                                       "take fewer parts along it, or a smaller width");
    }
    const detail::counted_weights counted(on, name, weights, positions.size());
    std::vector<cuts<Scalar>> along;
    for (std::size_t k = 0; k < D; ++k) {
        const auto& axis = cell.along(k);
        const auto lo = axis.real().lo();
        const auto hi = axis.real().hi();
        auto found = detail::balanced_cuts(
            on, axis, grid[k], positions.size(), [&](std::size_t i) { return where.to_cell(positions[i])[k]; },
            counted);
        // Where all lies in one point, parts would have no width.
        const auto narrowest = (hi - lo) / static_cast<Real>(grid[k]) * static_cast<Real>(1e-6);
        detail::widen(found, lo, hi, (std::max)(least, narrowest));
        std::vector<Scalar> inner;
        for (const auto x : found) inner.push_back(axis.from_real(x).position);
        along.emplace_back(axis, std::move(inner));
    }
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
        return brick_decomposition<D, Scalar>(cell, std::array<cuts<Scalar>, D>{std::move(along[K])...});
    }(std::make_index_sequence<D>{});
}

/// A bisection that gives every rank the same work, from a sample of all particles.
///
///     parts = tsubu::balanced_parts(on, box, grains.owned()[tsubu::position<3>], seconds, cutoff);
///     tsubu::migrate(grains, parts, on);
///
/// @param where      a box; the parts are those of its cell, as for balanced_bricks
/// @param positions  of the owned particles of this rank, inside the box [n]
/// @param weights    of each [n]; or none: then all are 1
/// @param least      width of a part along each axis, in units of the cell
/// @param sample     how many positions are gathered from all ranks together
/// @throws on all ranks: input_error as balanced_bricks; if a part is narrower than `least`, with the part and its
///         width.
/// Complexity: O(sample log sample); 8 (D + 1) bytes per position of the sample to each rank.
/// Collective: yes; the same box, width and sample on all ranks. A gather and three reductions.
template <transport Transport, class Box, class Positions>
[[nodiscard]] auto balanced_parts(Transport& on, const Box& where, const Positions& positions,
                                  std::span<const double> weights = {}, typename Box::real_type least = 0,
                                  std::size_t sample = 65536) {
    using Cell = std::remove_cvref_t<decltype(where.cell())>;
    using Scalar = typename Cell::scalar_type;
    using Position = typename Cell::position_type;
    constexpr auto D = Box::dimension;
    constexpr auto name = "balanced_parts";
    const detail::counted_weights counted(on, name, weights, positions.size());
    std::uint64_t total[] = {positions.size()};
    on.reduce(std::span<std::uint64_t>(total), reduction::sum);
    // Every stride-th particle of each rank, with the weight of those that it stands for.
    const auto stride = static_cast<std::size_t>(total[0] / (std::max)(sample, std::size_t{1}) + 1);
    std::vector<std::uint64_t> words;
    for (std::size_t i = 0; i < positions.size(); i += stride) {
        std::uint64_t weight = 0;
        for (auto j = i; j < positions.size() && j < i + stride; ++j) weight += counted[j];
        const auto at = where.to_cell(positions[i]);
        words.resize(words.size() + D);
        for (std::size_t k = 0; k < D; ++k) std::memcpy(words.data() + words.size() - D + k, &at[k], sizeof(at[k]));
        words.push_back(weight);
    }
    std::vector<Position> points;
    std::vector<double> shares;
    for (const auto& [from, told] : on.gather(words))
        for (std::size_t at = 0; at < told.size(); at += D + 1) {
            Position x{};
            for (std::size_t k = 0; k < D; ++k) std::memcpy(&x[k], told.data() + at + k, sizeof(x[k]));
            points.push_back(x);
            shares.push_back(static_cast<double>(told[at + D]));
        }
    bisection_decomposition<D, Scalar> parts(where.cell(), on.ranks(), points, shares);
    for (std::size_t rank = 0; rank < parts.ranks(); ++rank)
        if (const auto [width, axis] = parts.subdomain(rank).min_extent(); width < least)
            detail::raise<input_error>(name,
                                       "the part of rank " + std::to_string(rank) + " would be " +
                                           detail::shown(width) + " wide along axis " + std::to_string(axis) +
                                           ", less than " + detail::shown(least),
                                       "take fewer ranks, a smaller width, or balanced_bricks");
    return parts;
}

}  // namespace tsubu
