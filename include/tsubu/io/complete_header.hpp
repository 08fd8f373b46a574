// SPDX-License-Identifier: MIT
/// @file
/// complete_header: what the header of a LAMMPS data file says of a store.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/io/atom_style.hpp>
#include <tsubu/io/detail/field_named.hpp>
#include <tsubu/io/detail/store_sections.hpp>
#include <tsubu/io/lammps_header.hpp>
#include <tsubu/io/lammps_options.hpp>
#include <tsubu/store/topology.hpp>

#include <algorithm>  // std::max
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int32_t, std::int64_t
#include <limits>     // std::numeric_limits
#include <string>     // std::to_string
#include <vector>     // std::vector

namespace tsubu {
namespace detail {

/// Masses by type, from particles of which those of one type weigh the same.
template <class Store>
[[nodiscard]] std::vector<double> masses_by_type(const Store& store, std::int32_t types) {
    if (static_cast<std::size_t>(types) > store.owned_count())
        raise<input_error>("lammps_writer",
                           std::to_string(store.owned_count()) + " particles do not tell the masses of " +
                               std::to_string(types) + " types",
                           "give the masses in the header");
    constexpr auto untold = std::numeric_limits<double>::infinity();
    std::vector<double> masses(static_cast<std::size_t>(types), untold);
    for (std::size_t i = 0; i < store.owned_count(); ++i) {
        const auto type = type_at(store, i);
        const auto weight = static_cast<double>(value_at<"mass">(store, i, 0.0));
        auto& of_type = masses[static_cast<std::size_t>(type - 1)];
        if (!(weight > 0 && weight < untold))
            raise<input_error>("lammps_writer",
                               "a particle of type " + std::to_string(type) + " with the mass " + shown(weight),
                               "masses are finite, and above 0");
        if (of_type != untold && of_type != weight)
            raise<input_error>("lammps_writer",
                               "particles of type " + std::to_string(type) + " with masses " + shown(of_type) +
                                   " and " + shown(weight),
                               "atom styles but sphere have one mass per type");
        of_type = weight;
    }
    for (std::size_t k = 0; k < masses.size(); ++k)
        if (masses[k] == untold)
            raise<input_error>("lammps_writer", "no particle tells the mass of type " + std::to_string(k + 1),
                               "give the masses in the header");
    return masses;
}

}  // namespace detail

/// Sets the number of rows to what the owned particles have, raises the numbers of types to what they need, and takes
/// the masses from them if the header has none and the style wants them.
///
/// Over ranks: each completes its own; the header of the file has the sums of rows and the largest types.
/// @tparam Newton  newton_on or newton_off, as the store keeps its terms
/// @throws input_error for a species below 1, a type of a term that 32 bits do not hold, particles of one type with
///         different masses, or a type without mass.
template <class Newton, class Store>
void complete_header(lammps_header& top, const Store& store, atom_style style) {
    top.atoms.rows = static_cast<std::int64_t>(store.owned_count());
    for (std::size_t i = 0; i < store.owned_count(); ++i)
        top.atoms.types = (std::max)(top.atoms.types, detail::type_at(store, i));
    const auto terms = [&](lammps_section section, lammps_count& count) {
        count.rows = 0;
        detail::with_terms<Store>(section, [&]<auto Field>() {
            std::int64_t most = 0;
            topology<Field, Newton>::rows(store, [&](std::int64_t type, const auto&) {
                ++count.rows;
                most = (std::max)(most, type);
            });
            if (most > (std::numeric_limits<std::int32_t>::max)())
                detail::raise<input_error>("lammps_writer", "a term of type " + std::to_string(most),
                                           "types have 31 bits");
            count.types = (std::max)(count.types, static_cast<std::int32_t>(most));
        });
    };
    terms(lammps_section::bond_rows, top.bonds);
    terms(lammps_section::angle_rows, top.angles);
    terms(lammps_section::dihedral_rows, top.dihedrals);
    terms(lammps_section::improper_rows, top.impropers);
    if constexpr (detail::has_named<Store, "mass">)
        if (!is_sphere(style) && top.masses.empty() && top.atoms.types != 0)
            top.masses = detail::masses_by_type(store, top.atoms.types);
}

}  // namespace tsubu
