// SPDX-License-Identifier: MIT
/// @file
/// How many lines, of which kind, under which hash: the shape of a quotient table, and all that it holds.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/detail/quotient_lines.hpp>
#include <tsubu/id/flat_lines.hpp>

#include <algorithm>  // std::max, std::min
#include <bit>        // std::bit_width
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <cstring>    // std::memset
#include <span>       // std::span
#include <string>     // std::to_string

namespace tsubu {

namespace detail {

/// What a table is to hold.
struct line_demand {
    std::size_t count = 0;  // different ids at most
    std::uint64_t lowest = 0;
    std::uint64_t extent = 0;  // highest - lowest
    std::uint64_t greatest_index = 0;
    std::uint32_t multiplier = 0;  // number in the sequence of multipliers
};

/// The shape of a table: everything but its memory.
struct line_plan {
    line_demand demand;
    line_table table;
    flat_lines lines = flat_lines::narrow;
    std::size_t room = 0;  // different ids, erased ones included, before the table must grow
    std::size_t stash_capacity = 0;
};

inline constexpr std::uint32_t least_range_bits = 8;   // fewer would leave nothing to shift by
inline constexpr std::uint32_t attempts_per_size = 8;  // then more lines, and full ones are no reason for another
inline constexpr std::uint32_t most_attempts = 64;     // eight sizes, each a quarter larger: 4.8 times the lines

/// The k-th of a fixed sequence of odd multipliers; the first is 2^64 / golden ratio.
[[nodiscard]] constexpr std::uint64_t odd_multiplier(std::uint32_t k) noexcept {
    return k == 0 ? golden_stride : splitmix64(k) | 1;
}

/// Bits of h that a line does not imply: 2^r >= number of different h in any line.
[[nodiscard]] constexpr std::uint32_t remainder_bits(std::uint32_t range_bits, std::uint64_t lines) noexcept {
    const std::uint64_t high_words_per_line = ((std::uint64_t{1} << 32) + lines - 1) / lines;
    const auto bits = static_cast<std::uint32_t>(std::bit_width(high_words_per_line - 1));
    if (range_bits >= 32) return range_bits - 32 + bits;
    return bits > 32 - range_bits ? bits - (32 - range_bits) : 0;
}

/// Shapes the table with this many lines. @return false if the slots of Layout have too few bits.
template <class Layout>
[[nodiscard]] bool shape(line_plan& plan, std::uint64_t lines) noexcept {
    auto& table = plan.table;
    const auto index_bits = static_cast<std::uint32_t>(std::bit_width(plan.demand.greatest_index + 1));
    lines = (std::min)(lines, (std::uint64_t{1} << 32) / Layout::slots - 64);  // a place fits 32 bits
    table.lines = static_cast<std::uint32_t>(lines);
    if constexpr (Layout::keyed) {
        table.bits = 64;
        table.tag_shift = 0;
        table.index_bits = 31;
        table.tag_mask = ~std::uint64_t{0};
        table.tag_step = 0;
        table.most_probes = spill_lines;
        table.least_x = 1;
        table.limit = ~std::uint64_t{0} - 1;
    } else {
        table.bits = (std::max)(static_cast<std::uint32_t>(std::bit_width(plan.demand.extent)), least_range_bits);
        if (table.bits > Layout::slot_bits) return false;
        const auto remainder = remainder_bits(table.bits, lines);
        if (remainder + index_bits + least_displacement_bits > Layout::slot_bits) return false;
        const auto displacement_bits = (std::min)(most_displacement_bits, Layout::slot_bits - remainder - index_bits);
        table.tag_shift = table.bits - remainder;
        table.index_bits = index_bits;
        table.tag_mask = ~((std::uint64_t{1} << index_bits) - 1);
        table.tag_step = std::uint64_t{1} << index_bits;
        table.most_probes = (1U << displacement_bits) - 1;
        table.least_x = 0;
        table.limit = table.bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << table.bits) - 1;
        table.base = plan.demand.lowest;
    }
    table.fold = (table.bits + 1) / 2;
    table.multiplier = odd_multiplier(plan.demand.multiplier) << (Layout::slot_bits - table.bits);
    // Load .5 (.6 with keys) as planned; by assign up to 5/8 (3/4), where spilling is still rare.
    plan.room = Layout::keyed ? table.lines * std::size_t{Layout::slots} / 4 * 3
                              : table.lines * std::size_t{Layout::slots} / 8 * 5;
    plan.stash_capacity = 32 + table.lines / 1024;  // random ids leave fewer than one in 1e6 for it
    return true;
}

/// Narrow lines if the bits suffice, else wide, else keyed ones: then base_of_keys() names a value that no id has.
template <class BaseOfKeys>
[[nodiscard]] line_plan plan_lines(const line_demand& demand, BaseOfKeys&& base_of_keys) {
    line_plan plan;
    plan.demand = demand;
    plan.lines = flat_lines::narrow;
    if (shape<narrow_lines>(plan, demand.count / 8 + 1)) return plan;  // 16 slots at load .5
    plan.lines = flat_lines::wide;
    if (shape<wide_lines>(plan, demand.count / 4 + 1)) return plan;  // 8 slots at load .5
    plan.lines = flat_lines::keyed;
    static_cast<void>(shape<keyed_lines>(plan, demand.count * 5 / 24 + 1));  // 8 slots at load .6
    plan.table.base = base_of_keys();
    return plan;
}

/// Another multiplier; after each eight of them a quarter more lines.
inline void next_attempt(line_plan& plan, std::uint32_t multiplier, std::uint32_t attempt) {
    if (attempt >= most_attempts)
        raise<limit_error>("flat_storage::rebuild",
                           std::to_string(plan.demand.count) + " ids did not fit under " + std::to_string(attempt) +
                               " hash multipliers",
                           "use chained_storage for ids made to defeat this hash");
    plan.demand.multiplier = multiplier;
    const std::uint64_t lines =
        attempt % attempts_per_size == 0 ? plan.table.lines + plan.table.lines / 4 + 1 : plan.table.lines;
    switch (plan.lines) {  // more lines leave fewer bits to the slots: what fitted fits
        case flat_lines::narrow: static_cast<void>(shape<narrow_lines>(plan, lines)); break;
        case flat_lines::wide: static_cast<void>(shape<wide_lines>(plan, lines)); break;
        case flat_lines::keyed: static_cast<void>(shape<keyed_lines>(plan, lines)); break;
    }
}

// The memory of a table, in cache lines: the lines themselves, the overflow bits, the indices of keyed lines.

[[nodiscard]] constexpr std::size_t overflow_words(const line_table& table) noexcept {
    return (table.lines + extra_lines + std::size_t{63}) / 64;
}
[[nodiscard]] constexpr std::size_t overflow_offset(const line_table& table) noexcept {
    return table.lines + std::size_t{extra_lines};
}
[[nodiscard]] constexpr std::size_t indices_offset(const line_table& table) noexcept {
    return overflow_offset(table) + (overflow_words(table) + 7) / 8;
}
[[nodiscard]] constexpr std::size_t memory_lines(const line_table& table, flat_lines lines) noexcept {
    return indices_offset(table) +
           (lines == flat_lines::keyed ? (table.lines + extra_lines + std::size_t{1}) / 2 : 0);  // 8 indices of 4 bytes
}

inline void attach(line_table& table, cache_line* memory) noexcept {
    table.memory = memory->bytes;
    table.overflow = reinterpret_cast<std::uint64_t*>(memory + overflow_offset(table));
    table.indices = reinterpret_cast<std::uint32_t*>(memory + indices_offset(table));
}

inline void wipe(const line_table& table, flat_lines lines) noexcept {
    std::memset(table.memory, 0, memory_lines(table, lines) * 64);
}

/// A table without memory of its own, in which nothing is found.
inline constexpr cache_line vacant_lines[extra_lines + 1] = {};
[[nodiscard]] inline line_table no_lines() noexcept {
    line_table table;
    table.memory = const_cast<std::byte*>(vacant_lines[0].bytes);  // never written: it has room for nothing
    table.overflow = reinterpret_cast<std::uint64_t*>(table.memory);
    table.limit = ~std::uint64_t{0};  // every id is looked for, in line 0
    table.index_bits = 0;             // and no index fits, so that the first assign takes memory
    table.tag_step = 1;               // tags are never 0
    table.tag_mask = ~std::uint64_t{0};
    table.bits = least_range_bits;
    table.most_probes = 1;
    return table;
}

[[nodiscard]] constexpr bool index_fits(const line_table& table, index_t index) noexcept {
    return static_cast<std::uint64_t>(index) + 1 < std::uint64_t{1} << table.index_bits;
}

/// A value that no id has: below them, above them, or, if they reach both ends of 64 bits, one that is not
/// taken(value).
template <class Taken>
[[nodiscard]] std::uint64_t value_beside(std::uint64_t lowest, std::uint64_t highest, Taken&& taken) noexcept {
    // Far from both ends: ids that count up or down from them must not meet it. For signed ids it is -1, never an id.
    if (highest != ~std::uint64_t{0}) return ~std::uint64_t{0};
    if (lowest != 0) return 0;
    for (std::uint64_t k = 0;; ++k) {  // fewer than 2^31 of 2^64 values are taken: the first try succeeds
        const auto value = splitmix64(k);
        if (!taken(value)) return value;
    }
}

/// The x that (home line, tag at displacement 0) came from: hashing backwards.
template <class Layout>
[[nodiscard]] std::uint64_t x_of(const line_table& table, std::uint64_t home, typename Layout::slot_type tag) noexcept {
    const auto bits = table.bits;
    const std::uint64_t range_mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    std::uint64_t h = tag;
    if constexpr (!Layout::keyed) {
        const auto remainder_width = bits - table.tag_shift;
        const std::uint64_t remainder =
            remainder_width == 0 ? 0 : std::uint64_t{tag} >> (Layout::slot_bits - remainder_width);
        const std::uint64_t first_high =
            ((home << 32) + table.lines - 1) / table.lines;  // lowest high word of the line
        const std::uint64_t lowest = bits >= 32 ? first_high << (bits - 32)
                                                : (first_high + (std::uint64_t{1} << (32 - bits)) - 1) >> (32 - bits);
        h = lowest + ((remainder - lowest) & ((std::uint64_t{1} << remainder_width) - 1));
    }
    const std::uint64_t odd = table.multiplier >> (Layout::slot_bits - bits);
    std::uint64_t inverse = odd;  // right in 3 bits; each step of Newton doubles them
    for (int step = 0; step < 5; ++step) inverse *= 2 - odd * inverse;
    const std::uint64_t folded = (h * inverse) & range_mask;
    return folded ^ (folded >> table.fold);
}

/// An id and what is stored for it.
struct id_entry {
    std::uint64_t key;
    std::uint32_t index_plus_1;
};

/// Calls each(id as 64 bits, index + 1) for every id that is present.
template <class Layout, class Each>
void for_each_entry(const line_table& table, std::span<const spilled_id> stash, Each&& each) {
    using Slot = typename Layout::slot_type;
    if (table.lines == 0) return;
    for (std::uint64_t line = 0; line < table.lines + spill_lines; ++line) {
        for (std::uint64_t place = line * Layout::slots; place < (line + 1) * Layout::slots; ++place) {
            const Slot slot = table.slots<Layout>()[place];
            if (slot == 0 || index_at<Layout>(table, place) == 0) continue;
            const auto tag = static_cast<Slot>(slot & static_cast<Slot>(table.tag_mask));
            std::uint64_t home = line;
            if constexpr (!Layout::keyed) {
                const auto remainder_width = table.bits - table.tag_shift;
                const auto below = static_cast<Slot>(static_cast<Slot>(tag << remainder_width) >> remainder_width);
                home -= (below >> table.index_bits) - 1;
            }
            each(x_of<Layout>(table, home, tag) + table.base, index_at<Layout>(table, place));
        }
    }
    for (const auto& entry : stash)
        if (entry.index_plus_1 != 0)
            each(x_of<Layout>(table, entry.place / Layout::slots, static_cast<Slot>(entry.tag)) + table.base,
                 entry.index_plus_1);
}

}  // namespace detail
}  // namespace tsubu
