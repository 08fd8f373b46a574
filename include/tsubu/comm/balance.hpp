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
#include <tsubu/comm/detail/agreed.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cuts.hpp>

#include <algorithm>    // std::max, std::min
#include <array>        // std::array
#include <cmath>        // std::isfinite
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy
#include <optional>     // std::optional
#include <span>         // std::span
#include <string>       // std::to_string
#include <type_traits>  // std::remove_cvref_t
#include <utility>      // std::forward, std::index_sequence, std::make_index_sequence, std::move
#include <vector>       // std::vector

namespace tsubu {
namespace detail {

/// Weights in steps of a unit, so that sums depend neither on the order in which they are taken nor on the number of
/// ranks.
class counted_weights {
public:
    /// @param prepare  what else is to be done before messages; what it throws is thrown on all ranks too
    /// @throws on all ranks or none: input_error if a weight is negative or not finite, there is not one for each
    ///         particle, or some ranks have weights for their particles and others none.
    /// Collective: yes; two reductions.
    template <transport Transport, class Prepare>
    counted_weights(Transport& on, const char* where, std::span<const double> weights, std::size_t particles,
                    Prepare&& prepare)
        : weights_(weights) {
        enum : std::size_t { all_particles, ranks_with, ranks_without, sums };
        agreement<sums> all(on.rank());
        all.attempt([&] {
            std::forward<Prepare>(prepare)();
            greatest_ = greatest_of(where, particles);
        });
        all[all_particles] = particles;
        all[ranks_with] = particles != 0 && !weights.empty() ? 1 : 0;
        all[ranks_without] = particles != 0 && weights.empty() ? 1 : 0;
        on.reduce(all.words(), reduction::sum);
        all.settle(where);
        if (all[ranks_with] != 0 && all[ranks_without] != 0)
            raise<input_error>(where,
                               std::to_string(all[ranks_with]) + " ranks give weights, " +
                                   std::to_string(all[ranks_without]) + " with particles give none",
                               "give weights on all ranks, or on none");
        on.reduce(std::span<double>(&greatest_, 1), reduction::greatest);
        particles_ = all[all_particles];
        // If all were as heavy as the heaviest, they would have 2^62 units together: sums of 64 bits hold them.
        most_ = static_cast<double>(std::uint64_t{1} << 62) / static_cast<double>((std::max)(all[all_particles],
                                                                                             std::uint64_t{1}));
    }
    [[nodiscard]] std::uint64_t operator[](std::size_t i) const noexcept {
        if (weights_.empty()) return static_cast<std::uint64_t>(most_);
        // First the share, which is at most 1: the heaviest may be so light that most / greatest is infinite.
        return greatest_ > 0 ? static_cast<std::uint64_t>(weights_[i] / greatest_ * most_) : 0;
    }
    /// Of all ranks.
    [[nodiscard]] std::uint64_t particles() const noexcept { return particles_; }

private:
    [[nodiscard]] double greatest_of(const char* where, std::size_t particles) const {
        if (!weights_.empty() && weights_.size() != particles)
            raise<input_error>(where,
                               std::to_string(weights_.size()) + " weights for " + std::to_string(particles) +
                                   " particles",
                               "give one for each owned particle, or none on any rank: then all are 1");
        double greatest = 0;
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            if (!(weights_[i] >= 0) || !std::isfinite(weights_[i]))
                raise<input_error>(where, "weight " + shown(weights_[i]) + " of the particle at index " +
                                              std::to_string(i),
                                   "weights are finite, and at least 0");
            greatest = (std::max)(greatest, weights_[i]);
        }
        return greatest;
    }

