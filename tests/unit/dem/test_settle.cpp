// SPDX-License-Identifier: MIT
// A bed that settles on a floor: LAMMPS' figures, lists that are used too long, and memory of contacts.
#include <tsubu/dem/scenes/settle.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/stability.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace tsubu::dem;

#if defined(NDEBUG)
constexpr bool is_fast = true;
#else
constexpr bool is_fast = false;  // sanitizers: some thirty times slower
#endif

struct figures {
    double kinetic, rotational, height;
};
template <class Run>
void check_figures(Run& bed, const figures& of_lammps, double tolerance) {
    CHECK(kinetic_energy(bed) == Approx(of_lammps.kinetic).epsilon(tolerance));
    CHECK(rotational_energy(bed) == Approx(of_lammps.rotational).epsilon(tolerance));
    CHECK(mean_position(bed)[2] == Approx(of_lammps.height).epsilon(tolerance));
}
/// settle_scene, run in another way.
struct bed_with_options : settle_scene<> {
    std::int64_t id_offset = 0;
    unsigned check_every = 1;
    unsigned sort_every = 10;

    [[nodiscard]] options how() const {
        auto result = settle_scene<>::how();
        result.check_every = check_every;
        result.sort_every = sort_every;
        return result;
    }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        settle_scene<>::place(store, box, n);
        store[tsubu::id][store.owned_count() - 1] += id_offset;
    }
};
/// Positions and velocities in the order of ids.
template <class Run>
std::vector<tsubu::vec<3>> states_of(const Run& bed) {
    std::vector<std::pair<std::int64_t, std::size_t>> order;
    for (std::size_t i = 0; i < bed.particles().owned_count(); ++i)
        order.emplace_back(bed.particles()[tsubu::id][i], i);
    std::sort(order.begin(), order.end());
    std::vector<tsubu::vec<3>> states;
    for (const auto& [id, i] : order) {
        states.push_back(bed.particles()[tsubu::position<3>][i]);
        states.push_back(bed.particles()[tsubu::velocity<3>][i]);
    }
    return states;
}
double farthest(const std::vector<tsubu::vec<3>>& a, const std::vector<tsubu::vec<3>>& b, double period) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double apart = std::abs(a[i][k] - b[i][k]);
            most = std::fmax(most, std::fmin(apart, std::abs(apart - period)));
        }
    return most;
}

}  // namespace

