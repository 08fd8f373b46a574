// SPDX-License-Identifier: MIT
// One dimension: impacts of two spheres, the order of their restitution, and how long a time step may be.
#include <tsubu/dem/scenes/pair.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/explicit_euler.hpp>
#include <tsubu/dem/implicit_velocity_verlet.hpp>
#include <tsubu/dem/laws/dmt_cohesion.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/pefrl.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/dem/runge_kutta_4.hpp>
#include <tsubu/dem/scenes/bounce.hpp>
#include <tsubu/dem/scenes/chain.hpp>
#include <tsubu/dem/stability.hpp>
#include <tsubu/dem/symplectic_euler.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace {

using namespace tsubu::dem;

constexpr double stiffness = 2e5;
constexpr double gamma_n = 50;
constexpr double modulus = 2e6;

/// Steps per contact: with a whole number the errors of entry and exit cancel, and fake an order.
double steps_per_contact(int k) { return 5 * std::exp2(k) + .37; }

/// The restitution of one impact.
template <class Integrator, class Law>
double restitution(const Law& law, double time_step, double steps, double phase) {
    tsubu::self_transport on;
    const pair_scene<Law, Integrator> scene{.law = law, .time_step = time_step, .phase = phase, .is_watched = false};
    const auto pair = stage(scene, on);
    pair->steps(static_cast<std::size_t>(1.5 * steps) + 4);
    const auto v = pair->particles()[tsubu::velocity<1>];
    const auto x = pair->particles()[tsubu::position<1>];
    // Particles may have been sorted.
    return (v[1][0] - v[0][0]) * (x[1][0] > x[0][0] ? 1 : -1) / scene.speed;
}
/// The root of the mean square of its errors, over when the touch falls within a step.
template <class Integrator, class Law>
double error_of(const Law& law, double exact, double duration, double steps) {
    double sum = 0;
    constexpr int phases = 16;
    for (int p = 0; p < phases; ++p) {
        const double e = restitution<Integrator>(law, duration / steps, steps, (p + .5) / phases);
        sum += (e - exact) * (e - exact);
    }
    return std::sqrt(sum / phases);
}
/// The slope of a straight line through the logarithms.
template <class Integrator, class Law>
double order_of(const Law& law, double exact, double duration, int first = 2, int last = 8) {
    double sx = 0;
    double sy = 0;
    double sxx = 0;
    double sxy = 0;
    for (int k = first; k <= last; ++k) {
        const double x = std::log2(steps_per_contact(k));
        const double y = -std::log2(error_of<Integrator>(law, exact, duration, steps_per_contact(k)));
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const double n = last - first + 1;
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}
double hertz_duration() { return hertz_impact(modulus, .25, .5, 1).duration; }

/// The restitution of an impact whose force is elastic(d) - damping(d) v, by many small steps.
template <class Law>
double integrated_restitution(const Law& law, double duration) {
    const double mass = .5;
    const double radius = .25;
    const auto acceleration = [&](double d, double v) {
        return d <= 0 ? 0 : -(law.elastic(d, radius) + law.damping(d, mass, radius) * v) / mass;
    };
    double d = 0;
    double v = 1;
    // Steps grow from the touch, where forces are not smooth.
    double t = 0;
    for (int n = 0; n < 10000000; ++n) {
        const double h = duration * std::fmin(1e-5, 1e-9 + 1e-3 * std::fmin(t / duration, d));
        const double a1 = acceleration(d, v);
        const double a2 = acceleration(d + h / 2 * v, v + h / 2 * a1);
        const double a3 = acceleration(d + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2);
        const double a4 = acceleration(d + h * v + h * h / 2 * a2, v + h * a3);
        const double next = d + h * v + h * h / 6 * (a1 + a2 + a3);
        if (next <= 0) break;
        d = next;
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        t += h;
    }
    return -v;
}

#if defined(NDEBUG)
constexpr bool is_fast = true;
#else
constexpr bool is_fast = false;  // sanitizers: some fifty times slower
#endif

/// A scene of one sphere in one dimension.
template <class Scene, class... Models>
auto one_sphere(tsubu::self_transport& on, double time_step, double x, double v, const Models&... models) {
    using box_type = typename Scene::box_type;
    auto made = std::make_unique<run<Scene, tsubu::self_transport>>(
        box_type({-10}, {10}), options{.time_step = time_step, .skin = .1, .guard = no_guards}, on, models...);
    made->particles().push_back(tsubu::id = 1, tsubu::position<1> = {x}, tsubu::velocity<1> = {v});
    made->start();
    return made;
}

}  // namespace