    std::span<const double> weights_;
    std::uint64_t particles_ = 0;
    double greatest_ = 0;
    double most_ = 0;  // units of the heaviest
};

/// The cuts along one axis that give each part the same weight, as near as cuts between bins can be. Where nothing has
/// a weight, parts are equally wide.
///
/// Each round looks into the bin that a cut lies in, and divides it anew: 64 bins a round, until they are as narrow as
/// 2^-24 of the axis.
template <class Real>
class balanced_cuts {
    static constexpr std::size_t bins = 64;
    static constexpr int rounds = 4;  // 64^4 = 2^24

public:
    balanced_cuts() = default;
    balanced_cuts(Real first, Real last, std::size_t parts)
        : first_(first), last_(last), cuts_(parts - 1, {first, last, 0}) {
        brackets_.reserve(cuts_.size());
        sums_.reserve(cuts_.size() * bins);
    }
    /// @param x  of each particle, from the first to the last face [n]
    /// Complexity: O(n log parts). Memory: none, so that no rank can fail alone.
    /// Collective: yes; four reductions, if there are several parts.
    template <transport Transport>
    void find(Transport& on, std::span<const Real> x, const counted_weights& weights) {
        for (int round = 0; round < rounds && !cuts_.empty(); ++round) {
            look(x, weights);
            on.reduce(std::span<std::uint64_t>(sums_), reduction::sum);
            if (round == 0) {
                for (const auto sum : sums_) total_ += sum;
                if (total_ == 0) return divide_evenly();
            }
            narrow();
        }
    }
    /// [parts - 1]
    [[nodiscard]] std::vector<Real> found() const {
        std::vector<Real> cuts;
        for (const auto& one : cuts_) cuts.push_back(one.hi);
        return cuts;
    }

private:
    struct bracket {
        Real lo;
        Real hi;
        std::uint64_t below;  // weight below lo
        friend bool operator==(const bracket&, const bracket&) = default;
    };

    /// The weights in the bins of each bracket. Some cuts may share one: in the first round all do.
    void look(std::span<const Real> x, const counted_weights& weights) {
        brackets_.clear();
        for (const auto& one : cuts_)
            if (brackets_.empty() || !(brackets_.back() == one)) brackets_.push_back(one);
        sums_.assign(brackets_.size() * bins, 0);
        for (std::size_t i = 0; i < x.size(); ++i) {
            // They increase: the last one that does not begin above x. Without branches, which nobody could foretell.
            std::size_t k = 0;
            for (auto count = brackets_.size(); count > 1;) {
                const auto half = count / 2;
                k += brackets_[k + half].lo <= x[i] ? half : 0;
                count -= half;
            }
            const auto& in = brackets_[k];
            if (x[i] < in.lo || !(in.lo < in.hi) || (x[i] >= in.hi && in.hi < last_)) continue;
            const auto bin = static_cast<std::size_t>((x[i] - in.lo) / (in.hi - in.lo) * Real{bins});
            sums_[k * bins + (std::min)(bin, bins - 1)] += weights[i];
        }
    }
    /// Each cut to the bin that has its share of the weight below.
    void narrow() noexcept {
        const auto parts = cuts_.size() + 1;
        std::size_t k = 0;
        for (std::size_t c = 0; c < cuts_.size(); ++c) {
            auto& cut = cuts_[c];
            if (!(brackets_[k] == cut)) ++k;
            const auto* mine = sums_.data() + k * bins;
            // floor(total (c + 1) / parts) without overflow
            const auto target = total_ / parts * (c + 1) + total_ % parts * (c + 1) / parts;
            std::size_t b = 0;
            while (b + 1 < bins && cut.below + mine[b] < target) cut.below += mine[b++];
            const Real width = (cut.hi - cut.lo) / Real{bins};
            const Real lo = cut.lo + width * static_cast<Real>(b);
            cut.hi = b + 1 == bins ? cut.hi : cut.lo + width * static_cast<Real>(b + 1);
            cut.lo = lo;
        }
    }
    void divide_evenly() noexcept {
        const auto parts = static_cast<Real>(cuts_.size() + 1);
        for (std::size_t c = 0; c < cuts_.size(); ++c)
            cuts_[c].hi = first_ + (last_ - first_) / (parts / static_cast<Real>(c + 1));
    }

