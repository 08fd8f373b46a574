// SPDX-License-Identifier: MIT
/// @file
/// Sets of ids as simulations number them, and as they break hash tables.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <limits>   // std::numeric_limits
#include <utility>  // std::swap
#include <vector>   // std::vector

namespace tsubu::testing {

/// How ids may be numbered. Strides are those that put every id into one bucket of some known table.
enum class id_pattern {
    lattice,        ///< consecutive
    equal,          ///< one id, over and over
    repeated,       ///< about two copies of each id
    blocks,         ///< runs of 32 somewhere in 2^24
    sparse,         ///< random below 8 N
    stride_1009,    ///< the bucket count of LIGGGHTS' scheme at its least capacity
    stride_32771,   ///< its bucket count for 16384 ids
    stride_65536,   ///< equal low 16 bits
    stride_2_32,    ///< equal low 32 bits
    stride_golden,  ///< multiples of 2^64 / golden ratio: the inverse problem of multiplicative hashing
    bit_reversed,   ///< counters with their bits in reverse
    rank_high,      ///< rank << 40 | counter
    rank_low,       ///< counter << 24 | rank
    billions,       ///< rank * 10^9 + counter
    full_width,     ///< any value that the type holds and that is not negative
    extremes,       ///< 0, the highest value of the type, powers of two, and their neighbours
};
/// How many patterns there are.
inline constexpr std::size_t id_pattern_count = static_cast<std::size_t>(id_pattern::extremes) + 1;

/// For messages and tables.
[[nodiscard]] constexpr const char* name_of(id_pattern pattern) noexcept {
    constexpr const char* names[id_pattern_count] = {"lattice",     "equal",         "repeated",     "blocks",
                                                     "sparse",      "stride_1009",   "stride_32771", "stride_65536",
                                                     "stride_2_32", "stride_golden", "bit_reversed", "rank_high",
                                                     "rank_low",    "billions",      "full_width",   "extremes"};
    return names[static_cast<std::size_t>(pattern)];
}

/// `count` ids of this pattern, in the order of their making or shuffled, with or without repeated ids: the stream
/// decides. Values that the type cannot hold are taken modulo its range, never negative.
template <particle_id Id>
[[nodiscard]] std::vector<Id> make_ids(id_pattern pattern, std::size_t count, random_stream& random) {
    constexpr auto highest = static_cast<std::uint64_t>((std::numeric_limits<Id>::max)());
    constexpr int digits = std::numeric_limits<Id>::digits;
    constexpr std::uint64_t one = 1;
    constexpr std::uint64_t extremes[] = {0,         1,         highest,   highest / 2, one << 16,
                                          one << 31, one << 32, one << 53, one << 62};
    const std::uint64_t start = random.below(3) == 0 ? random.below(1'000'000) : random.below(2);
    const std::uint64_t rank_count = 1 + random.below(9);
    std::uint64_t block = 0;
    std::vector<Id> ids;
    ids.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        std::uint64_t value = 0;
        const std::uint64_t counter = start + k;
        switch (pattern) {
            case id_pattern::lattice: value = counter; break;
            case id_pattern::equal: value = start; break;
            case id_pattern::repeated: value = random.below(count / 2 + 1); break;
            case id_pattern::blocks:
                if (k % 32 == 0) block = random.below(one << 24);
                value = block + k % 32;
                break;
            case id_pattern::sparse: value = random.below(8 * count); break;
            case id_pattern::stride_1009: value = counter * 1009; break;
            case id_pattern::stride_32771: value = counter * 32771; break;
            case id_pattern::stride_65536: value = counter << 16; break;
            case id_pattern::stride_2_32: value = counter << 32; break;
            case id_pattern::stride_golden: value = counter * golden_stride >> (64 - digits); break;
            case id_pattern::bit_reversed:
                for (int bit = 0; bit < digits; ++bit) value |= (counter >> bit & 1) << (digits - 1 - bit);
                break;
            case id_pattern::rank_high: value = random.below(rank_count) << 40 | counter; break;
            case id_pattern::rank_low: value = counter << 24 | random.below(rank_count); break;
            case id_pattern::billions: value = random.below(rank_count) * 1'000'000'000 + counter; break;
            case id_pattern::full_width: value = random(); break;
            case id_pattern::extremes: value = extremes[random.below(9)] + random.below(3) - 1; break;
        }
        ids.push_back(static_cast<Id>(value & highest));
    }
    if (count != 0 && random.below(2) == 0)  // as particles that have mixed
        for (std::size_t k = count; k-- > 1;) std::swap(ids[k], ids[random.below(k + 1)]);
    if (count != 0 && random.below(2) == 0)  // as ghosts: one in eight is the image of another
        for (std::size_t k = 0; k < count / 8; ++k) ids[random.below(count)] = ids[random.below(count)];
    return ids;
}

}  // namespace tsubu::testing
