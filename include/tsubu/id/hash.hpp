// SPDX-License-Identifier: MIT
/// @file
/// From an id to a bucket: the notes' remainder, and a mixing hash.
#pragma once

#include <tsubu/core/random.hpp>

#include <concepts>  // std::semiregular
#include <cstdint>   // std::uint64_t

namespace tsubu {

/// A hash policy: bucket(id, bucket_count) < bucket_count, the same for equal arguments.
template <class Hash>
concept bucket_hash = std::semiregular<Hash> && requires(std::uint64_t id, std::uint64_t bucket_count) {
    { Hash::bucket(id, bucket_count) } noexcept -> std::same_as<std::uint64_t>;
};

/// h(t) = t mod B, the notes' hash.
///
/// Choose it when: results of such a code are to be reproduced. Do not when: ids may be strided. Ids that are
/// multiples of B fall into one chain: 40 000 ids k * 32771 cost 8e8 node visits per build.
/// Source: A9.
struct mod_prime {
    [[nodiscard]] static constexpr std::uint64_t bucket(std::uint64_t id, std::uint64_t bucket_count) noexcept {
        return id % bucket_count;
    }
};
static_assert(bucket_hash<mod_prime>);

/// Mixes every bit of the id into every bit of the bucket; no pattern of ids that simulations make is special.
///
/// The bucket is the high word of mixed * B, so B need not be a power of two, and no division is needed.
/// Source: splitmix64; the multiply-shift reduction of Lemire 2019, doi:10.1145/3230636.
struct mixed {
    [[nodiscard]] static constexpr std::uint64_t bucket(std::uint64_t id, std::uint64_t bucket_count) noexcept {
        const std::uint64_t high = splitmix64(id) >> 32;
        return (high * bucket_count) >> 32;  // exact while bucket_count < 2^32: indices have 31 bits
    }
};
static_assert(bucket_hash<mixed>);

}  // namespace tsubu
