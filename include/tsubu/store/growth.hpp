// SPDX-License-Identifier: MIT
/// @file
/// Growth policies: how much memory a store takes when it is full.
///
/// | policy | reallocations of n appends | elements copied | choose it when |
/// |---|---|---|---|
/// | geometric_growth (default) | O(log n) | O(n) | the number of particles changes |
/// | block_growth | n / 16384 | O(n^2) | results and memory of LIGGGHTS' scheme are to be reproduced |
#pragma once

#include <tsubu/core/error.hpp>

#include <algorithm>  // std::max
#include <concepts>   // std::same_as, std::semiregular
#include <cstdint>    // std::uint64_t
#include <limits>     // std::numeric_limits
#include <string>     // std::to_string

namespace tsubu {

/// Particles per block of memory (C1).
inline constexpr std::uint64_t store_block = 16384;
/// Entries per block of what only some particles have (C2).
inline constexpr std::uint64_t bonus_block = 8192;

/// The next capacity in whole blocks, strictly greater: 16384 -> 32768 (C1, C2). @throws limit_error past 64 bits.
[[nodiscard]] constexpr std::uint64_t next_block(std::uint64_t capacity, std::uint64_t block = store_block) {
    const auto blocks = capacity / block + 1;
    if (blocks > (std::numeric_limits<std::uint64_t>::max)() / block)
        detail::raise<limit_error>("next_block", "no whole block above " + std::to_string(capacity) + " fits 64 bits",
                                   "ask for fewer");
    return blocks * block;
}
/// The least multiple of a block that holds n: 0 -> 0, 16384 -> 16384, 16385 -> 32768.
/// @throws limit_error past 64 bits.
[[nodiscard]] constexpr std::uint64_t round_up(std::uint64_t n, std::uint64_t block = store_block) {
    return n % block == 0 ? n : next_block(n, block);
}

/// How much a full store takes.
///  1. next(capacity, needed) is at least needed, above capacity, and a multiple of store_block.
template <class Growth>
concept growth_policy = std::semiregular<Growth> && requires(const Growth& growth, std::uint64_t n) {
    { growth.next(n, n) } -> std::same_as<std::uint64_t>;
};

/// Half as much again, in whole blocks: n appends copy fewer than 3 n elements in all.
///
/// Concept: growth_policy. Cost: O(n) for n appends; bytes: up to half as much again. Deterministic: yes.
/// Choose it when particles come and go. Do not when memory must stay within a block of the need.
struct geometric_growth {
    [[nodiscard]] constexpr std::uint64_t next(std::uint64_t capacity, std::uint64_t needed) const {
        return round_up((std::max)({needed, capacity + capacity / 2, capacity + 1}));
    }
};
static_assert(growth_policy<geometric_growth>);

/// One block more, whatever there is: 1e8 appends copy 3e11 elements.
///
/// Concept: growth_policy. Cost: O(n^2) for n appends; bytes: up to a block more. Deterministic: yes.
/// Choose it when LIGGGHTS' memory is to be reproduced (C1). Do not when many are appended.
struct block_growth {
    [[nodiscard]] constexpr std::uint64_t next(std::uint64_t capacity, std::uint64_t needed) const {
        return (std::max)(next_block(capacity), round_up(needed));
    }
};
static_assert(growth_policy<block_growth>);

}  // namespace tsubu