TEST_CASE("the restitution of Hookean impacts is of the order that the damping allows", "[dem][order]") {
    const double free = pi / std::sqrt(stiffness / .5);
    CHECK(order_of<velocity_verlet>(hooke<>{{stiffness}}, 1, free) == Approx(2).margin(.15));

    // A dashpot begins with a jump: order 1 of the half step's damping and of the full step's.
    const auto damped = dashpot_impact(stiffness, gamma_n, .5);
    const hooke_dashpot<> law{{stiffness, gamma_n}};
    CHECK(order_of<velocity_verlet>(law, damped.restitution, damped.duration) == Approx(1).margin(.15));
    CHECK(order_of<implicit_velocity_verlet>(law, damped.restitution, damped.duration) == Approx(1).margin(.15));
    const auto ended = dashpot_impact_without_attraction(stiffness, gamma_n, .5);
    const hooke_dashpot<without_attraction> other{{stiffness, gamma_n}, {}};
    CHECK(order_of<velocity_verlet>(other, ended.restitution, ended.duration) == Approx(1).margin(.15));
}
TEST_CASE("the restitution of Hertzian impacts is of order 2.5, 1.5 and 1.25", "[dem][order]") {
    const double duration = hertz_duration();
    CHECK(order_of<velocity_verlet>(hertz<>{{modulus}}, 1, duration) == Approx(2.5).margin(.15));

    const hertz_tsuji<> tsuji{{modulus, .45}};
    const double e = tsuji_restitution(.45);
    CHECK(integrated_restitution(tsuji.normal(), duration) == Approx(e).epsilon(1e-8));
    CHECK(order_of<implicit_velocity_verlet>(tsuji, e, duration) == Approx(1.25).margin(.15));
    const hertz_dashpot<> grows{{modulus, 1e4}};
    const double e_grows = integrated_restitution(grows.normal(), duration);
    CHECK(order_of<implicit_velocity_verlet>(grows, e_grows, duration) == Approx(1.5).margin(.15));
    // The half step's damping lags behind by half a step, which costs an order as soon as damping is strong.
    CHECK(order_of<velocity_verlet>(tsuji, e, duration) == Approx(1).margin(.15));
    // Where it is weak, the order of the law shows first.
    CHECK(order_of<velocity_verlet>(hertz_tsuji<>{{modulus, .1}}, tsuji_restitution(.1), duration, 0, 7) ==
          Approx(1.25).margin(.15));
}
TEST_CASE("a fine step gives the restitution of the exact solution", "[dem][reference]") {
    const auto check = [](const auto& law, const impact& exact, double tolerance) {
        CHECK(restitution<velocity_verlet>(law, exact.duration / 2000.37, 2000, .5) ==
              Approx(exact.restitution).epsilon(0).margin(tolerance));
    };
    check(hooke<>{{stiffness}}, {1, pi / std::sqrt(stiffness / .5)}, 1e-6);
    check(hooke_dashpot<>{{stiffness, gamma_n}}, dashpot_impact(stiffness, gamma_n, .5), 1e-4);
    check(hooke_dashpot<without_attraction>{{stiffness, gamma_n}, {}},
          dashpot_impact_without_attraction(stiffness, gamma_n, .5), 1e-4);
    check(hertz<>{{modulus}}, {1, hertz_duration()}, 1e-8);
    check(hertz_tsuji<>{{modulus, .45}}, {tsuji_restitution(.45), hertz_duration()}, 2e-4);
}
TEST_CASE("a Hertzian impact is bounded above five steps, and gains energy below two", "[dem][stability]") {
    const hertz<> law{{modulus}};
    for (const double steps : {5.37, 7.37, 10.37})
        CHECK(error_of<velocity_verlet>(law, 1, hertz_duration(), steps) < 2e-3);
    const double gain = error_of<velocity_verlet>(law, 1, hertz_duration(), 1.99);
    CHECK(gain > .5);
    CHECK(gain < 1.5);
    CHECK(error_of<velocity_verlet>(law, 1, hertz_duration(), 1.5) > .5);
}
TEST_CASE("spheres that hit a wall are pressed in as far, as hard and as long as Hertz says", "[dem][reference]") {
    // Chung & Ooi 2011, doi:10.1007/s10035-011-0277-0, tests 1 to 3: two glass spheres, of which each sees the middle
    // as a rigid wall; an aluminium alloy; cast iron.
    struct material {
        double radius, modulus, nu, density, speed;
        double overlap, force, duration;
        bool is_pair;
    };
    for (const material& one :
         {material{.01, 4.8e10, .2, 2800, 20, 274.112702e-6, 10696.889, 40.3394557e-6, true},
          material{.1, 7e10, .3, 2699, .2, 49.7171752e-6, 11369.8583, 731.656641e-6, false},
          material{.0025, 1e11, .25, 7000, 3.9, 17.1887136e-6, 506.760233, 12.9720806e-6, false}}) {
        const double mass = 4 * pi / 3 * std::pow(one.radius, 3) * one.density;
        // Twice as stiff, and half the mass and radius of the pair: a body of the effective ones on a wall.
        const double share = one.is_pair ? .5 : 1;
        const double effective = one.modulus / (1 - one.nu * one.nu) * share;
        const auto exact = hertz_impact(effective, one.radius * share, mass * share, one.speed);
        CHECK(exact.overlap == Approx(one.overlap).epsilon(1e-8));
        CHECK(exact.force == Approx(one.force).epsilon(1e-8));
        CHECK(exact.duration == Approx(one.duration).epsilon(1e-8));

        const double radius = one.radius * share;
        const double h = exact.duration / 2000.37;
        tsubu::self_transport on;
        using scene = simulation<1, double, velocity_verlet, hertz<>, walls>;
        const auto ball =
            one_sphere<scene>(on, h, radius + .5 * h * one.speed, -one.speed, hertz<>{{effective}},
                              walls{{{.point = {0}, .normal = {1}}}}, equal_spheres{radius, mass * share});
        double overlap = 0;
        double force = 0;
        int touched = 0;
        for (int step = 0; step < 2010; ++step) {
            ball->steps(1);
            const double now = radius - ball->position(0)[0];
            overlap = std::fmax(overlap, now);
            force = std::fmax(force, ball->particles()[tsubu::force<1>][0][0]);
            touched += now > 0 ? 1 : 0;
        }
        CHECK(overlap == Approx(one.overlap).epsilon(2e-6));
        CHECK(force == Approx(one.force).epsilon(2e-6));
        CHECK(touched * h == Approx(one.duration).margin(1.01 * h));
        CHECK(ball->particles()[tsubu::velocity<1>][0][0] == Approx(one.speed).epsilon(1e-7));
    }
}
TEST_CASE("a ball bounces as its closed form says, time after time", "[dem][reference]") {
    // The dashpot is of order 1.
    const double h = is_fast ? 1e-6 : 2e-5;
    tsubu::self_transport on;
    const bounce_scene<> scene{.law = hooke_dashpot<>{{5e4, 10}}, .time_step = h};
    const auto ball = stage(scene, on);
    bouncing_ball exact{.height = scene.height,
                        .radius = scene.radius,
                        .mass = 1,
                        .k = 5e4,
                        .gamma = 10,
                        .gravity = scene.acceleration};
    for (int bounces = 1; bounces <= 5; ++bounces) {
        exact.bounce();
        ball->steps(static_cast<std::size_t>(exact.time / h) - ball->steps_done());
        // In free flight: the top from where it is.
        const double v = ball->particles()[tsubu::velocity<1>][0][0];
        INFO("bounce " << bounces);
        CHECK(ball->position(0)[0] + v * v / (2 * scene.acceleration) == Approx(exact.height).epsilon(50 * h));
        CHECK(static_cast<double>(ball->steps_done()) * h + v / scene.acceleration ==
              Approx(exact.time).epsilon(50 * h));
    }
}
TEST_CASE("a ball on a floor that sticks keeps its energy, through contacts that it leaves", "[dem][reference]") {
    tsubu::self_transport on;
    const double e_star = 1e7;
    const double adhesion = 50;
    const bounce_scene<hertz<dmt_cohesion>> scene{.law = hertz<dmt_cohesion>{{e_star}, {adhesion}}, .time_step = 1e-5};
    const auto ball = stage(scene, on);
    const auto energy = [&] { return kinetic_energy(*ball) + elastic_energy(*ball) + gravity_energy(*ball); };
    const double at_first = energy();
    CHECK(at_first == Approx(scene.mass * scene.acceleration * scene.height).epsilon(1e-12));
    double most_lost = 0;
    double least_elastic = 0;
    unsigned bounces = 0;
    bool was_touching = false;
    for (int n = 0; n < 40000; ++n) {
        ball->steps(2);
        most_lost = std::fmax(most_lost, std::abs(energy() - at_first));
        const double elastic = elastic_energy(*ball);
        least_elastic = std::fmin(least_elastic, elastic);
        bounces += elastic != 0 && !was_touching ? 1 : 0;
        was_touching = elastic != 0;
    }
    CHECK(bounces == 2);
    CHECK(most_lost < 1e-3 * at_first);
    // Where the pull is as great as the push: F = 4/3 E* sqrt(R) d^1.5, of which the energy is 2/5 F d.
    const double pull = 2 * pi * adhesion * scene.radius;
    const double overlap = std::pow(.75 * pull / e_star / std::sqrt(scene.radius), 2. / 3);
    CHECK(least_elastic == Approx(-.6 * pull * overlap).epsilon(.02));
}
TEST_CASE("a ball that loses nothing comes back to where it began", "[dem][reference]") {
    const double h = is_fast ? 2e-5 : 1e-4;
    tsubu::self_transport on;
    const bounce_scene<> scene{.law = hooke_dashpot<>{{5e4, 0}}, .time_step = h};
    const auto ball = stage(scene, on);
    bouncing_ball exact{
        .height = scene.height, .radius = scene.radius, .mass = 1, .k = 5e4, .gamma = 0, .gravity = scene.acceleration};
    for (int bounces = 1; bounces <= 20; ++bounces) {
        exact.bounce();
        CHECK(exact.height == Approx(scene.height).epsilon(1e-12));
        ball->steps(static_cast<std::size_t>(exact.time / h) - ball->steps_done());
        const double v = ball->particles()[tsubu::velocity<1>][0][0];
        CHECK(ball->position(0)[0] + v * v / (2 * scene.acceleration) == Approx(exact.height).epsilon(2e4 * h * h));
    }
}