TEST_CASE("a small bed settles as in LAMMPS", "[dem][reference]") {
    // lmp of Debian (29 Sep 2021), gran/hooke/history, the same 8 x 8 x 8 spheres.
    tsubu::self_transport on;
    settle_scene<> scene;
    scene.cells = {8, 8, 8};
    const auto bed = stage(scene, on);
    check_figures(*bed, {63.924268036913048, 0, 4.8001004594590064}, 1e-12);
    bed->steps(1000);
    check_figures(*bed, {68.689716379406377, 2.3222656509869082, 4.7834841633573353}, 1e-9);
    if (!is_fast) return;
    bed->steps(2000);
    check_figures(*bed, {119.01060532470332, 13.002259342969957, 4.6462849376878612}, 1e-8);
}
TEST_CASE("ten thousand spheres settle as in LAMMPS for a thousand steps", "[dem][reference]") {
    if (!is_fast) return;
    tsubu::self_transport on;
    const auto bed = stage(settle_scene<>{}, on);
    bed->steps(1000);
    check_figures(*bed, {1386.7640192413, 45.855867894931, 14.981043924235}, 1e-9);
}
TEST_CASE("ten thousand spheres settle as in LAMMPS for five thousand steps", "[dem][reference][slow]") {
    tsubu::self_transport on;
    const auto bed = stage(settle_scene<>{}, on);
    bed->steps(5000);
    check_figures(*bed, {5187.2730665039, 333.71583577136, 14.533884770835}, 1e-6);
}
TEST_CASE("neighbours that were used too long are found out, and named", "[dem][stability]") {
    bed_with_options scene;
    scene.cells = {5, 5, 6};
    tsubu::self_transport on;
    // 2 v_max dt every is at most .04, below the skin of .1.
    const auto after = [&](unsigned check_every) {
        scene.check_every = check_every;
        const auto bed = stage(scene, on);
        bed->steps(800);
        return states_of(*bed);
    };
    CHECK(farthest(after(20), after(1), 6) < 1e-9);

    scene.check_every = 500;
    const auto bed = stage(scene, on);
    const auto text = thrown<tsubu::input_error>([&] { bed->steps(5000); });
    INFO(text);
    CHECK(says(text, "skin_watch: neighbours were used after the fastest particles had gone"));
    CHECK(says(text, "more than half of the skin of 0.1 m"));
    CHECK(says(text, "looked at every 500 steps"));
    CHECK(says(text, "2 v_max dt every"));
}
TEST_CASE("what contacts remember follows particles that are sorted, whatever their ids", "[dem][history]") {
    bed_with_options scene;
    scene.cells = {5, 5, 6};
    tsubu::self_transport on;
    const auto after = [&](unsigned sort_every, std::int64_t offset) {
        scene.sort_every = sort_every;
        scene.id_offset = offset;
        const auto bed = stage(scene, on);
        bed->steps(1500);
        CHECK(bed->renewals() > 3);
        return states_of(*bed);
    };
    const auto never = after(0, 0);
    CHECK(farthest(after(1, 0), never, 6) < 1e-9);
    // Nothing but their names: bit for bit.
    const auto ordinary = after(10, 0);
    CHECK(after(10, 2000000000) == ordinary);
    CHECK(after(10, 9000000000000) == ordinary);
}
TEST_CASE("of a contact each side remembers its own, whichever comes first", "[dem][history]") {
    bed_with_options scene;
    scene.cells = {5, 5, 6};
    scene.sort_every = 0;
    tsubu::self_transport on;
    const auto after = [&](bool turns_round) {
        const auto bed = stage(scene, on);
        bed->steps(1500);
        bed->keep_history();
        auto& particles = bed->particles();
        particles.clear_ghosts();
        if (turns_round) {
            std::vector<tsubu::index_t> order;
            for (auto i = particles.owned_count(); i-- > 0;) order.push_back(static_cast<tsubu::index_t>(i));
            particles.permute(order);
        }
        bed->resume();
        bed->steps(200);
        return states_of(*bed);
    };
    CHECK(farthest(after(true), after(false), 6) < 1e-9);
}
TEST_CASE("ten thousand spheres come to rest as densely as they should", "[dem][reference][slow]") {
    // Heights of seven realisations scatter by .009 (one standard deviation), fractions by .0009 and contacts by .02, more
    // than the margins of their mean, .015, .0015 and .03: twice those. With another skin other roundings make another one.
    tsubu::self_transport on;
    settle_scene<> scene;
    scene.skin = .12;
    const auto bed = stage(scene, on);
    bed->steps(100000);
    CHECK(mean_position(*bed)[2] == Approx(7.84).margin(.03));
    CHECK(coordination_number(*bed) == Approx(4.65).margin(.05));

    // Between 2 and 12 diameters above the floor: what of each sphere lies there.
    double volume = 0;
    const auto below = [](double z) { return std::acos(-1.0) * (z / 4 - z * z * z / 3); };
    for (std::size_t i = 0; i < bed->particles().owned_count(); ++i) {
        const double z = bed->position(static_cast<tsubu::index_t>(i))[2];
        volume += below(std::clamp(12 - z, -.5, .5)) - below(std::clamp(2 - z, -.5, .5));
    }
    CHECK(volume / (24 * 24 * 10) == Approx(.591).margin(.003));
}
TEST_CASE("a settled bed comes to rest below the limit, and boils above it in silence", "[dem][stability][slow]") {
    // A bed that has settled with strong damping; then with the damping of the scene at .70 and .80 sqrt(m/k).
    tsubu::self_transport on;
    settle_scene<> scene;
    scene.cells = {6, 6, 10};
    scene.law = hooke_dashpot<linear_history>{{.k = 2e3, .gamma = 20}, {.k_t = 2e3 * 2 / 7, .mu = .5, .gamma_t = 20}};
    scene.time_step = 2e-3;
    const auto settled = stage(scene, on);
    settled->steps(15000);
    settled->keep_history();
    const auto after = [&](double share) {
        auto again = scene;
        again.law = hooke_dashpot<linear_history>{{.k = 2e3, .gamma = 5}, {.k_t = 2e3 * 2 / 7, .mu = .5}};
        again.time_step = share * std::sqrt(1 / 2e3);
        again.is_watched = false;
        using simulation = settle_scene<>::simulation;
        const auto models = again.models();
        run<simulation, tsubu::self_transport> bed(again.box(), again.how(), on, std::get<0>(models),
                                                   std::get<1>(models), std::get<2>(models), std::get<3>(models));
        bed.particles() = settled->particles();
        bed.resume();
        const double before = kinetic_energy(bed);
        bed.steps(5000);
        // Nothing is lost either way.
        CHECK(particle_count(bed) == scene.count());
        return std::pair(kinetic_energy(bed) / before, coordination_number(bed));
    };
    const auto [stable, z_stable] = after(.70);
    const auto [unstable, z_unstable] = after(.80);
    CHECK(stable < 1);
    CHECK(z_stable > 4.5);
    CHECK(unstable > 10);
    CHECK(z_unstable < 4.4);
}
