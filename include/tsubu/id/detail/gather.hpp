// SPDX-License-Identifier: MIT
/// @file
/// Many look-ups at once in a flat or a paged table: AVX2 and AVX-512 kernels beside their portable twins.
///
/// Every kernel of a family writes the same answers; the instruction set is chosen by the caller at run time, so the
/// loops live inside the functions that carry the target attribute (from outside, intrinsics could not be inlined).
/// No branch depends on an id: on half misses a mispredicted branch would cost more than the look-up.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint32_t, std::uint64_t

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>  // _mm256_*, _mm512_*
#endif

namespace tsubu::detail {

/// A flat table: the index of id is entries[id - lowest] if id - lowest < count, else absent.
template <particle_id Id>
struct flat_window {
    const index_t* entries;
    std::uint64_t count;
    unsigned_id<Id> lowest;
};

/// A paged table: page (id >> bits) - first of the directory, if it is < count, else absent. Page 0 is always empty.
template <particle_id Id>
struct paged_window {
    const std::uint32_t* directory;
    std::uint64_t count;
    unsigned_id<Id> first;
    unsigned bits;
    const index_t* pool;
};

template <particle_id Id>
void gather_portable(const flat_window<Id>& table, const Id* ids, index_t* out, std::size_t n) noexcept {
    using unsigned_type = unsigned_id<Id>;
    if (table.count == 0) {  // then there is no entry 0 to read instead
        for (std::size_t k = 0; k < n; ++k) out[k] = absent;
        return;
    }
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint64_t offset = static_cast<unsigned_type>(static_cast<unsigned_type>(ids[k]) - table.lowest);
        const bool inside = offset < table.count;
        const index_t found = table.entries[inside ? offset : 0];
        out[k] = inside ? found : absent;
    }
}

template <particle_id Id>
void gather_portable(const paged_window<Id>& table, const Id* ids, index_t* out, std::size_t n) noexcept {
    using unsigned_type = unsigned_id<Id>;
    if (table.count == 0) {
        for (std::size_t k = 0; k < n; ++k) out[k] = absent;
        return;
    }
    const std::uint64_t mask = (std::uint64_t{1} << table.bits) - 1;
    for (std::size_t k = 0; k < n; ++k) {
        const auto t = static_cast<unsigned_type>(ids[k]);
        const std::uint64_t page =
            static_cast<unsigned_type>(static_cast<unsigned_type>(t >> table.bits) - table.first);
        const bool inside = page < table.count;
        const std::uint64_t held = inside ? table.directory[inside ? page : 0] : 0;
        out[k] = table.pool[(held << table.bits) | (t & mask)];
    }
}

#if defined(__x86_64__) && defined(__GNUC__)

// Four ids in lanes of 64 bits, narrower ones with zeros above.
template <particle_id Id>
[[gnu::target("avx2")]] inline __m256i lanes_avx2(const Id* ids) noexcept {
    if constexpr (sizeof(Id) == 8)
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
    else
        return _mm256_cvtepu32_epi64(_mm_loadu_si128(reinterpret_cast<const __m128i*>(ids)));
}

// a - b in the width of the id: for 32 bits the upper halves are 0 in both and must stay 0.
template <particle_id Id>
[[gnu::target("avx2")]] inline __m256i subtract_avx2(__m256i a, __m256i b) noexcept {
    if constexpr (sizeof(Id) == 8)
        return _mm256_sub_epi64(a, b);
    else
        return _mm256_sub_epi32(a, b);
}

inline constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;

// All bits of lane k (32 bits) set where a[k] < b[k] (64 bits; b with its sign bit flipped: AVX2 compares signed).
[[gnu::target("avx2")]] inline __m128i below_avx2(__m256i a, __m256i flipped_b) noexcept {
    const __m256i sign = _mm256_set1_epi64x(static_cast<long long>(sign_bit));
    const __m256i below = _mm256_cmpgt_epi64(flipped_b, _mm256_xor_si256(a, sign));
    const __m256i even = _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
    return _mm256_castsi256_si128(_mm256_permutevar8x32_epi32(below, even));
}

template <particle_id Id>
[[gnu::target("avx2")]] void gather_avx2(const flat_window<Id>& table, const Id* ids, index_t* out,
                                         std::size_t n) noexcept {
    const __m256i lowest = _mm256_set1_epi64x(static_cast<long long>(std::uint64_t{table.lowest}));
    const __m256i count = _mm256_set1_epi64x(static_cast<long long>(table.count ^ sign_bit));
    const __m128i none = _mm_set1_epi32(absent);
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4) {
        const __m256i offset = subtract_avx2<Id>(lanes_avx2(ids + k), lowest);
        const __m128i found = _mm256_mask_i64gather_epi32(none, table.entries, offset, below_avx2(offset, count), 4);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out + k), found);
    }
    gather_portable(table, ids + k, out + k, n - k);
}

