// SPDX-License-Identifier: MIT
// Many spheres without friction: what a gas conserves, how it cools, and how long the step of a crystal may be.
#include <tsubu/dem/scenes/gas.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/dem/scenes/crystal.hpp>
#include <tsubu/dem/scenes/pair.hpp>
#include <tsubu/dem/stability.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace tsubu::dem;

#if defined(NDEBUG)
constexpr bool is_fast = true;
#else
constexpr bool is_fast = false;  // sanitizers: some thirty times slower
#endif

/// How long two spheres touch, for a stiffness of 2e5.
const double contact_time = pi / std::sqrt(2e5 / .5);

template <class Run>
double energy_of(Run& gas) {
    return kinetic_energy(gas) + elastic_energy(gas);
}
template <class Run>
double greatest_drift(Run& gas, const std::vector<double>& before) {
    const auto after = momentum(gas);
    double most = 0;
    for (std::size_t k = 0; k < before.size(); ++k) most = std::fmax(most, std::abs(after[k] - before[k]));
    return most;
}
template <class Run>
std::vector<double> momentum_of(Run& gas) {
    const auto now = momentum(gas);
    return {now.begin(), now.end()};
}
gas_scene<> elastic_gas(double steps_per_contact, std::uint64_t per_edge) {
    return {.law = hooke<>{{2e5}}, .time_step = contact_time / steps_per_contact, .per_edge = per_edge};
}

}  // namespace

TEST_CASE("a crystal is stable to within a hundredth of the limit", "[dem][stability]") {
    const auto after = [](double time_step) {
        crystal_scene<> scene{.law = hooke<>{{1}}, .time_step = time_step, .cells = is_fast ? 6U : 3U};
        tsubu::self_transport on;
        const auto crystal = stage(scene, on);
        CHECK(crystal->particles().owned_count() == scene.count());
        CHECK(coordination_number(*crystal) == 12);
        CHECK(greatest_frequency(*crystal) == Approx(std::sqrt(8.0)).epsilon(1e-5));
        const double before = kinetic_energy(*crystal);
        crystal->steps(600);
        return kinetic_energy(*crystal) / before;
    };
    CHECK(after(.70) < 2);
    CHECK(after(.72) > 1e3);
}
TEST_CASE("a time step past the limit is refused, with both numbers", "[dem][stability][guards]") {
    for (const double time_step : {.70, .72}) {
        const crystal_scene<> scene{.law = hooke<>{{1}}, .time_step = time_step, .cells = 3, .is_watched = true};
        tsubu::self_transport on;
        const auto text = thrown<tsubu::input_error>([&] { return stage(scene, on)->steps(1); });
        INFO(text);
        if (time_step < .71) CHECK(text == "nothing was thrown");
        if (time_step > .71) {
            CHECK(says(text, "step 0"));
            CHECK(says(text, "a time step of 0.72 s"));
            CHECK(says(text, "stable up to 0.7071"));
            CHECK(says(text, "take a smaller time step"));
        }
    }
}
TEST_CASE("an elastic gas keeps its energy, its momentum and its particles", "[dem][reference]") {
    tsubu::self_transport on;
    const auto gas = stage(elastic_gas(20.37, is_fast ? 10 : 6), on);
    const double energy = energy_of(*gas);
    const auto p = momentum_of(*gas);
    gas->steps(is_fast ? 8000 : 2000);
    CHECK(energy_of(*gas) == Approx(energy).epsilon(1e-4));
    CHECK(greatest_drift(*gas, p) < 1e-10);
    CHECK(particle_count(*gas) == (is_fast ? 1000 : 216));
    CHECK(gas->renewals() > 2);
}
TEST_CASE("a gas of disks keeps its energy and momentum", "[dem][reference]") {
    tsubu::self_transport on;
    const auto gas =
        stage(disks_scene<>{.law = hooke<>{{2e5}}, .time_step = contact_time / 20.37, .per_edge = is_fast ? 24U : 12U},
              on);
    const double energy = energy_of(*gas);
    const auto p = momentum_of(*gas);
    gas->steps(is_fast ? 8000 : 4000);
    CHECK(energy_of(*gas) == Approx(energy).epsilon(is_fast ? 1e-4 : 1e-3));  // fewer: more noise
    CHECK(greatest_drift(*gas, p) < 1e-10);
}
TEST_CASE("the energy of a gas drifts by a power of the time step above four", "[dem][reference][slow]") {
    // Over 60 time units.
    const auto drift = [](double steps) {
        tsubu::self_transport on;
        const auto gas = stage(elastic_gas(steps, 8), on);
        const double energy = energy_of(*gas);
        gas->steps(static_cast<std::size_t>(60 / contact_time * steps));
        return energy_of(*gas) / energy - 1;
    };
    const double coarse = drift(5.37);
    const double finer = drift(7.37);  // beyond, the noise of single collisions is larger
    INFO("drift " << coarse << " at N = 5.37, " << finer << " at 7.37");
    CHECK(coarse == Approx(2.5e-2).margin(1e-2));
    CHECK(std::log(coarse / finer) / std::log(7.37 / 5.37) == Approx(4.3).margin(.8));
    CHECK(std::abs(drift(20.37)) < 1e-3);
}
TEST_CASE("a small gas conserves what it should over a million steps", "[dem][reference][slow]") {
    tsubu::self_transport on;
    const auto gas = stage(elastic_gas(40.37, 5), on);
    const double energy = energy_of(*gas);
    const auto p = momentum_of(*gas);
    gas->steps(1000000);
    CHECK(energy_of(*gas) == Approx(energy).epsilon(1e-3));
    CHECK(greatest_drift(*gas, p) < 1e-9);
    CHECK(particle_count(*gas) == 125);
}

