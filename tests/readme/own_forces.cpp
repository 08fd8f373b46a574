// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <cmath>
#include <cstdio>
#include <span>

using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>>;

int main() {
    tsubu::self_transport on;  // over MPI: <tsubu/mpi.hpp>, an mpi_environment, and mpi_transport here
    const tsubu::domain<3> box({0, 0, 0}, {8, 8, 8}, {.periodic = {true, true, true}});
    const tsubu::brick_decomposition bricks(box, on.ranks());
    tsubu::particle_store<carried> g;
    tsubu::random_stream random(7);
    const auto at_random = [&] { return tsubu::vec<3>{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5}; };
    for (std::int64_t i = 0; i < 512; ++i) {
        const std::int64_t column = i % 8, row = i / 8 % 8, layer = i / 64;
        const tsubu::vec<3> x{0.5 + double(column), 0.5 + double(row), 0.5 + double(layer)}, v = at_random();
        if (bricks.owner(x) == on.rank()) g.push_back(tsubu::id = i, tsubu::position<3> = x, tsubu::velocity<3> = v);
    }

    const double cutoff = 1.2, skin = 0.3, k = 100, dt = 2e-3;  // [m], [m], [N/m], [s]; masses are 1 kg
    decltype(tsubu::make_halo(g, bricks, cutoff, on)) halo;
    tsubu::pair_list list;
    tsubu::skin_watch watch(skin);
    const auto is_owned = [&](tsubu::index_t i) { return static_cast<std::size_t>(i) < g.owned_count(); };
    double first = 0, last = 0;  // energies [J]
    for (int step = 0; step <= 2000; ++step) {
        if (step == 0 || watch.is_due(on)) {
            tsubu::migrate(g, bricks, on);
            halo = tsubu::make_halo(g, bricks, cutoff + skin, on);
            list.build(g[tsubu::position<3>], g.owned_count(), tsubu::same_reach{cutoff + skin});
            watch.restart();
        } else {
            halo.forward(g, tsubu::position<3>);
        }
        for (auto& f : g[tsubu::force<3>]) f = {};
        double energy[] = {0};
        for (const auto [i, j] : list.pairs()) {  // i is owned; j may be a ghost, and then its owner has this pair too
            auto &&x = g[tsubu::position<3>], &&f = g[tsubu::force<3>];
            const tsubu::vec<3> d{x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]};
            const double r = std::hypot(d[0], d[1], d[2]), overlap = cutoff - r;
            if (overlap <= 0) continue;
            for (std::size_t a = 0; a < 3; ++a) f[i][a] += k * overlap * d[a] / r;
            if (is_owned(j))
                for (std::size_t a = 0; a < 3; ++a) f[j][a] -= k * overlap * d[a] / r;
            energy[0] += (is_owned(j) ? 0.5 : 0.25) * k * overlap * overlap;
        }
        double fastest = 0;
        for (auto grain : g.owned()) {
            auto& v = grain[tsubu::velocity<3>];
            for (std::size_t a = 0; a < 3; ++a) {
                energy[0] += 0.5 * v[a] * v[a];
                v[a] += dt * grain[tsubu::force<3>][a];
                grain[tsubu::position<3>][a] += dt * v[a];
            }
            fastest = std::fmax(fastest, std::hypot(v[0], v[1], v[2]));
        }
        watch.travel(fastest * dt);
        on.reduce(std::span<double>(energy), tsubu::reduction::sum);
        if (step == 0) first = energy[0];
        last = energy[0];
        if (step % 500 == 0 && on.rank() == 0) std::printf("step %4d: %.2f J\n", step, last);
    }
    return std::abs(last / first - 1) < 0.01 ? 0 : 1;
}
