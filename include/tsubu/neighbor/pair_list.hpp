// SPDX-License-Identifier: MIT
/// @file
/// pair_list: which particles are near each other, each pair once.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/neighbor/detail/cells.hpp>
#include <tsubu/neighbor/detail/growing.hpp>
#include <tsubu/neighbor/reach.hpp>

#include <algorithm>    // std::max, std::min
#include <cstddef>      // std::size_t
#include <span>         // std::span
#include <tuple>        // std::tuple_size_v
#include <type_traits>  // std::remove_cvref_t

namespace tsubu {

/// Two particles that are near each other: i is owned, and i < j; j may be a ghost.
struct index_pair {
    index_t i;
    index_t j;
};

/// Which particles are near each other? Each pair once; of those across a border each rank has one.
///
///     tsubu::pair_list list;
///     list.build(g[tsubu::position<3>], g.owned_count(), tsubu::same_reach(cutoff + skin));
///     for (const auto [i, j] : list.pairs()) ...
///
/// Choose it where what i does to j is the opposite of what j does to i. Do not where each particle gathers from all of
/// its neighbours, or threads write to one particle each: neighbor_list.
///
/// Bytes:   8 per pair; while it is built 8 D + 8 per particle and 4 to 20 for cells more.
/// Threads: many readers or one writer.
class pair_list {
public:
    /// @param x      positions of the owned particles, then of the ghosts [m]: size() and x[i][k]
    /// @param reach  a pair_reach: up to which distance a pair is near
    /// @throws input_error if a position is not finite, or the reach is not a positive length; limit_error at 2^32
    ///         pairs. The list is as before then.
    /// Complexity: O(N) if the density is bounded.
    template <class Positions, pair_reach Reach>
    void build(const Positions& x, std::size_t owned, const Reach& reach) {
        constexpr std::size_t D = std::tuple_size_v<std::remove_cvref_t<decltype(x[0])>>;
        using real = typename std::remove_cvref_t<decltype(x[0])>::value_type;
        const auto cutoff = static_cast<real>(reach.greatest());
        detail::check_reach("pair_list::build", reach.greatest());
        const detail::cells<D, real> sorted(x, cutoff);
        const auto near = reach.template sorted<real>(sorted.origin(), sorted.size());
        detail::growing<index_pair> found((std::max)(pairs_.size(), 4 * owned + 64));
        const auto* const origin = sorted.origin();
        const auto first_ghost = static_cast<index_t>(owned);
        sorted.each_half([&](std::size_t a, const auto& stretches) {
            std::size_t most = 0;
            for (const auto [first, last] : stretches) most += last - first;
            auto* to = found.room(most);
            const auto mine = origin[a];
            for (const auto [first, last] : stretches)
                for (auto b = first; b < last; ++b) {
                    real square = 0;
                    for (std::size_t k = 0; k < D; ++k) {
                        const auto d = sorted.along(k)[a] - sorted.along(k)[b];
                        square += d * d;
                    }
                    // Branch-free: whether two are near cannot be predicted.
                    const auto i = (std::min)(mine, origin[b]);
                    *to = {i, (std::max)(mine, origin[b])};
                    to += static_cast<int>(square < near(a, b)) & static_cast<int>(i < first_ghost);
                }
            found.up_to(to);
        });
        pairs_ = found.take();
    }
    [[nodiscard]] std::span<const index_pair> pairs() const noexcept { return {pairs_.data(), pairs_.size()}; }
    [[nodiscard]] std::size_t size() const noexcept { return pairs_.size(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return pairs_.memory_bytes(); }

private:
    buffer<index_pair> pairs_;
};

}  // namespace tsubu
