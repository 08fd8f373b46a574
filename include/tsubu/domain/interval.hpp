// SPDX-License-Identifier: MIT
/// @file
/// interval: the coordinates from a first to a last one, and the neighbours of a floating-point number.
#pragma once

#include <tsubu/domain/lattice.hpp>

#include <bit>          // std::bit_cast
#include <concepts>     // std::floating_point
#include <cstdint>      // std::int64_t
#include <limits>       // std::numeric_limits
#include <type_traits>  // std::conditional_t

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0) || \
    defined(__ASSOCIATIVE_MATH__)
#error \
    "tsubu: -ffast-math and its parts remove the tests for NaN and infinity, or regroup the sums, that decide whose \
a particle is; compile without them"
#endif

namespace tsubu {

/// All coordinates x with first <= x <= last. Closed on both sides, because the highest value of a lattice has no
/// successor; for floating point, x < top is x <= the number before top.
template <class Scalar>
struct interval {
    Scalar first;
    Scalar last;

    /// One comparison pair and no branch; NaN is in no interval.
    [[nodiscard]] constexpr bool contains(Scalar x) const noexcept {
        const bool from = x >= first;
        const bool to = x <= last;
        return from & to;
    }
    /// Every value that the type has, infinities excepted.
    [[nodiscard]] static constexpr interval all() noexcept {
        if constexpr (is_lattice<Scalar>) {
            using limits = std::numeric_limits<decltype(Scalar{}.value)>;
            return {{(limits::min)()}, {(limits::max)()}};
        } else {
            return {std::numeric_limits<Scalar>::lowest(), (std::numeric_limits<Scalar>::max)()};
        }
    }
};

namespace detail {

template <std::floating_point Scalar>
using bits_of = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;

[[nodiscard]] inline bool reads_as_zero(double x) noexcept {
    volatile double read = x;  // compared when the program runs
    return !(read > 0);
}
/// Whether this thread takes numbers below the normal ones for 0: linking with -ffast-math is enough, whatever the
/// objects were compiled with. A cut at 0 then has its neighbours further away.
[[nodiscard]] constexpr bool denormals_are_zero() noexcept {
    if (std::is_constant_evaluated()) return false;
    return reads_as_zero(std::numeric_limits<double>::denorm_min());
}

/// The next number towards +infinity, as std::nextafter; constexpr. The highest number stays.
template <std::floating_point Scalar>
[[nodiscard]] constexpr Scalar next_above(Scalar x) noexcept {
    using Bits = bits_of<Scalar>;
    using limits = std::numeric_limits<Scalar>;
    if (x >= (limits::max)()) return x;
    if (x == 0) return denormals_are_zero() ? (limits::min)() : limits::denorm_min();
    if (x == -(limits::min)() && denormals_are_zero()) return 0;
    const auto bits = std::bit_cast<Bits>(x);
    return std::bit_cast<Scalar>(x > 0 ? bits + 1 : bits - 1);
}
template <std::floating_point Scalar>
[[nodiscard]] constexpr Scalar next_below(Scalar x) noexcept {
    return -next_above(-x);
}

/// The coordinates next to x; nothing lies between. Past the ends of a lattice lies its other end.
template <class Scalar>
[[nodiscard]] constexpr Scalar after(Scalar x) noexcept {
    if constexpr (is_lattice<Scalar>)
        return x + decltype(x.value){1};
    else
        return next_above(x);
}
template <class Scalar>
[[nodiscard]] constexpr Scalar before(Scalar x) noexcept {
    if constexpr (is_lattice<Scalar>)
        return x + decltype(x.value){-1};
    else
        return next_below(x);
}

/// The place of a coordinate among all of its type, infinities excepted: increasing, 1 from one to the next.
template <class Scalar>
[[nodiscard]] constexpr std::int64_t ordinal(Scalar x) noexcept {
    if constexpr (is_lattice<Scalar>) {
        return x.value;
    } else {
        if (x == 0) return 0;
        const auto size = static_cast<std::int64_t>(std::bit_cast<bits_of<Scalar>>(x < 0 ? -x : x));
        return x < 0 ? -size : size;
    }
}
/// The coordinate at a place.
template <class Scalar>
[[nodiscard]] constexpr Scalar at_ordinal(std::int64_t place) noexcept {
    if constexpr (is_lattice<Scalar>) {
        return {static_cast<decltype(Scalar{}.value)>(place)};
    } else {
        const auto size = std::bit_cast<Scalar>(static_cast<bits_of<Scalar>>(place < 0 ? -place : place));
        return place < 0 ? -size : size;
    }
}

/// NaN and infinities are not finite: x - x is 0 for all others.
template <std::floating_point Scalar>
[[nodiscard]] constexpr bool is_finite(Scalar x) noexcept {
    return x - x == 0;  // NOLINT(misc-redundant-expression)
}

}  // namespace detail
}  // namespace tsubu
