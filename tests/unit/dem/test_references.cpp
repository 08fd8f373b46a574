// SPDX-License-Identifier: MIT
// The references themselves: against figures that were computed elsewhere.
#include <tsubu/dem/references.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace tsubu::dem;

TEST_CASE("a linear impact has the restitution and the duration of the damped oscillator", "[dem][reference]") {
    const auto parted = dashpot_impact(2e5, 50, .5);
    CHECK(parted.restitution == Approx(.883132984296).epsilon(1e-12));
    CHECK(parted.duration == Approx(4.97117938506e-3).epsilon(1e-12));
    const auto released = dashpot_impact_without_attraction(2e5, 50, .5);
    CHECK(released.restitution == Approx(.885899978934).epsilon(1e-12));
    CHECK(released.duration == Approx(4.84604901375e-3).epsilon(1e-12));
    CHECK(dashpot_impact(2e5, 0, .5).restitution == 1);
    CHECK(dashpot_impact_without_attraction(2e5, 0, .5).duration == dashpot_impact(2e5, 0, .5).duration);
}
TEST_CASE("strongly damped, a linear impact is released before half of its time", "[dem][reference]") {
    // Damping ratio .9, past the .7071 where beta exceeds wd: t' = (pi - 2 atan(beta / wd)) / wd.
    const double k = 1e4;
    const double beta = .9 * 100;
    const double wd = std::sqrt(k - beta * beta);
    const auto released = dashpot_impact_without_attraction(k, 2 * beta, 1);
    CHECK(released.duration == Approx((pi - 2 * std::atan(beta / wd)) / wd).epsilon(1e-13));
    CHECK(released.restitution == Approx(std::exp(-beta * released.duration)).epsilon(1e-14));
}
TEST_CASE("Hertzian impacts have the peaks that Chung and Ooi print", "[dem][reference]") {
    struct bodies {
        double radius, modulus, poisson, density, speed;
        bool is_pair;
        hertz_peak expected;
    };
    const bodies cases[] = {{.01, 4.8e10, .2, 2800, 20, true, {274.112702e-6, 10696.889, 40.3394557e-6}},
                            {.1, 7e10, .3, 2699, .2, false, {49.7171752e-6, 11369.8583, 731.656641e-6}},
                            {.0025, 1e11, .25, 7000, 3.9, false, {17.1887136e-6, 506.760233, 12.9720806e-6}}};
    for (const auto& one : cases) {
        const double mass = 4 * pi / 3 * std::pow(one.radius, 3) * one.density;
        const double plane_strain = one.modulus / (1 - one.poisson * one.poisson);
        const double share = one.is_pair ? .5 : 1;  // of two equal spheres; of one on a rigid wall
        const auto found = hertz_impact(share * plane_strain, share * one.radius, share * mass, one.speed);
        INFO("radius " << one.radius << " m");
        CHECK(found.overlap == Approx(one.expected.overlap).epsilon(2e-9));
        CHECK(found.force == Approx(one.expected.force).epsilon(5e-8));
        CHECK(found.duration == Approx(one.expected.duration).epsilon(5e-9));
    }
}
TEST_CASE("Tsuji's damping has the restitution of an oscillator", "[dem][reference]") {
    CHECK(tsuji_restitution(0) == 1);
    // What the polynomial of Tsuji et al. gives for nominal .5 and .36665.
    CHECK(tsuji_restitution(.340740625) == Approx(.616).margin(5e-4));
    CHECK(tsuji_restitution(.4817708678692641) == Approx(.5).margin(5e-6));
}
TEST_CASE("an oblique impact sticks up to a slope of 3.5 mu, and slips beyond", "[dem][reference]") {
    const auto sticks = oblique_impact(1, 1, .5, .5);
    CHECK(sticks.tangential == Approx(.428571).margin(5e-7));
    CHECK(sticks.spin == Approx(2.857143).margin(5e-7));
    const auto slips = oblique_impact(1, 1, .2, .5);
    CHECK(slips.tangential == Approx(.6).epsilon(1e-14));
    CHECK(slips.spin == Approx(2).epsilon(1e-14));
    // At the border both are the same motion.
    const auto below = oblique_impact(1, 1.05 - 1e-12, .3, .5);
    const auto above = oblique_impact(1, 1.05 + 1e-12, .3, .5);
    CHECK(above.tangential == Approx(below.tangential).margin(1e-11));
    CHECK(above.spin == Approx(below.spin).margin(1e-11));
}
TEST_CASE("a sphere that slides rolls at five sevenths of its speed", "[dem][reference]") {
    const auto rolls = slip_to_roll(1.4, .25, 8);
    CHECK(rolls.time == Approx(.2).epsilon(1e-14));
    CHECK(rolls.speed == Approx(1).epsilon(1e-14));
}
TEST_CASE("a bouncing ball falls and touches in closed form", "[dem][reference]") {
    // From a fourth-order integration with 5e-6 s in 30 digits.
    bouncing_ball soft{.height = .5, .radius = .2, .mass = 1, .k = 5e3, .gamma = 10, .gravity = 9.81};
    soft.bounce();
    CHECK(soft.time == Approx(.487830285351344).epsilon(1e-11));
    CHECK(soft.height == Approx(.3848827119784048).epsilon(1e-11));
    soft.bounce();
    CHECK(soft.time == Approx(.8804000843864981).epsilon(1e-11));
    CHECK(soft.height == Approx(.3126437325206442).epsilon(1e-11));
    // Without damping it comes back to where it was; the contact is 2 (pi - atan(v w / g)) / w.
    bouncing_ball elastic{.height = .5, .radius = .2, .mass = 2, .k = 800, .gamma = 0, .gravity = 9.81};
    const double fall = std::sqrt(2 * .3 / 9.81);
    elastic.bounce();
    CHECK(elastic.height == Approx(.5).epsilon(1e-13));
    CHECK(elastic.time == Approx(2 * fall + 2 * (pi - std::atan(fall * 20)) / 20).epsilon(1e-13));
    // Stiff: h_k = (h_0 - R) e^(2 k) + R.
    bouncing_ball stiff{.height = .5, .radius = .2, .mass = 1, .k = 1e14, .gamma = 1e6, .gravity = 9.81};
    const double e = dashpot_impact(1e14, 1e6, 1).restitution;
    for (int bounces = 0; bounces < 3; ++bounces) stiff.bounce();
    CHECK(stiff.height == Approx(.3 * std::pow(e, 6) + .2).epsilon(1e-6));
}
TEST_CASE("a chain has the modes and limits of its size", "[dem][reference]") {
    CHECK(2 / chain_frequency(64, 64, 1, 1) == Approx(1.000292).margin(5e-7));
    CHECK(chain_frequency(1, 1, 3, 2) == Approx(std::sqrt(3.0)).epsilon(1e-14));  // one mass between two springs
    CHECK(chain_frequency(1, 2, 3, 2) == Approx(std::sqrt(1.5)).epsilon(1e-14));  // two in step, and against each other
    CHECK(chain_frequency(2, 2, 3, 2) == Approx(std::sqrt(4.5)).epsilon(1e-14));
    // 1 - cos of the error of the phase after ten periods of mode 1.
    struct row {
        double time_step, expected;
    };
    const double w = chain_frequency(1, 64, 1, 1);
    for (const auto& [h, expected] : {row{.9, 1.225e-5}, row{.5, 1.167e-6}, row{.2, 2.989e-8}})
        CHECK(1 - std::cos((verlet_frequency(w, h) - w) * 20 * pi / w) == Approx(expected).epsilon(2e-3));
    CHECK(verlet_frequency(2, 1) == Approx(pi).epsilon(1e-14));  // at the limit: to and fro
}
TEST_CASE("a gas cools in the time of Haff", "[dem][reference]") {
    // phi .05, e .9, d 1: g0 1.13719201, nu0 .769910264.
    const auto cools = haff_cooling(1, .9, .05 * 6 / pi, 1);
    CHECK(cools.time == Approx(41.0164000113).epsilon(1e-11));
    CHECK(cools.at(0) == 1);
    CHECK(cools.at(cools.time) == Approx(.25).epsilon(1e-15));
    // The time goes with 1 / sqrt(T0), lengths apart.
    CHECK(haff_cooling(4, .9, .05 * 6 / pi, 1).time == Approx(cools.time / 2).epsilon(1e-14));
    CHECK(haff_cooling(1, .9, .05 * 6 / pi / 8, 2).time == Approx(2 * cools.time).epsilon(1e-14));
}
