// SPDX-License-Identifier: MIT
/// @file
/// Batched look-up in quotient lines, blocks of ids on their way through three steps at once; and the choice of
/// kernels.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/id/detail/quotient_avx2.hpp>
#include <tsubu/id/detail/quotient_avx512.hpp>
#include <tsubu/id/detail/quotient_kernels.hpp>
#include <tsubu/id/detail/quotient_lines.hpp>

#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint32_t
#include <span>         // std::span
#include <type_traits>  // std::true_type

namespace tsubu::detail {

/// From this size on a table does not stay in the second-level cache, and prefetching pays. [bytes]
inline constexpr std::size_t prefetch_threshold = std::size_t{1} << 20;

/// Asks for a place of the table, and for the index beside a keyed one; to be written if Write.
template <class Layout, bool Write>
[[gnu::always_inline]] inline void prefetch_place(const line_table& table, std::uint32_t place) noexcept {
    detail::prefetch<Write>(table.slots<Layout>() + place);
    if constexpr (Layout::keyed) detail::prefetch<Write>(table.indices + place);
}

/// Many ids: block b is hashed; the preferred slots of block b - 1 are loaded while those of b are prefetched, one by
/// one, since the processor waits for no more than some twenty lines at once; block b - 2 is compared. The loads are
/// plain scalar ones (a gather instruction is no faster, and slower on some processors); the comparison comes a block
/// later, when their stores no longer stall the vector loads.
template <class Kernels, class Layout, class Id>
void find_blocks(const line_table& table, std::span<const spilled_id> stash, const Id* ids, std::size_t blocks,
                 index_t* out, bool beyond_cache) noexcept {
    using Slot = typename Layout::slot_type;
    id_block<Layout> ring[3];
    alignas(64) std::uint32_t queue[block_size + 16];  // a vector store may write 16 beyond the last
    const Slot* const slots = table.slots<Layout>();
    for (std::size_t step = 0; step < blocks + 2; ++step) {
        if (step < blocks) Kernels::template locate<Layout>(table, ids + step * block_size, ring[step % 3]);
        if (step >= 1 && step - 1 < blocks) {
            auto& block = ring[(step - 1) % 3];
            const auto load = [&](auto ask_ahead) {
                for (std::uint32_t k = 0; k < block_size; ++k) {
                    if constexpr (ask_ahead) prefetch_place<Layout, false>(table, ring[step % 3].place[k]);
                    block.slot[k] = slots[block.place[k]];
                    if constexpr (Layout::keyed) block.index[k] = table.indices[block.place[k]];
                }
            };
            if (beyond_cache && step < blocks)
                load(std::true_type{});
            else
                load(std::false_type{});
        }
        if (step >= 2) {
            const auto& block = ring[(step - 2) % 3];
            auto* const answers = out + (step - 2) * block_size;
            auto queued = Kernels::template settle<Layout>(table, block, answers, queue);
            queued = Kernels::template search<Layout>(table, block, answers, queue, queued);
            for (std::uint32_t q = 0; q < queued; ++q)
                answers[queue[q]] = find_beyond<Layout>(table, stash, block.place[queue[q]], block.tag[queue[q]]);
        }
    }
}

/// Calls with(kernels) with the best kernels of this machine. To call them by pointers costs nothing, since a function
/// with a target attribute is not inlined; so the loops around them need not be compiled for each instruction set.
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
