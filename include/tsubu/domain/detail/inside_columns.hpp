// SPDX-License-Identifier: MIT
/// @file
/// Which points of columns lie in a box: kernels for AVX2 and AVX-512. The loop in each_point.hpp is their portable
/// twin, and does what they leave.
///
/// In the caches a batch is bound by its comparisons: 6 per point in 3 dimensions, two vectors of them per cycle.
/// AVX-512 compares under a mask, which saves all the conjunctions, and compares lattice coordinates once, as unsigned
/// distances from the first. So it does, along axis 0, with floating-point numbers: as integers in the order of the
/// numbers, which other pipes of the processor compare meanwhile.
#pragma once

#include <tsubu/domain/interval.hpp>

#include <array>        // std::array
#include <bit>          // std::bit_cast
#include <concepts>     // std::floating_point, std::same_as
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t
#include <limits>       // std::numeric_limits
#include <type_traits>  // std::conditional_t, std::is_integral_v
#include <utility>      // std::index_sequence

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

namespace tsubu::detail {

/// The numbers that the kernels below are for; not the integers of a small lattice, made to be tried in full.
template <class Number>
inline constexpr bool has_column_kernel =
    std::floating_point<Number> || std::same_as<Number, std::int32_t> || std::same_as<Number, std::int64_t>;

/// Columns of numbers, and what of them is asked: first <= x <= last along each axis.
template <std::size_t D, class Number>
struct column_question {
    std::array<const Number*, D> start;
    std::array<Number, D> first;
    std::array<Number, D> last;
};

// ---- AVX2: all ones in each lane whose x is not in [first, last]; NaN never is.

template <class Number>
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i vector_at(const Number* x) noexcept {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(x));
}
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i outside_avx2(__m256i x, double first, double last) noexcept {
    const __m256d at = _mm256_castsi256_pd(x);
    return _mm256_castpd_si256(_mm256_or_pd(_mm256_cmp_pd(at, _mm256_set1_pd(first), _CMP_NGE_UQ),
                                            _mm256_cmp_pd(at, _mm256_set1_pd(last), _CMP_NLE_UQ)));
}
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i outside_avx2(__m256i x, float first, float last) noexcept {
    const __m256 at = _mm256_castsi256_ps(x);
    return _mm256_castps_si256(_mm256_or_ps(_mm256_cmp_ps(at, _mm256_set1_ps(first), _CMP_NGE_UQ),
                                            _mm256_cmp_ps(at, _mm256_set1_ps(last), _CMP_NLE_UQ)));
}
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i outside_avx2(__m256i x, std::int32_t first,
                                                                        std::int32_t last) noexcept {
    return _mm256_or_si256(_mm256_cmpgt_epi32(_mm256_set1_epi32(first), x),
                           _mm256_cmpgt_epi32(x, _mm256_set1_epi32(last)));
}
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i outside_avx2(__m256i x, std::int64_t first,
                                                                        std::int64_t last) noexcept {
    return _mm256_or_si256(_mm256_cmpgt_epi64(_mm256_set1_epi64x(first), x),
                           _mm256_cmpgt_epi64(x, _mm256_set1_epi64x(last)));
}

/// For as many points from i as a vector has numbers: all ones in the lane of each that is outside along any axis.
template <std::size_t D, class Number, std::size_t... K>
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i vector_outside(const column_question<D, Number>& asked,
                                                                          std::size_t i,
                                                                          std::index_sequence<K...>) noexcept {
    __m256i outside = _mm256_setzero_si256();
    ((outside = _mm256_or_si256(outside, outside_avx2(vector_at(asked.start[K] + i), asked.first[K], asked.last[K]))),
     ...);
    return outside;
}

/// For 8 points from i: all ones in the lane of 32 bits of each that is outside along any axis.
template <class Number, class Question, class Axes>
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i eight_outside(const Question& asked, std::size_t i,
                                                                         Axes axes) noexcept {
    const __m256i low = vector_outside(asked, i, axes);
    if constexpr (sizeof(Number) == 4) {
        return low;
    } else {
        const __m256i high = vector_outside(asked, i + 4, axes);
        return _mm256_packs_epi32(low, high);  // in the order 0 1 4 5 2 3 6 7
    }
}

/// mask[i] = 1 if point i lies inside, else 0, for all i below the result, which is at most count.
template <template <std::size_t, class> class Question, std::size_t D, class Number>
[[gnu::target("avx2")]] std::size_t inside_avx2(Question<D, Number> asked, std::size_t count,
                                                unsigned char* mask) noexcept {
    constexpr auto axes = std::make_index_sequence<D>{};
    std::size_t i = 0;
    for (; i + 32 <= count; i += 32) {
        // Each is named, so that memory is read from front to back: the processor then foresees what is read next.
        const __m256i first = eight_outside<Number>(asked, i, axes);
        const __m256i second = eight_outside<Number>(asked, i + 8, axes);
        const __m256i third = eight_outside<Number>(asked, i + 16, axes);
        const __m256i fourth = eight_outside<Number>(asked, i + 24, axes);
        const __m256i low = _mm256_packs_epi32(first, second);
        const __m256i high = _mm256_packs_epi32(third, fourth);
        // Packing works on the halves of a vector, so four points of one half follow four of the other.
        __m256i outside =
            _mm256_permutevar8x32_epi32(_mm256_packs_epi16(low, high), _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
        if constexpr (sizeof(Number) == 8)
            outside =
                _mm256_shuffle_epi8(outside, _mm256_broadcastsi128_si256(
                                                 _mm_setr_epi8(0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15)));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(mask + i), _mm256_andnot_si256(outside, _mm256_set1_epi8(1)));
    }
    return i;
}

