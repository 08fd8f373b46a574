// SPDX-License-Identifier: MIT
/// @file
/// Which sections a store has fields for, and which atom style.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/io/atom_style.hpp>
#include <tsubu/io/detail/atom_row.hpp>
#include <tsubu/io/detail/field_named.hpp>
#include <tsubu/io/lammps_options.hpp>
#include <tsubu/store/term.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t
#include <limits>       // std::numeric_limits
#include <string>       // std::string
#include <string_view>  // std::string_view

namespace tsubu::detail {

inline constexpr std::array<std::string_view, 6> section_names{"Atoms",  "Velocities", "Bonds",
                                                               "Angles", "Dihedrals",  "Impropers"};
inline constexpr std::array<lammps_section, 6> all_sections{
    lammps_section::atom_rows,  lammps_section::velocity_rows, lammps_section::bond_rows,
    lammps_section::angle_rows, lammps_section::dihedral_rows,  lammps_section::improper_rows};

/// Calls body.operator()<Field>() for the field of terms that the section lists, if the store has it.
/// @return whether it has.
template <class Store, class Body>
bool with_terms(lammps_section section, Body&& body) {
    bool found = false;
    const auto one = [&]<auto Field>(lammps_section of) {
        if constexpr (Store::template has<decltype(Field)>)
            if (section == of) {
                found = true;
                body.template operator()<Field>();
            }
    };
    one.template operator()<bonds>(lammps_section::bond_rows);
    one.template operator()<angles>(lammps_section::angle_rows);
    one.template operator()<dihedrals>(lammps_section::dihedral_rows);
    one.template operator()<impropers>(lammps_section::improper_rows);
    return found;
}

template <class Store>
[[nodiscard]] bool has_section(lammps_section section) {
    if (section == lammps_section::atom_rows) return true;
    if (section == lammps_section::velocity_rows)
        return has_named<Store, "velocity"> || has_named<Store, "angular_velocity">;
    return with_terms<Store>(section, []<auto>() {});
}

/// The first field of the store that keeps it from being one of spheres, or "".
template <class Store>
[[nodiscard]] constexpr std::string_view beyond_sphere() noexcept {
    if (has_named<Store, "charge">) return "charge";
    if (has_named<Store, "dihedrals">) return "dihedrals";
    if (has_named<Store, "impropers">) return "impropers";
    if (has_named<Store, "angles">) return "angles";
    if (has_named<Store, "bonds">) return "bonds";
    return has_named<Store, "molecule"> ? "molecule" : "";
}
/// @throws input_error if no style has all fields of the store.
template <class Store>
[[nodiscard]] atom_style least_style() {
    constexpr auto other = beyond_sphere<Store>();
    if (other.empty())
        return lacking_in<Store>(atom_style::atomic).empty() ? atom_style::atomic : atom_style::sphere;
    auto least = atom_style::bond;
    if (other == "charge") least = atom_style::full;
    if (other == "dihedrals" || other == "impropers") least = atom_style::molecular;
    if (other == "angles") least = atom_style::angle;
    if (const auto lacking = lacking_in<Store>(least); !lacking.empty())
        raise<input_error>("lammps_writer",
                           "no atom style has " + std::string(lacking) + " and " + std::string(other),
                           "name one in lammps_write_options.style, or write a store without");
    return least;
}

/// @throws input_error if the store lacks what rows of this style tell.
template <class Store>
void check_style(atom_style style) {
    const auto lack = [&](const char* field) {
        raise<input_error>("lammps_writer",
                           "atom style " + std::string(name_of(style)) + " tells a " + field +
                               ", which the store lacks",
                           "set lammps_write_options.style to another, or give the store the field");
    };
    if (has_charge(style) && !has_named<Store, "charge">) lack("charge");
    if (!is_sphere(style)) return;
    if (!has_named<Store, "radius">) lack("radius");
    if (!has_named<Store, "mass"> && !has_named<Store, "density">) lack("mass or density");
}

/// The type of a particle: its species, or 1. @throws input_error unless it is from 1 to 2^31 - 1.
template <class Store>
[[nodiscard]] std::int32_t type_at(const Store& store, std::size_t i) {
    const auto type = value_at<"species">(store, i, std::int32_t{1});
    if (type < 1 || type > (std::numeric_limits<std::int32_t>::max)()) [[unlikely]]
        raise<input_error>("lammps_writer", "the species " + std::to_string(type), "types of LAMMPS begin with 1");
    return static_cast<std::int32_t>(type);
}

}  // namespace tsubu::detail
