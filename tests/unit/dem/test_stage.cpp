// SPDX-License-Identifier: MIT
// Scenes count in whatever they are told to.
#include <tsubu/dem/stage.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/scenes.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace {

using namespace tsubu::dem;
using mixed = mixed_precision<double, float>;
using lattice64 = tsubu::lattice<std::int64_t>;

/// Where two scenes put particle n, and how fast it is, differ by no more than `grain`, the resolution of the coarser.
template <class Exact, class Scene>
void check_place(const Exact& exact, const Scene& scene, std::uint64_t n, double grain) {
    const auto placed = [n](const auto& one) {
        using simulation = typename std::remove_cvref_t<decltype(one)>::simulation;
        constexpr auto D = simulation::dimension;
        const auto box = one.box();
        typename simulation::store_type store;
        one.place(store, box, n);
        tsubu::vec<2 * D> all{};
        for (std::size_t k = 0; k < D; ++k) {
            all[k] = static_cast<double>(box.along(k).to_real(store[simulation::quantities_type::position][0][k]));
            if constexpr (simulation::quantities_type::has_offsets)
                all[k] += static_cast<double>(store[simulation::quantities_type::offset][0][k]);
            all[D + k] = static_cast<double>(store[simulation::quantities_type::velocity][0][k]);
        }
        CHECK(store[tsubu::id].size() == 1);
        return all;
    };
    const auto expected = placed(exact);
    const auto found = placed(scene);
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(std::abs(found[k] - expected[k]) <= grain);
}
/// The scenes in numbers of one kind.
template <class Number>
struct scenes_in {
    pair_scene<hooke<>, velocity_verlet, Number> pair{.law = hooke<>{{2e5}}, .time_step = 1e-4};
    bounce_scene<hooke_dashpot<>, velocity_verlet, Number> bounce{.law = hooke_dashpot<>{{5e4, 10}}, .time_step = 1e-4};
    chain_scene<velocity_verlet, Number> chain{.time_step = .2, .masses = 6, .amplitude = .3};
    crystal_scene<hooke<>, velocity_verlet, Number> crystal{.law = hooke<>{{1e3}},
                                                            .time_step = 5e-3,
                                                            .cells = 2,
                                                            .speed = .1};
    oblique_scene<hooke<linear_history>, velocity_verlet, Number> oblique{
        .law = hooke<linear_history>{{2e5}, {2e5 * 2 / 7, .5}}, .time_step = 1e-4};
    floor_scene<hooke_dashpot<coulomb>, velocity_verlet, Number> floor{
        .law = hooke_dashpot<coulomb>{{2e5, 50}, {.mu = .3, .gamma_t = 20}}, .time_step = 1e-4};
    settle_scene<hooke_dashpot<linear_history>, velocity_verlet, Number> settle{};
    gas_scene<hooke<>, velocity_verlet, Number> gas{.law = hooke<>{{2e4}}, .time_step = 1e-3, .per_edge = 3};
    disks_scene<hooke<>, velocity_verlet, Number> disks{.law = hooke<>{{2e4}}, .time_step = 1e-3, .per_edge = 3};
};
/// Kinetic, rotational and elastic energy after twenty steps are what they are in doubles.
template <class Scene>
void check_energies(const Scene& scene, const tsubu::vec<3>& expected, double tolerance) {
    tsubu::self_transport on;
    const auto moving = stage(scene, on);
    moving->steps(20);
    CHECK(kinetic_energy(*moving) == Approx(expected[0]).epsilon(tolerance));
    CHECK(rotational_energy(*moving) == Approx(expected[1]).epsilon(tolerance));
    CHECK(elastic_energy(*moving) == Approx(expected[2]).epsilon(tolerance));
}

}  // namespace

TEMPLATE_TEST_CASE("scenes are placed in numbers of all kinds", "[dem]", float, in_cells<float>,
                   tsubu::lattice<std::int32_t>) {
    const scenes_in<double> exact;
    const scenes_in<TestType> scenes;
    // Half a step of a lattice of 2^32, or what a float loses: of the edge of the box.
    const double fine = 1e-7;
    check_place(exact.pair, scenes.pair, 1, 4 * fine);
    check_place(exact.bounce, scenes.bounce, 0, 2 * fine);
    check_place(exact.chain, scenes.chain, 3, 9 * fine);
    check_place(exact.crystal, scenes.crystal, 13, 3 * fine);
    check_place(exact.oblique, scenes.oblique, 0, 100 * fine);
    check_place(exact.floor, scenes.floor, 0, 1000 * fine);
    check_place(exact.settle, scenes.settle, 9999, 32 * fine);
    check_place(exact.gas, scenes.gas, 26, 8 * fine);
    check_place(exact.disks, scenes.disks, 8, 8 * fine);
}
TEST_CASE("scenes in floats on doubles have the energies of doubles", "[dem]") {
    // Expected is what the same scenes give in doubles. A float has a distance to 6e-8 of it: to less of an overlap.
    const scenes_in<mixed> scenes;
    check_energies(scenes.bounce, {0.0001924722, 0, 0}, 1e-6);
    check_energies(scenes.crystal, {0.0716082306927818, 0, 9.6774819172166}, 1e-5);
    check_energies(scenes.oblique, {0.606664762597822, 0.0139552020022211, 0.29315329859351}, 1e-4);
    check_energies(scenes.floor, {0.494131322498001, 4.33062449999915e-05, 0.00024059024999995}, 1e-3);
    check_energies(scenes.chain, {0.0297806360415927, 0, 0.00135506930981714}, 1e-5);
}
TEST_CASE("a chain on a lattice, which is periodic, has the energy of doubles", "[dem]") {
    check_energies(scenes_in<lattice64>{}.chain, {0.0297806360415927, 0, 0.00135506930981714}, 1e-12);
}
