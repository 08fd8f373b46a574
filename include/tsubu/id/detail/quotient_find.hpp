// SPDX-License-Identifier: MIT
/// @file
/// Look-up in quotient lines: one id, or blocks of ids on their way through three steps at once.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/id/detail/quotient_kernels.hpp>
#include <tsubu/id/detail/quotient_lines.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span

namespace tsubu::detail {

/// An id that found no place in its lines: (place, tag) name it as exactly as the id does.
struct spilled_id {
    std::uint64_t tag;
    std::uint32_t place;
    std::uint32_t index_plus_1;
};

/// The rare rest of a look-up: the lines after the home line, then the stash.
template <class Layout>
[[nodiscard, gnu::noinline]] index_t find_beyond(const line_table& table, std::span<const spilled_id> stash,
                                                 std::uint64_t place, typename Layout::slot_type tag) noexcept {
    const auto end = walk<Layout>(table, place, tag, table.lines + spill_lines);
    if (end.what == search_end::outcome::match) return static_cast<index_t>(index_at<Layout>(table, end.place)) - 1;
    if (end.what == search_end::outcome::boundary)
        for (const auto& entry : stash)
            if (entry.place == place && entry.tag == tag) return static_cast<index_t>(entry.index_plus_1) - 1;
    return absent;
}

/// One id. No branch depends on whether it is there, nor in which slot: looking at the preferred slot first would save
/// a third of the instructions on hits, but its mispredicted branches double the time of misses.
template <class Layout>
[[nodiscard, gnu::always_inline]] inline index_t find_one(const line_table& table, std::span<const spilled_id> stash,
                                                          std::uint64_t id) noexcept {
    using Slot = typename Layout::slot_type;
    const auto x = id - table.base;
    if (!table.may_hold<Layout>(x)) return absent;
    const auto at = table.locate<Layout>(x);
    const auto first = at.place & ~std::uint64_t{Layout::slots - 1};
    const auto found = matches<Layout>(table.slots<Layout>() + first, at.tag, static_cast<Slot>(table.tag_mask));
    const auto index = index_at<Layout>(table, first + first_match<Layout>(found));
    if ((static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots)) != 0) [[unlikely]]
        return find_beyond<Layout>(table, stash, at.place, at.tag);
    return index_if(found != 0, index);
}

/// From this size on a table does not stay in the second-level cache, and prefetching pays. [bytes]
inline constexpr std::size_t prefetch_threshold = std::size_t{1} << 20;

/// Many ids: while block b is hashed and prefetched, the preferred slots of block b - 1 are loaded and block b - 2 is
/// compared. The loads are plain scalar ones (a gather instruction is no faster, and slower on some processors); the
/// comparison comes a block later, when their stores no longer stall the vector loads.
template <class Kernels, class Layout, class Id>
void find_blocks(const line_table& table, std::span<const spilled_id> stash, const Id* ids, std::size_t blocks,
                 index_t* out, bool prefetch) noexcept {
    using Slot = typename Layout::slot_type;
    id_block<Layout> ring[3];
    alignas(64) std::uint32_t queue[block_size + 16];  // a vector store may write 16 beyond the last
    const Slot* const slots = table.slots<Layout>();
    for (std::size_t b = 0; b < blocks + 2; ++b) {
        if (b < blocks) {
            auto& block = ring[b % 3];
            Kernels::template locate<Layout>(table, ids + b * block_size, block);
            if (prefetch)
                for (std::uint32_t k = 0; k < block_size; ++k) __builtin_prefetch(slots + block.place[k]);
        }
        if (b >= 1 && b - 1 < blocks) {
            auto& block = ring[(b - 1) % 3];
            for (std::uint32_t k = 0; k < block_size; ++k) block.slot[k] = slots[block.place[k]];
            if constexpr (Layout::keyed)
                for (std::uint32_t k = 0; k < block_size; ++k) block.index[k] = table.indices[block.place[k]];
        }
        if (b >= 2) {
            const auto& block = ring[(b - 2) % 3];
            auto* const answers = out + (b - 2) * block_size;
            auto queued = Kernels::template settle<Layout>(table, block, answers, queue);
            queued = Kernels::template search<Layout>(table, block, answers, queue, queued);
            for (std::uint32_t q = 0; q < queued; ++q)
                answers[queue[q]] = find_beyond<Layout>(table, stash, block.place[queue[q]], block.tag[queue[q]]);
        }
    }
}

/// Calls with(kernels) with the best kernels of this machine.
template <class With>
void with_kernels(With&& with) {
#if defined(__x86_64__) && defined(__GNUC__)
    switch (best_instruction_set()) {
        case instruction_set::avx512: return with(avx512_kernels{});
        case instruction_set::avx2: return with(avx2_kernels{});
        case instruction_set::portable: break;
    }
#endif
    with(portable_kernels{});
}

}  // namespace tsubu::detail
