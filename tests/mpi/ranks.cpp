// SPDX-License-Identifier: MIT
#include <tsubu/comm/halo.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/comm/mpi_transport.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/io/vtk.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <string>

using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::radius>;

int main(int argc, char** argv) {
    const tsubu::mpi_environment mpi(argc, argv);
    tsubu::mpi_transport on(MPI_COMM_WORLD);  // or self_transport, without MPI: all that follows is the same
    const tsubu::domain<3> box{{0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, false}}};
    const tsubu::brick_decomposition bricks(box, on.ranks());

    tsubu::particle_store<carried> g;
    tsubu::random_stream random(7 + on.rank());
    for (int i = 0; i < 1000; ++i)
        g.push_back(tsubu::id = i + 1000 * std::int64_t{on.rank()}, tsubu::radius = 0.01,
                    tsubu::position<3> = {random.unit(), random.unit(), random.unit()});

    tsubu::id_map<> where;
    tsubu::same_id_links same;
    for (int step = 0; step < 20; ++step) {
        for (auto grain : g.owned())
            for (std::size_t k = 0; k < 2; ++k) grain[tsubu::position<3>][k] += 0.1 * (random.unit() - 0.5);
        tsubu::migrate(g, bricks, on);                      // each to the rank that owns its position
        auto halo = tsubu::make_halo(g, bricks, 0.05, on);  // copies of what is near, periodic images too
        where.rebuild(g[tsubu::id].span(), same);           // which particle is where, ghosts included
        for (auto& v : g.owned()[tsubu::velocity<3>]) v[2] -= 9.81e-3;
        halo.forward(g, tsubu::velocity<3>);  // from owners to ghosts, as often as values change
    }
    tsubu::write_vtp("grains_" + std::to_string(on.rank()) + ".vtp", g, tsubu::position<3>);
    std::uint64_t count[] = {g.owned_count()};
    on.reduce(std::span<std::uint64_t>(count), tsubu::reduction::sum);
    return count[0] == 1000 * on.ranks() && where.find(g[tsubu::id][0]) == 0 ? 0 : 1;
}