namespace {

/// The displacement of a sphere between two walls that both touch it, after it was 1e-9 m beside its place.
template <class Integrator>
double displacement_between_walls(double damping_ratio, double omega_dt) {
    using scene = simulation<1, double, Integrator, hooke_dashpot<>, walls>;
    const double k = 1;
    const double omega = std::sqrt(2 * k);
    tsubu::self_transport on;
    // Of each wall the dashpot is gamma m: 2 gamma m = 2 z m omega.
    const auto one = one_sphere<scene>(on, omega_dt / omega, 1e-9, 0, hooke_dashpot<>{{k, damping_ratio * omega}},
                                       walls{{{.point = {-.9}, .normal = {1}}, {.point = {.9}, .normal = {-1}}}},
                                       equal_spheres{1, 1});
    CHECK(greatest_frequency(*one) == Approx(omega).epsilon(1e-12));
    double last = 0;
    one->steps(1200);
    for (int n = 0; n < 20; ++n) {
        one->steps(1);
        last = std::fmax(last, std::abs(one->position(0)[0]));
    }
    return last;
}

}  // namespace

TEST_CASE("a sphere between walls is stable to within a hundredth of the limit", "[dem][stability]") {
    for (const double z : {0.0, .1, .4, 1.0}) {
        const double limit = 2 * (std::sqrt(1 + z * z) - z);
        INFO("damping ratio " << z << ", limit " << limit);
        CHECK(displacement_between_walls<velocity_verlet>(z, .99 * limit) < 1e-8);
        CHECK(displacement_between_walls<velocity_verlet>(z, 1.01 * limit) > 1e-7);
    }
    for (const double z : {0.0, .1, .4, 1.0, 3.0}) {
        INFO("implicit, damping ratio " << z);
        CHECK(displacement_between_walls<implicit_velocity_verlet>(z, .99 * 2) < 1e-8);
        CHECK(displacement_between_walls<implicit_velocity_verlet>(z, 1.01 * 2) > 1e-7);
    }
}

