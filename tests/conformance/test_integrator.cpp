// SPDX-License-Identifier: MIT
/// @file
/// Do the integrators keep what their concept says, and does the suite catch what it is there for?
#include <tsubu/testing/integrator_conformance.hpp>

#include <tsubu/dem/explicit_euler.hpp>
#include <tsubu/dem/implicit_velocity_verlet.hpp>
#include <tsubu/dem/pefrl.hpp>
#include <tsubu/dem/runge_kutta_4.hpp>
#include <tsubu/dem/symplectic_euler.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace {

using namespace tsubu::dem;

template <class Integrator>
verdict judged(const tsubu::testing::integrator_claims& claims) {
    verdict seen;
    tsubu::testing::check_integrator<Integrator>(claims, seen);
    return seen;
}
template <class Integrator>
void check_kept(const tsubu::testing::integrator_claims& claims) {
    const auto seen = judged<Integrator>(claims);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 20);
}

/// With the members that the concept names and no others: half a drift, a kick, half a drift.
struct drift_first {
    static constexpr unsigned force_evaluations = 1;
    static constexpr bool moves_spins = true;
    static constexpr bool solves_damping = false;
    static double stable_until(double z) { return 2 / (std::sqrt(1 + z * z) + z); }
    template <class Q>
    using keeps = tsubu::fields<>;

    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        for (std::size_t n = 0; n < steps; ++n) {
            run.drift(h / 2);
            run.clear_forces();
            run.evaluate_forces();
            run.kick(h);
            run.drift(h / 2);
            run.end_step();
        }
        run.clear_forces();
        run.evaluate_forces();
    }
};

/// Each breaks one law.
struct boastful : velocity_verlet {
    static double stable_until(double) { return 2; }
};
struct timid : velocity_verlet {
    static double stable_until(double z) { return .9 * velocity_verlet::stable_until(z); }
};
struct dear : velocity_verlet {
    static constexpr unsigned force_evaluations = 2;
};
struct endless : velocity_verlet {
    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        for (std::size_t n = 0; n < steps; ++n) {
            run.template kick_and_drift<false>(h / 2, h);
            run.evaluate_forces();
            run.kick(h / 2);
        }
        run.end_step();
    }
};
struct heaping : symplectic_euler {
    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        for (std::size_t n = 0; n < steps; ++n) {
            run.kick(h);
            run.drift(h);
            run.evaluate_forces();
            run.end_step();
        }
    }
};
struct restless : velocity_verlet {
    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        run.kick(h / 2);
        for (std::size_t n = 0; n < steps; ++n) {
            run.drift(h);
            run.clear_forces();
            run.evaluate_forces();
            run.kick(n + 1 < steps ? h : h / 2);
            run.end_step();
        }
    }
};
struct hurried : velocity_verlet {
    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        velocity_verlet::advance(run, h, steps);
        run.drift(h);
    }
};

}  // namespace

TEST_CASE("the shipped integrators keep their laws", "[dem][conformance]") {
    check_kept<velocity_verlet>({.order = 2, .damped_order = 1});
    check_kept<implicit_velocity_verlet>({.order = 2, .damped_order = 2});
    check_kept<symplectic_euler>({.order = 1, .damped_order = 1});
    check_kept<explicit_euler>({.order = 1, .damped_order = 1});
    check_kept<runge_kutta_4>({.order = 4, .damped_order = 4, .is_limit_exact = false});
    check_kept<pefrl>({.order = 4, .damped_order = 1, .is_limit_exact = false});
}
TEST_CASE("an integrator of the least that the concept asks for is judged", "[dem][conformance]") {
    check_kept<drift_first>({.order = 2, .damped_order = 1});
}
TEST_CASE("an integrator that breaks a law is caught", "[dem][conformance]") {
    const auto only = [](const verdict& seen, const char* law, const char* words) {
        INFO(seen.first);
        CHECK(seen.broken.size() == 1);
        CHECK(seen.broken.count(law) == 1);
        CHECK(seen.first.find(words) != std::string::npos);
    };
    const tsubu::testing::integrator_claims second{.order = 2, .damped_order = 1};
    only(judged<boastful>(second), "law 4", "does not grow");
    only(judged<timid>(second), "law 4", "grows above");
    only(judged<dear>(second), "law 2", "force_evaluations");
    only(judged<endless>(second), "law 1", "end_step");
    only(judged<restless>(second), "law 1", "no steps");
    only(judged<symplectic_euler>(second), "claim", "order");
    CHECK(judged<heaping>({.order = 1, .damped_order = 1}).broken.count("law 1") == 1);
    CHECK(judged<hurried>(second).broken.count("law 1") == 1);
}
