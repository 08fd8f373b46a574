// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <cmath>
#include <span>

using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>>;

int main() {
    tsubu::self_transport on;  // or mpi_transport
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

    const auto momentum = [&] {
        double sum[] = {0};
        for (const auto& v : g.owned()[tsubu::velocity<3>]) sum[0] += v[0];
        on.reduce(std::span<double>(sum), tsubu::reduction::sum);
        return sum[0];
    };
    const double before = momentum();

    const double cutoff = 1.2, skin = 0.3, dt = 2e-3;  // [m], [m], [s]
    tsubu::halo<tsubu::brick_decomposition<3>, tsubu::self_transport> halo;
    tsubu::pair_list list;
    tsubu::skin_watch watch(skin);
    for (int step = 0; step < 1000; ++step) {
        if (step == 0 || watch.is_due(on)) {
            tsubu::migrate(g, bricks, on);
            halo = tsubu::make_halo(g, bricks, cutoff + skin, on);
            list.build(g[tsubu::position<3>], g.owned_count(), tsubu::same_reach{cutoff + skin});
            watch.restart();
        } else {
            halo.forward(g, tsubu::position<3>);
        }
        for (auto& f : g[tsubu::force<3>]) f = {};
        for (const auto [i, j] : list.pairs()) {  // each pair once; j may be a ghost
            auto &&x = g[tsubu::position<3>], &&f = g[tsubu::force<3>];
            tsubu::vec<3> d{};
            for (std::size_t k = 0; k < 3; ++k) d[k] = x[i][k] - x[j][k];
            const double r = std::hypot(d[0], d[1], d[2]);
            if (r >= cutoff) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                f[i][k] += 100 * (cutoff - r) * d[k] / r;
                f[j][k] -= 100 * (cutoff - r) * d[k] / r;
            }
        }
        halo.reverse(g, tsubu::force<3>);  // what ghosts have received, to their owners
        double fastest = 0;
        for (auto grain : g.owned()) {
            auto& v = grain[tsubu::velocity<3>];
            for (std::size_t k = 0; k < 3; ++k) v[k] += dt * grain[tsubu::force<3>][k];
            for (std::size_t k = 0; k < 3; ++k) grain[tsubu::position<3>][k] += dt * v[k];
            fastest = std::fmax(fastest, std::hypot(v[0], v[1], v[2]));
        }
        watch.travel(fastest * dt);
    }
    return std::abs(momentum() - before) < 1e-10 && g.owned_count() == 512 ? 0 : 1;
}
