// SPDX-License-Identifier: MIT
/// @file
/// The fastest ordinary read of some memory: the limit for whatever has to look at every byte of it once.
#pragma once

#include <tsubu/core/instruction_set.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <cstring>  // std::memcpy
#include <span>     // std::span

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

namespace bench {
namespace detail {

/// Four sums, so that no addition waits for the one before.
[[nodiscard]] inline std::uint64_t read_portable(const unsigned char* bytes, std::size_t count) noexcept {
    std::uint64_t sums[4] = {};
    std::size_t i = 0;
    for (; i + sizeof sums <= count; i += sizeof sums) {
        std::uint64_t words[4];
        std::memcpy(words, bytes + i, sizeof words);
        for (std::size_t k = 0; k < 4; ++k) sums[k] += words[k];
    }
    for (; i < count; ++i) sums[0] += bytes[i];
    return sums[0] + sums[1] + sums[2] + sums[3];
}

#if defined(__x86_64__) && defined(__GNUC__)
[[nodiscard, gnu::target("avx2")]] inline std::uint64_t read_avx2(const unsigned char* bytes,
                                                                  std::size_t count) noexcept {
    __m256i a = _mm256_setzero_si256(), b = a, c = a, d = a;
    const auto* from = reinterpret_cast<const __m256i*>(bytes);
    const std::size_t rounds = count / 128;
    for (std::size_t i = 0; i < rounds; ++i, from += 4) {
        a = _mm256_add_epi64(a, _mm256_loadu_si256(from));
        b = _mm256_add_epi64(b, _mm256_loadu_si256(from + 1));
        c = _mm256_add_epi64(c, _mm256_loadu_si256(from + 2));
        d = _mm256_add_epi64(d, _mm256_loadu_si256(from + 3));
    }
    std::uint64_t sums[4];
    a = _mm256_add_epi64(_mm256_add_epi64(a, b), _mm256_add_epi64(c, d));
    std::memcpy(sums, &a, sizeof sums);
    return sums[0] + sums[1] + sums[2] + sums[3] + read_portable(bytes + 128 * rounds, count - 128 * rounds);
}
#endif

}  // namespace detail

/// A sum of all the bytes, with vectors where the batched predicates have them.
template <class Value>
[[nodiscard]] std::uint64_t plain_read(std::span<const Value> values) noexcept {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
#if defined(__x86_64__) && defined(__GNUC__)
    if (tsubu::best_instruction_set() != tsubu::instruction_set::portable)
        return detail::read_avx2(bytes, values.size_bytes());
#endif
    return detail::read_portable(bytes, values.size_bytes());
}

}  // namespace bench