TEST_CASE("damping is solved for down to motions that are hardly numbers", "[dem][stability]") {
    // Such a step damps so well that velocities end among the denormal numbers.
    CHECK(displacement_between_walls<implicit_velocity_verlet>(1, 1.0196) < 1e-15);
}

namespace {

/// The displacement of mass n, in amplitudes.
template <class Chain>
double displacement(const Chain& chain, std::size_t i, double amplitude) {
    return (chain.particles()[tsubu::position<1>][i][0] - static_cast<double>(chain.particles()[tsubu::id][i])) /
           amplitude;
}
/// Of one mass on two springs, from the exact cosine, after about ten periods.
template <class Integrator>
double error_of_oscillator(double steps_per_period) {
    const chain_scene<Integrator> scene{.time_step = 2 * pi / std::sqrt(2.0) / steps_per_period, .masses = 1};
    tsubu::self_transport on;
    const auto one = stage(scene, on);
    double error = 0;
    const double w = std::sqrt(2.0);
    for (int step = 1; step <= 10 * steps_per_period; ++step) {
        one->steps(1);
        for (std::size_t i = 0; i < 3; ++i)
            if (one->particles()[tsubu::id][i] == 1)
                error = std::fmax(error, std::abs(displacement(*one, i, scene.amplitude) -
                                                  std::cos(w * step * scene.time_step)));
    }
    return error;
}

}  // namespace

