// SPDX-License-Identifier: MIT
/// @file
/// The three loops over a block of 64 ids that the batched calls of flat_storage spend their time in, for each
/// instruction set: locate (hash), settle (compare the preferred slots), search (compare whole lines).
///
/// A block is 64 ids: long enough that the calls cost nothing, short enough that its 1.5 kB of places, tags and slots
/// stay in the first-level cache together with those of the blocks before and after it.
#pragma once

#include <tsubu/id/detail/quotient_lines.hpp>

#include <cstdint>      // std::uint32_t
#include <type_traits>  // std::is_signed_v

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>  // the functions below carry the target attributes that it needs
#endif

namespace tsubu::detail {

inline constexpr std::uint32_t block_size = 64;

/// One block on its way through a batch: what the ids became, and what stands in their preferred slots.
template <class Layout>
struct alignas(64) id_block {
    using Slot = typename Layout::slot_type;
    alignas(64) std::uint32_t place[block_size];
    alignas(64) Slot tag[block_size];
    alignas(64) Slot slot[block_size];
    alignas(64) std::uint32_t index[block_size];  // keyed lines only
};

/// What every instruction set offers, written for any machine. Each function is one step for a whole block.
struct portable_kernels {
    /// block.place, block.tag from ids; an id that cannot be in the table gets the line that is always empty.
    template <class Layout, class Id>
    static void locate(const line_table& table, const Id* ids, id_block<Layout>& block) noexcept {
        const auto nowhere = table.nowhere<Layout>();
        for (std::uint32_t k = 0; k < block_size; ++k) {
            const auto x = static_cast<std::uint64_t>(ids[k]) - table.base;
            const auto at = table.locate<Layout>(x);
            block.place[k] = table.may_hold<Layout>(x) ? static_cast<std::uint32_t>(at.place) : nowhere;
            block.tag[k] = at.tag;
        }
    }
    /// out from the preferred slots: index or absent. Where another id stands there, k goes into the queue.
    /// @return length of the queue.
    template <class Layout>
    static std::uint32_t settle(const line_table& table, const id_block<Layout>& block, index_t* out,
                                std::uint32_t* queue) noexcept {
        using Slot = typename Layout::slot_type;
        const auto mask = static_cast<Slot>(table.tag_mask);
        std::uint32_t queued = 0;
        for (std::uint32_t k = 0; k < block_size; ++k) {
            const Slot slot = block.slot[k];
            const bool match = (slot & mask) == block.tag[k];
            const auto index =
                Layout::keyed ? block.index[k] : static_cast<std::uint32_t>(slot & static_cast<Slot>(~mask));
            out[k] = index_if(match, index);
            queue[queued] = k;
            queued += static_cast<std::uint32_t>(!match) & static_cast<std::uint32_t>(slot != 0);
        }
        return queued;
    }
    /// out for the queued ids, by comparing the whole home line. Where that line passed ids on, k stays queued.
    template <class Layout>
    static std::uint32_t search(const line_table& table, const id_block<Layout>& block, index_t* out,
                                std::uint32_t* queue, std::uint32_t queued) noexcept {
        using Slot = typename Layout::slot_type;
        const auto mask = static_cast<Slot>(table.tag_mask);
        std::uint32_t kept = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto first = block.place[k] & ~(Layout::slots - 1);
            const auto found = matches<Layout>(table.slots<Layout>() + first, block.tag[k], mask);
            const auto at = first + first_match<Layout>(found);
            const auto index = index_at<Layout>(table, at);
            out[k] = index_if(found != 0, index);
            queue[kept] = k;
            kept += static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots);
        }
        return kept;
    }
};

#if defined(__x86_64__) && defined(__GNUC__)

// GCC 12 takes the undefined first operand inside its own AVX-512 intrinsics for a use of ours (GCC bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