template <particle_id Id>
[[gnu::target("avx2")]] void gather_avx2(const paged_window<Id>& table, const Id* ids, index_t* out,
                                         std::size_t n) noexcept {
    const __m256i first = _mm256_set1_epi64x(static_cast<long long>(std::uint64_t{table.first}));
    const __m256i count = _mm256_set1_epi64x(static_cast<long long>(table.count ^ sign_bit));
    const __m256i mask = _mm256_set1_epi64x(static_cast<long long>((std::uint64_t{1} << table.bits) - 1));
    const __m128i bits = _mm_cvtsi32_si128(static_cast<int>(table.bits));
    const __m128i none = _mm_set1_epi32(absent);
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4) {
        const __m256i t = lanes_avx2(ids + k);
        const __m256i page = subtract_avx2<Id>(_mm256_srl_epi64(t, bits), first);
        const __m128i inside = below_avx2(page, count);
        const __m128i held = _mm256_mask_i64gather_epi32(
            _mm_setzero_si128(), reinterpret_cast<const int*>(table.directory), page, inside, 4);
        const __m256i at =
            _mm256_or_si256(_mm256_sll_epi64(_mm256_cvtepu32_epi64(held), bits), _mm256_and_si256(t, mask));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(out + k),
                         _mm256_mask_i64gather_epi32(none, table.pool, at, inside, 4));
    }
    gather_portable(table, ids + k, out + k, n - k);
}

// Without optimisation GCC's masked gathers are macros that pass the mask as a plain char.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"

template <particle_id Id>
[[gnu::target("avx512f")]] inline __m512i lanes_avx512(const Id* ids) noexcept {
    if constexpr (sizeof(Id) == 8)
        return _mm512_loadu_si512(ids);
    else
        return _mm512_maskz_cvtepu32_epi64(0xff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids)));
}

template <particle_id Id>
[[gnu::target("avx512f")]] inline __m512i subtract_avx512(__m512i a, __m512i b) noexcept {
    if constexpr (sizeof(Id) == 8)
        return _mm512_sub_epi64(a, b);
    else
        return _mm512_sub_epi32(a, b);
}

template <particle_id Id>
[[gnu::target("avx512f")]] void gather_avx512(const flat_window<Id>& table, const Id* ids, index_t* out,
                                              std::size_t n) noexcept {
    const __m512i lowest = _mm512_set1_epi64(static_cast<long long>(std::uint64_t{table.lowest}));
    const __m512i count = _mm512_set1_epi64(static_cast<long long>(table.count));
    const __m256i none = _mm256_set1_epi32(absent);
    std::size_t k = 0;
    for (; k + 8 <= n; k += 8) {
        const __m512i offset = subtract_avx512<Id>(lanes_avx512(ids + k), lowest);
        const __mmask8 inside = _mm512_cmplt_epu64_mask(offset, count);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + k),
                            _mm512_mask_i64gather_epi32(none, inside, offset, table.entries, 4));
    }
    gather_portable(table, ids + k, out + k, n - k);
}

template <particle_id Id>
[[gnu::target("avx512f")]] void gather_avx512(const paged_window<Id>& table, const Id* ids, index_t* out,
                                              std::size_t n) noexcept {
    const __m512i first = _mm512_set1_epi64(static_cast<long long>(std::uint64_t{table.first}));
    const __m512i count = _mm512_set1_epi64(static_cast<long long>(table.count));
    const __m512i mask = _mm512_set1_epi64(static_cast<long long>((std::uint64_t{1} << table.bits) - 1));
    const __m128i bits = _mm_cvtsi32_si128(static_cast<int>(table.bits));
    const __m256i none = _mm256_set1_epi32(absent);
    std::size_t k = 0;
    for (; k + 8 <= n; k += 8) {
        const __m512i t = lanes_avx512(ids + k);
        const __m512i page = subtract_avx512<Id>(_mm512_maskz_srl_epi64(0xff, t, bits), first);
        const __mmask8 inside = _mm512_cmplt_epu64_mask(page, count);
        const __m256i held = _mm512_mask_i64gather_epi32(_mm256_setzero_si256(), inside, page, table.directory, 4);
        const __m512i at = _mm512_or_si512(
            _mm512_maskz_sll_epi64(0xff, _mm512_maskz_cvtepu32_epi64(0xff, held), bits), _mm512_and_si512(t, mask));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + k),
                            _mm512_mask_i64gather_epi32(none, inside, at, table.pool, 4));
    }
    gather_portable(table, ids + k, out + k, n - k);
}

#pragma GCC diagnostic pop

#endif

/// out[k] = index of ids[k] for k < n, with the instructions of `set`, which the machine must support.
template <class Window, particle_id Id>
void gather(instruction_set set, const Window& table, const Id* ids, index_t* out, std::size_t n) noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    if (set == instruction_set::avx512) return gather_avx512(table, ids, out, n);
    if (set == instruction_set::avx2) return gather_avx2(table, ids, out, n);
#else
    static_cast<void>(set);
#endif
    gather_portable(table, ids, out, n);
}

}  // namespace tsubu::detail
