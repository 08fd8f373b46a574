// SPDX-License-Identifier: MIT
/// @file
/// Which points of an array of vectors lie in a box: kernels for AVX2 and AVX-512. The loop in each_point.hpp is their
/// portable twin, and does what they leave.
///
/// N points are D * N numbers one behind the other, so D vectors of L numbers hold L points:
///
///     x y z x y z x y | z x y z x y z x | y z x y z x y z        L = 8, D = 3
///
/// AVX2 sorts them by axis, and goes on as with columns. AVX-512 leaves them where they are and compares each vector
/// with the faces in the same order; D * L bits come out, and those of a point lie side by side. No branch asks whether
/// all are inside: it saves little where all are, and is often wrong where one point in a hundred is not.
#pragma once

#include <tsubu/core/mask_number.hpp>
#include <tsubu/domain/detail/inside_columns.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t, std::uint64_t
#include <type_traits>  // std::is_integral_v, std::make_unsigned_t
#include <utility>      // std::index_sequence

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

namespace tsubu::detail {

/// In one dimension an array of vectors is a column.
template <std::size_t D, class Number>
inline constexpr bool has_row_kernel = has_column_kernel<Number> && (D == 2 || D == 3);

/// An array of vectors, and what of it is asked: first <= x <= last along each axis.
template <std::size_t D, class Number>
struct row_question {
    const Number* start;
    std::array<Number, D> first;
    std::array<Number, D> last;
};

// ---- AVX2

/// Lanes of 32 bits, from both halves of a alike, then of b: those that Order tells.
template <int Order>
[[gnu::target("avx2"), gnu::always_inline]] inline __m256d quarters(__m256d a, __m256d b) noexcept {
    return _mm256_castps_pd(_mm256_shuffle_ps(_mm256_castpd_ps(a), _mm256_castpd_ps(b), Order));
}

/// One vector for each axis.
template <std::size_t D>
struct by_axis {
    __m256d at[D];
};

/// As many points as a vector has numbers, which lie from x on. Shuffles do the same in both halves of a vector: so the
/// lower half of the points goes into the lower halves of a, b, c, and the upper half into the upper ones.
template <std::size_t D, class Number>
[[gnu::target("avx2"), gnu::always_inline]] inline by_axis<D> sorted_by_axis(const Number* x) noexcept {
    constexpr std::size_t lanes = 32 / sizeof(Number);
    const __m256d u = _mm256_castsi256_pd(vector_at(x));
    const __m256d v = _mm256_castsi256_pd(vector_at(x + lanes));
    if constexpr (D == 2) {
        const __m256d a = _mm256_permute2f128_pd(u, v, 0x20);
        const __m256d b = _mm256_permute2f128_pd(u, v, 0x31);
        if constexpr (sizeof(Number) == 8)  // a: x0 y0, b: x1 y1
            return {{_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b)}};
        else  // a: x0 y0 x1 y1, b: x2 y2 x3 y3
            return {{quarters<_MM_SHUFFLE(2, 0, 2, 0)>(a, b), quarters<_MM_SHUFFLE(3, 1, 3, 1)>(a, b)}};
    } else {
        const __m256d w = _mm256_castsi256_pd(vector_at(x + 2 * lanes));
        const __m256d a = _mm256_blend_pd(u, v, 0b1100);
        const __m256d b = _mm256_permute2f128_pd(u, w, 0x21);
        const __m256d c = _mm256_blend_pd(v, w, 0b1100);
        if constexpr (sizeof(Number) == 8) {  // a: x0 y0, b: z0 x1, c: y1 z1
            return {
                {_mm256_shuffle_pd(a, b, 0b1010), _mm256_shuffle_pd(a, c, 0b0101), _mm256_shuffle_pd(b, c, 0b1010)}};
        } else {  // a: x0 y0 z0 x1, b: y1 z1 x2 y2, c: z2 x3 y3 z3
            const __m256d early = quarters<_MM_SHUFFLE(1, 0, 2, 1)>(a, b);  // y0 z0 y1 z1
            const __m256d late = quarters<_MM_SHUFFLE(2, 1, 3, 2)>(b, c);   // x2 y2 x3 y3
            return {{quarters<_MM_SHUFFLE(2, 0, 3, 0)>(a, late), quarters<_MM_SHUFFLE(3, 1, 2, 0)>(early, late),
                     quarters<_MM_SHUFFLE(3, 0, 3, 1)>(early, c)}};
        }
    }
}

template <std::size_t D, class Number, std::size_t... K>
[[gnu::target("avx2"), gnu::always_inline]] inline __m256i vector_outside(const row_question<D, Number>& asked,
                                                                          std::size_t i,
                                                                          std::index_sequence<K...>) noexcept {
    const by_axis<D> x = sorted_by_axis<D>(asked.start + D * i);
    __m256i outside = _mm256_setzero_si256();
    ((outside = _mm256_or_si256(outside, outside_avx2(_mm256_castpd_si256(x.at[K]), asked.first[K], asked.last[K]))),
     ...);
    return outside;
}

// ---- AVX-512

/// One row again and again: D vectors.
template <std::size_t D, class Number>
struct alignas(64) repeated_row {
    static constexpr std::size_t lanes = 64 / sizeof(Number);
    Number numbers[D * lanes];
    explicit repeated_row(const std::array<Number, D>& row) noexcept {
        for (std::size_t i = 0; i < lanes; ++i)
            for (std::size_t k = 0; k < D; ++k) numbers[D * i + k] = row[k];
    }
    [[nodiscard, gnu::always_inline]] const Number* vector(std::size_t v) const noexcept { return numbers + v * lanes; }
};

