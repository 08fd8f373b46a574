// SPDX-License-Identifier: MIT
// Each law alone, without a scene: normal, tangential, rolling, cohesion, and all of them together.
#include <tsubu/dem/contact_law.hpp>

#include <tsubu/core/error.hpp>
#include <tsubu/core/random.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace {

using namespace tsubu::dem;
using tsubu::lanes;
using tsubu::vec;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A contact along x, of bodies that neither move nor turn.
template <std::size_t D>
contact<D, double> touching(double overlap) {
    contact<D, double> at{};
    at.overlap = overlap;
    at.mass = 0.5;
    at.radius = 0.25;
    at.time_step = 1e-3;
    at.normal[0] = 1;
    return at;
}
template <class Vector>
double length_of(const Vector& v) {
    double square = 0;
    for (const double one : v) square += one * one;
    return std::sqrt(square);
}
/// Any contact: overlap, direction, velocities and spins.
template <std::size_t D>
contact<D, double> any_contact(tsubu::random_stream& random) {
    const auto signed_unit = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
    contact<D, double> at{};
    at.overlap = 1e-3 * (1.1 + signed_unit());
    at.mass = 0.5 + 0.1 * signed_unit();
    at.radius = 0.25 + 0.1 * signed_unit();
    at.time_step = 1e-3;
    for (auto& one : at.normal) one = signed_unit();
    const double length = length_of(at.normal);
    for (auto& one : at.normal) one /= length;
    for (auto& one : at.velocity) one = signed_unit();
    for (auto& one : at.sliding) one = signed_unit();
    for (auto& one : at.turning) one = 4 * signed_unit();
    return at;
}

template <class Law>
void check_potential(const Law& law) {
    const double radius = 0.25;
    CHECK(law.elastic(0.0, radius) == 0);
    CHECK(law.energy(0.0, radius) == 0);
    for (const double d : {1e-6, 1e-4, 3e-3, 0.1}) {
        INFO("overlap " << d);
        const double small = 1e-4 * d;
        CHECK((law.elastic(d + small, radius) - law.elastic(d - small, radius)) / (2 * small) ==
              Approx(law.stiffness(d, radius)).epsilon(1e-7));
        // Simpson's rule in u^2 = overlap, where the force of Hertz is a polynomial: it is exact for neither law by
        // chance.
        double work = 0;
        const int parts = 1000;
        const double top = std::sqrt(d);
        for (int n = 0; n <= parts; ++n) {
            const double u = top * n / parts;
            const double weight = n == 0 || n == parts ? 1 : n % 2 == 0 ? 2 : 4;
            work += weight * law.elastic(u * u, radius) * 2 * u;
        }
        work *= top / parts / 3;
        CHECK(law.energy(d, radius) == Approx(work).epsilon(1e-10));
    }
}

}  // namespace

