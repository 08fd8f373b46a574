// SPDX-License-Identifier: MIT
/// @file
/// The loops of quotient_kernels.hpp in AVX2.
#pragma once

#include <tsubu/id/detail/quotient_kernels.hpp>

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>  // the functions below carry the target attributes that it needs

#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint32_t
#include <type_traits>  // std::is_signed_v

namespace tsubu::detail {

/// 256-bit vectors: 8 narrow or 4 wide slots at a time.
struct avx2_kernels {
    template <class Layout, class Id>
    [[gnu::target("avx2,bmi2")]] static void locate(const line_table& table, const Id* ids,
                                                    id_block<Layout>& block) noexcept {
        // AVX2 compares signed only: both sides are moved by 2^63.
        constexpr auto sign = static_cast<long long>(0x8000000000000000U);
        const std::uint64_t first = table.base + table.least_x;
        const __m256i base = _mm256_set1_epi64x(static_cast<long long>(first));
        const __m256i least = _mm256_set1_epi64x(static_cast<long long>(table.least_x));
        const __m256i limit = _mm256_set1_epi64x(static_cast<long long>(table.limit) ^ sign);
        const __m256i flip = _mm256_set1_epi64x(sign);
        const __m256i lines = _mm256_set1_epi64x(table.lines);
        const __m256i nowhere = _mm256_set1_epi32(static_cast<int>(table.nowhere<Layout>()));
        const __m128i fold = _mm_cvtsi32_si128(static_cast<int>(table.fold));
        const __m128i tag_shift = _mm_cvtsi32_si128(static_cast<int>(table.tag_shift));
        for (std::uint32_t k = 0; k < block_size; k += 8) {
            const __m256i from0 = _mm256_sub_epi64(load_4(ids + k), base);
            const __m256i from1 = _mm256_sub_epi64(load_4(ids + k + 4), base);
            const __m256i outside = low_words(_mm256_cmpgt_epi64(_mm256_xor_si256(from0, flip), limit),
                                              _mm256_cmpgt_epi64(_mm256_xor_si256(from1, flip), limit));
            __m256i place;
            if constexpr (Layout::slots == 16) {
                const __m256i multiplier = _mm256_set1_epi32(static_cast<int>(table.multiplier));
                const __m256i step = _mm256_set1_epi32(static_cast<int>(table.tag_step));
                const __m256i x = low_words(from0, from1);
                const __m256i h = _mm256_mullo_epi32(_mm256_xor_si256(x, _mm256_srl_epi32(x, fold)), multiplier);
                const __m256i even = _mm256_srli_epi64(_mm256_mul_epu32(h, lines), Layout::place_shift);
                const __m256i odd =
                    _mm256_slli_epi64(_mm256_mul_epu32(_mm256_srli_epi64(h, 32), lines), 32 - Layout::place_shift);
                place = _mm256_blend_epi32(even, odd, 0xAA);
                _mm256_store_si256(reinterpret_cast<__m256i*>(block.tag + k),
                                   _mm256_or_si256(_mm256_sll_epi32(h, tag_shift), step));
            } else {
                const __m256i step = _mm256_set1_epi64x(static_cast<long long>(table.tag_step));
                const __m256i x0 = _mm256_add_epi64(from0, least);
                const __m256i x1 = _mm256_add_epi64(from1, least);
                const __m256i h0 = multiply(_mm256_xor_si256(x0, _mm256_srl_epi64(x0, fold)), table.multiplier);
                const __m256i h1 = multiply(_mm256_xor_si256(x1, _mm256_srl_epi64(x1, fold)), table.multiplier);
                place = low_words(_mm256_srli_epi64(_mm256_mul_epu32(_mm256_srli_epi64(h0, 32), lines),
                                                    Layout::place_shift),
                                  _mm256_srli_epi64(_mm256_mul_epu32(_mm256_srli_epi64(h1, 32), lines),
                                                    Layout::place_shift));
                _mm256_store_si256(reinterpret_cast<__m256i*>(block.tag + k),
                                   _mm256_or_si256(_mm256_sll_epi64(h0, tag_shift), step));
                _mm256_store_si256(reinterpret_cast<__m256i*>(block.tag + k + 4),
                                   _mm256_or_si256(_mm256_sll_epi64(h1, tag_shift), step));
            }
            _mm256_store_si256(reinterpret_cast<__m256i*>(block.place + k),
                               _mm256_blendv_epi8(place, nowhere, outside));
        }
    }

