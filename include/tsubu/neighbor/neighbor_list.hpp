// SPDX-License-Identifier: MIT
/// @file
/// neighbor_list: which particles are near this one?
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/neighbor/detail/cells.hpp>
#include <tsubu/neighbor/detail/growing.hpp>
#include <tsubu/neighbor/positions.hpp>
#include <tsubu/neighbor/reach.hpp>

#include <algorithm>  // std::max
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <utility>    // std::move

namespace tsubu {

/// Which particles are near this one? For each owned particle all of them, owned and ghosts.
///
///     tsubu::neighbor_list list;
///     list.build(g[tsubu::position<3>], g.owned_count(), tsubu::same_reach{cutoff + skin});
///     for (std::size_t i = 0; i < list.size(); ++i)
///         for (const auto j : list.of(i)) ...
///
/// Near are two of which the distance is less than the reach. The order depends on the input alone.
///
/// Choose it where each particle gathers from all of its neighbours, or threads write to one particle each. Do not
/// where what i does to j is the opposite of what j does to i, and one thread does it: pair_list has each pair once, is
/// built in two thirds of the time, and lets each force be computed once.
///
/// Bytes:   4 to 4.5 per neighbour (each pair of owned particles is two) and 8 per owned particle; while it is built
///          D coordinates and 12 bytes per particle, and 4 to 20 for cells. A pair_list has 8 to 9 per pair, and none per particle.
/// Threads: many readers or one writer.
class neighbor_list {
public:
    /// @param x      positions of the owned particles, then of the ghosts [m]
    /// @param reach  a pair_reach: up to which distance a pair is near
    /// @throws input_error if a position is not finite, or the reach is not a positive length; limit_error at 2^32
    ///         neighbours. The list is as before then.
    /// Complexity: O(N) if the density is bounded, and the box around all particles but a few is not far larger than
    ///             what they fill.
    template <point_positions Positions, pair_reach Reach>
    void build(const Positions& x, std::size_t owned, const Reach& reach) {
        constexpr auto where = "neighbor_list::build";
        const auto sorted = detail::sorted_into_cells(where, x, owned, reach);
        detail::growing<index_t> found(detail::room_after((std::max)(count_, owned)),
                                       (std::numeric_limits<std::uint32_t>::max)(), where, "neighbours");
        buffer<row> rows(owned, {});
        sorted.each_full(static_cast<index_t>(owned), [&](auto& near, std::size_t k) {
            const auto i = near.index(k);
            const auto begin = found.size();
            auto* itself = found.room(near.most());
            auto* const end = near.near(k, 0, reach, itself, [](index_t j) { return j; });
            // It is near itself, unless its reach is 0, and soon found: its cell is among the first.
            *end = i;
            while (*itself != i) ++itself;
            auto* const last = itself == end ? end : end - 1;
            *itself = *last;
            found.up_to(last);
            rows[static_cast<std::size_t>(i)] = {static_cast<std::uint32_t>(begin),
                                                 static_cast<std::uint32_t>(found.size() - begin)};
        });
        const auto count_of_all = found.size();
        neighbors_ = found.take();  // the last that may throw
        count_ = count_of_all;
        rows_ = std::move(rows);
    }
    /// Those near owned particle i. Precondition: i < size().
    [[nodiscard]] std::span<const index_t> of(std::size_t i) const {
        TSUBU_EXPECTS(i < rows_.size(), "neighbor_list::of: no owned particle has this index; ghosts have no row");
        return {neighbors_.data() + rows_[i].begin, rows_[i].count};
    }
    /// How many owned particles there are: each has a row. Of a pair_list it is the pairs, which are what it holds.
    [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }
    /// How many neighbours all have together.
    [[nodiscard]] std::size_t total() const noexcept { return count_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return neighbors_.memory_bytes() + rows_.memory_bytes(); }

private:
    struct row {
        std::uint32_t begin;
        std::uint32_t count;
    };
    buffer<index_t> neighbors_;
    buffer<row> rows_;
    std::size_t count_ = 0;
};

}  // namespace tsubu
