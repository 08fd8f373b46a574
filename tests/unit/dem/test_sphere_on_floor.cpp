// SPDX-License-Identifier: MIT
// Two dimensions: a sphere that slides, rolls, sticks and rests.
#include <tsubu/dem/scenes/sphere_on_floor.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/io/restart.hpp>

#include "support/catch.hpp"
#include "unit/io/scratch_folder.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace {

using namespace tsubu::dem;

constexpr double g = 9.81;

template <class Run>
struct state_of {
    explicit state_of(const Run& of)
        : x(of.particles()[tsubu::position<2>][0]),
          v(of.particles()[tsubu::velocity<2>][0]),
          spin(of.particles()[tsubu::angular_velocity<2>][0][0]) {}
    tsubu::vec<2> x;
    tsubu::vec<2> v;
    double spin;
    double slip() const { return v[0] + .5 * spin; }
};

}  // namespace

TEST_CASE("a sphere that hits a floor at an angle leaves it as it should", "[dem][reference]") {
    // With 2/7 of the normal stiffness both springs are back at the same time, to whatever is left at the end.
    for (const auto& [mu, tolerance] : {std::pair{.5, 2e-6}, std::pair{.2, 2e-4}}) {
        tsubu::self_transport on;
        const double h = 4.97e-3 / 1000.37;
        const oblique_scene<> scene{.law = hooke<linear_history>{{2e5}, {2e5 * 2 / 7, mu}}, .time_step = h};
        const auto one = stage(scene, on);
        one->steps(2000);
        const state_of after(*one);
        const auto exact = oblique_impact(1, 1, mu, .5);
        CHECK(after.v[1] == Approx(1).epsilon(1e-5));
        CHECK(after.v[0] == Approx(exact.tangential).epsilon(tolerance));
        CHECK(after.spin == Approx(-exact.spin).epsilon(tolerance));
    }
    CHECK(oblique_impact(1, 1, .5, .5).tangential == Approx(.428571).epsilon(2e-6));
    CHECK(oblique_impact(1, 1, .5, .5).spin == Approx(2.857143).epsilon(1e-7));
}
TEST_CASE("a Hertzian sphere that slides through an impact loses what Coulomb takes", "[dem][reference]") {
    // Chung & Ooi 2011, test 4: aluminium oxide on a rigid wall. At both angles it slides from touch to release, so
    // that all laws of friction with mu agree: what counts is e = .98, here Tsuji's, and mu.
    const double modulus = 3.8e11;
    const double nu = .23;
    const double radius = .0025;
    const double effective = modulus / (1 - nu * nu);
    const double shear = modulus / (2 * (1 + nu)) / (2 - nu);
    const double mass = 4 * pi / 3 * std::pow(radius, 3) * 4000;
    const double ln = std::log(.98);
    const double alpha = std::sqrt(5.0) * -ln / std::sqrt(ln * ln + pi * pi);
    CHECK(tsuji_restitution(alpha) == Approx(.98).epsilon(1e-12));
    struct row {
        double angle, tangential, spin;
    };
    for (const auto& [angle, tangential, spin] : {row{45, .81784, 502.346}, row{70, .933699, 242.979}}) {
        const double normal = 3.9 * std::cos(angle * pi / 180);
        const double along = 3.9 * std::sin(angle * pi / 180);
        const double h = hertz_impact(effective, radius, mass, normal).duration / 1000.37;
        tsubu::self_transport on;
        const oblique_scene<hertz_tsuji<mindlin_history>> scene{
            .law = hertz_tsuji<mindlin_history>{{effective, alpha}, {.shear_modulus = shear, .mu = .092}},
            .time_step = h,
            .normal_speed = normal,
            .along_speed = along,
            .radius = radius,
            .mass = mass};
        const auto one = stage(scene, on);
        one->steps(1100);
        const state_of after(*one);
        INFO("at " << angle << " degrees " << after.v[1] / normal << " " << after.v[0] / along << " " << after.spin);
        CHECK(after.v[1] / normal == Approx(.98).margin(1e-4));
        CHECK(after.v[0] / along == Approx(tangential).margin(2e-5));
        CHECK(-after.spin == Approx(spin).epsilon(2e-4));
    }
}
TEST_CASE("a sphere that slides rolls in the end", "[dem][reference]") {
    const double mu = .3;
    const double h = 1e-4;
    tsubu::self_transport on;
    const floor_scene<> scene{.law = hooke_dashpot<coulomb>{{2e5, 50}, {mu, 2e3}}, .time_step = h};
    const auto one = stage(scene, on);
    const auto exact = slip_to_roll(1, mu, g);
    one->steps(500);
    const state_of sliding(*one);
    CHECK(sliding.v[0] == Approx(1 - mu * g * .05).epsilon(1e-9));
    CHECK(sliding.spin == Approx(-2.5 * mu * g * .05 / .5).epsilon(1e-9));
    // Where the slip ends if it goes on like this.
    CHECK(.05 / (1 - sliding.slip()) == Approx(exact.time).epsilon(1e-9));
    one->steps(static_cast<std::size_t>(.1 / h));
    const state_of rolling(*one);
    CHECK(rolling.v[0] == Approx(exact.speed).epsilon(1e-9));
    CHECK(rolling.slip() == Approx(0).margin(1e-9));
    CHECK(rotational_energy(*one) == Approx(.1 / 2 * rolling.spin * rolling.spin).epsilon(1e-12));
}
TEST_CASE("on a slope a sphere rolls, and its friction is 2/7 of the pull", "[dem][reference]") {
    tsubu::self_transport on;
    const double gamma_t = 2e3;
    const floor_scene<> scene{.law = hooke_dashpot<coulomb>{{2e5, 50}, {.5, gamma_t}},
                              .time_step = 1e-4,
                              .speed = 0,
                              .slope = .1};
    const auto one = stage(scene, on);
    one->steps(3000);
    const state_of rolling(*one);
    CHECK(rolling.v[0] == Approx(g * std::sin(.1) * 5 / 7 * .3).epsilon(1e-3));
    CHECK(rolling.slip() == Approx(g * std::sin(.1) * 2 / 7 / gamma_t).epsilon(1e-3));
}

