// SPDX-License-Identifier: MIT
/// @file
/// Texts of LAMMPS data files that the tests change here and there, and stores to read them into.
#pragma once

#include <tsubu/io/lammps_data_file.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <stdexcept>
#include <string>
#include <string_view>

/// Four particles of style full, with terms of all kinds.
inline const std::string full_text =
    "four of a kind\n"
    "\n"
    "4 atoms\n"
    "3 bonds\n"
    "2 angles\n"
    "1 dihedrals\n"
    "1 impropers\n"
    "2 atom types\n"
    "2 bond types\n"
    "1 angle types\n"
    "1 dihedral types\n"
    "3 improper types\n"
    "\n"
    "0 10 xlo xhi\n"
    "-1 1 ylo yhi\n"
    "0 2.5 zlo zhi\n"
    "\n"
    "Masses\n"
    "\n"
    "2 16\n"
    "1 1.008\n"
    "\n"
    "Atoms # full\n"
    "\n"
    "20 1 2 -0.5 1 0.5 2 0 0 1\n"
    "10 1 1 0.25 0.1 0 0 0 -1 0\n"
    "40 2 1 0.25 9 -0.5 1 0 0 0\n"
    "30 2 1 0 5 0 1 2 0 0\n"
    "\n"
    "Velocities\n"
    "\n"
    "40 4 0 0\n"
    "10 1 0 0\n"
    "20 2 0 0\n"
    "30 3 0 -0.125\n"
    "\n"
    "Bonds\n"
    "\n"
    "1 2 20 10\n"
    "2 1 20 30\n"
    "3 1 30 40\n"
    "\n"
    "Angles\n"
    "\n"
    "1 1 10 20 30\n"
    "2 1 20 30 40\n"
    "\n"
    "Dihedrals\n"
    "\n"
    "1 1 10 20 30 40\n"
    "\n"
    "Impropers\n"
    "\n"
    "1 3 40 10 20 30\n";

using full_fields =
    tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>, tsubu::mass, tsubu::image<3>,
                  tsubu::molecule, tsubu::charge, tsubu::bonds, tsubu::angles, tsubu::dihedrals, tsubu::impropers>;
template <class Layout = tsubu::soa>
using full_store = tsubu::particle_store<full_fields, Layout>;
using atomic_store = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>>>;

/// The text with one part replaced; fails loudly if the part is not in it.
inline std::string with(std::string text, std::string_view part, std::string_view replacement) {
    const auto at = text.find(part);
    if (at == std::string::npos) throw std::invalid_argument("no such part: " + std::string(part));
    return text.replace(at, part.size(), replacement);
}

template <class Newton = tsubu::newton_on, class Store, class Keep = tsubu::every_particle>
tsubu::lammps_header read_text(std::string_view text, Store& store, const tsubu::lammps_read_options& options = {},
                               Keep&& keep = {}) {
    tsubu::lammps_reader<tsubu::memory_source> file(tsubu::memory_source(text, "some.lmp"), options);
    file.template read<Newton>(store, keep);
    return file.header();
}

template <class Newton = tsubu::newton_on, class Store>
std::string text_of(const Store& store, const tsubu::lammps_header& top,
                    const tsubu::lammps_write_options& options = {}) {
    std::string text;
    tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; }, options, Newton{});
    out.write(store, top);
    return text;
}