    template <class Layout>
    [[gnu::target("avx2,bmi2")]] static std::uint32_t settle(const line_table& table, const id_block<Layout>& block,
                                                             index_t* out, std::uint32_t* queue) noexcept {
        const __m256i one = _mm256_set1_epi32(1);
        const __m256i zero = _mm256_setzero_si256();
        const __m256i mask = set1_mask<Layout>(table);
        std::uint32_t queued = 0;
        for (std::uint32_t k = 0; k < block_size; k += 8) {
            __m256i match;
            __m256i vacant;
            __m256i index;
            if constexpr (Layout::slots == 16) {
                const __m256i slot = load(block.slot + k);
                match = _mm256_cmpeq_epi32(_mm256_and_si256(slot, mask), load(block.tag + k));
                vacant = _mm256_cmpeq_epi32(slot, zero);
                index = _mm256_andnot_si256(mask, slot);
            } else {
                const __m256i low = load(block.slot + k);
                const __m256i high = load(block.slot + k + 4);
                match = low_words(_mm256_cmpeq_epi64(_mm256_and_si256(low, mask), load(block.tag + k)),
                                  _mm256_cmpeq_epi64(_mm256_and_si256(high, mask), load(block.tag + k + 4)));
                vacant = low_words(_mm256_cmpeq_epi64(low, zero), _mm256_cmpeq_epi64(high, zero));
                if constexpr (Layout::keyed)
                    index = load(block.index + k);
                else
                    index = low_words(_mm256_andnot_si256(mask, low), _mm256_andnot_si256(mask, high));
            }
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + k),
                                _mm256_sub_epi32(_mm256_and_si256(index, match), one));
            const auto left =
                ~static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_or_si256(match, vacant)))) &
                0xFFU;
            for (std::uint32_t j = 0; j < 8; ++j) {  // no branch: about one in five is left, at random
                queue[queued] = k + j;
                queued += left >> j & 1;
            }
        }
        return queued;
    }

    template <class Layout>
    [[gnu::target("avx2,bmi,bmi2")]] static std::uint32_t search(const line_table& table, const id_block<Layout>& block,
                                                                 index_t* out, std::uint32_t* queue,
                                                                 std::uint32_t queued) noexcept {
        const __m256i mask = set1_mask<Layout>(table);
        std::uint32_t kept = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto first = block.place[k] & ~(Layout::slots - 1);
            const auto found = matches_under<Layout>(table.slots<Layout>() + first, mask, block.tag[k]);
            out[k] = answer<Layout>(table, first + first_match<Layout, 1>(found), block.tag[k], found);
            queue[kept] = k;
            kept += static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots);
        }
        return kept;
    }

    template <class Layout, bool LinksAreAbsent>
    [[gnu::target("avx2,bmi,bmi2")]] static std::uint32_t insert(const line_table& table, const id_block<Layout>& block,
                                                                 std::uint32_t index_plus_1, index_t* links,
                                                                 std::uint32_t* queue, std::uint32_t queued,
                                                                 std::size_t& repeated) noexcept {
        const __m256i mask = set1_mask<Layout>(table);
        std::uint32_t kept = 0;
        std::uint32_t met = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto first = block.place[k] & ~(Layout::slots - 1);
            const auto* const line = table.slots<Layout>() + first;
            const auto same = matches_under<Layout>(line, mask, block.tag[k]);
            const auto vacant = matches_under<Layout>(line, _mm256_set1_epi32(-1), 0);
            if ((same | vacant) == 0) [[unlikely]]
                queue[kept++] = k;
            else
                met += put_in_home_line<Layout, 1, LinksAreAbsent>(table, links, block.place[k], block.tag[k],
                                                                   index_plus_1 + k, same, vacant);
        }
        repeated += met;
        return kept;
    }

    template <class Layout, class Spills>
    [[gnu::target("avx2,bmi,bmi2")]] static index_t find(const line_table& table, const Spills& stash,
                                                         std::uint64_t t) noexcept {
        const auto x = t - table.base;
        if (!table.may_hold<Layout>(x)) return absent;
        const auto at = table.locate<Layout>(x);
        const auto first = at.place & ~std::uint64_t{Layout::slots - 1};
        const auto found = matches_under<Layout>(table.slots<Layout>() + first, set1_mask<Layout>(table), at.tag);
        if ((static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots)) != 0) [[unlikely]]
            return find_beyond<Layout>(table, stash.entries(), at.place, at.tag);
        return answer<Layout>(table, first + _tzcnt_u32(found), at.tag,
                              found);  // nothing found: 32 slots further, in lines that are there
    }

