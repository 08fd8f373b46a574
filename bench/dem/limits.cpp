// SPDX-License-Identifier: MIT
/// @file
/// Errors over the time step, up to the limit of stability and past it.

#include "plan.hpp"

#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/dem/scenes/gas.hpp>
#include <tsubu/dem/scenes/settle.hpp>
#include <tsubu/dem/stability.hpp>

#include <algorithm>  // std::max
#include <cmath>      // std::cos, std::exp, std::sin, std::sqrt
#include <tuple>      // std::tuple

namespace bench {
namespace {

using namespace tsubu::dem;
using tsubu::lattice;

// ---------------------------------------------------------------------------------------------------------------
// A sphere between two walls

/// A sphere that is pressed between two walls, and oscillates: a damped oscillator, x'' + 2 z w x' + w^2 x = 0 with w =
/// 1, as long as both contacts last.
template <class Law, class Integrator>
struct between_walls_scene {
    using simulation = tsubu::dem::simulation<1, double, Integrator, Law, walls>;
    Law law;
    double time_step;
    double amplitude = 1e-6;  // far below the overlap, so that the contacts last even where it grows
    double overlap = 0.1;
    double speed = 0;

    [[nodiscard]] auto box() const { return typename simulation::box_type({-3}, {3}); }
    [[nodiscard]] tsubu::dem::options how() const { return {.time_step = time_step, .skin = 0.5, .guard = no_guards}; }
    [[nodiscard]] auto models() const {
        const double at = 0.5 - overlap;
        return std::tuple(law, walls{{{.point = {-at}, .normal = {1}}, {.point = {at}, .normal = {-1}}}},
                          equal_spheres{0.5, 1});
    }
    [[nodiscard]] static std::uint64_t count() noexcept { return 1; }
    template <class Store, class Box>
    void place(Store& store, const Box&, std::uint64_t) const {
        store.push_back(tsubu::id = 1, simulation::quantities_type::position = {amplitude},
                        simulation::quantities_type::velocity = {speed});
    }
};

/// The greatest error of the position within some periods, by the amplitude.
template <class Law, class Integrator>
double oscillation_error(const Law& law, double zeta, double time_step) {
    using scene = between_walls_scene<Law, Integrator>;
    const double w = std::sqrt(std::abs(1 - zeta * zeta));
    const auto exact = [&](double t) {
        const double e = std::exp(-zeta * t);
        if (w < 1e-9) return e * (1 + t);
        return zeta < 1 ? e * (std::cos(w * t) + zeta / w * std::sin(w * t))
                        : e * (std::cosh(w * t) + zeta / w * std::sinh(w * t));
    };
    const scene at{.law = law, .time_step = time_step};
    auto run = stage(at, alone());
    double worst = 0;
    // Enough for one hundredth past the limit to show, in few periods where steps are short.
    const int steps = 300;
    for (int n = 1; n <= steps; ++n) {
        try {
            run->steps(1);
        } catch (const tsubu::input_error&) {
            return lost;  // damping that cannot be solved for
        }
        const double x = run->position(0)[0] / at.amplitude;
        worst = (std::max)(worst, std::abs(x - exact(n * time_step)));
        if (!(worst < 1e4)) return lost;  // soon a contact would end
    }
    return worst;
}
template <class Law, class Integrator>
void oscillate(row_reporter& report, const Law& law, double zeta) {
    char text[16];
    std::snprintf(text, sizeof text, "%g", zeta);
    for (double w_dt = 0.05; w_dt < 4.05; w_dt = w_dt < 0.5 ? w_dt * 1.25 : w_dt + 0.03125)
        report.counted("dem/walls/" + std::string(text) + "/" + integrator_name<Integrator> + "/double",
                       {{"omega_dt", w_dt},
                        {"error", shown_error(oscillation_error<Law, Integrator>(law, zeta, w_dt))}});
}
void between_walls(row_reporter& report) {
    // Two springs of k = 1/2 give w = 1.
    const hooke<> elastic{{0.5}};
    oscillate<hooke<>, velocity_verlet>(report, elastic, 0);
    oscillate<hooke<>, symplectic_euler>(report, elastic, 0);
    oscillate<hooke<>, pefrl>(report, elastic, 0);
    oscillate<hooke<>, runge_kutta_4>(report, elastic, 0);
    oscillate<hooke<>, explicit_euler>(report, elastic, 0);
    for (const double zeta : {0.1, 0.4, 1.0}) {
        const hooke_dashpot<> damped{{0.5, zeta}};  // twice gamma = 2 z w
        oscillate<hooke_dashpot<>, velocity_verlet>(report, damped, zeta);
        oscillate<hooke_dashpot<>, implicit_velocity_verlet>(report, damped, zeta);
    }
}

// ---------------------------------------------------------------------------------------------------------------
// The energy of a gas

template <class Integrator, class Number>
gas_scene<hooke<>, Integrator, Number> small_gas(double steps_per_contact) {
    return {.law = hooke<>{{2e5}},
            .time_step = pi / std::sqrt(2e5 / 0.5) / steps_per_contact,
            .per_edge = 10,
            .is_watched = false};
}
template <class Integrator, class Number = double>
void drift(row_reporter& report, extent how_much) {
    // Some collisions win energy, others lose it: what a quarter of a time unit changes, rms over many.
    const int windows = how_much == extent::quick ? 16 : how_much == extent::standard ? 24 : 160;
    const int last = how_much == extent::quick ? 4 : 6;
    for (int k = 0; k <= last; ++k) {
        const double n = 5 * std::pow(2, 0.5 * k) + 0.37;
        const auto scene = small_gas<Integrator, Number>(n);
        row_fields fields = {{"steps", n}, {"evaluations", n * Integrator::force_evaluations}};
        double error = lost;
        try {
            auto gas = stage(scene, alone());
            const double first = kinetic_energy(*gas);
            double before = first;
            double sum = 0;
            for (int window = 0; window < windows; ++window) {
                gas->steps(static_cast<std::size_t>(0.25 / scene.time_step));
                const double after = kinetic_energy(*gas) + elastic_energy(*gas);
                sum += (after - before) * (after - before) / (first * first);
                before = after;
            }
            error = std::sqrt(sum / windows);
        } catch (const tsubu::input_error&) {  // so fast that neighbours were used too long
        }
        fields.emplace_back("error", shown_error((std::max)(error, 1e-16)));
        report.counted("dem/gas/hooke/" + std::string(integrator_name<Integrator>) + "/" + number_name<Number>, fields);
    }
}
template <class Integrator, class Number = double>
timed_contender gas_cost() {
    const auto scene = small_gas<Integrator, Number>(20.37);
    using run_type = typename decltype(stage(scene, alone()))::element_type;
    std::shared_ptr<run_type> gas = stage(scene, alone());
    constexpr std::size_t steps = 100;
    constexpr std::size_t calls = 8;
    return {"dem/gas_cost/hooke/" + std::string(integrator_name<Integrator>) + "/" + number_name<Number>,
            static_cast<double>(calls * steps * scene.count()),
            [gas](row_fields&) { return undisturbed_seconds(calls, [&] { gas->steps(steps); }); }};
}
void gas(row_reporter& report, extent how_much) {
    drift<velocity_verlet>(report, how_much);
    drift<symplectic_euler>(report, how_much);
    drift<pefrl>(report, how_much);
    drift<runge_kutta_4>(report, how_much);
    drift<velocity_verlet, float>(report, how_much);
    drift<velocity_verlet, mixed_precision<double, float>>(report, how_much);
    drift<velocity_verlet, in_cells<float>>(report, how_much);
    drift<velocity_verlet, lattice<std::int64_t>>(report, how_much);
    drift<velocity_verlet, lattice<std::int32_t>>(report, how_much);
    take_turns(report,
               {gas_cost<velocity_verlet>(), gas_cost<symplectic_euler>(), gas_cost<pefrl>(), gas_cost<runge_kutta_4>(),
                gas_cost<velocity_verlet, float>(), gas_cost<velocity_verlet, mixed_precision<double, float>>(),
                gas_cost<velocity_verlet, in_cells<float>>(), gas_cost<velocity_verlet, lattice<std::int64_t>>(),
                gas_cost<velocity_verlet, lattice<std::int32_t>>()},
               rounds_of(how_much));
}

// ---------------------------------------------------------------------------------------------------------------
// A bed that settles with too long a step

/// The share of the volume that spheres fill, between a quarter and three quarters of the height of the bed.
template <class Run>
double packing(const Run& bed, double area) {
    double top = 0;
    const auto owned = bed.particles().owned_count();
    for (std::size_t i = 0; i < owned; ++i) top += 2 * bed.position(static_cast<tsubu::index_t>(i))[2] / double(owned);
    const double lo = 0.25 * top;
    const double hi = 0.75 * top;
    double volume = 0;
    for (std::size_t i = 0; i < owned; ++i) {
        // Of a sphere, what is between two heights: of radius 1/2, up to z from its bottom it has pi z^2 (1/2 - z/3).
        const double z = bed.position(static_cast<tsubu::index_t>(i))[2] - 0.5;
        const auto below = [&](double height) {
            const double up = (std::min)((std::max)(height - z, 0.0), 1.0);
            return pi * up * up * (0.5 - up / 3);
        };
        volume += below(hi) - below(lo);
    }
    return volume / (area * (hi - lo));
}

void cliff(row_reporter& report, extent how_much) {
    const bool is_quick = how_much == extent::quick;
    const double unit = std::sqrt(1 / 2e5);  // sqrt(m/k)
    const std::vector<double> steps =
        is_quick ? std::vector<double>{.3, .5, .65, .75, .8, .85, .9, 1.0}
                 : std::vector<double>{.1, .2, .3, .4, .5, .6, .65, .7, .725, .75, .775, .8, .85, .9, 1.0, 1.1};
    for (const double step : steps) {
        settle_scene<> scene{.time_step = step * unit, .cells = {10, 10, is_quick ? 6U : 12U}, .is_watched = false};
        row_fields fields = {{"omega_dt", step}};
        try {
            auto bed = stage(scene, alone());
            const double duration = is_quick ? 15 : 20;
            const auto count = static_cast<std::size_t>(duration / scene.time_step);
            const double seconds = seconds_of([&] { bed->steps(count); });
            fields.emplace_back("packing", packing(*bed, 144));
            fields.emplace_back("coordination", coordination_number(*bed));
            fields.emplace_back("height", mean_position(*bed)[2]);
            fields.emplace_back("kinetic", kinetic_energy(*bed) / double(scene.count()));
            if (step < 0.55) fields.emplace_back("limit", longest_time_step(*bed) / unit);  // of a bed at rest
            fields.emplace_back("nanoseconds_per_second", 1e9 * seconds / duration / double(scene.count()));
        } catch (const tsubu::input_error&) {  // particles have left the box, or were faster than lists
            fields.emplace_back("kinetic", lost);
        }
        report.counted("dem/settle/bed/velocity_verlet/double", fields);
    }
}

}  // namespace

void add_limits(std::vector<group>& groups, extent how_much) {
    const double longer = how_much == extent::quick ? 1 : 8;
    groups.push_back({"dem/walls", 0.1, between_walls});
    groups.push_back({"dem/gas", 6 * longer, [how_much](row_reporter& report) { gas(report, how_much); }});
    groups.push_back({"dem/settle", 2.5 * longer, [how_much](row_reporter& report) { cliff(report, how_much); }});
}

}  // namespace bench