    Real first_{};
    Real last_{};
    std::vector<bracket> cuts_;
    std::vector<bracket> brackets_;    // the different ones, of a round
    std::vector<std::uint64_t> sums_;  // of each of these [bins]
    std::uint64_t total_ = 0;
};

/// Moves cuts apart until each part is at least so wide. Precondition: all of them have room.
template <class Real>
void widen(std::vector<Real>& cuts, Real lo, Real hi, Real least) noexcept {
    for (auto& cut : cuts) lo = cut = (std::max)(cut, lo + least);
    for (auto k = cuts.size(); k-- > 0;) hi = cuts[k] = (std::min)(cuts[k], hi - least);
}

/// @throws input_error if the parts are not as many as the ranks, or have no room.
template <class Cell, std::size_t D, class Real>
void check_grid(const char* where, const Cell& cell, const std::array<std::size_t, D>& grid, std::size_t ranks,
                Real least) {
    std::size_t parts = 1;
    for (const auto count : grid) parts *= count;
    check_ranks(where, parts, ranks);
    for (std::size_t k = 0; k < D; ++k) {
        const Real length = cell.along(k).real().length();
        if (!(least >= 0) || !(least * static_cast<Real>(grid[k]) <= length))
            raise<input_error>(where,
                               std::to_string(grid[k]) + " parts of a width of at least " + shown(least) +
                                   " along axis " + std::to_string(k) + ", which is " + shown(length) + " long",
                               "take fewer parts along it, or a smaller width");
    }
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
/// @param positions  of the owned particles of this rank, inside the box [n]; others count at its faces
/// @param weights    of each, such as its seconds or its contacts [n]; or none on any rank: then all are 1
/// @param least      width of a part along each axis, in units of the cell: at least the cutoff, if halos are not to
///                   reach over several ranks
/// Without particles, or if all weights are 0, parts are equally wide. Where cuts would coincide, as if all particles
/// lie in one point, a part keeps 1e-6 of the width of an even one.
///
/// @throws on all ranks or none: input_error if a weight is negative or not finite, there is not one for each, some
///         ranks give weights and others none, the grid has not as many parts as there are ranks, or an axis has no
///         room for so many parts of that width; std::bad_alloc on the rank itself.
/// Complexity: O(n log parts) for each axis, four times. Memory: D coordinates per particle.
/// Collective: yes; the same box, grid and width on all ranks. Three reductions of a few words, and four of at most 64
///             words per cut for each axis that is cut.
template <transport Transport, class Box, class Positions>
[[nodiscard]] auto balanced_bricks(Transport& on, const Box& where, const std::array<std::size_t, Box::dimension>& grid,
                                   const Positions& positions, std::span<const double> weights = {},
                                   typename Box::real_type least = 0) {
    using Scalar = typename std::remove_cvref_t<decltype(where.cell())>::scalar_type;
    using Real = typename Box::real_type;
    constexpr auto D = Box::dimension;
    constexpr auto name = "balanced_bricks";
    const auto& cell = where.cell();
    std::array<std::vector<Real>, D> x;
    std::array<detail::balanced_cuts<Real>, D> along;
    const detail::counted_weights counted(on, name, weights, positions.size(), [&] {
        detail::check_grid(name, cell, grid, on.ranks(), least);
        for (std::size_t k = 0; k < D; ++k) {
            along[k] = {cell.along(k).real().lo(), cell.along(k).real().hi(), grid[k]};
            x[k].resize(positions.size());
        }
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const auto at = where.to_cell(positions[i]);
            for (std::size_t k = 0; k < D; ++k) {
                const auto to = cell.along(k).to_real(at[k]);
                const auto lo = cell.along(k).real().lo();
                x[k][i] = to >= lo ? (std::min)(to, cell.along(k).real().hi()) : lo;  // NaN too
            }
        }
    });
    for (std::size_t k = 0; k < D; ++k) along[k].find(on, x[k], counted);
    std::optional<brick_decomposition<D, Scalar>> bricks;
    detail::agreed(on, name, [&] {
        const auto cuts_along = [&](std::size_t k) {
            const auto& axis = cell.along(k);
            const auto lo = axis.real().lo();
            const auto hi = axis.real().hi();
            auto found = along[k].found();
            const auto narrowest = (hi - lo) / static_cast<Real>(grid[k]) * static_cast<Real>(1e-6);
            detail::widen(found, lo, hi, (std::max)(least, narrowest));
            std::vector<Scalar> inner;
            for (const auto cut : found) inner.push_back(axis.from_real(cut).position);
            return cuts<Scalar>(axis, std::move(inner));
        };
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            bricks.emplace(cell, std::array<cuts<Scalar>, D>{cuts_along(K)...});
        }(std::make_index_sequence<D>{});
    });
    return *std::move(bricks);
}

