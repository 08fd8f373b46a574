// SPDX-License-Identifier: MIT
/// @file
/// The loops of quotient_kernels.hpp in AVX-512.
#pragma once

#include <tsubu/core/mask_number.hpp>
#include <tsubu/id/detail/quotient_kernels.hpp>

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>  // the functions below carry the target attributes that it needs

#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint32_t
#include <type_traits>  // std::is_signed_v

namespace tsubu::detail {

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
            const auto end = search_line<Layout>(table, mask, block.place[k], block.tag[k]);
            out[k] = end.index;
            queue[kept] = k;
            kept += static_cast<std::uint32_t>(end.may_lie_beyond);
        }
        return kept;
    }

    template <class Layout, bool LinksAreAbsent>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2")]] static std::uint32_t insert(
        const line_table& table, const id_block<Layout>& block, std::uint32_t index_plus_1, index_t* links,
        std::uint32_t* queue, std::uint32_t queued, std::size_t& repeated) noexcept {
        const __m512i mask = set1_mask<Layout>(table);
        std::uint32_t kept = 0;
        std::uint32_t met = 0;
        for (std::uint32_t q = 0; q < queued; ++q) {
            const auto k = queue[q];
            const auto first = block.place[k] & ~(Layout::slots - 1);
            const __m512i line = _mm512_load_si512(table.slots<Layout>() + first);
            const auto same = matches_in<Layout>(_mm512_and_si512(line, mask), block.tag[k]);
            const auto vacant = matches_in<Layout>(line, 0);
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
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2")]] static index_t find(const line_table& table,
                                                                                       const Spills& stash,
                                                                                       std::uint64_t t) noexcept {
        const auto x = t - table.base;
        if (!table.may_hold<Layout>(x)) return absent;
        const auto at = table.locate<Layout>(x);
        const auto end = search_line<Layout>(table, set1_mask<Layout>(table), at.place, at.tag);
        if (end.may_lie_beyond) [[unlikely]]
            return find_beyond<Layout>(table, stash.entries(), at.place, at.tag);
        return end.index;
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
    struct line_search {
        index_t index;
        bool may_lie_beyond;  // not in this line, which has no empty slot
    };
    /// Where the tag is in the line of a place, at most once: a slot that matches, without the tag, is the index.
    template <class Layout>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2"), gnu::always_inline]] static inline line_search
    search_line(const line_table& table, __m512i mask, std::uint64_t place, typename Layout::slot_type tag) noexcept {
        const auto first = place & ~std::uint64_t{Layout::slots - 1};
        const __m512i line = _mm512_load_si512(table.slots<Layout>() + first);
        if constexpr (Layout::slots == 16) {
            const __m512i rest = _mm512_xor_si512(line, _mm512_set1_epi32(static_cast<int>(tag)));
            const __mmask16 match = _mm512_testn_epi32_mask(rest, mask);
            const __m512i index = _mm512_maskz_compress_epi32(match, rest);
            return {_mm_cvtsi128_si32(_mm512_castsi512_si128(index)) - 1,
                    _kortestz_mask16_u8(match, _mm512_testn_epi32_mask(line, line)) != 0};
        } else {
            const __m512i rest = _mm512_xor_si512(line, _mm512_set1_epi64(static_cast<long long>(tag)));
            const __mmask8 match = _mm512_testn_epi64_mask(rest, mask);
            const bool may_lie_beyond = _kortestz_mask8_u8(match, _mm512_testn_epi64_mask(line, line)) != 0;
            if constexpr (Layout::keyed) {
                const auto found = number_of(match);  // nothing found: 32 slots further, in lines that are there
                return {index_if(found != 0, table.indices[first + _tzcnt_u32(found)]), may_lie_beyond};
            } else {
                const __m512i index = _mm512_maskz_compress_epi64(match, rest);
                return {_mm_cvtsi128_si32(_mm512_castsi512_si128(index)) - 1, may_lie_beyond};
            }
        }
    }
    /// Bit k: slot k of the line is the tag.
    template <class Layout>
    [[gnu::target("avx512f,avx512bw,avx512vl,avx512dq"), gnu::always_inline]] static inline std::uint32_t matches_in(
        __m512i line, typename Layout::slot_type tag) noexcept {
        if constexpr (Layout::slots == 16)
            return number_of(_mm512_cmpeq_epi32_mask(line, _mm512_set1_epi32(static_cast<int>(tag))));
        else
            return number_of(_mm512_cmpeq_epi64_mask(line, _mm512_set1_epi64(static_cast<long long>(tag))));
    }
    [[gnu::target("avx512bw"), gnu::always_inline]] static inline __mmask16 join(__mmask8 low, __mmask8 high) noexcept {
        return _mm512_kunpackb(high, low);
    }
};

#if !defined(__clang__)
#pragma GCC diagnostic pop
#endif

}  // namespace tsubu::detail

#endif  // x86-64