/// 512-bit vectors: 16 narrow or 8 wide slots at a time.
struct avx512_kernels {
    template <class Layout, class Id>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq,bmi2")]] static void locate(const line_table& table,
                                                                                  const Id* ids,
                                                                                  id_block<Layout>& block) noexcept {
        const std::uint64_t first = table.base + table.least_x;
        const __m512i base = _mm512_set1_epi64(static_cast<long long>(first));
        const __m512i limit = _mm512_set1_epi64(static_cast<long long>(table.limit));
        const __m512i least = _mm512_set1_epi64(static_cast<long long>(table.least_x));
        const __m512i lines = _mm512_set1_epi64(table.lines);
        const __m128i fold = _mm_cvtsi32_si128(static_cast<int>(table.fold));
        const __m128i tag_shift = _mm_cvtsi32_si128(static_cast<int>(table.tag_shift));
        if constexpr (Layout::slots == 16) {
            const __m512i multiplier = _mm512_set1_epi32(static_cast<int>(table.multiplier));
            const __m512i step = _mm512_set1_epi32(static_cast<int>(table.tag_step));
            const __m512i nowhere = _mm512_set1_epi32(static_cast<int>(table.nowhere<Layout>()));
            const __m512i low_words = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
            for (std::uint32_t k = 0; k < block_size; k += 16) {
                const __m512i x0 = _mm512_sub_epi64(load_8(ids + k), base);
                const __m512i x1 = _mm512_sub_epi64(load_8(ids + k + 8), base);
                const __mmask16 inside = join(_mm512_cmple_epu64_mask(x0, limit), _mm512_cmple_epu64_mask(x1, limit));
                const __m512i x = _mm512_permutex2var_epi32(x0, low_words, x1);
                const __m512i h = _mm512_mullo_epi32(_mm512_xor_si512(x, _mm512_srl_epi32(x, fold)), multiplier);
                // 32 x 32 -> 64 bits for the even and the odd words; place = product >> 28 in each.
                const __m512i even = _mm512_srli_epi64(_mm512_mul_epu32(h, lines), Layout::place_shift);
                const __m512i odd =
                    _mm512_slli_epi64(_mm512_mul_epu32(_mm512_srli_epi64(h, 32), lines), 32 - Layout::place_shift);
                const __m512i place = _mm512_mask_blend_epi32(0xAAAA, even, odd);
                _mm512_store_si512(block.place + k, _mm512_mask_mov_epi32(nowhere, inside, place));
                _mm512_store_si512(block.tag + k, _mm512_or_si512(_mm512_sll_epi32(h, tag_shift), step));
            }
        } else {
            const __m512i multiplier = _mm512_set1_epi64(static_cast<long long>(table.multiplier));
            const __m512i step = _mm512_set1_epi64(static_cast<long long>(table.tag_step));
            const __m256i nowhere = _mm256_set1_epi32(static_cast<int>(table.nowhere<Layout>()));
            for (std::uint32_t k = 0; k < block_size; k += 8) {
                const __m512i from_least = _mm512_sub_epi64(load_8(ids + k), base);
                const __mmask8 inside = _mm512_cmple_epu64_mask(from_least, limit);
                const __m512i x = _mm512_add_epi64(from_least, least);
                const __m512i h = _mm512_mullo_epi64(_mm512_xor_si512(x, _mm512_srl_epi64(x, fold)), multiplier);
                const __m512i place =
                    _mm512_srli_epi64(_mm512_mul_epu32(_mm512_srli_epi64(h, 32), lines), Layout::place_shift);
                _mm256_store_si256(reinterpret_cast<__m256i*>(block.place + k),
                                   _mm256_mask_mov_epi32(nowhere, inside, _mm512_cvtepi64_epi32(place)));
                _mm512_store_si512(block.tag + k, _mm512_or_si512(_mm512_sll_epi64(h, tag_shift), step));
            }
        }
    }

    template <class Layout>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq,bmi2,popcnt")]] static std::uint32_t settle(
        const line_table& table, const id_block<Layout>& block, index_t* out, std::uint32_t* queue) noexcept {
        const __m512i one = _mm512_set1_epi32(1);
        const __m512i counting = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
        const __m512i mask = set1_mask<Layout>(table);
        std::uint32_t queued = 0;
        for (std::uint32_t k = 0; k < block_size; k += 16) {
            __mmask16 match;
            __mmask16 taken;
            __m512i index;
            if constexpr (Layout::slots == 16) {
                const __m512i slot = _mm512_load_si512(block.slot + k);
                match = _mm512_cmpeq_epi32_mask(_mm512_and_si512(slot, mask), _mm512_load_si512(block.tag + k));
                taken = _mm512_test_epi32_mask(slot, slot);
                index = _mm512_andnot_si512(mask, slot);
            } else {
                const __m512i low = _mm512_load_si512(block.slot + k);
                const __m512i high = _mm512_load_si512(block.slot + k + 8);
                match =
                    join(_mm512_cmpeq_epi64_mask(_mm512_and_si512(low, mask), _mm512_load_si512(block.tag + k)),
                         _mm512_cmpeq_epi64_mask(_mm512_and_si512(high, mask), _mm512_load_si512(block.tag + k + 8)));
                taken = join(_mm512_test_epi64_mask(low, low), _mm512_test_epi64_mask(high, high));
                if constexpr (Layout::keyed) {
                    index = _mm512_load_si512(block.index + k);
                } else {
                    const __m512i low_words =
                        _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
                    index = _mm512_permutex2var_epi32(_mm512_andnot_si512(mask, low), low_words,
                                                      _mm512_andnot_si512(mask, high));
                }
            }
            _mm512_storeu_si512(out + k, _mm512_sub_epi32(_mm512_maskz_mov_epi32(match, index), one));
            const auto left = static_cast<__mmask16>(taken & ~match);
            const __m512i number = _mm512_add_epi32(counting, _mm512_set1_epi32(static_cast<int>(k)));
            _mm512_storeu_si512(queue + queued, _mm512_maskz_compress_epi32(left, number));
            queued += static_cast<std::uint32_t>(_mm_popcnt_u32(number_of(left)));
        }
        return queued;
    }

    template <class Layout>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2")]] static std::uint32_t search(
        const line_table& table, const id_block<Layout>& block, index_t* out, std::uint32_t* queue,
        std::uint32_t queued) noexcept {
        const __m512i mask = set1_mask<Layout>(table);
        std::uint32_t kept = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto first = block.place[k] & ~(Layout::slots - 1);
            const __m512i line = _mm512_load_si512(table.slots<Layout>() + first);
            std::uint32_t found;
            if constexpr (Layout::slots == 16)
                found = number_of(_mm512_cmpeq_epi32_mask(_mm512_and_si512(line, mask),
                                                          _mm512_set1_epi32(static_cast<int>(block.tag[k]))));
            else
                found = number_of(_mm512_cmpeq_epi64_mask(_mm512_and_si512(line, mask),
                                                          _mm512_set1_epi64(static_cast<long long>(block.tag[k]))));
            const auto at = first + first_match<Layout, 1>(found);
            const auto index = index_at<Layout>(table, at);
            out[k] = index_if(found != 0, index);
            queue[kept] = k;
            kept += static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots);
        }
        return kept;
    }