/// A bisection that gives every rank the same work, from a sample of all particles.
///
///     parts = tsubu::balanced_parts(on, box, grains.owned()[tsubu::position<3>], seconds, cutoff);
///     tsubu::migrate(grains, parts, on);
///
/// @param where      a box; the parts are those of its cell, as for balanced_bricks
/// @param positions  of the owned particles of this rank, inside the box [n]
/// @param weights    of each [n]; or none on any rank: then all are 1
/// @param least      width of a part along each axis, in units of the cell
/// @param sample     how many positions are gathered from all ranks together
/// @throws on all ranks or none: input_error as balanced_bricks; if a part is narrower than `least`, with the part and
///         its width; std::bad_alloc on the rank itself.
/// Complexity: O(sample log sample); 8 (D + 1) bytes per position of the sample to each rank.
/// Collective: yes; the same box, width and sample on all ranks. A gather and four reductions.
template <transport Transport, class Box, class Positions>
[[nodiscard]] auto balanced_parts(Transport& on, const Box& where, const Positions& positions,
                                  std::span<const double> weights = {}, typename Box::real_type least = 0,
                                  std::size_t sample = 65536) {
    using Cell = std::remove_cvref_t<decltype(where.cell())>;
    using Scalar = typename Cell::scalar_type;
    using Position = typename Cell::position_type;
    constexpr auto D = Box::dimension;
    constexpr auto name = "balanced_parts";
    const detail::counted_weights counted(on, name, weights, positions.size(), [] {});
    std::vector<std::uint64_t> words;
    detail::agreed(on, name, [&] {
        // Every stride-th particle of each rank, with the weight of those that it stands for.
        const auto stride = static_cast<std::size_t>(counted.particles() / (std::max)(sample, std::size_t{1}) + 1);
        for (std::size_t i = 0; i < positions.size(); i += stride) {
            std::uint64_t weight = 0;
            for (auto j = i; j < positions.size() && j < i + stride; ++j) weight += counted[j];
            const auto at = where.to_cell(positions[i]);
            words.resize(words.size() + D);
            for (std::size_t k = 0; k < D; ++k)
                std::memcpy(words.data() + words.size() - D + k, &at[k], sizeof(at[k]));
            words.push_back(weight);
        }
    });
    std::optional<bisection_decomposition<D, Scalar>> parts;
    detail::agreed_gather(on, name, words, [&](const mailbox& came) {
        std::vector<Position> points;
        std::vector<double> shares;
        for (const auto& [from, told] : came)
            for (std::size_t at = 0; at < told.size(); at += D + 1) {
                Position x{};
                for (std::size_t k = 0; k < D; ++k) std::memcpy(&x[k], told.data() + at + k, sizeof(x[k]));
                points.push_back(x);
                shares.push_back(static_cast<double>(told[at + D]));
            }
        parts.emplace(where.cell(), on.ranks(), points, shares);
        for (std::size_t rank = 0; rank < parts->ranks(); ++rank)
            if (const auto [width, axis] = parts->subdomain(rank).min_extent(); width < least)
                detail::raise<input_error>(name,
                                           "the part of rank " + std::to_string(rank) + " would be " +
                                               detail::shown(width) + " wide along axis " + std::to_string(axis) +
                                               ", less than " + detail::shown(least),
                                           "take fewer ranks, a smaller width, or balanced_bricks");
    });
    return *std::move(parts);
}

}  // namespace tsubu
