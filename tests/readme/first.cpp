// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <cstdio>

int main() {
    tsubu::self_transport on;  // over MPI: <tsubu/mpi.hpp>, an mpi_environment, and mpi_transport here
    const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, false}});
    const tsubu::brick_decomposition bricks(box, on.ranks());
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>>> grains;
    if (on.rank() == 0) grains.push_back(tsubu::id = 901417, tsubu::position<3> = {2.98, 0.5, 0.5});
    // grains[tsubu::radius][0] = 1;                        // does not compile: this store has no such field
    tsubu::migrate(grains, bricks, on);                     // each to the rank that owns its position
    auto halo = tsubu::make_halo(grains, bricks, 0.1, on);  // copies of what is near, and periodic images
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    where.rebuild(grains[tsubu::id].span(), same);
    for (const auto k : same.images(where.find(901417)))
        std::printf("at index %d: x = %g\n", k, grains[k][tsubu::position<3>][0]);
    // at index 0: x = 0.98
    // at index 1: x = -0.02: its periodic image
}
