// SPDX-License-Identifier: MIT
/// @file
/// LAMMPS data files in one call: read_lammps and write_lammps.
#pragma once

#include <tsubu/io/atomic_file.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/lammps_fields.hpp>
#include <tsubu/io/lammps_header.hpp>
#include <tsubu/io/lammps_options.hpp>
#include <tsubu/io/lammps_reader.hpp>
#include <tsubu/io/lammps_writer.hpp>
#include <tsubu/store/topology.hpp>

#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::move

namespace tsubu {

/// Reads all particles of a file into an empty store.
///
///     tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>>> g;
///     auto top = tsubu::read_lammps("melt.lmp", g);
///
/// @return the header, with masses
/// @throws input_error as lammps_reader, file_error as file_source; the store is as before then.
template <class Newton = newton_on, class Store>
lammps_header read_lammps(std::string path, Store& store, const lammps_read_options& with = {}) {
    lammps_reader<file_source> file(file_source(std::move(path)), with);
    file.template read<Newton>(store);
    return file.header();
}

/// Writes the owned particles to a file, which is there whole or not at all.
///
/// @param top  title, box, and masses if the store does not tell them
/// @throws input_error as lammps_writer, file_error as atomic_file; what was at `path` is as before then.
template <class Newton = newton_on, class Store>
void write_lammps(std::string path, const Store& store, lammps_header top, const lammps_write_options& with = {}) {
    atomic_file file(std::move(path));
    const auto to_file = [&](std::string_view text) { file.append(text); };
    lammps_writer<decltype(to_file), Newton> out(to_file, with);
    out.write(store, std::move(top));
    file.commit();
}

}  // namespace tsubu