TEST_CASE("a chain swings at the frequency of the scheme", "[dem][reference]") {
    struct row {
        double time_step;
        double cosine;  ///< 1 - cos of the error of the phase after 10 periods
    };
    for (const auto& [h, cosine] : {row{.9, 1.225e-5}, row{.5, 1.167e-6}, row{.2, 2.989e-8}}) {
        const chain_scene<> scene{.time_step = h};
        const double w = chain_frequency(1, 64, 1, 1);
        const double numerical = verlet_frequency(w, h);
        CHECK(1 - std::cos((numerical - w) * 20 * pi / w) == Approx(cosine).epsilon(2e-3));
        if (!is_fast && h < .9) continue;
        tsubu::self_transport on;
        const auto chain = stage(scene, on);
        double error = 0;
        for (int step = 1; step * h < 20 * pi / w; ++step) {
            chain->steps(1);
            const double swing = std::cos(numerical * step * h);
            for (std::size_t i = 0; i < chain->particles().owned_count(); ++i) {
                const auto id = static_cast<std::uint64_t>(chain->particles()[tsubu::id][i]);
                const double shape = id == 0 || id == 65 ? 0 : scene.shape(id);
                error = std::fmax(error, std::abs(displacement(*chain, i, scene.amplitude) - shape * swing));
            }
        }
        CHECK(error < 1e-9);
    }
}
TEST_CASE("the energy of a mode ripples by (w dt / 2)^2", "[dem][reference]") {
    const chain_scene<> scene{.time_step = .5, .mode = 31};
    tsubu::self_transport on;
    const auto chain = stage(scene, on);
    CHECK(greatest_frequency(*chain) == Approx(2).epsilon(1e-2));
    double least = 1;
    double most = 0;
    for (int step = 0; step < 500; ++step) {
        chain->steps(1);
        const double energy = kinetic_energy(*chain) + elastic_energy(*chain);
        least = std::fmin(least, energy);
        most = std::fmax(most, energy);
    }
    const double w = chain_frequency(31, 64, 1, 1);
    CHECK((most - least) / most == Approx(w * w * .25 / 4).epsilon(1e-2));
}
TEST_CASE("a chain is stable to within a hundredth of the limit", "[dem][stability]") {
    const double limit = 2 / chain_frequency(64, 64, 1, 1);
    CHECK(limit == Approx(1.000292).epsilon(1e-6));
    const auto swing = [&](double share) {
        const chain_scene<> scene{.time_step = share * limit, .mode = 64, .amplitude = 1e-9};
        tsubu::self_transport on;
        const auto chain = stage(scene, on);
        chain->steps(100);
        double most = 0;
        for (std::size_t i = 0; i < chain->particles().owned_count(); ++i)
            most = std::fmax(most, std::abs(displacement(*chain, i, scene.amplitude)));
        return most;
    };
    CHECK(swing(.99) < 10);
    CHECK(swing(1.01) > 1000);
}
TEST_CASE("integrators have their orders where forces are smooth", "[dem][order]") {
    const auto order = [](auto integrator, double steps) {
        using scheme = decltype(integrator);
        return std::log2(error_of_oscillator<scheme>(steps) / error_of_oscillator<scheme>(2 * steps));
    };
    CHECK(order(velocity_verlet{}, 64) == Approx(2).margin(.1));
    CHECK(order(symplectic_euler{}, 1024) == Approx(1).margin(.1));
    CHECK(order(explicit_euler{}, 4096) == Approx(1).margin(.1));
    CHECK(order(pefrl{}, 16) == Approx(4).margin(.2));
    CHECK(order(runge_kutta_4{}, 64) == Approx(4).margin(.2));
}
