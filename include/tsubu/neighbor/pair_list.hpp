// SPDX-License-Identifier: MIT
/// @file
/// pair_list: which particles are near each other, each pair once.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/neighbor/detail/cells.hpp>
#include <tsubu/neighbor/detail/growing.hpp>
#include <tsubu/neighbor/positions.hpp>
#include <tsubu/neighbor/reach.hpp>

#include <algorithm>  // std::copy_n, std::max, std::min
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span

namespace tsubu {

/// Two particles that are near each other: i is owned, and i < j; j may be a ghost.
struct index_pair {
    index_t i;
    index_t j;
};

/// Which particles are near each other? Each pair once; one across a border is in the lists of both sides, and so twice
/// where one process is its own neighbour. Add what it does to the owned one alone.
///
///     tsubu::pair_list list;
///     list.build(g[tsubu::position<3>], g.owned_count(), tsubu::same_reach{cutoff + skin});
///     for (const auto [i, j] : list.pairs()) ...
///
/// Near are two of which the distance is less than the reach. Pairs follow the order of the particles as far as those
/// that are near each other have near indices: sort particles along a curve. The order depends on the input alone.
///
/// Choose it where what i does to j is the opposite of what j does to i. Do not where each particle gathers from all of
/// its neighbours, or threads write to one particle each: neighbor_list.
///
/// Bytes:   8 to 9 per pair; while it is built D coordinates and 12 bytes per particle, and 4 to 20 for cells.
/// Threads: many readers or one writer.
class pair_list {
public:
    /// @param x      positions of the owned particles, then of the ghosts [m]
    /// @param reach  a pair_reach: up to which distance a pair is near
    /// @throws input_error if a position is not finite, or the reach is not a positive length; limit_error at 2^32
    ///         pairs. The list is as before then.
    /// Complexity: O(N) if the density is bounded, and the box around all particles but a few is not far larger than
    ///             what they fill.
    template <point_positions Positions, pair_reach Reach>
    void build(const Positions& x, std::size_t owned, const Reach& reach) {
        constexpr auto where = "pair_list::build";
        const auto sorted = detail::sorted_into_cells(where, x, owned, reach);
        detail::growing<index_pair> found(detail::room_after((std::max)(count_, owned)),
                                          (std::numeric_limits<std::uint32_t>::max)(), where, "pairs");
        const auto first_ghost = static_cast<index_t>(owned);
        // Which of two is an owned one, and has the lower index, is asked of many pairs in one loop.
        constexpr std::size_t batch = 512;
        std::size_t settled = 0;
        detail::growing<index_pair> outer(detail::room_after(count_ - inner_count_),
                                          (std::numeric_limits<std::uint32_t>::max)(), where, "pairs");
        const auto settle = [&] {
            auto* const first = found.data();
            auto* to = first + settled;
            auto* to_outer = outer.room(found.size() - settled + 1);
            for (const auto* from = to; from != first + found.size(); ++from) {
                const auto [a, b] = *from;
                const index_pair pair{(std::min)(a, b), (std::max)(a, b)};
                const int is_owned = pair.i < first_ghost ? 1 : 0;
                const int is_inner = pair.j < first_ghost ? 1 : 0;
                *to = *to_outer = pair;
                to += is_inner;
                to_outer += is_owned - is_inner;
            }
            found.up_to(to);
            outer.up_to(to_outer);
            settled = found.size();
        };
        sorted.each_half([&](const auto& near, std::size_t k, std::size_t begin) {
            const auto a = near.index(k);
            auto* const to = found.room(near.most());
            found.up_to(near.near(k, begin, reach, to, [a](index_t b) { return index_pair{a, b}; }));
            if (found.size() - settled >= batch) settle();
        });
        settle();
        const auto inner = found.size();
        found.up_to(std::copy_n(outer.data(), outer.size(), found.room(outer.size())));
        const auto count_of_all = found.size();
        pairs_ = found.take();  // the last that may throw
        count_ = count_of_all;
        inner_count_ = inner;
    }
    [[nodiscard]] std::span<const index_pair> pairs() const noexcept { return {pairs_.data(), count_}; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    /// So many pairs, the first ones, are of two owned particles; the others have a ghost, and can wait for its values.
    [[nodiscard]] std::size_t inner_count() const noexcept { return inner_count_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return pairs_.memory_bytes(); }

private:
    buffer<index_pair> pairs_;
    std::size_t count_ = 0;
    std::size_t inner_count_ = 0;
};

}  // namespace tsubu
