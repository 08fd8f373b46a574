// SPDX-License-Identifier: MIT
/// @file
/// Batched look-up in quotient lines: blocks of ids on their way through three steps at once.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/id/detail/quotient_avx2.hpp>
#include <tsubu/id/detail/quotient_avx512.hpp>
#include <tsubu/id/detail/quotient_kernels.hpp>
#include <tsubu/id/detail/quotient_lines.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span

namespace tsubu::detail {

/// From this size on a table does not stay in the second-level cache, and prefetching pays. [bytes]
inline constexpr std::size_t prefetch_threshold = std::size_t{1} << 20;

/// Asks for the preferred slots of a block, and the indices beside keyed ones; to be written if Write.
template <class Layout, int Write>
[[gnu::always_inline]] inline void prefetch_places(const line_table& table, const id_block<Layout>& block) noexcept {
    for (std::uint32_t k = 0; k < block_size; ++k) __builtin_prefetch(table.slots<Layout>() + block.place[k], Write);
    if constexpr (Layout::keyed)
        for (std::uint32_t k = 0; k < block_size; ++k) __builtin_prefetch(table.indices + block.place[k], Write);
}

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
            if (prefetch) prefetch_places<Layout, 0>(table, block);
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