namespace {

using resting_law = hooke_dashpot<linear_history, rolling_resistance>;

floor_scene<resting_law> slope_of(double angle) {
    return {.law = resting_law{{2e5, 50}, {2e5 * 2 / 7, .5, 50}, {.mu_r = .2, .eta_r = .3}},
            .time_step = 2e-4,
            .speed = 0,
            .slope = angle};
}
}  // namespace

TEST_CASE("without memory a sphere that does not roll creeps down a slope, with it it rests", "[dem][reference]") {
    const double gamma_t = 200;
    using creeping_law = hooke_dashpot<coulomb, rolling_resistance>;
    tsubu::self_transport on;
    const floor_scene<creeping_law> creeping{.law = creeping_law{{2e5, 50}, {.5, gamma_t}, {.mu_r = .2, .eta_r = .3}},
                                             .time_step = 2e-4,
                                             .speed = 0,
                                             .slope = .1};
    const auto one = stage(creeping, on);
    one->steps(5000);
    CHECK(state_of(*one).v[0] == Approx(g * std::sin(.1) / gamma_t).epsilon(1e-9));
    CHECK(state_of(*one).spin == Approx(0).margin(1e-9));

    const auto other = stage(slope_of(.1), on);
    other->steps(5000);
    const auto before = state_of(*other).x;
    other->steps(5000);
    CHECK(std::abs(state_of(*other).x[0] - before[0]) < 1e-12);
    CHECK(std::abs(state_of(*other).x[1] - before[1]) < 1e-12);
}
TEST_CASE("rolling resistance holds below its slope, and rolls above it", "[dem][rolling]") {
    tsubu::self_transport on;
    for (const double share : {.95, 1.05}) {
        const double angle = std::atan(.2 * share);
        const auto one = stage(slope_of(angle), on);
        one->steps(5000);
        const double before = state_of(*one).v[0];
        one->steps(1000);
        const double gained = state_of(*one).v[0] - before;
        INFO("tan(slope) = " << share << " mu_r");
        if (share < 1) CHECK(std::abs(gained) < 1e-12);
        if (share > 1)
            CHECK(gained == Approx(5.0 / 7 * g * (std::sin(angle) - .2 * std::cos(angle)) * .2).epsilon(1e-6));
    }
}
TEST_CASE("a resting sphere stays through new lists, restarts of the run and of the program", "[dem][history]") {
    tsubu::self_transport on;
    auto scene = slope_of(.1);
    const auto one = stage(scene, on);
    one->steps(5000);
    const auto at_rest = state_of(*one).x;
    const auto moved = [&](auto& other) {
        other.steps(500);
        return std::fmax(std::abs(state_of(other).x[0] - at_rest[0]), std::abs(state_of(other).x[1] - at_rest[1]));
    };
    one->keep_history();
    const scratch_folder folder;
    const auto path = folder / "rest.tsubu";
    using simulation = decltype(scene)::simulation;
    tsubu::write_restart(path, one->particles(), simulation::restart_fields{});

    CHECK(moved(*one) < 1e-12);

    one->keep_history();
    one->start();
    CHECK(moved(*one) < 1e-12);

    // A skin that any motion uses up: neighbours are found anew in each step.
    const auto fresh = [&](double skin, bool forgets) {
        auto how = scene.how();
        how.skin = skin;
        auto made = std::apply(
            [&](const auto&... models) {
                return std::make_unique<run<simulation, tsubu::self_transport>>(scene.box(), how, on, models...);
            },
            scene.models());
        tsubu::read_restart(path, made->particles(), simulation::restart_fields{});
        CHECK(made->particles().size() == 1);
        if (forgets) made->particles()[simulation::quantities_type::contacts<simulation::history_size>][0].clear();
        made->resume();
        return made;
    };
    CHECK(moved(*fresh(.5, false)) < 1e-12);
    const auto often = fresh(1e-300, false);
    CHECK(moved(*often) < 1e-12);
    CHECK(often->renewals() > 100);
    // Dropped on purpose: the slope's pull has to stretch the spring again.
    CHECK(moved(*fresh(.5, true)) > 5e-6);
}
