// SPDX-License-Identifier: MIT
/// @file
/// lattice: a coordinate as a fixed-point fraction of a periodic axis.
#pragma once

#include <compare>      // std::strong_ordering
#include <concepts>     // std::signed_integral
#include <type_traits>  // std::make_unsigned_t

namespace tsubu {

/// One of the 2^b equidistant coordinates of a periodic axis, b the bits of Int: the lowest value is its lower face,
/// and one past the highest is the lower face again.
///
/// A wrap is integer overflow, a nearest image a subtraction, ownership a comparison: exact, and as fine everywhere in
/// the box: L / 2^32 or L / 2^64. Periodic axes only; domain<D, lattice<Int>> converts
/// positions from and to real units.
///
/// @tparam Int  std::int32_t or std::int64_t; smaller ones for exhaustive tests.
template <std::signed_integral Int>
struct lattice {
    Int value = 0;

    friend constexpr auto operator<=>(lattice, lattice) noexcept = default;  // NOLINT(modernize-use-nullptr)
    /// Moves on by an offset in lattice steps, around the axis as often as need be.
    friend constexpr lattice operator+(lattice at, Int offset) noexcept {
        using Unsigned = std::make_unsigned_t<Int>;
        return {static_cast<Int>(static_cast<Unsigned>(at.value) + static_cast<Unsigned>(offset))};
    }
    /// Steps from b to a the shorter way round, in [-2^(b-1), 2^(b-1)): of two ways of equal length the negative one.
    friend constexpr Int operator-(lattice a, lattice b) noexcept {
        using Unsigned = std::make_unsigned_t<Int>;
        return static_cast<Int>(static_cast<Unsigned>(a.value) - static_cast<Unsigned>(b.value));
    }
};

/// Whether a type is a coordinate on a lattice.
template <class Scalar>
inline constexpr bool is_lattice = false;
template <class Int>
inline constexpr bool is_lattice<lattice<Int>> = true;

}  // namespace tsubu
