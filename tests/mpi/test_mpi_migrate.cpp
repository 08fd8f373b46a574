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
using comm_laws::wedge_of;
using comm_laws::world_size;

}  // namespace

TEST_CASE("no particle is lost or doubled over MPI", "[comm][mpi][migrate]") {
    const auto check = [](const auto& box, std::size_t most_words) {
        each_decomposition(box, world_size(), [&](const auto& parts) {
            check_in(MPI_COMM_WORLD, most_words,
                     [&](auto& on, verdict& seen) { comm_laws::migrate_keeps_all(parts, on, 3, 60, 21, seen); });
        });
    };
    check(box_of<3>(7), comm_laws::ordinary_words);
    check(box_of<3>(7), 7);
    check(wedge_of(6), comm_laws::ordinary_words);
}
TEST_CASE("particles that have left the box are settled over MPI", "[comm][mpi][migrate]") {
    const tsubu::brick_decomposition<3> bricks(box_of<3>(3), world_size());
    check_in_world([&](auto& on, verdict& seen) { comm_laws::migrate_settles_the_lost(bricks, on, 3, 2, seen); });
}
TEST_CASE("ghosts are the images within the cutoff over MPI", "[comm][mpi][halo]") {
    const auto check = [](const auto& box, std::size_t most_words) {
        for (const double cutoff : {0.0, 0.2, 1.1})
            each_decomposition(box, world_size(), [&](const auto& parts) {
                check_in(MPI_COMM_WORLD, most_words,
                         [&](auto& on, verdict& seen) { comm_laws::ghosts_are_images(parts, on, cutoff, seen); });
            });
    };
    check(box_of<3>(5), comm_laws::ordinary_words);
    check(box_of<3>(5), 7);
    check(wedge_of(3), comm_laws::ordinary_words);
}
TEST_CASE("a halo that cannot be is refused on all ranks over MPI", "[comm][mpi][halo]") {
    const auto box = box_of<3>(5);
    const tsubu::brick_decomposition<3> bricks(box, world_size());
    const tsubu::brick_decomposition<3> more(box, world_size() + 1);
    check_in_world([&](auto& on, verdict& seen) {
        comm_laws::ghosts_of all(bricks, on, tsubu::direct_pattern{}, 0.3, 5, 40, seen);
        all.examine_refusals(more);
    });
}
