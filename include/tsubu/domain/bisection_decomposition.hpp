// SPDX-License-Identifier: MIT
/// @file
/// bisection_decomposition: a tree of cuts, each through a weighted middle of the particles.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/detail/owners_of.hpp>
#include <tsubu/domain/detail/reach.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/neighbor_rank.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/domain/subdomain.hpp>

#include <algorithm>  // std::min, std::sort
#include <array>      // std::array
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint32_t
#include <limits>     // std::numeric_limits
#include <numeric>    // std::iota
#include <span>       // std::span
#include <string>     // std::to_string
#include <vector>     // std::vector

namespace tsubu {

/// Recursive coordinate bisection: the box is cut across the direction in which the sample is longest, so that both
/// sides have the weight that their numbers of ranks ask for, and each side again.
///
///     tsubu::bisection_decomposition<3> parts(box, ranks, sampled_positions);   // on all ranks the same sample
///
/// Concept:      decomposition; its border is always exact.
/// Cost:         construction O(S log S log ranks) for S samples; owner O(log ranks); subdomain O(D); neighbors
///               O(ranks) for cutoffs up to the box.
/// Bytes:        16 to 24 per rank for the tree, 2 D coordinates for the subdomain.
/// Deterministic: yes, if all ranks give the same sample and weights in the same order.
/// Choose it when particles are uneven: a heap, a jet, a drum. Do not when they fill the box: brick_decomposition has
///               fewer neighbours, and finds an owner in O(1).
/// Source:       Berger & Bokhari 1987, doi:10.1109/TC.1987.1676942.
template <std::size_t D, class Scalar = double>
class bisection_decomposition {
public:
    using box_type = domain<D, Scalar>;
    using scalar_type = Scalar;
    using real_type = typename box_type::real_type;
    using position_type = typename box_type::position_type;
    static constexpr std::size_t dimension = D;

    /// @param sample   positions of particles, of all or of a fair choice of them; those outside the box do not
    ///                 count. The same on all ranks: with MPI, gather a few thousand of each.
    ///                 Where no sample lies, a cut halves the volume.
    /// @param weights  of each, at least 0; empty: all 1.
    /// @throws input_error if ranks is 0, a weight is negative or not finite, the lengths differ, or a part has too few
    ///         numbers along every axis to be cut, or positions are given and none is inside.
    bisection_decomposition(const box_type& whole, std::size_t ranks, const points<D, const Scalar>& sample,
                            std::span<const double> weights = {})
        : whole_(whole) {
        if (ranks == 0) detail::raise<input_error>("bisection_decomposition", "0 ranks", "ask for at least 1");
        if (static_cast<double>(ranks) > detail::most_ranks)
            detail::raise<input_error>("bisection_decomposition", detail::shown(ranks) + " ranks",
                                       "ask for at most 2^31 - 1: no communicator has more");
        if (!weights.empty() && weights.size() != sample.size())
            detail::raise<input_error>("bisection_decomposition",
                                       std::to_string(weights.size()) + " weights for " +
                                           std::to_string(sample.size()) + " positions",
                                       "give one for each, or none");
        for (std::size_t i = 0; i < weights.size(); ++i)
            if (!(weights[i] >= 0) || !detail::is_finite(weights[i]))
                detail::raise<input_error>("bisection_decomposition",
                                           "weight " + std::to_string(i) + " is " + detail::shown(weights[i]),
                                           "give finite weights of at least 0");
        std::vector<std::size_t> inside;
        inside.reserve(sample.size());
        for (std::size_t i = 0; i < sample.size(); ++i)
            if (whole.contains(sample[i])) inside.push_back(i);
        if (inside.empty() && sample.size() != 0)
            detail::raise<input_error>("bisection_decomposition",
                                       "none of " + std::to_string(sample.size()) + " positions is inside the box",
                                       "give positions of this box: to_cell(x), if it is the cell of another; or none");
        region box{};
        for (std::size_t k = 0; k < D; ++k) box[k] = whole.along(k).inside();
        leaves_.reserve(ranks);
        nodes_.reserve(ranks);
        split(box, ranks, inside, sample, weights);
    }

