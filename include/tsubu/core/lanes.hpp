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
#include <immintrin.h>  // _mm256_sqrt_pd, _mm256_sqrt_ps
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
/// @tparam Real  float or double.
template <class Real>
struct lanes {
    static constexpr std::size_t count = lane_bytes / sizeof(Real);
    using integer = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
    typedef Real native __attribute__((vector_size(lane_bytes)));
    typedef integer native_mask __attribute__((vector_size(lane_bytes)));

    /// True or false of each lane, as a comparison answers.
    struct mask {
        native_mask value;
        /// Bit l is lane l.
        [[nodiscard, gnu::always_inline]] unsigned bits() const noexcept {
#if defined(__SSE2__) && !defined(__AVX__)
            if constexpr (sizeof(Real) == 8)
                return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(value)));
            else
                return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(value)));
#else
            unsigned result = 0;
            for (std::size_t l = 0; l < count; ++l) result |= (value[l] != 0 ? 1U : 0U) << l;
            return result;
#endif
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
    [[gnu::always_inline]] lanes& operator*=(const lanes& b) noexcept { return *this = *this * b; }

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
template <class Real>
struct number_in<lanes<Real>> {
    using type = Real;
};

}  // namespace detail

/// The type of each number: Real of lanes<Real>, and a number's own.
template <class Real>
using number_of = typename detail::number_in<Real>::type;

/// chosen ? yes : no, of each lane.
template <class Real>
[[nodiscard, gnu::always_inline]] inline lanes<Real> select(const typename lanes<Real>::mask& chosen,
                                                            const lanes<Real>& yes, const lanes<Real>& no) noexcept {
    return chosen.value ? yes.value : no.value;
}

/// Correctly rounded, as std::sqrt.
template <class Real>
[[nodiscard, gnu::always_inline]] inline lanes<Real> sqrt(const lanes<Real>& a) noexcept {
#if defined(__AVX__)
    if constexpr (sizeof(Real) == 8)
        return typename lanes<Real>::native(_mm256_sqrt_pd(a.value));
    else
        return typename lanes<Real>::native(_mm256_sqrt_ps(a.value));
#elif defined(__SSE2__)
    if constexpr (sizeof(Real) == 8)
        return typename lanes<Real>::native(_mm_sqrt_pd(a.value));
    else
        return typename lanes<Real>::native(_mm_sqrt_ps(a.value));
#else
    lanes<Real> result = a;
    for (std::size_t l = 0; l < lanes<Real>::count; ++l) result.set(l, std::sqrt(a[l]));
    return result;
#endif
}

/// The same of one number, so that a formula can be written for either.
[[nodiscard, gnu::always_inline]] inline double select(bool chosen, double yes, double no) noexcept {
    return chosen ? yes : no;
}
[[nodiscard, gnu::always_inline]] inline float select(bool chosen, float yes, float no) noexcept {
    return chosen ? yes : no;
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

}  // namespace tsubu
