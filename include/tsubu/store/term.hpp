// SPDX-License-Identifier: MIT
/// @file
/// term: a bond, an angle, a dihedral, an improper: particles that belong together, by their ids; and their fields.
#pragma once

#include <tsubu/store/field.hpp>
#include <tsubu/store/list_of.hpp>

#include <array>    // std::array
#include <compare>  // operator<=>
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t

namespace tsubu {

/// Particles that belong together, and of which type the term is. Type 0 is no term. A negative type is type -type,
/// switched off, as in LAMMPS: kept, counted and resolved as any other, and written without its sign. That such a term
/// does not act is up to the code that computes its force.
template <std::size_t Order>
struct term {
    static_assert(Order >= 2 && Order <= 4, "a term joins two, three or four particles");
    static constexpr std::size_t order = Order;
    std::int64_t type = 0;  // as wide as an id: no padding, which would travel and be stored as it lies
    std::array<std::int64_t, Order> ids{};

    friend constexpr auto operator<=>(const term&, const term&) noexcept = default;
};

/// The terms of two that a particle keeps: see topology.
inline constexpr field<"bonds", list_of<term<2>>> bonds{};
/// Of three, the middle one between its partners.
inline constexpr field<"angles", list_of<term<3>>> angles{};
/// Of four in a row.
inline constexpr field<"dihedrals", list_of<term<4>>> dihedrals{};
/// Of four, one of which is held in, or out of, the plane of the others.
inline constexpr field<"impropers", list_of<term<4>>> impropers{};

}  // namespace tsubu