    [[nodiscard]] const box_type& whole() const noexcept { return whole_; }
    [[nodiscard]] std::size_t ranks() const noexcept { return leaves_.size(); }
    /// The rank of any finite point: beyond the faces, that on whose side of each cut it is (B4). Precondition: no
    /// coordinate is NaN.
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept {
        if (nodes_.empty()) return 0;
        std::uint32_t at = 0;
        for (;;) {
            const auto& cut = nodes_[at];
            const auto next = x[cut.axis] < cut.begin ? cut.below : cut.above;
            if ((next & leaf) != 0) return next & ~leaf;
            at = next;
        }
    }
    /// The same for each of many points. Precondition: no coordinate is NaN. @throws input_error if the lengths differ.
    void owner(const points<D, const Scalar>& x, std::span<rank_t> owners) const {
        detail::owners_of("bisection_decomposition::owner", *this, x, owners);
    }
    /// @throws input_error if there is no such rank.
    template <std::integral Rank>
    [[nodiscard]] tsubu::subdomain<D, Scalar> subdomain(Rank which) const {
        const auto rank = detail::checked_rank("bisection_decomposition::subdomain", which, ranks());
        const auto& owned = leaves_[rank];
        auto extended = owned;
        vec<D, real_type> lo{};
        vec<D, real_type> hi{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto inside = whole_.along(k).inside();
            if (owned[k].first == inside.first) extended[k].first = interval<Scalar>::all().first;
            if (owned[k].last == inside.last) extended[k].last = interval<Scalar>::all().last;
            const auto [from, to] = detail::real_stretch(whole_.along(k), owned[k]);
            lo[k] = from;
            hi[k] = to;
        }
        return {owned, extended, lo, hi};
    }
    /// As brick_decomposition::neighbors.
    template <std::integral Rank>
    [[nodiscard]] std::vector<neighbor_rank<D>> neighbors(Rank rank, real_type cutoff) const {
        return detail::neighbors_within("bisection_decomposition::neighbors", *this, rank, cutoff);
    }

private:
    using region = std::array<interval<Scalar>, D>;
    static constexpr std::uint32_t leaf = std::uint32_t{1} << 31;  // the rest of the word is the rank

    struct node {
        Scalar begin;  // of the upper side
        std::uint32_t axis;
        std::uint32_t below;
        std::uint32_t above;
    };