private:
    // By size and sign, not by name: long and long long may both have 64 bits.
    template <class Id>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq"), gnu::always_inline]] static inline __m512i load_8(
        const Id* ids) noexcept {
        if constexpr (sizeof(Id) == 8)
            return _mm512_loadu_si512(ids);
        else if constexpr (std::is_signed_v<Id>)
            return _mm512_cvtepi32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids)));
        else
            return _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids)));
    }
    template <class Layout>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq"), gnu::always_inline]] static inline __m512i set1_mask(
        const line_table& table) noexcept {
        if constexpr (Layout::slots == 16)
            return _mm512_set1_epi32(static_cast<int>(table.tag_mask));
        else
            return _mm512_set1_epi64(static_cast<long long>(table.tag_mask));
    }
    /// A mask in a general register. GCC 12 may spill a mask as 16 bits and read it back as 32, whose upper half is then
    /// whatever lay there before (seen with -O1 -fsanitize=undefined); an instruction of our own leaves it no choice.
    [[gnu::target("avx512f"), gnu::always_inline]] static inline std::uint32_t number_of(__mmask16 mask) noexcept {
        std::uint32_t number;
        asm("kmovw %1, %0" : "=r"(number) : "k"(mask));
        return number;
    }
    [[gnu::target("avx512bw"), gnu::always_inline]] static inline __mmask16 join(__mmask8 low, __mmask8 high) noexcept {
        return _mm512_kunpackb(high, low);
    }
};

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
    [[gnu::target("avx2,bmi2,popcnt")]] static std::uint32_t settle(const line_table& table,
                                                                    const id_block<Layout>& block, index_t* out,
                                                                    std::uint32_t* queue) noexcept {
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
            const auto* line = table.slots<Layout>() + first;
            const __m256i low = _mm256_and_si256(load(line), mask);
            const __m256i high = _mm256_and_si256(load(line + Layout::slots / 2), mask);
            std::uint32_t found;
            if constexpr (Layout::slots == 16) {
                const __m256i tag = _mm256_set1_epi32(static_cast<int>(block.tag[k]));
                found = movemask_32(_mm256_cmpeq_epi32(low, tag)) | movemask_32(_mm256_cmpeq_epi32(high, tag)) << 8;
            } else {
                const __m256i tag = _mm256_set1_epi64x(static_cast<long long>(block.tag[k]));
                found = movemask_64(_mm256_cmpeq_epi64(low, tag)) | movemask_64(_mm256_cmpeq_epi64(high, tag)) << 4;
            }
            const auto at = first + first_match<Layout, 1>(found);
            const auto index = index_at<Layout>(table, at);
            out[k] = index_if(found != 0, index);
            queue[kept] = k;
            kept += static_cast<std::uint32_t>(found == 0) & table.overflow_bit(first / Layout::slots);
        }
        return kept;
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

#if !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif  // x86-64

}  // namespace tsubu::detail