private:
    [[gnu::target("avx2"), gnu::always_inline]] static inline __m256i load(const void* from) noexcept {
        return _mm256_load_si256(static_cast<const __m256i*>(from));
    }
    template <class Id>
    [[gnu::target("avx2"), gnu::always_inline]] static inline __m256i load_4(const Id* ids) noexcept {
        if constexpr (sizeof(Id) == 8)
            return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
        else if constexpr (std::is_signed_v<Id>)
            return _mm256_cvtepi32_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(ids)));
        else
            return _mm256_cvtepu32_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(ids)));
    }
    /// Bit k: slot k of the line is the tag, under the mask.
    template <class Layout>
    [[gnu::target("avx2"), gnu::always_inline]] static inline std::uint32_t matches_under(
        const typename Layout::slot_type* line, __m256i mask, typename Layout::slot_type tag) noexcept {
        const __m256i low = _mm256_and_si256(load(line), mask);
        const __m256i high = _mm256_and_si256(load(line + Layout::slots / 2), mask);
        if constexpr (Layout::slots == 16) {
            const __m256i wanted = _mm256_set1_epi32(static_cast<int>(tag));
            return movemask_32(_mm256_cmpeq_epi32(low, wanted)) | movemask_32(_mm256_cmpeq_epi32(high, wanted)) << 8;
        } else {
            const __m256i wanted = _mm256_set1_epi64x(static_cast<long long>(tag));
            return movemask_64(_mm256_cmpeq_epi64(low, wanted)) | movemask_64(_mm256_cmpeq_epi64(high, wanted)) << 4;
        }
    }
    /// The low halves of four and four 64-bit words, in order.
    [[gnu::target("avx2"), gnu::always_inline]] static inline __m256i low_words(__m256i first,
                                                                                __m256i second) noexcept {
        const __m256i picked = _mm256_castps_si256(
            _mm256_shuffle_ps(_mm256_castsi256_ps(first), _mm256_castsi256_ps(second), _MM_SHUFFLE(2, 0, 2, 0)));
        return _mm256_permute4x64_epi64(picked, _MM_SHUFFLE(3, 1, 2, 0));
    }
    /// a * b mod 2^64 in each word; AVX2 has 32 x 32 -> 64 only.
    [[gnu::target("avx2"), gnu::always_inline]] static inline __m256i multiply(__m256i a, std::uint64_t b) noexcept {
        const __m256i b_low = _mm256_set1_epi64x(static_cast<long long>(b & 0xFFFFFFFFU));
        const __m256i b_high = _mm256_set1_epi64x(static_cast<long long>(b >> 32));
        const __m256i cross =
            _mm256_add_epi64(_mm256_mul_epu32(_mm256_srli_epi64(a, 32), b_low), _mm256_mul_epu32(a, b_high));
        return _mm256_add_epi64(_mm256_mul_epu32(a, b_low), _mm256_slli_epi64(cross, 32));
    }
    template <class Layout>
    [[gnu::target("avx2"), gnu::always_inline]] static inline __m256i set1_mask(const line_table& table) noexcept {
        if constexpr (Layout::slots == 16)
            return _mm256_set1_epi32(static_cast<int>(table.tag_mask));
        else
            return _mm256_set1_epi64x(static_cast<long long>(table.tag_mask));
    }
    [[gnu::target("avx2"), gnu::always_inline]] static inline std::uint32_t movemask_32(__m256i v) noexcept {
        return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(v)));
    }
    [[gnu::target("avx2"), gnu::always_inline]] static inline std::uint32_t movemask_64(__m256i v) noexcept {
        return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_castsi256_pd(v)));
    }
};

}  // namespace tsubu::detail

#endif  // x86-64
