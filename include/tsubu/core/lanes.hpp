// SPDX-License-Identifier: MIT
/// @file
/// lanes: as many numbers as a vector register holds, with the arithmetic of one.
#pragma once

#include <tsubu/version.hpp>

#include <cmath>        // std::sqrt
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t
#include <type_traits>  // std::conditional_t, std::integral_constant
#include <utility>      // std::index_sequence, std::make_index_sequence

#if defined(__SSE2__)
#include <emmintrin.h>  // _mm_movemask_pd, _mm_movemask_ps, _mm_sqrt_pd, _mm_sqrt_ps
#endif
#if defined(__AVX__)
#include <immintrin.h>  // _mm256_movemask_pd, _mm256_movemask_ps, _mm256_sqrt_pd, _mm256_sqrt_ps
#endif

namespace tsubu {

/// How many bytes a vector register has, for what the compiler was told to build for: the vectors of the compiler are
/// as wide, since wider ones are taken apart before they are inlined.
#if defined(__AVX__)
inline constexpr std::size_t lane_bytes = 32;
#else
inline constexpr std::size_t lane_bytes = 16;
#endif

/// Some numbers side by side: every operation is done on each. A formula written once, as a template of its number
/// type, works on one number and on lanes of them; the results are the same bit for bit.
///
///     template <class Real>
///     Real hooke(Real overlap, Real stiffness) { return stiffness * overlap; }   // double, or lanes<double>
///
/// With contraction of products and sums (-ffp-contract=fast, where there are fused ones) the compiler may round either
/// otherwise.
///
/// @tparam Real   float or double.
/// @tparam Bytes  of a register: parts of a program built for different machines have different types.
template <class Real, std::size_t Bytes = lane_bytes>
struct lanes {
    static constexpr std::size_t count = Bytes / sizeof(Real);
    using integer = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
    typedef Real native __attribute__((vector_size(Bytes)));
    typedef integer native_mask __attribute__((vector_size(Bytes)));

    /// True or false of each lane, as a comparison answers.
    struct mask {
        native_mask value;
        /// Bit l is lane l.
        [[nodiscard, gnu::always_inline]] unsigned bits() const noexcept {
#if defined(__AVX__)
            if constexpr (Bytes == 32 && sizeof(Real) == 8)
                return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(value)));
            else if constexpr (Bytes == 32)
                return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(value)));
            else
#endif
#if defined(__SSE2__)
            if constexpr (Bytes == 16 && sizeof(Real) == 8)
                return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(value)));
            else if constexpr (Bytes == 16)
                return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(value)));
            else
#endif
            {
                unsigned result = 0;
                for (std::size_t l = 0; l < count; ++l) result |= (value[l] != 0 ? 1U : 0U) << l;
                return result;
            }
        }
        [[gnu::always_inline]] friend mask operator&(const mask& a, const mask& b) noexcept {
            return {a.value & b.value};
        }
        [[gnu::always_inline]] friend mask operator|(const mask& a, const mask& b) noexcept {
            return {a.value | b.value};
        }
    };

    native value;

    lanes() = default;
    [[gnu::always_inline]] lanes(const native& all) noexcept : value(all) {}
    /// The same number in each.
    [[gnu::always_inline]] lanes(Real each) noexcept : lanes(of([each](auto) { return each; })) {}

    /// Lane l is make(l), l a constant: put together in registers, where one write for each lane would go through memory.
    template <class Make>
    [[nodiscard, gnu::always_inline]] static lanes of(Make&& make) {
        return [&]<std::size_t... L>(std::index_sequence<L...>) __attribute__((always_inline)) {
            return lanes(native{make(std::integral_constant<std::size_t, L>{})...});
        }
        (std::make_index_sequence<count>{});
    }

    /// `count` numbers that follow each other in memory, and to there.
    [[nodiscard, gnu::always_inline]] static lanes load(const Real* from) noexcept {
        native value;
        __builtin_memcpy(&value, from, sizeof(value));
        return value;
    }
    [[gnu::always_inline]] void store(Real* to) const noexcept { __builtin_memcpy(to, &value, sizeof(value)); }

    [[nodiscard, gnu::always_inline]] Real operator[](std::size_t l) const noexcept { return value[l]; }
    /// Makes lane l this number.
    [[gnu::always_inline]] void set(std::size_t l, Real to) noexcept { value[l] = to; }

    [[gnu::always_inline]] friend lanes operator+(const lanes& a, const lanes& b) noexcept {
        return a.value + b.value;
    }
    [[gnu::always_inline]] friend lanes operator-(const lanes& a, const lanes& b) noexcept {
        return a.value - b.value;
    }
    [[gnu::always_inline]] friend lanes operator*(const lanes& a, const lanes& b) noexcept {
        return a.value * b.value;
    }
    [[gnu::always_inline]] friend lanes operator/(const lanes& a, const lanes& b) noexcept {
        return a.value / b.value;
    }
    [[gnu::always_inline]] friend lanes operator-(const lanes& a) noexcept { return -a.value; }
    [[gnu::always_inline]] lanes& operator+=(const lanes& b) noexcept { return *this = *this + b; }
    [[gnu::always_inline]] lanes& operator-=(const lanes& b) noexcept { return *this = *this - b; }

    [[gnu::always_inline]] friend mask operator<(const lanes& a, const lanes& b) noexcept {
        return {a.value < b.value};
    }
    [[gnu::always_inline]] friend mask operator>(const lanes& a, const lanes& b) noexcept {
        return {a.value > b.value};
    }
};

