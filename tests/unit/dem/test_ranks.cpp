// SPDX-License-Identifier: MIT
// Scenes on 1, 2, 3 and 4 ranks inside one process.
#include <tsubu/dem/stage.hpp>

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/dem/implicit_velocity_verlet.hpp>
#include <tsubu/domain/lattice.hpp>

#include "comm_laws/on_ranks.hpp"

namespace dem_laws {

template <class Body>
void on_one_rank(tsubu::local_transport&, Body&& body) {
    tsubu::run_ranks(1, body);
}

}  // namespace dem_laws

#include "dem_laws/rank_laws.hpp"
#include "unit/dem/exact_gas.hpp"
#include "unit/io/scratch_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

constexpr std::size_t rank_counts[] = {1, 2, 3, 4};

using namespace tsubu::dem;

/// A bed of spheres that are pressed together a little, so that contacts need no time to come: some stick, some slide.
struct close_bed : settle_scene<> {
    close_bed() : settle_scene<>{.time_step = 5e-4, .cells = {6, 6, 7}} {}
    static constexpr double pitch = .9995;

    [[nodiscard]] auto box() const {
        return scene_box<simulation>({0, 0, -1}, {6 * pitch, 6 * pitch, 9}, {true, true, false});
    }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        const double x[] = {static_cast<double>(n % 6), static_cast<double>(n / 6 % 6), static_cast<double>(n / 36)};
        tsubu::vec<3> at{};
        tsubu::vec<3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = pitch * (x[k] + .5);
            v[k] = static_cast<double>(tsubu::splitmix64(8 * n + k) >> 11) * 0x1p-54 - .25;
        }
        add_particle<simulation>(store, box, static_cast<std::int64_t>(n + 1), at, v);
    }
};

/// Spheres close to each other with friction that remembers, on a lattice.
using frictional_gas = exact_gas<hooke_dashpot<linear_history>, tsubu::lattice<std::int64_t>>;
frictional_gas dense_gas(double origin) {
    frictional_gas scene{};
    scene.law = hooke_dashpot<linear_history>{{.k = 2e4, .gamma = 5}, {.k_t = 2e4 * 2 / 7, .mu = .5}};
    scene.time_step = 1e-3;
    scene.per_edge = 4;
    scene.origin = origin;
    scene.pitch = 1.125;
    scene.jitter = .0625;
    return scene;
}

}  // namespace

TEST_CASE("a pair on any number of ranks is the same bit for bit", "[dem][ranks]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::pair_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a chain on any number of ranks is the same bit for bit", "[dem][ranks]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::chain_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a gas on any number of ranks is the same to rounding", "[dem][ranks]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::gas_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a bed with friction that remembers is the same on any number of ranks, to rounding",
          "[dem][ranks][history]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::bed_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a bed goes on from a restart file on any number of ranks", "[dem][ranks][history]") {
    const scratch_folder folder;
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks, [&](auto& on, verdict& seen) {
            dem_laws::bed_goes_on_from_a_file(on, folder / "bed.restart", seen);
        });
}
TEST_CASE("a bed that two ranks wrote goes on as it would have on three, and on one", "[dem][ranks][history]") {
    const scratch_folder folder;
    const std::string path = folder / "bed.restart";
    const close_bed scene;
    constexpr std::size_t later = 300;
    std::vector<double> expected;
    double contacts = 0;
    // What ranks find is judged on the main thread.
    tsubu::run_ranks(2, [&](tsubu::local_transport& on) {
        const auto bed = stage(scene, on);
        bed->steps(400);
        bed->keep_history();
        tsubu::write_restart(on, path, bed->particles(), close_bed::simulation::restart_fields{});
        const double of_all = coordination_number(*bed);
        bed->steps(later);
        const auto states = dem_laws::all_states(*bed, 1, scene.count());
        if (on.rank() != 0) return;
        contacts = of_all;
        expected = states;
    });
    CHECK(contacts > 2);
    for (const std::size_t ranks : {3U, 1U}) {
        std::vector<double> found;
        std::vector<double> forgetful;
        tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) {
            const auto states = dem_laws::states_after_file(scene, path, later, on);
            const auto others = dem_laws::states_after_file(scene, path, later, on, false, true);
            if (on.rank() != 0) return;
            found = states;
            forgetful = others;
        });
        INFO(ranks << " ranks");
        CHECK(dem_laws::farthest(found, expected, scene.box(), 3) < 1e-9);
        CHECK(dem_laws::farthest(forgetful, expected, scene.box(), 3) > 1e-6);
    }
}
TEST_CASE("damping that is solved for is the same on any number of ranks, to rounding", "[dem][ranks]") {
    const gas_scene<hooke_dashpot<>, implicit_velocity_verlet> scene{.law = hooke_dashpot<>{{2e4, 50}},
                                                                     .time_step = 1e-3,
                                                                     .per_edge = 5,
                                                                     .fraction = .3};
    for (const std::size_t ranks : {1U, 2U, 3U})
        comm_laws::check_on_ranks(ranks, [&](auto& on, verdict& seen) {
            dem_laws::scene_does_not_depend_on_ranks(scene, 200, 1e-9, on, seen);
        });
}
TEST_CASE("friction that remembers on a lattice depends neither on the origin nor on the ranks", "[dem][ranks][far]") {
    for (const std::size_t ranks : {1U, 2U})
        comm_laws::check_on_ranks(ranks, [](auto& on, verdict& seen) {
            dem_laws::scene_does_not_depend_on_ranks(dense_gas(0), 300, 1e-9, on, seen);
        });
    std::vector<double> at_zero;
    for (const double origin : {0.0, 1e3, 1e9}) {
        std::vector<double> found;
        double rotation = 0;
        tsubu::run_ranks(1, [&](tsubu::local_transport& on) {
            const auto gas = stage(dense_gas(origin), on);
            gas->steps(300);
            rotation = rotational_energy(*gas);
            for (const auto& v : gas->particles().owned()[tsubu::velocity<3>])
                found.insert(found.end(), v.begin(), v.end());
        });
        if (at_zero.empty()) at_zero = found;
        INFO("origin " << origin);
        CHECK(rotation > 1e-2);
        CHECK(found == at_zero);
    }
}