TEST_CASE("an elastic force is 0 where bodies part, its stiffness the derivative, its energy the integral", "[dem]") {
    check_potential(hooke_normal{2e5});
    check_potential(hooke_dashpot_normal{2e5, 50});
    check_potential(hertz_normal{1e7});
    check_potential(hertz_dashpot_normal{1e7, 50});
    check_potential(hertz_tsuji_normal{1e7, .3});
}
TEST_CASE("normal forces are those of the table", "[dem]") {
    auto at = touching<1>(1e-3);
    at.velocity = {-2};  // approaching
    const double root = std::sqrt(at.radius * at.overlap);
    const double hertzian = 4.0 / 3 * 1e7 * root * at.overlap;
    const auto of = [&](const auto& law) { return law.template normal_force<true, 1, double>(at); };
    CHECK(of(hooke<>{{2e5}}) == Approx(200).epsilon(1e-14));
    CHECK(of(hooke_dashpot<>{{2e5, 50}}) == Approx(200 + 50 * .5 * 2).epsilon(1e-14));
    CHECK(of(hertz<>{{1e7}}) == Approx(hertzian).epsilon(1e-14));
    CHECK(of(hertz_dashpot<>{{1e7, 50}}) == Approx(hertzian + root * 50 * .5 * 2).epsilon(1e-14));
    const double K = 4.0 / 3 * 1e7 * std::sqrt(at.radius);
    CHECK(of(hertz_tsuji<>{{1e7, .3}}) ==
          Approx(hertzian + .3 * std::sqrt(at.mass * K) * std::pow(at.overlap, .25) * 2).epsilon(1e-14));

    // The same without damping: what the implicit integrator asks for.
    const hooke_dashpot<> law{{2e5, 50}};
    CHECK(law.normal_force<false, 1, double>(at) == Approx(200).epsilon(1e-14));
}
TEST_CASE("a contact without attraction never pulls, and is the same until then", "[dem]") {
    const hooke_dashpot<> pulls{{2e5, 50}};
    const hooke_dashpot<without_attraction> ends{{2e5, 50}, {}};
    for (const double v : {-3.0, 0.0, 3.0, 7.9, 8.1, 30.0}) {
        auto at = touching<2>(1e-3);
        at.velocity = {v, 1};
        const double expected = 200 - 25 * v;
        CHECK(pulls.normal_force<true, 2, double>(at) == Approx(expected).epsilon(1e-13));
        CHECK(ends.normal_force<true, 2, double>(at) == Approx(std::max(expected, 0.0)).epsilon(1e-13));
    }
}
TEST_CASE("sliding friction is viscous up to Coulomb's limit, against the slip", "[dem]") {
    const hooke<coulomb> law{{2e5}, {.mu = .5, .gamma_t = 100}};  // at most 100 N; 50 N s/m
    for (const double slip : {0.0, 1e-9, 1.9, 2.1, 50.0, -1.9, -50.0}) {
        auto at = touching<2>(1e-3);
        at.velocity = {-3, slip};
        vec<0, double> none{};
        const auto action = law.act<true, 2, double>(at, none);
        INFO("slip " << slip);
        CHECK(action.force[0] == Approx(200).epsilon(1e-14));
        const double limit = std::min(50 * std::abs(slip), 100.0);
        CHECK(action.force[1] == Approx(slip < 0 ? limit : -limit).margin(1e-300).epsilon(1e-14));
        // -R times this is the torque on i: a force to -y at the point of contact, at -R n, turns i to +z.
        CHECK(action.twist[0] == Approx(action.force[1]).margin(1e-300).epsilon(1e-14));
    }
    auto rolling = touching<2>(1e-3);
    rolling.velocity = {0, 1};
    rolling.sliding = {1};  // omega x (-R n) = -R omega y: the surface stands still
    vec<0, double> none{};
    CHECK(law.act<true, 2, double>(rolling, none).force[1] == Approx(0).margin(1e-12));
    rolling.sliding = {-1};
    CHECK(law.act<true, 2, double>(rolling, none).force[1] == Approx(-100));
}
TEST_CASE("a tangential spring grows with the way, is cut off at Coulomb's limit, and unloads from there", "[dem]") {
    const hooke<linear_history> law{{2e5}, {.k_t = 5e4, .mu = .5}};  // at most 100 N: 2 mm
    auto at = touching<2>(1e-3);
    at.velocity = {0, 1};
    vec<2, double> spring{};
    for (int step = 1; step <= 5; ++step) {
        const auto action = law.act<true, 2, double>(at, spring);
        const double expected = std::min(5e4 * 1e-3 * step, 100.0);
        INFO("step " << step);
        CHECK(action.force[1] == Approx(-expected).epsilon(1e-13));
        CHECK(spring[1] == Approx(expected / 5e4).epsilon(1e-13));
        CHECK(spring[0] == 0);
    }
    at.velocity = {0, -1};
    CHECK(law.act<true, 2, double>(at, spring).force[1] == Approx(-50).epsilon(1e-13));
    CHECK(law.act<true, 2, double>(at, spring).force[1] == Approx(0).margin(1e-11));
    CHECK(law.act<true, 2, double>(at, spring).force[1] == Approx(50).epsilon(1e-12));

    // No time passes: nothing changes.
    at.time_step = 0;
    const auto before = spring;
    CHECK(law.act<true, 2, double>(at, spring).force[1] == Approx(50).epsilon(1e-12));
    CHECK(spring == before);
}
TEST_CASE("a tangential dashpot helps the spring, and the spring holds what is left at the limit", "[dem]") {
    const hooke<linear_history> law{{2e5}, {.k_t = 5e4, .mu = .5, .gamma_t = 40}};  // 20 N s/m
    auto at = touching<2>(1e-3);
    at.velocity = {0, 1};
    vec<2, double> spring{};
    CHECK(law.act<true, 2, double>(at, spring).force[1] == Approx(-70).epsilon(1e-13));
    CHECK(spring[1] == Approx(1e-3).epsilon(1e-13));
    CHECK(law.act<true, 2, double>(at, spring).force[1] == Approx(-100).epsilon(1e-13));
    CHECK(spring[1] == Approx(80 / 5e4).epsilon(1e-13));  // 100 N less the dashpot's 20
}
TEST_CASE("a tangential spring turns with the contact", "[dem]") {
    const hooke<linear_history> law{{2e5}, {.k_t = 5e4, .mu = 10}};
    auto at = touching<3>(1e-3);
    const double angle = 1e-2;
    at.normal = {std::cos(angle), std::sin(angle), 0};
    vec<3, double> spring{0, 1e-3, 2e-3};
    const auto action = law.act<true, 3, double>(at, spring);
    CHECK(dot<3, double>(spring, at.normal) == Approx(0).margin(1e-18));
    CHECK(spring[2] == Approx(2e-3).epsilon(1e-14));
    CHECK(length_of(spring) == Approx(std::hypot(1e-3 * std::cos(angle), 2e-3)).epsilon(1e-14));
    CHECK(dot<3, double>(minus<3, double>(action.force, scaled<3, double>(at.normal, 200.0)), at.normal) ==
          Approx(0).margin(1e-10));
}
TEST_CASE("Mindlin's spring is 8 G* sqrt(R* d) stiff", "[dem]") {
    const hertz<mindlin_history> law{{1e7}, {.shear_modulus = 4e6, .mu = .5}};
    auto at = touching<3>(1e-3);
    at.velocity = {0, 1e-3, 0};
    vec<3, double> spring{};
    const double k_t = 8 * 4e6 * std::sqrt(.25e-3);
    CHECK(law.act<true, 3, double>(at, spring).force[1] == Approx(-k_t * 1e-6).epsilon(1e-13));
    // Its dashpot is a share of the normal one.
    const hertz_tsuji<mindlin_history> damped{{1e7, .3}, {.shear_modulus = 4e6, .mu = .5, .damping = .7}};
    spring = {};
    const double c = damped.normal().damping(at.overlap, at.mass, at.radius);
    CHECK(damped.act<true, 3, double>(at, spring).force[1] == Approx(-k_t * 1e-6 - .7 * c * 1e-3).epsilon(1e-13));
}
TEST_CASE("rolling resistance is a spring that yields, and a dashpot until then", "[dem]") {
    const double k = 2e5;
    const double mu_r = .1;
    const double arm = mu_r * .25;
    const double k_r = 2.25 * k * arm * arm;
    const hooke<linear_history, rolling_resistance> law{{k}, {.k_t = 5e4, .mu = .5}, {.mu_r = mu_r}};
    auto at = touching<2>(1e-3);
    const double most = arm * 200;
    at.turning = {most / k_r / 2.5 / 1e-3};
    vec<3, double> memory{};
    for (int step = 1; step <= 5; ++step) {
        INFO("step " << step);
        CHECK(law.act<true, 2, double>(at, memory).rolling[0] ==
              Approx(-std::min(most, most * step / 2.5)).epsilon(1e-12));
    }
    at.turning = {-at.turning[0]};
    CHECK(law.act<true, 2, double>(at, memory).rolling[0] == Approx(-most * 1.5 / 2.5).epsilon(1e-12));

    const hooke<linear_history, rolling_resistance> damped{{k}, {.k_t = 5e4, .mu = .5}, {.mu_r = mu_r, .eta_r = .3}};
    at.turning = {1e-3};
    memory = {};
    const double inertia = 1.4 * at.mass * at.radius * at.radius;
    CHECK(damped.act<true, 2, double>(at, memory).rolling[0] ==
          Approx(-k_r * 1e-6 - 2 * .3 * std::sqrt(inertia * k_r) * 1e-3).epsilon(1e-12));
    at.turning = {1e6};  // it yields: the dashpot gives nothing
    CHECK(damped.act<true, 2, double>(at, memory).rolling[0] == Approx(-most).epsilon(1e-12));

    // In 3-D what turns about the normal does not roll.
    const auto in_space = [&](vec<3, double> turning) {
        auto twisting = touching<3>(1e-3);
        twisting.turning = turning;
        vec<6, double> held{};
        return law.act<true, 3, double>(twisting, held).rolling;
    };
    CHECK(length_of(in_space({5, 0, 0})) == 0);
    CHECK(in_space({5, 1e-3, 0})[1] == Approx(-k_r * 1e-6).epsilon(1e-12));
}
TEST_CASE("cohesion of DMT pulls by 2 pi w R* as long as bodies touch, and friction does not feel it", "[dem]") {
    const hertz<coulomb, dmt_cohesion> law{{1e7}, {.mu = .5, .gamma_t = 1e9}, {.work = .05}};
    const hertz<coulomb> dry{{1e7}, {.mu = .5, .gamma_t = 1e9}};
    const double pull_off = 2 * 3.14159265358979323846 * .05 * .25;
    double least = 0;
    for (const double d : {1e-15, 1e-9, 1e-6, 1e-4, 1e-3}) {
        auto at = touching<2>(d);
        at.velocity = {0, 1};
        vec<0, double> none{};
        const auto wet = law.act<true, 2, double>(at, none);
        const auto without = dry.act<true, 2, double>(at, none);
        CHECK(wet.force[0] == Approx(without.force[0] - pull_off).epsilon(1e-13));
        CHECK(wet.force[1] == without.force[1]);
        least = std::min(least, wet.force[0]);
    }
    CHECK(least == Approx(-pull_off).epsilon(1e-9));
}

