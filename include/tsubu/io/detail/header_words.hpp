// SPDX-License-Identifier: MIT
/// @file
/// What the header of a LAMMPS data file calls its numbers.
#pragma once

#include <tsubu/io/lammps_header.hpp>

#include <array>        // std::array
#include <string_view>  // std::string_view

namespace tsubu::detail {

/// A kind of row that the header counts.
struct counted_kind {
    std::string_view rows;   ///< as in "10 atoms"
    std::string_view types;  ///< as in "2 atom types"
    lammps_count lammps_header::*count;
};
inline constexpr std::array<counted_kind, 5> counted_kinds{
    {{"atoms", "atom types", &lammps_header::atoms},
     {"bonds", "bond types", &lammps_header::bonds},
     {"angles", "angle types", &lammps_header::angles},
     {"dihedrals", "dihedral types", &lammps_header::dihedrals},
     {"impropers", "improper types", &lammps_header::impropers}}};
inline constexpr std::array<std::string_view, 3> face_names{"xlo xhi", "ylo yhi", "zlo zhi"};

}  // namespace tsubu::detail
