// SPDX-License-Identifier: MIT
/// @file
/// What can be chosen when LAMMPS data files are read and written.
#pragma once

#include <tsubu/io/atom_style.hpp>

#include <cstddef>   // std::size_t
#include <optional>  // std::optional

namespace tsubu {

/// What happens at sections and lines of the header that tsubu does not know, such as Pair Coeffs.
enum class unknown_lines { refuse, skip };

/// What read_lammps takes for granted, and what it lets pass.
struct lammps_read_options {
    std::optional<atom_style> style{};  ///< else the file says it: "Atoms # full"
    unknown_lines unknown = unknown_lines::refuse;  ///< sections and lines that the reader does not know
    bool allows_repeats = false;        ///< terms in which a particle is twice, such as a bond to itself
    bool velocities_may_lack = false;   ///< a file without Velocities leaves them 0, as in LAMMPS
    std::size_t chunk = std::size_t{1} << 20;  ///< characters held at a time; no line may be longer, nor than 65536
};

/// How write_lammps writes.
struct lammps_write_options {
    /// Else the least that has all fields of the store. A style that is named writes the columns that it has, whatever
    /// else is in the store.
    std::optional<atom_style> style{};
    /// Atoms and velocities by id, terms by their ids, and bonds from the lower id: bytes that do not depend on the
    /// order of particles in the store, nor on who keeps terms.
    bool canonical = false;
    bool images = true;                        ///< image flags, if the store has them
    std::size_t chunk = std::size_t{1} << 20;  ///< characters held at a time, at least 1024
};

/// The sections that have a row per particle or per term, in the order in which they are written.
enum class lammps_section { atom_rows, velocity_rows, bond_rows, angle_rows, dihedral_rows, improper_rows };

}  // namespace tsubu