// ---- AVX-512: a bit for each of the points among those asked about whose x is in [first, last].

[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __mmask8 inside_avx512(
    __mmask8 among, const double* x, double first, double last) noexcept {
    const __m512d at = _mm512_loadu_pd(x);
    const __mmask8 above = _mm512_mask_cmp_pd_mask(among, at, _mm512_set1_pd(first), _CMP_GE_OQ);
    return _mm512_mask_cmp_pd_mask(above, at, _mm512_set1_pd(last), _CMP_LE_OQ);
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __mmask16 inside_avx512(
    __mmask16 among, const float* x, float first, float last) noexcept {
    const __m512 at = _mm512_loadu_ps(x);
    const __mmask16 above = _mm512_mask_cmp_ps_mask(among, at, _mm512_set1_ps(first), _CMP_GE_OQ);
    return _mm512_mask_cmp_ps_mask(above, at, _mm512_set1_ps(last), _CMP_LE_OQ);
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __mmask8 between_avx512(
    __mmask8 among, __m512i x, std::int64_t first, std::int64_t last) noexcept {
    const auto width = static_cast<std::int64_t>(static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first));
    return _mm512_mask_cmple_epu64_mask(among, _mm512_sub_epi64(x, _mm512_set1_epi64(first)), _mm512_set1_epi64(width));
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __mmask16 between_avx512(
    __mmask16 among, __m512i x, std::int32_t first, std::int32_t last) noexcept {
    const auto width = static_cast<std::int32_t>(static_cast<std::uint32_t>(last) - static_cast<std::uint32_t>(first));
    return _mm512_mask_cmple_epu32_mask(among, _mm512_sub_epi32(x, _mm512_set1_epi32(first)), _mm512_set1_epi32(width));
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __mmask8 inside_avx512(
    __mmask8 among, const std::int64_t* x, std::int64_t first, std::int64_t last) noexcept {
    return between_avx512(among, _mm512_loadu_si512(x), first, last);
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __mmask16 inside_avx512(
    __mmask16 among, const std::int32_t* x, std::int32_t first, std::int32_t last) noexcept {
    return between_avx512(among, _mm512_loadu_si512(x), first, last);
}

/// Floating-point numbers as integers in the same order: -0 is -1, just below +0, and NaN is beyond both infinities.
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __m512i in_order(
    const double* x) noexcept {
    // The shift with a mask, since without one g++ 12 warns of its own header. 0x78: a ^ (b & c).
    const __m512i bits = _mm512_loadu_si512(x);
    return _mm512_ternarylogic_epi64(bits, _mm512_maskz_srai_epi64(0xff, bits, 63),
                                     _mm512_set1_epi64(0x7fffffffffffffff), 0x78);
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __m512i in_order(
    const float* x) noexcept {
    const __m512i bits = _mm512_loadu_si512(x);
    return _mm512_ternarylogic_epi32(bits, _mm512_maskz_srai_epi32(0xffff, bits, 31), _mm512_set1_epi32(0x7fffffff),
                                     0x78);
}
template <class Int>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline __m512i in_order(
    const Int* x) noexcept {
    return _mm512_loadu_si512(x);
}
/// The least or the greatest integer of a face, which are two for zero.
template <class Number>
[[nodiscard]] constexpr auto integer_of_face(Number face, bool greatest) noexcept {
    using Int = std::conditional_t<sizeof(Number) == 8, std::int64_t, std::int32_t>;
    const auto bits = std::bit_cast<Int>(face);
    if constexpr (!std::is_integral_v<Number>) {
        if (face == 0) {
            // All that this thread takes for 0.
            Int others = 0;  // not const: that would be decided at compile time, where no thread is asked
            if (denormals_are_zero()) others = std::bit_cast<Int>((std::numeric_limits<Number>::min)()) - 1;
            return greatest ? others : static_cast<Int>(-1 - others);
        }
        if (bits < 0) return static_cast<Int>(bits ^ (std::numeric_limits<Int>::max)());
    }
    return bits;
}

/// Axis 0 as integers from `least` to `greatest`, for whose sake the loop does not compute them; the others as they
/// are.
template <std::size_t D, class Number, class Int, std::size_t... K>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline auto vector_inside(
    const column_question<D, Number>& asked, Int least, Int greatest, std::size_t i,
    std::index_sequence<K...>) noexcept {
    using Mask = std::conditional_t<sizeof(Number) == 8, __mmask8, __mmask16>;
    Mask inside = between_avx512(static_cast<Mask>(~0U), in_order(asked.start[0] + i), least, greatest);
    ((inside = inside_avx512(inside, asked.start[K + 1] + i, asked.first[K + 1], asked.last[K + 1])), ...);
    return inside;
}

/// As inside_avx2.
template <std::size_t D, class Number>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] std::size_t inside_avx512(column_question<D, Number> asked,
                                                                                std::size_t count,
                                                                                unsigned char* mask) noexcept {
    constexpr auto further_axes = std::make_index_sequence<D - 1>{};
    const auto least = integer_of_face(asked.first[0], false);
    const auto greatest = integer_of_face(asked.last[0], true);
    std::size_t i = 0;
    for (; i + 16 <= count; i += 16) {
        __mmask16 inside = 0;
        if constexpr (sizeof(Number) == 4)
            inside = vector_inside(asked, least, greatest, i, further_axes);
        else
            inside = static_cast<__mmask16>(_mm512_kunpackb(vector_inside(asked, least, greatest, i + 8, further_axes),
                                                            vector_inside(asked, least, greatest, i, further_axes)));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(mask + i), _mm_maskz_set1_epi8(inside, 1));
    }
    return i;
}

}  // namespace tsubu::detail
#endif
