// SPDX-License-Identifier: MIT
/// @file
/// Lines of slots that identify an id exactly without storing it: the table inside flat_storage.
///
/// x = id - base has W bits. h(x) = (x ^ (x >> fold)) * multiplier mod 2^W is a bijection (fold >= W/2, multiplier
/// odd). The line is floor(h * lines / 2^W), so the line implies all but the low r bits of h, r = about W -
/// log2(lines): a slot that keeps those r bits tells every id of its line from every other.
///
///     slot, 32 or 64 bits      | remainder (r) |  unused  | displacement + 1 (2..3) | index + 1 |      0 = empty
///                               <------------ tag, under tag_mask ----------------->
///     line, 64 bytes           | slot | slot | slot | ...                16 slots of 4 bytes, or 8 of 8 bytes
///     table                    | line 0 | ... | line lines-1 | 7 lines for what the last ones spill | 1 empty line |
///                              | overflow: one bit per line | indices (keyed lines only) |
///
/// The bits of h below those that choose the line choose the preferred slot. An id lies in the first slot at or
/// after the preferred one (around the line's end) that was free; if the line was full, the line's overflow bit is set
/// and the id lies in one of the next lines, with its displacement; what finds no place there goes to a small stash.
/// It is critical that no slot becomes empty again before the table is cleared: then an empty slot on the way of an id
/// means that the id is not there. So erase leaves the tag and sets index + 1 to 0, which a look-up reads as absent.
/// Tags are never 0, since displacement + 1 is not, so an empty slot never matches.
///
/// Keyed lines hold ids of more bits than fit: the slot is h in full (8 bytes), the index + 1 stands in an array
/// beside it; base is a value that no id has, so h is never 0.
///
/// A pattern of ids that one multiplier maps badly shows itself by many full lines, or by a full stash: the next
/// multiplier is taken, and remembered.
///
/// Source: quotienting as in Cleary 1984, "Compact hash tables using bidirectional linear probing",
/// doi:10.1109/TC.1984.1676499; multiply-shift hashing as in Dietzfelbinger et al. 1997, doi:10.1006/jagm.1997.0873.
#pragma once

#include <tsubu/core/types.hpp>

#include <bit>      // std::countr_zero
#include <cstddef>  // std::byte
#include <cstdint>  // std::uint32_t
#include <cstring>  // std::memset
#include <span>     // std::span

#if defined(__SSE2__)
#include <emmintrin.h>  // part of every x86-64
#endif

namespace tsubu::detail {

/// 64 bytes, the unit of transfer between memory and cache, and of allocation.
struct alignas(64) cache_line {
    std::byte bytes[64];
};

inline constexpr std::uint32_t spill_lines = 7;                // displacement + 1 has at most 3 bits: 1 .. 7
inline constexpr std::uint32_t extra_lines = spill_lines + 1;  // and the line that is always empty
inline constexpr std::uint32_t most_displacement_bits =
    3;  // an id 7 lines from home would be one of 100 in a row without a free slot
inline constexpr std::uint32_t least_displacement_bits = 2;  // 1 bit would leave no displacement but 0

/// How one line is read: as 16 slots of 4 bytes, 8 of 8 bytes, or 8 keys of 8 bytes.
template <class Slot, bool Keyed = false>
struct line_layout {
    using slot_type = Slot;
    static constexpr bool keyed = Keyed;
    static constexpr std::uint32_t slot_bits = sizeof(Slot) * 8;
    static constexpr std::uint32_t slots = 64 / sizeof(Slot);
    static constexpr std::uint32_t place_shift = 32 - static_cast<std::uint32_t>(std::countr_zero(slots));
    static_assert(!Keyed || sizeof(Slot) == 8);
};
using narrow_lines = line_layout<std::uint32_t>;
using wide_lines = line_layout<std::uint64_t>;
using keyed_lines = line_layout<std::uint64_t, true>;

/// What an id becomes: its preferred place (line * slots + slot) and its tag at displacement 0.
template <class Slot>
struct located {
    std::uint64_t place;
    Slot tag;
};

/// Everything a look-up needs, held by value: parameters of the hash and where the lines are.
struct line_table {
    std::byte* memory = nullptr;        // lines, then overflow bits, then indices
    std::uint64_t* overflow = nullptr;  // bit L: something passed line L because it was full
    std::uint32_t* indices = nullptr;   // keyed lines only: index + 1 per place
    std::uint64_t base = 0;             // x = id - base
    std::uint64_t limit = 0;            // x - least_x <= limit, else the id cannot be here
    std::uint64_t least_x = 0;          // 0; for keyed lines 1: the base itself is no id
    std::uint64_t multiplier = 0;       // odd * 2^(slot_bits - W)
    std::uint32_t fold = 0;             // ceil(W / 2)
    std::uint32_t bits = 0;             // W
    std::uint32_t tag_shift = 0;        // W - r: brings the remainder to the top of the slot
    std::uint32_t index_bits = 0;
    std::uint32_t lines = 0;
    std::uint32_t most_probes = 0;  // lines an id may lie in: greatest displacement + 1
    std::uint64_t tag_mask = 0;
    std::uint64_t tag_step = 0;  // displacement + 1 counts in units of this; 0 for keyed lines

