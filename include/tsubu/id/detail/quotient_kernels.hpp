// SPDX-License-Identifier: MIT
/// @file
/// Where flat_storage spends its time: the loops of the batched calls over a block of 64 ids, locate (hash), settle
/// (compare the preferred slots), search and insert (compare whole lines), and find for one id. Here for any machine;
/// quotient_avx2.hpp and quotient_avx512.hpp offer the same functions with wider vectors. Their loops are written out
/// again, since a function without the target attribute cannot inline one that has it.
///
/// A block is 64 ids: long enough that the calls cost nothing, short enough that its 1.5 kB of places, tags and slots
/// stay in the first-level cache together with those of the blocks before and after it.
#pragma once

#include <tsubu/id/detail/quotient_lines.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint32_t

namespace tsubu::detail {

inline constexpr std::uint32_t block_size = 64;

/// One block on its way through a batch: what the ids became, and what stands in their preferred slots.
template <class Layout>
struct alignas(64) id_block {
    using Slot = typename Layout::slot_type;
    alignas(64) std::uint32_t place[block_size];
    alignas(64) Slot tag[block_size];
    alignas(64) Slot slot[block_size];
    alignas(64) std::uint32_t index[block_size];  // keyed lines only
};

/// What every instruction set offers, written for any machine. Each function but find is one step for a whole block.
struct portable_kernels {
    /// block.place, block.tag from ids; an id that cannot be in the table gets the line that is always empty.
    template <class Layout, class Id>
    static void locate(const line_table& table, const Id* ids, id_block<Layout>& block) noexcept {
        const auto nowhere = table.nowhere<Layout>();
        for (std::uint32_t k = 0; k < block_size; ++k) {
            const auto x = static_cast<std::uint64_t>(ids[k]) - table.base;
            const auto at = table.locate<Layout>(x);
            block.place[k] = table.may_hold<Layout>(x) ? static_cast<std::uint32_t>(at.place) : nowhere;
            block.tag[k] = at.tag;
        }
    }
    /// out from the preferred slots: index or absent. Where another id stands there, k goes into the queue.
    /// @return length of the queue.
    template <class Layout>
    static std::uint32_t settle(const line_table& table, const id_block<Layout>& block, index_t* out,
                                std::uint32_t* queue) noexcept {
        using Slot = typename Layout::slot_type;
        const auto mask = static_cast<Slot>(table.tag_mask);
        std::uint32_t queued = 0;
        for (std::uint32_t k = 0; k < block_size; ++k) {
            const Slot slot = block.slot[k];
            const bool match = (slot & mask) == block.tag[k];
            const auto index =
                Layout::keyed ? block.index[k] : static_cast<std::uint32_t>(slot & static_cast<Slot>(~mask));
            out[k] = index_if(match, index);
            queue[queued] = k;
            queued += static_cast<std::uint32_t>(!match) & static_cast<std::uint32_t>(slot != 0);
        }
        return queued;
    }
    /// out for the queued ids, by comparing the whole home line. Where the id may lie beyond that line, k stays queued.
    template <class Layout>
    static std::uint32_t search(const line_table& table, const id_block<Layout>& block, index_t* out,
                                std::uint32_t* queue, std::uint32_t queued) noexcept {
        using Slot = typename Layout::slot_type;
        const auto mask = static_cast<Slot>(table.tag_mask);
        std::uint32_t kept = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto first = block.place[k] & ~(Layout::slots - 1);
            const auto found = matches<Layout>(table.slots<Layout>() + first, block.tag[k], mask);
            out[k] = answer<Layout>(table, first + first_match<Layout>(found), block.tag[k], found);
            queue[kept] = k;
            kept += static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots);
        }
        return kept;
    }
    /// Inserts the queued ids into their home lines: id k with index_plus_1 + k. Where that line is full, k stays
    /// queued. repeated grows by how many were in the table already.
    template <class Layout, bool LinksAreAbsent>
    static std::uint32_t insert(const line_table& table, const id_block<Layout>& block, std::uint32_t index_plus_1,
                                index_t* links, std::uint32_t* queue, std::uint32_t queued,
                                std::size_t& repeated) noexcept {
        using Slot = typename Layout::slot_type;
        const auto mask = static_cast<Slot>(table.tag_mask);
        std::uint32_t kept = 0;
        std::uint32_t met = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto* const line = table.slots<Layout>() + (block.place[k] & ~(Layout::slots - 1));
            const auto same = matches<Layout>(line, block.tag[k], mask);
            const auto vacant = matches<Layout>(line, 0, static_cast<Slot>(~Slot{0}));
            if ((same | vacant) == 0) [[unlikely]]
                queue[kept++] = k;
            else
                met += put_in_home_line<Layout, 16 / Layout::slots, LinksAreAbsent>(table, links, block.place[k],
                                                                                    block.tag[k], index_plus_1 + k,
                                                                                    same, vacant);
        }
        repeated += met;
        return kept;
    }
    /// Index of one id, or absent.
    template <class Layout, class Spills>
    static index_t find(const line_table& table, const Spills& stash, std::uint64_t t) noexcept {
        const auto x = t - table.base;
        if (!table.may_hold<Layout>(x)) return absent;
        const auto at = table.locate<Layout>(x);
        const auto first = at.place & ~std::uint64_t{Layout::slots - 1};
        const auto found = matches<Layout>(table.slots<Layout>() + first, at.tag,
                                           static_cast<typename Layout::slot_type>(table.tag_mask));
        if ((static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots)) != 0) [[unlikely]]
            return find_beyond<Layout>(table, stash.entries(), at.place, at.tag);
        return answer<Layout>(table, first + first_match<Layout>(found), at.tag, found);
    }
};

}  // namespace tsubu::detail