    /// @return the node, or the leaf, of this region.
    std::uint32_t split(const region& box, std::size_t ranks, std::vector<std::size_t>& members,
                        const points<D, const Scalar>& sample, std::span<const double> weights) {
        if (ranks == 1) {
            leaves_.push_back(box);
            return static_cast<std::uint32_t>(leaves_.size() - 1) | leaf;
        }
        const auto below_ranks = ranks / 2;
        const double portion =
            static_cast<double>(ranks) / static_cast<double>(below_ranks);  // 1 / the lower side's share
        const auto cut = choose_cut(box, ranks, portion, members, sample, weights);
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        const auto k = cut.axis;
        nodes_.push_back({cut.begin, static_cast<std::uint32_t>(k), 0, 0});
        std::vector<std::size_t> below;
        std::vector<std::size_t> above;
        for (const auto i : members) (sample[i][k] < cut.begin ? below : above).push_back(i);
        members = {};  // not needed any more while the sides are split
        auto side = box;
        side[k].last = detail::before(cut.begin);
        nodes_[number].below = split(side, below_ranks, below, sample, weights);
        side = box;
        side[k].first = cut.begin;
        const auto upper = split(side, ranks - below_ranks, above, sample, weights);
        nodes_[number].above = upper;
        return number;
    }
    struct chosen_cut {
        std::size_t axis;
        Scalar begin;
        double miss;  // of the wished weight below, as a share of all
    };
    /// Across the direction in which the sample is longest, else the box is, of those that can be cut so that each side
    /// has at least as many points as ranks.
    chosen_cut choose_cut(const region& box, std::size_t ranks, double portion, std::vector<std::size_t>& members,
                          const points<D, const Scalar>& sample, std::span<const double> weights) const {
        std::array<std::size_t, D> axes{};
        std::iota(axes.begin(), axes.end(), std::size_t{0});
        vec<D, real_type> edge{};
        vec<D, real_type> spread{};
        for (std::size_t k = 0; k < D; ++k) {
            edge[k] = edge_of(k, box[k]);
            spread[k] = members.empty() ? 0 : edge_of(k, range_of(k, members, sample));
        }
        std::sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) {
            if (spread[a] != spread[b]) return spread[a] > spread[b];
            return edge[a] != edge[b] ? edge[a] > edge[b] : a < b;
        });
        // One stray particle can make any direction the longest: a cut there that misses by so much is compared with
        // those along the others.
        constexpr double good = 1.0 / 32;
        chosen_cut best{D, {}, std::numeric_limits<double>::infinity()};
        for (const auto k : axes) {
            std::uint64_t across = 1;  // points with the same coordinate k; more than ranks are as good as ranks
            for (const auto other : axes)
                if (other != k && across < ranks)
                    across *= (std::min)(steps_of(box[other]), static_cast<std::uint64_t>(ranks - 1)) + 1;
            const auto needed = [&](std::size_t side) { return (side + across - 1) / across; };
            const auto below = needed(ranks / 2);
            const auto above = needed(ranks - ranks / 2);
            if (below + above - 1 > steps_of(box[k])) continue;
            const interval<Scalar> begins{moved(box[k].first, static_cast<std::int64_t>(below)),
                                          moved(box[k].last, 1 - static_cast<std::int64_t>(above))};
            const auto cut = cut_along(k, box[k], begins, portion, members, sample, weights);
            if (cut.miss < best.miss) best = cut;
            if (best.miss <= good) break;
        }
        if (best.axis != D) return best;
        detail::raise<input_error>("bisection_decomposition",
                                   "a part has so few points that the scalar tells apart that no cut gives each of " +
                                       std::to_string(ranks) + " ranks one",
                                   "ask for fewer ranks, or scale the unit of length");
    }
    /// From the lowest to the highest coordinate of the samples.
    [[nodiscard]] static interval<Scalar> range_of(std::size_t k, const std::vector<std::size_t>& members,
                                                   const points<D, const Scalar>& sample) {
        interval<Scalar> range{sample[members[0]][k], sample[members[0]][k]};
        for (const auto i : members) {
            range.first = (std::min)(range.first, sample[i][k]);
            range.last = (std::max)(range.last, sample[i][k]);
        }
        return range;
    }
    /// The coordinate where the upper side begins, one of `begins`: that of the sample nearest to the wished share.
    chosen_cut cut_along(std::size_t k, const interval<Scalar>& range, const interval<Scalar>& begins, double portion,
                         std::vector<std::size_t>& members, const points<D, const Scalar>& sample,
                         std::span<const double> weights) const {
        // In units of the largest, so that no sum overflows.
        double largest = 0;
        for (const auto i : members)
            if (!weights.empty()) largest = (std::max)(largest, weights[i]);
        const auto weight = [&](std::size_t i) {
            return weights.empty() ? 1.0 : largest > 0 ? weights[i] / largest : 0.0;
        };
        // Of equal coordinates the lower index first: all ranks must find the same cut.
        std::sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
            return sample[a][k] < sample[b][k] || (sample[a][k] == sample[b][k] && a < b);
        });
        double total = 0;
        for (const auto i : members) total += weight(i);
        // A quotient, not a product: no fused multiply-add can make the difference below another.
        const double wished = total / portion;
        Scalar best = range.first;
        double least = std::numeric_limits<double>::infinity();
        double below = 0;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const auto x = sample[members[m]][k];
            // A cut here has all samples before this one below it: if they are lower, and it may be here.
            if (begins.contains(x) && (m == 0 || sample[members[m - 1]][k] < x)) {
                const double miss = below > wished ? below - wished : wished - below;
                if (miss < least) {
                    least = miss;
                    best = x;
                }
            }
            below += weight(members[m]);
        }
        if (total > 0 && best > range.first) return {k, best, least / total};
        return {k, geometric_cut(k, range, begins, portion), total > 0 ? 1.0 : 0.0};
    }
    [[nodiscard]] Scalar geometric_cut([[maybe_unused]] std::size_t k, const interval<Scalar>& range,
                                       const interval<Scalar>& begins, double portion) const {
        Scalar cut{};
        if constexpr (is_lattice<Scalar>) {
            using Int = decltype(cut.value);
            using Unsigned = std::make_unsigned_t<Int>;
            const auto steps = static_cast<Unsigned>(static_cast<Unsigned>(range.last.value) -
                                                     static_cast<Unsigned>(range.first.value));
            cut = range.first + static_cast<Int>(static_cast<Unsigned>(static_cast<double>(steps) / portion));
        } else {
            const auto [from, to] = detail::real_stretch(whole_.along(k), range);
            cut = from + (to - from) / static_cast<Scalar>(portion);
        }
        if (cut < begins.first) return begins.first;
        return cut > begins.last ? begins.last : cut;
    }
    /// How many steps from the first to the last coordinate.
    [[nodiscard]] static std::uint64_t steps_of(const interval<Scalar>& range) noexcept {
        return static_cast<std::uint64_t>(detail::ordinal(range.last)) -
               static_cast<std::uint64_t>(detail::ordinal(range.first));
    }
    [[nodiscard]] static Scalar moved(Scalar x, std::int64_t steps) noexcept {
        return detail::at_ordinal<Scalar>(detail::ordinal(x) + steps);
    }
    /// The length from the first to the last coordinate: without a product that is added, so that fused multiply-add
    /// chooses no other axis.
    [[nodiscard]] real_type edge_of([[maybe_unused]] std::size_t k, const interval<Scalar>& range) const noexcept {
        if constexpr (is_lattice<Scalar>)
            return whole_.along(k).length_of(static_cast<double>(steps_of(range)));
        else
            return range.last - range.first;
    }

    box_type whole_;
    std::vector<node> nodes_;     // the first is the root
    std::vector<region> leaves_;  // by rank
};
static_assert(decomposition<bisection_decomposition<3>> && decomposition<bisection_decomposition<1, float>> &&
              decomposition<bisection_decomposition<2, lattice<std::int64_t>>>);

}  // namespace tsubu