namespace detail {

template <class Real>
struct number_in {
    using type = Real;
};
template <class Real, std::size_t Bytes>
struct number_in<lanes<Real, Bytes>> {
    using type = Real;
};

}  // namespace detail

/// The type of each number: Real of lanes<Real>, and a number's own.
template <class Real>
using number_of = typename detail::number_in<Real>::type;

/// Functions of lanes, and the same ones of one number: a formula that calls them can be written for either.
namespace lanewise {

/// chosen ? yes : no, of each lane.
template <class Real, std::size_t Bytes>
[[nodiscard, gnu::always_inline]] inline lanes<Real, Bytes> select(const typename lanes<Real, Bytes>::mask& chosen,
                                                                   const lanes<Real, Bytes>& yes,
                                                                   const lanes<Real, Bytes>& no) noexcept {
    return chosen.value ? yes.value : no.value;
}
[[nodiscard, gnu::always_inline]] inline double select(bool chosen, double yes, double no) noexcept {
    return chosen ? yes : no;
}
[[nodiscard, gnu::always_inline]] inline float select(bool chosen, float yes, float no) noexcept {
    return chosen ? yes : no;
}

/// Correctly rounded, as std::sqrt.
template <class Real, std::size_t Bytes>
[[nodiscard, gnu::always_inline]] inline lanes<Real, Bytes> sqrt(const lanes<Real, Bytes>& a) noexcept {
    using native [[maybe_unused]] = typename lanes<Real, Bytes>::native;
#if defined(__AVX__)
    if constexpr (Bytes == 32 && sizeof(Real) == 8)
        return native(_mm256_sqrt_pd(a.value));
    else if constexpr (Bytes == 32)
        return native(_mm256_sqrt_ps(a.value));
    else
#endif
#if defined(__SSE2__)
    if constexpr (Bytes == 16 && sizeof(Real) == 8)
        return native(_mm_sqrt_pd(a.value));
    else if constexpr (Bytes == 16)
        return native(_mm_sqrt_ps(a.value));
    else
#endif
        return lanes<Real, Bytes>::of([&](auto l) { return static_cast<Real>(std::sqrt(a[l])); });
}
[[nodiscard, gnu::always_inline]] inline double sqrt(double a) noexcept { return std::sqrt(a); }
[[nodiscard, gnu::always_inline]] inline float sqrt(float a) noexcept { return std::sqrt(a); }

/// Whether any lane is chosen.
[[nodiscard, gnu::always_inline]] inline bool any(bool chosen) noexcept { return chosen; }
template <class Mask>
    requires requires(const Mask& chosen) { chosen.bits(); }
[[nodiscard, gnu::always_inline]] inline bool any(const Mask& chosen) noexcept {
    return chosen.bits() != 0;
}

/// The greater of two, lane by lane.
template <class Real>
[[nodiscard, gnu::always_inline]] inline Real greatest(const Real& a, const Real& b) noexcept {
    return select(a < b, b, a);
}

}  // namespace lanewise
}  // namespace tsubu