namespace {

/// How far the temperature is from Haff's law, at most; the clock starts after some collisions, when velocities are
/// nearly Maxwell's. Until it has fallen by a third: that they are not quite, that contacts take time, and that a run
/// of so few spheres has only so many collisions, each make some 0.5 % of the rate, and add up.
double error_of_haff(std::uint64_t per_edge, double fraction, double start, double end) {
    const hooke_dashpot<> law{{2e5, 42.40}};
    const double h = contact_time / 12.37;
    tsubu::self_transport on;
    // The restitution as it is at this time step.
    double e = 0;
    for (int p = 0; p < 16; ++p) {
        const pair_scene<hooke_dashpot<>> impact{.law = law, .time_step = h, .phase = (p + .5) / 16};
        const auto pair = stage(impact, on);
        pair->steps(40);
        const auto v = pair->particles()[tsubu::velocity<1>];
        e += std::abs(v[1][0] - v[0][0]) / 16;
    }
    const gas_scene<hooke_dashpot<>> scene{.law = law, .time_step = h, .per_edge = per_edge, .fraction = fraction};
    const auto gas = stage(scene, on);
    const auto n = static_cast<double>(scene.count());
    const auto temperature = [&] {
        // Of the motion about the mean.
        const auto p = momentum(*gas);
        return (2 * kinetic_energy(*gas) - (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / n) / (3 * n);
    };
    gas->steps(static_cast<std::size_t>(start / h));
    const double volume = std::pow(scene.spacing(), 3);
    const auto exact = haff_cooling(temperature(), e, 1 / volume, 1);
    double error = 0;
    const auto first = gas->steps_done();
    for (int k = 1; k <= 4; ++k) {
        gas->steps(static_cast<std::size_t>((end - start) / 4 / h));
        const double t = static_cast<double>(gas->steps_done() - first) * h;
        error = std::fmax(error, std::abs(temperature() / exact.at(t) - 1));
    }
    return error;
}

}  // namespace

TEST_CASE("a gas cools as Haff says", "[dem][reference]") {
    if (is_fast) CHECK(error_of_haff(16, .1, 4, 7) < 1e-2);
}
TEST_CASE("a large gas cools as Haff says for long", "[dem][reference][slow]") {
    CHECK(error_of_haff(22, .05, 6, 15) < 1e-2);
}
