// SPDX-License-Identifier: MIT
/// @file
/// From an id to a bucket: LIGGGHTS' remainder, and a mixing hash.
#pragma once

#include <tsubu/core/random.hpp>

#include <concepts>  // std::same_as, std::semiregular
#include <cstdint>   // std::uint64_t

namespace tsubu {

/// A hash policy: bucket(id, bucket_count) < bucket_count, the same for equal arguments.
template <class Hash>
concept bucket_hash = std::semiregular<Hash> && requires(std::uint64_t t, std::uint64_t bucket_count) {
    { Hash::bucket(t, bucket_count) } noexcept -> std::same_as<std::uint64_t>;
};

/// h(t) = t mod B, LIGGGHTS' hash.
///
/// Concept:       bucket_hash.
/// Cost:          one 64-bit division.
/// Deterministic: yes.
/// Choose it when results of such a code are to be reproduced.
/// Do not when    ids may be strided: multiples of B fall into one chain. 16 384 ids k * 32771, for which B is 32771,
///                cost 1.3e8 node visits per rebuild.
/// Source:        A9.
struct mod_prime {
    [[nodiscard]] static constexpr std::uint64_t bucket(std::uint64_t t, std::uint64_t bucket_count) noexcept {
        return t % bucket_count;
    }
};
static_assert(bucket_hash<mod_prime>);

/// Mixes every bit of the id into every bit of the bucket; no pattern of ids that simulations make is special.
///
/// The bucket is the high word of (32 mixed bits) * B, so B need not be a power of two.
///
/// Concept:       bucket_hash.
/// Cost:          three multiplications, no division.
/// Deterministic: yes.
/// Choose it when you do not have to reproduce anything.
/// Do not when    chains are to be those of LIGGGHTS' scheme.
/// Source:        splitmix64; the multiply-shift reduction of Lemire 2019, doi:10.1145/3230636.
struct mixed {
    [[nodiscard]] static constexpr std::uint64_t bucket(std::uint64_t t, std::uint64_t bucket_count) noexcept {
        const std::uint64_t high = splitmix64(t) >> 32;
        // B is at most 2^32 + 15, the prime above 2 (2^31 - 1): past 2^32 the product may wrap, but into a bucket.
        return (high * bucket_count) >> 32;
    }
};
static_assert(bucket_hash<mixed>);

}  // namespace tsubu