/// The faces for each of D vectors, as they are, and as integers in the order of the numbers: the least and how many
/// follow it.
template <std::size_t D, class Number>
struct row_faces {
    using integer = decltype(integer_of_face(Number{}, false));
    repeated_row<D, Number> first;
    repeated_row<D, Number> last;
    repeated_row<D, integer> least;
    repeated_row<D, integer> width;

    explicit row_faces(const row_question<D, Number>& asked) noexcept
        : first(asked.first), last(asked.last), least(least_of(asked)), width(width_of(asked)) {}

private:
    static std::array<integer, D> least_of(const row_question<D, Number>& asked) noexcept {
        std::array<integer, D> result{};
        for (std::size_t k = 0; k < D; ++k) result[k] = integer_of_face(asked.first[k], false);
        return result;
    }
    static std::array<integer, D> width_of(const row_question<D, Number>& asked) noexcept {
        using Unsigned = std::make_unsigned_t<integer>;
        auto result = least_of(asked);
        for (std::size_t k = 0; k < D; ++k)
            result[k] = static_cast<integer>(static_cast<Unsigned>(integer_of_face(asked.last[k], true)) -
                                             static_cast<Unsigned>(result[k]));
        return result;
    }
};

/// A bit for each number of a vector, if it is in the interval that belongs to its lane.
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline std::uint64_t lanes_inside(
    const double* x, const double* first, const double* last) noexcept {
    const __m512d at = _mm512_loadu_pd(x);
    const __mmask8 above = _mm512_cmp_pd_mask(at, _mm512_load_pd(first), _CMP_GE_OQ);
    return number_of(_mm512_mask_cmp_pd_mask(above, at, _mm512_load_pd(last), _CMP_LE_OQ));
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline std::uint64_t lanes_inside(
    const float* x, const float* first, const float* last) noexcept {
    const __m512 at = _mm512_loadu_ps(x);
    const __mmask16 above = _mm512_cmp_ps_mask(at, _mm512_load_ps(first), _CMP_GE_OQ);
    return number_of(_mm512_mask_cmp_ps_mask(above, at, _mm512_load_ps(last), _CMP_LE_OQ));
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline std::uint64_t lanes_between(
    __m512i x, const std::int64_t* least, const std::int64_t* width) noexcept {
    return number_of(_mm512_cmple_epu64_mask(_mm512_sub_epi64(x, _mm512_load_si512(least)), _mm512_load_si512(width)));
}
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline std::uint64_t lanes_between(
    __m512i x, const std::int32_t* least, const std::int32_t* width) noexcept {
    return number_of(_mm512_cmple_epu32_mask(_mm512_sub_epi32(x, _mm512_load_si512(least)), _mm512_load_si512(width)));
}
/// The same for vector V of D: of floating-point numbers the first one as integers, as with columns.
template <std::size_t V, std::size_t D, class Number>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl"), gnu::always_inline]] inline std::uint64_t row_vector_inside(
    const Number* x, const row_faces<D, Number>& faces) noexcept {
    if constexpr (V == 0 || std::is_integral_v<Number>)
        return lanes_between(in_order(x), faces.least.vector(V), faces.width.vector(V));
    else
        return lanes_inside(x, faces.first.vector(V), faces.last.vector(V));
}

/// For as many points from x on as a vector has numbers: a bit for each that is inside along all axes.
template <std::size_t D, class Number, std::size_t... V>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,bmi2"), gnu::always_inline]] inline std::uint64_t rows_inside(
    const Number* x, const row_faces<D, Number>& faces, std::index_sequence<V...>) noexcept {
    constexpr std::size_t lanes = 64 / sizeof(Number);
    constexpr std::uint64_t first_of_each_point =
        (D == 2 ? 0x5555555555555555 : 0x9249249249249249) & ((std::uint64_t{1} << D * lanes) - 1);
    const std::uint64_t numbers = (... | (row_vector_inside<V>(x + V * lanes, faces) << (V * lanes)));
    const std::uint64_t points = (... & (numbers >> V));  // the bits of the axes, one upon the other
    return _pext_u64(points, first_of_each_point);
}
/// The same for Count points.
template <std::size_t Count, std::size_t D, class Number>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,bmi2"), gnu::always_inline]] inline std::uint64_t rows_inside(
    const Number* x, const row_faces<D, Number>& faces) noexcept {
    std::uint64_t inside = 0;
    for (std::size_t i = 0; i < Count; i += 64 / sizeof(Number))
        inside |= rows_inside(x + D * i, faces, std::make_index_sequence<D>{}) << i;
    return inside;
}

/// As inside_avx2.
template <std::size_t D, class Number>
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,bmi2")]] std::size_t inside_avx512(row_question<D, Number> asked,
                                                                                     std::size_t count,
                                                                                     unsigned char* mask) noexcept {
    const row_faces<D, Number> faces(asked);
    std::size_t i = 0;
    for (; i + 64 <= count; i += 64)
        _mm512_storeu_si512(mask + i, _mm512_maskz_set1_epi8(rows_inside<64>(asked.start + D * i, faces), 1));
    for (; i + 16 <= count; i += 16) {
        const auto inside = static_cast<__mmask16>(rows_inside<16>(asked.start + D * i, faces));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(mask + i), _mm_maskz_set1_epi8(inside, 1));
    }
    return i;
}

}  // namespace tsubu::detail
#endif