    template <class Layout>
    [[nodiscard]] auto* slots() const noexcept {
        return reinterpret_cast<typename Layout::slot_type*>(memory);
    }
    template <class Layout>
    [[nodiscard]] bool may_hold(std::uint64_t x) const noexcept {
        return Layout::keyed ? x != 0 : x <= limit;
    }
    /// 1 if ids were passed on from this line, else 0: to be combined with & where && would be a branch.
    [[nodiscard]] std::uint32_t overflow_bit(std::uint64_t line) const noexcept {
        return static_cast<std::uint32_t>(overflow[line / 64] >> (line % 64)) & 1U;
    }
    /// Place of the line that is always empty: where ids out of range look.
    template <class Layout>
    [[nodiscard]] std::uint32_t nowhere() const noexcept {
        return (lines + spill_lines) * Layout::slots;
    }

    template <class Layout>
    [[nodiscard, gnu::always_inline]] located<typename Layout::slot_type> locate(std::uint64_t x) const noexcept {
        using Slot = typename Layout::slot_type;
        const auto narrow = static_cast<Slot>(x);
        const auto h = static_cast<Slot>((narrow ^ (narrow >> fold)) * static_cast<Slot>(multiplier));
        const std::uint64_t high = h >> (Layout::slot_bits - 32);
        const auto tag = static_cast<Slot>(static_cast<Slot>(h << tag_shift) | static_cast<Slot>(tag_step));
        return {high * lines >> Layout::place_shift, tag};
    }
};

/// Bit k (16 slots) or bit 2 k (8 slots): slot k of the line matches the tag, under the mask.
template <class Layout>
[[nodiscard, gnu::always_inline]] inline std::uint32_t matches(const typename Layout::slot_type* line,
                                                               typename Layout::slot_type tag,
                                                               typename Layout::slot_type mask) noexcept {
#if defined(__SSE2__)
    const auto* quarter = reinterpret_cast<const __m128i*>(line);
    __m128i wanted;
    __m128i under;
    if constexpr (Layout::slots == 16) {
        wanted = _mm_set1_epi32(static_cast<int>(tag));
        under = _mm_set1_epi32(static_cast<int>(mask));
    } else {
        wanted = _mm_set1_epi64x(static_cast<long long>(tag));
        under = _mm_set1_epi64x(static_cast<long long>(mask));
    }
    const auto equal = [&](int k) {
        return _mm_cmpeq_epi32(_mm_and_si128(_mm_load_si128(quarter + k), under), wanted);
    };
    const auto halves = static_cast<std::uint32_t>(
        _mm_movemask_epi8(_mm_packs_epi16(_mm_packs_epi32(equal(0), equal(1)), _mm_packs_epi32(equal(2), equal(3)))));
    if constexpr (Layout::slots == 16) return halves;
    // 64-bit slots: both halves must match; the pairs of bits 0 1, 2 3, ... become bits 0, 2, ...
    return halves & halves >> 1 & 0x5555U;
#else
    std::uint32_t found = 0;
    for (std::uint32_t k = 0; k < Layout::slots; ++k)
        found |= static_cast<std::uint32_t>((line[k] & mask) == tag) << (Layout::slots == 16 ? k : 2 * k);
    return found;
#endif
}

/// The slot that the lowest bit of `found` names, some slot if there is none. Bit 16 lies above the slots of one line:
/// it spares the branch that countr_zero takes for 0.
template <class Layout, std::uint32_t BitsPerSlot = 16 / Layout::slots>
[[nodiscard, gnu::always_inline]] inline std::uint32_t first_match(std::uint32_t found) noexcept {
    return static_cast<std::uint32_t>(std::countr_zero(found | 0x10000U)) / BitsPerSlot % Layout::slots;
}

/// index + 1 that stands at a place.
template <class Layout>
[[nodiscard, gnu::always_inline]] inline std::uint32_t index_at(const line_table& table, std::uint64_t place) noexcept {
    if constexpr (Layout::keyed) {
        return table.indices[place];
    } else {
        using Slot = typename Layout::slot_type;
        return static_cast<std::uint32_t>(table.slots<Layout>()[place] & static_cast<Slot>(~table.tag_mask));
    }
}

/// index + 1 -> index, or absent; by a mask, because a compiler may turn ?: into a branch that is then mispredicted.
[[nodiscard, gnu::always_inline]] inline index_t index_if(bool there, std::uint32_t index_plus_1) noexcept {
    return static_cast<index_t>(index_plus_1 & (0U - static_cast<std::uint32_t>(there))) - 1;
}

/// Stores the id at its preferred place if that is empty. @return whether it was; no branch depends on it.
template <class Layout>
[[nodiscard, gnu::always_inline]] inline bool store_if_free(const line_table& table, std::uint64_t place,
                                                            typename Layout::slot_type tag,
                                                            std::uint32_t index_plus_1) noexcept {
    using Slot = typename Layout::slot_type;
    Slot& slot = table.slots<Layout>()[place];
    const bool taken = slot != 0;
    const auto if_free = static_cast<Slot>(static_cast<Slot>(taken) - 1);  // all ones, or 0
    if constexpr (Layout::keyed) {
        slot |= tag & if_free;
        table.indices[place] |= index_plus_1 & static_cast<std::uint32_t>(if_free);
    } else {
        slot |= (tag | static_cast<Slot>(index_plus_1)) & if_free;
    }
    return !taken;
}

template <class Layout>
[[gnu::always_inline]] inline void write_slot(const line_table& table, std::uint64_t place,
                                              typename Layout::slot_type tag, std::uint32_t index_plus_1) noexcept {
    using Slot = typename Layout::slot_type;
    if constexpr (Layout::keyed) {
        table.slots<Layout>()[place] = tag;
        table.indices[place] = index_plus_1;
    } else {
        table.slots<Layout>()[place] = static_cast<Slot>(tag | static_cast<Slot>(index_plus_1));
    }
}

/// Where the search for an id ended.
struct search_end {
    enum class outcome { match, free_slot, boundary };
    outcome what = outcome::boundary;
    std::uint64_t place = 0;  // of the match or the free slot
    std::uint32_t probe = 0;  // lines between it and the home line
};

/// Walks from the preferred slot to the first match or the first free slot, in the home line and those after it;
/// never past end_line, where another part of the table may begin that is not filled yet.
template <class Layout>
[[nodiscard]] inline search_end walk(const line_table& table, std::uint64_t place, typename Layout::slot_type tag,
                                     std::uint64_t end_line) noexcept {
    using Slot = typename Layout::slot_type;
    const auto* slots = table.slots<Layout>();
    const auto mask = static_cast<Slot>(table.tag_mask);
    const std::uint64_t home = place / Layout::slots;
    const auto preferred = static_cast<std::uint32_t>(place % Layout::slots);
    for (std::uint32_t probe = 0; probe < table.most_probes && home + probe < end_line; ++probe) {
        const std::uint64_t first = (home + probe) * Layout::slots;
        for (std::uint32_t k = 0; k < Layout::slots; ++k) {
            const auto at = first + (preferred + k) % Layout::slots;
            if (slots[at] == 0) return {search_end::outcome::free_slot, at, probe};
            if ((slots[at] & mask) == tag) return {search_end::outcome::match, at, probe};
        }
        tag = static_cast<Slot>(tag + static_cast<Slot>(table.tag_step));
    }
    return {};
}

/// An id that found no place in its lines: (place, tag) name it as exactly as the id does.
struct spilled_id {
    std::uint64_t tag;
    std::uint32_t place;
    std::uint32_t index_plus_1;
};

/// The rare rest of a look-up, if the home line is full and does not hold the id: the lines after it, then the stash.
template <class Layout>
[[nodiscard, gnu::noinline]] index_t find_beyond(const line_table& table, std::span<const spilled_id> stash,
                                                 std::uint64_t place, typename Layout::slot_type tag) noexcept {
    if (table.overflow_bit(place / Layout::slots) == 0) return absent;
    const auto end = walk<Layout>(table, place, tag, table.lines + spill_lines);
    if (end.what == search_end::outcome::match) return static_cast<index_t>(index_at<Layout>(table, end.place)) - 1;
    if (end.what == search_end::outcome::boundary)
        for (const auto& entry : stash)
            if (entry.place == place && entry.tag == tag) return static_cast<index_t>(entry.index_plus_1) - 1;
    return absent;
}

/// The answer for one id, once its home line is compared: found is not 0 if it is there, at that place. No
/// branch depends on whether it is there, nor in which slot: looking at the preferred slot first would save some
/// instructions on hits, but its mispredicted branches double the time of misses.
template <class Layout>
[[nodiscard, gnu::always_inline]] inline index_t answer(const line_table& table, std::uint64_t place,
                                                        typename Layout::slot_type tag, std::uint32_t found) noexcept {
    if constexpr (Layout::keyed)
        return index_if(found != 0, table.indices[place]);
    else  // a slot that matches is the tag and the index
        return index_if(found != 0, static_cast<std::uint32_t>(table.slots<Layout>()[place] - tag));
}

/// Stores an id in its home line, which has a match for it or a vacant slot: at the match, else in the first vacant
/// slot from the preferred one on. Its link is written, or, if they are all absent already, only where it is not. Which
/// slot it is decides no branch, as long as the compiler makes a conditional move of the choice. @return 1 if there was
/// a match, else 0.
template <class Layout, std::uint32_t BitsPerSlot, bool LinksAreAbsent = false>
[[gnu::always_inline]] inline std::uint32_t put_in_home_line(const line_table& table, index_t* links,
                                                             std::uint64_t place, typename Layout::slot_type tag,
                                                             std::uint32_t index_plus_1, std::uint32_t same,
                                                             std::uint32_t vacant) noexcept {
    constexpr std::uint32_t line_bits = Layout::slots * BitsPerSlot;
    const auto preferred = static_cast<std::uint32_t>(place % Layout::slots);
    const auto from_preferred = (vacant | vacant << line_bits) >> (preferred * BitsPerSlot);
    const auto free_slot = preferred + first_match<Layout, BitsPerSlot>(from_preferred);
    const auto is_repeated = static_cast<std::uint32_t>(same != 0);
    const auto slot = same != 0 ? first_match<Layout, BitsPerSlot>(same) : free_slot;
    const auto at = (place & ~std::uint64_t{Layout::slots - 1}) + slot % Layout::slots;
    if (links != nullptr && (!LinksAreAbsent || is_repeated != 0))
        links[index_plus_1 - 1] = static_cast<index_t>(index_at<Layout>(table, at)) - 1;
    write_slot<Layout>(table, at, tag, index_plus_1);  // a free slot had index + 1 = 0: its link is absent
    return is_repeated;
}

/// Clears lines [first, end), with their overflow bits and indices; the last part clears the lines after them too.
/// first is a multiple of 64, so that no two parts share a word of overflow bits.
template <class Layout>
void wipe_lines(const line_table& table, std::uint64_t first, std::uint64_t end) noexcept {
    if (first >= end) return;
    if (end == table.lines) end += extra_lines;
    std::memset(table.memory + first * 64, 0, (end - first) * 64);
    std::memset(table.overflow + first / 64, 0, ((end + 63) / 64 - first / 64) * sizeof(std::uint64_t));
    if constexpr (Layout::keyed)
        std::memset(table.indices + first * Layout::slots, 0, (end - first) * Layout::slots * sizeof(std::uint32_t));
}

}  // namespace tsubu::detail
