// SPDX-License-Identifier: MIT
#include <tsubu/dem/restart.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/equal_spheres.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/dem/walls.hpp>

#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <string>

namespace {

namespace dem = tsubu::dem;
using scene = dem::simulation<3, double, dem::velocity_verlet, dem::hooke_dashpot<dem::linear_history>, dem::walls,
                              dem::gravity>;

auto slope(tsubu::self_transport& on, double height = 4) {
    return dem::make_run<scene>({{0, 0, 0}, {3, 3, height}, {.periodic = {true, true, false}}},
                                {.time_step = 2e-3, .skin = 0.1}, on,
                                scene::contact_type{{.k = 1e4, .gamma = 5}, {.k_t = 3e3, .mu = 0.5}},
                                dem::walls{{{.point = {0, 0, 0}, .normal = {0, 0, 1}}}}, dem::gravity{{0.3, 0, -1}},
                                dem::equal_spheres{.radius = 0.5, .mass = 1});
}
template <class Run>
auto place(const Run& run) {
    return run.particles()[tsubu::position<3>][0];
}

}  // namespace

TEST_CASE("a run that was written goes on in another as if nothing had been, its contacts too", "[dem][history]") {
    const scratch_folder folder;
    const std::string path = folder / "slope.restart";
    tsubu::self_transport on;
    auto first = slope(on);
    first.particles().push_back(tsubu::id = 1, tsubu::position<3> = {1, 1, 0.499});
    first.steps(200);
    dem::write_restart(first, path);
    first.steps(300);

    auto second = slope(on);
    CHECK(dem::read_restart(second, path).step == 200);
    second.steps(300);
    for (std::size_t k = 0; k < 3; ++k) CHECK(place(second)[k] == Approx(place(first)[k]).epsilon(1e-12));
    CHECK(place(second)[0] != 1);

    dem::write_restart(second, path, 200);
    CHECK(tsubu::restart_reader(path).state().step == 500);
}
TEST_CASE("a restart is read into a run that has no particles, and the box that was written", "[dem]") {
    const scratch_folder folder;
    const std::string path = folder / "slope.restart";
    tsubu::self_transport on;
    auto first = slope(on);
    first.particles().push_back(tsubu::id = 1, tsubu::position<3> = {1, 1, 1});
    first.start();
    dem::write_restart(first, path);

    const auto refusal = [](auto& run, const std::string& file) {
        return thrown<tsubu::error>([&] { dem::read_restart(run, file); });
    };
    CHECK(says(refusal(first, path), "the run has particles already"));
    auto higher = slope(on, 5);
    CHECK(says(refusal(higher, path), "is of another box"));
    CHECK(says(refusal(higher, folder / "missing"), "missing"));
    CHECK(higher.particles().empty());
}
