// SPDX-License-Identifier: MIT
/// @file
/// The laws of migrate and of halos, over MPI.
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/mpi_transport.hpp>

#include "comm_laws/halo_laws.hpp"
#include "comm_laws/migrate_laws.hpp"
#include "in_world.hpp"

#include <cstddef>

namespace {

using comm_laws::box_of;
using comm_laws::check_in;
using comm_laws::check_in_world;
using comm_laws::each_decomposition;
using comm_laws::passed;
using comm_laws::world_size;

}  // namespace

// In one box: what depends on boxes is tested on threads, without MPI.
TEST_CASE("no particle is lost or doubled over MPI", "[comm][mpi][migrate]") {
    for (const auto most_words : {comm_laws::ordinary_words, std::size_t{7}})
        each_decomposition(box_of<3>(7), world_size(), [&](const auto& parts) {
            check_in(MPI_COMM_WORLD, most_words,
                     [&](auto& on, verdict& seen) { comm_laws::migrate_keeps_all(parts, on, 3, 60, 21, seen); });
        });
}
TEST_CASE("particles that have left the box are settled over MPI", "[comm][mpi][migrate]") {
    const comm_laws::any_parts<tsubu::domain<3>> bricks(comm_laws::bricks_of(box_of<3>(3), world_size()));
    check_in_world([&](auto& on, verdict& seen) { comm_laws::migrate_settles_the_lost(bricks, on, 3, 2, seen); });
}
TEST_CASE("ghosts are the images within the cutoff over MPI", "[comm][mpi][halo]") {
    for (const auto most_words : {comm_laws::ordinary_words, std::size_t{7}})
        for (const double cutoff : {0.0, 0.2, 1.1})
            comm_laws::each_kind_of_bricks(box_of<3>(5), world_size(), [&](const auto& parts) {
                for (const auto how : {passed::directly, passed::in_stages})
                    check_in(MPI_COMM_WORLD, most_words, [&](auto& on, verdict& seen) {
                        comm_laws::ghosts_are_images(parts, on, how, cutoff, seen);
                    });
            });
}
TEST_CASE("a halo that cannot be is refused on all ranks over MPI", "[comm][mpi][halo]") {
    const auto bricks = comm_laws::bricks_of(box_of<3>(5), world_size());
    const auto more = comm_laws::bricks_of(box_of<3>(5), world_size() + 1);
    check_in_world([&](auto& on, verdict& seen) {
        comm_laws::ghosts_of all(bricks, on, passed::directly, 0.3, 5, 40, seen);
        all.examine_refusals(more);
    });
}
