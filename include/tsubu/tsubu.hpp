// SPDX-License-Identifier: MIT
/// @file
/// All of tsubu that needs no MPI. For whoever includes the library; inside it nobody includes this header.
#pragma once

#include <tsubu/version.hpp>

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/executor.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/fixed_string.hpp>
#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>

#include <tsubu/id/adaptive_storage.hpp>
#include <tsubu/id/bitmap_storage.hpp>
#include <tsubu/id/chained_storage.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/copies.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_lines.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/hash.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>
#include <tsubu/id/paged_storage.hpp>
#include <tsubu/id/prime.hpp>
#include <tsubu/id/same_id_links.hpp>
#include <tsubu/id/sizing.hpp>

#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/border.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/cuts.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/ghost.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/domain/neighbor_rank.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/domain/rank_grid.hpp>
#include <tsubu/domain/subdomain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/domain/wedge.hpp>

#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/bonus_of.hpp>
#include <tsubu/store/column.hpp>
#include <tsubu/store/concepts.hpp>
#include <tsubu/store/curve.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/growth.hpp>
#include <tsubu/store/list_of.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_range.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/soa.hpp>
#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/term.hpp>
#include <tsubu/store/topology.hpp>

#include <tsubu/io/atom_style.hpp>
#include <tsubu/io/atomic_file.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/checksum.hpp>
#include <tsubu/io/complete_header.hpp>
#include <tsubu/io/every_particle.hpp>
#include <tsubu/io/file_error.hpp>
#include <tsubu/io/lammps_data_file.hpp>
#include <tsubu/io/lammps_fields.hpp>
#include <tsubu/io/lammps_header.hpp>
#include <tsubu/io/lammps_options.hpp>
#include <tsubu/io/lammps_reader.hpp>
#include <tsubu/io/lammps_writer.hpp>
#include <tsubu/io/restart.hpp>
#include <tsubu/io/restart_state.hpp>
#include <tsubu/io/text_sink.hpp>
#include <tsubu/io/vtk.hpp>