namespace {

template <class Law, std::size_t D>
using memory_of = vec<Law::template history_size<D>, double>;

/// j sees the opposite of what i sees, but for the twist, which both have.
template <std::size_t D, class Law>
void check_reaction(const Law& law) {
    // The same instructions for both: where products are fused, copies of them may round otherwise.
    const auto act = [&](const contact<D, double>& at, memory_of<Law, D>& memory) __attribute__((noinline)) {
        return law.template act<true, D, double>(at, memory);
    };
    tsubu::random_stream random(99);
    for (int n = 0; n < 50; ++n) {
        const auto at = any_contact<D>(random);
        auto back = at;
        for (auto& one : back.normal) one = -one;
        for (auto& one : back.velocity) one = -one;
        for (auto& one : back.turning) one = -one;
        memory_of<Law, D> memory{};
        for (auto& one : memory) one = 1e-4 * (static_cast<double>(random() >> 11) * 0x1p-53 - .5);
        auto opposite = memory;
        for (auto& one : opposite) one = -one;
        const auto on_i = act(at, memory);
        const auto on_j = act(back, opposite);
        for (std::size_t k = 0; k < D; ++k) CHECK(on_i.force[k] == -on_j.force[k]);
        for (std::size_t k = 0; k < memory.size(); ++k) CHECK(memory[k] == -opposite[k]);
        if constexpr (Law::turns)
            for (std::size_t k = 0; k < on_i.twist.size(); ++k) {
                CHECK(on_i.twist[k] == on_j.twist[k]);
                if constexpr (Law::rolling_type::resists) CHECK(on_i.rolling[k] == -on_j.rolling[k]);
            }
        if constexpr (Law::turns) {
            // What friction adds is at right angles to the normal, and within Coulomb's limit.
            const double along = dot<D, double>(on_i.force, at.normal);
            const double across = length_of(tangential<D, double>(on_i.force, at.normal));
            const double normal = law.template normal_force<true, D, double>(at);
            if (Law::cohesion_type::pulls) continue;
            CHECK(along == Approx(normal).epsilon(1e-9));
            CHECK(across <= law.tangential().mu * std::abs(normal) * (1 + 1e-12));
        }
    }
}
/// What lies in the plane z = 0 does the same in 3-D.
template <class Law>
void check_in_plane(const Law& law) {
    tsubu::random_stream random(7);
    constexpr auto planar = Law::template history_size<2>;
    for (int n = 0; n < 50; ++n) {
        const auto flat = any_contact<2>(random);
        contact<3, double> deep{};
        deep.overlap = flat.overlap;
        deep.mass = flat.mass;
        deep.radius = flat.radius;
        deep.time_step = flat.time_step;
        deep.normal = {flat.normal[0], flat.normal[1], 0};
        deep.velocity = {flat.velocity[0], flat.velocity[1], 0};
        deep.sliding = {0, 0, flat.sliding[0]};
        deep.turning = {0, 0, flat.turning[0]};
        memory_of<Law, 2> in_plane{};
        memory_of<Law, 3> in_space{};
        for (int step = 0; step < 3; ++step) {
            const auto a = law.template act<true, 2, double>(flat, in_plane);
            const auto b = law.template act<true, 3, double>(deep, in_space);
            for (std::size_t k = 0; k < 2; ++k) CHECK(a.force[k] == Approx(b.force[k]).epsilon(1e-12).margin(1e-12));
            CHECK(b.force[2] == 0);
            if constexpr (Law::turns) {
                CHECK(a.twist[0] == Approx(b.twist[2]).epsilon(1e-12).margin(1e-12));
                CHECK(b.twist[0] == 0);
                if constexpr (Law::rolling_type::resists) {
                    CHECK(a.rolling[0] == Approx(b.rolling[2]).epsilon(1e-12).margin(1e-12));
                    CHECK(in_plane[planar - 1] == Approx(in_space[5]).epsilon(1e-12).margin(1e-12));
                }
            }
            if constexpr (planar >= 2)
                for (std::size_t k = 0; k < 2; ++k)
                    CHECK(in_plane[k] == Approx(in_space[k]).epsilon(1e-12).margin(1e-18));
        }
    }
}
bool same_bits(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Lanes with different contacts in them.
template <std::size_t D, class Law>
void check_lanes(const Law& law) {
    using V = lanes<double>;
    constexpr auto springs = Law::template history_size<D>;
    tsubu::random_stream random(3);
    for (int n = 0; n < 30; ++n) {
        contact<D, V> all{};
        vec<springs, V> held{};
        contact<D, double> each[V::count];
        vec<springs, double> memory[V::count];
        for (std::size_t l = 0; l < V::count; ++l) {
            each[l] = any_contact<D>(random);
            all.overlap.set(l, each[l].overlap);
            all.mass.set(l, each[l].mass);
            all.radius.set(l, each[l].radius);
            all.time_step.set(l, each[l].time_step);
            for (std::size_t k = 0; k < D; ++k) {
                all.normal[k].set(l, each[l].normal[k]);
                all.velocity[k].set(l, each[l].velocity[k]);
            }
            for (std::size_t k = 0; k < all.sliding.size(); ++k) {
                all.sliding[k].set(l, each[l].sliding[k]);
                all.turning[k].set(l, each[l].turning[k]);
            }
            for (std::size_t k = 0; k < springs; ++k) {
                memory[l][k] = 1e-4 * (static_cast<double>(random() >> 11) * 0x1p-53 - .5);
                held[k].set(l, memory[l][k]);
            }
        }
        const auto together = law.template act<true, D, V>(all, held);
        for (std::size_t l = 0; l < V::count; ++l) {
            const auto alone = law.template act<true, D, double>(each[l], memory[l]);
            bool same = true;
            for (std::size_t k = 0; k < D; ++k) same = same && same_bits(together.force[k][l], alone.force[k]);
            for (std::size_t k = 0; k < springs; ++k) same = same && same_bits(held[k][l], memory[l][k]);
            if constexpr (Law::turns)
                for (std::size_t k = 0; k < alone.twist.size(); ++k) {
                    same = same && same_bits(together.twist[k][l], alone.twist[k]);
                    if constexpr (Law::rolling_type::resists)
                        same = same && same_bits(together.rolling[k][l], alone.rolling[k]);
                }
            CHECK(same);
        }
    }
}
template <class Body>
void each_rich_law(Body&& body) {
    body(hooke<>{{2e5}});
    body(hooke_dashpot<coulomb>{{2e5, 50}, {.5, 30}});
    body(hooke_dashpot<linear_history, rolling_resistance>{{2e5, 50}, {5e4, .5, 20}, {.1, .2}});
    body(hertz_dashpot<mindlin_history, without_attraction>{{1e7, 3e3}, {4e6, .5, .3}, {}});
    body(hertz_tsuji<mindlin_history, rolling_resistance, dmt_cohesion>{{1e7, .3}, {4e6, .5, .3}, {.1, .2}, {.5}});
}

}  // namespace

TEST_CASE("what acts on j is the opposite, friction is across the normal and within its limit", "[dem]") {
    each_rich_law([](const auto& law) {
        check_reaction<2>(law);
        check_reaction<3>(law);
    });
}
TEST_CASE("two and three dimensions agree in a plane", "[dem]") {
    each_rich_law([](const auto& law) { check_in_plane(law); });
}
// A compiler that fuses multiply and add may do so in one form and not in the other.
#if !defined(__FMA__) && !defined(__FP_FAST_FMA)
TEST_CASE("lanes give the bits of a number", "[dem][lanes]") {
    each_rich_law([](const auto& law) {
        check_lanes<2>(law);
        check_lanes<3>(law);
    });
    check_lanes<1>(hertz_tsuji<>{{1e7, .3}});
}
#endif
TEST_CASE("parts of a law may be given in any order", "[dem]") {
    const hooke_dashpot<linear_history, rolling_resistance> one{{2e5, 50}, {5e4, .5}, {.1}};
    const hooke_dashpot<rolling_resistance, linear_history> other{{2e5, 50}, {.1}, {5e4, .5}};
    auto at = touching<2>(1e-3);
    at.velocity = {-1, 2};
    at.turning = {3};
    vec<3, double> a{};
    vec<3, double> b{};
    const auto x = one.act<true, 2, double>(at, a);
    const auto y = other.act<true, 2, double>(at, b);
    CHECK(x.force == y.force);
    CHECK(x.rolling == y.rolling);
    CHECK(a == b);
}
TEST_CASE("a parameter that cannot be is named, with its value and the remedy", "[dem]") {
    const auto check_says = [](const std::string& text, const std::string& what) {
        INFO(text);
        CHECK(says(text, what));
        CHECK(says(text, "give a finite number"));
    };
    using tsubu::input_error;
    check_says(thrown<input_error>([] { hooke<>{{-1}}; }), "dem::hooke_normal: stiffness k = -1 N/m; ");
    check_says(thrown<input_error>([] { hooke<>{{0}}; }), "dem::hooke_normal: stiffness k = 0 N/m; ");
    check_says(thrown<input_error>([] { hooke<>{{not_a_number}}; }), "stiffness k = nan N/m");
    check_says(thrown<input_error>([] { hooke<>{{infinity}}; }), "stiffness k = inf N/m");
    check_says(thrown<input_error>([] { hooke_dashpot<>{{1, -2}}; }),
               "dem::hooke_dashpot_normal: damping gamma = -2 1/s; ");
    check_says(thrown<input_error>([] { hertz<>{{0}}; }), "dem::hertz_normal: effective modulus = 0 Pa; ");
    check_says(thrown<input_error>([] { hertz_dashpot<>{{1, not_a_number}}; }),
               "dem::hertz_dashpot_normal: damping gamma = nan 1/(m s); ");
    check_says(thrown<input_error>([] { hertz_tsuji<>{{1, -.5}}; }), "dem::hertz_tsuji_normal: damping alpha = -0.5; ");
    check_says(thrown<input_error>([] { hooke<coulomb>{{1}, {-1, 0}}; }), "dem::coulomb: friction mu = -1; ");
    check_says(thrown<input_error>([] { hooke<coulomb>{{1}, {1, not_a_number}}; }),
               "dem::coulomb: damping gamma_t = nan 1/s; ");
    check_says(thrown<input_error>([] { hooke<coulomb>{{1}, {.mu = .5, .gamma_t = 0}}; }),
               "dem::coulomb: damping gamma_t = 0 1/s; give a finite number above 0");
    CHECK_NOTHROW(hooke<coulomb>{{1}, {0, 0}});
    check_says(thrown<input_error>([] { hooke<linear_history>{{1}, {0, 1}}; }),
               "dem::linear_history: stiffness k_t = 0 N/m; ");
    check_says(thrown<input_error>([] { hertz<mindlin_history>{{1}, {-1, 1}}; }),
               "dem::mindlin_history: effective shear modulus = -1 Pa; ");
    check_says(thrown<input_error>([] { hertz<mindlin_history>{{1}, {1, 1, -1}}; }),
               "dem::mindlin_history: share of damping = -1; ");
    check_says(thrown<input_error>([] {
                   hooke<coulomb, rolling_resistance>{{1}, {1, 1}, {0}};
               }),
               "dem::rolling_resistance: coefficient mu_r = 0; ");
    check_says(thrown<input_error>([] {
                   hooke<coulomb, rolling_resistance>{{1}, {1, 1}, {1, -1}};
               }),
               "dem::rolling_resistance: damping eta_r = -1; ");
    check_says(thrown<input_error>([] { hertz<dmt_cohesion>{{1}, {-1}}; }),
               "dem::dmt_cohesion: work of adhesion = -1 J/m^2; ");
}
TEST_CASE("a share of damping where there is none to share is refused", "[dem]") {
    const auto text = thrown<tsubu::input_error>([] { hertz<mindlin_history>{{1}, {1, 1, .3}}; });
    CHECK(says(text, "dem::contact_law: friction takes a share of 0.3 of the normal law's damping, and this one has "
                     "none"));
    CHECK(says(text, "take hertz_tsuji or hertz_dashpot, or a share of 0"));
    CHECK(hertz_dashpot<mindlin_history>{{1, 1}, {1, 1, .3}}.tangential().damping == .3);
}
