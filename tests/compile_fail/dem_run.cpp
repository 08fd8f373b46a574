// SPDX-License-Identifier: MIT
#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/equal_spheres.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/run.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

using namespace tsubu::dem;
using scene = simulation<3, double, velocity_verlet, hooke<>, gravity>;

int main() {
    tsubu::self_transport on;
    const scene::box_type box({0, 0, 0}, {4, 4, 4});
    const scene::contact_type law{{.k = 1e4}};
    const gravity down{{0, 0, -1}};
    const equal_spheres grains{.radius = 0.5, .mass = 1};
#if CASE == 1
    const auto bed = make_run<scene>(box, {.time_step = 1e-3}, on, law, down);
#elif CASE == 2
    const auto bed = make_run<scene>(box, {.time_step = 1e-3}, on, down, law, grains);
#else
    const auto bed = make_run<scene>(box, {.time_step = 1e-3}, on, law, down, grains);
#endif
    return bed.particles().empty() ? 0 : 1;
}
