// SPDX-License-Identifier: MIT
/// @file
/// Impacts of two spheres: the error of what they leave over the number of steps in a contact, for each law, integrator
/// and number. Here, since the laws are compiled in two parts, each of which takes a minute.
///
/// All elastic laws have the same time of contact, and damped ones nearly, so that steps per contact and steps per
/// second are the same axis. The steps per contact are not whole numbers: errors of entry and exit would cancel, and
/// fake an order.
#pragma once

#include "plan.hpp"

#include <tsubu/dem/references.hpp>
#include <tsubu/dem/scenes/pair.hpp>

#include <algorithm>    // std::max
#include <cmath>        // std::pow, std::sqrt
#include <cstdint>      // std::int32_t, std::int64_t, std::uint64_t
#include <functional>   // std::function
#include <memory>       // std::shared_ptr
#include <string>       // std::string
#include <tuple>        // std::tuple
#include <type_traits>  // std::is_same_v
#include <vector>       // std::vector

namespace bench {

using namespace tsubu::dem;
using tsubu::lattice;

inline constexpr double stiffness = 2e5;     // N/m
inline constexpr double pair_mass = 0.5;     // effective: two spheres of 1 kg
inline constexpr double pair_radius = 0.25;  // effective: two spheres of 0.5 m
inline constexpr double tsuji_alpha = 0.44721359549995794;  // b = 1/5, so e = .527
inline constexpr int phases = 16;

inline const double contact_time = pi / std::sqrt(stiffness / pair_mass);

/// That of a Hertzian impact at 1 m/s that lasts as long as the Hookean one.
inline double hertz_modulus() {
    const double overlap = contact_time / 2.943275184;
    return 5 * pair_mass / (4 * std::pow(overlap, 2.5)) * 3 / (4 * std::sqrt(pair_radius));
}

/// How long a damped Hertzian impact lasts, for which there is no closed form: integrated in small steps.
inline double tsuji_duration() {
    const hertz_tsuji_normal law{hertz_modulus(), tsuji_alpha};
    const double h = contact_time / 1e5;
    double overlap = 0;
    double speed = 1;
    double t = 0;
    while (t == 0 || overlap > 0) {
        const double damping = law.damping(overlap, pair_mass, pair_radius);
        speed -= h / pair_mass * (law.elastic(overlap, pair_radius) + damping * speed);
        overlap += h * speed;
        t += h;
    }
    return t;
}

template <class Law>
struct impact_case;
template <>
struct impact_case<hooke<>> {
    static constexpr const char* name = "hooke";
    static hooke<> law() { return hooke<>{{stiffness}}; }
    static impact exact() { return {1, contact_time}; }
};
template <>
struct impact_case<hooke_dashpot<>> {
    static constexpr const char* name = "dashpot";
    static hooke_dashpot<> law() { return hooke_dashpot<>{{stiffness, 50}}; }
    static impact exact() { return dashpot_impact(stiffness, 50, pair_mass); }
};
template <>
struct impact_case<hertz<>> {
    static constexpr const char* name = "hertz";
    static hertz<> law() { return hertz<>{{hertz_modulus()}}; }
    static impact exact() { return {1, contact_time}; }
};
template <>
struct impact_case<hertz_tsuji<>> {
    static constexpr const char* name = "tsuji";
    static hertz_tsuji<> law() { return hertz_tsuji<>{{hertz_modulus(), tsuji_alpha}}; }
    static impact exact() {
        static const double duration = tsuji_duration();
        return {tsuji_restitution(tsuji_alpha), duration};
    }
};

/// rms over the phases of the error of the restitution; 1 m/s of approach.
template <class Law, class Integrator, class Number>
double restitution_error(double steps_per_contact) {
    using one = impact_case<Law>;
    const auto exact = one::exact();
    const double h = exact.duration / steps_per_contact;
    double sum = 0;
    for (int p = 0; p < phases; ++p) {
        try {
            auto run = stage(pair_scene<Law, Integrator, Number>{
                                 .law = one::law(), .time_step = h, .phase = (p + 0.5) / phases, .is_watched = false},
                             alone());
            // Once parted, the spheres keep their speed.
            run->steps(static_cast<std::size_t>(1.7 * steps_per_contact) + 5);
            const auto v = run->particles()[pair_scene<Law, Integrator, Number>::simulation::quantities_type::velocity];
            // Of the right one, by their ids: spheres that have flown through each other have not rebounded.
            const double side = run->particles()[tsubu::id][0] < run->particles()[tsubu::id][1] ? 1 : -1;
            const double apart = side * (static_cast<double>(v[1][0]) - static_cast<double>(v[0][0]));
            sum += (apart - exact.restitution) * (apart - exact.restitution);
        } catch (const tsubu::input_error&) {
            return lost;  // flown out of the box
        }
    }
    return std::sqrt(sum / phases);
}

/// A row of spheres, each of which is pressed against two others: the simulation of the pair, large enough to time.
template <class Law, class Integrator, class Number>
struct row_scene {
    using simulation = typename pair_scene<Law, Integrator, Number>::simulation;
    static constexpr std::uint64_t spheres = 4096;
    static constexpr double spacing = 0.999;

    [[nodiscard]] auto box() const {
        using number = typename simulation::box_type::real_type;
        return typename simulation::box_type({number(0)}, {static_cast<number>(spacing * double(spheres))},
                                             {.periodic = {true}});
    }
    [[nodiscard]] tsubu::dem::options how() const {
        // So short that nothing moves: with explicit_euler the row would burst.
        return {.time_step = 1e-9, .skin = 0.1, .guard = no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(impact_case<Law>::law(), equal_spheres{0.5, 1}); }
    [[nodiscard]] static std::uint64_t count() noexcept { return spheres; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        using number = typename Box::real_type;
        const auto i = store.push_back(tsubu::id = static_cast<std::int64_t>(n));
        put<typename simulation::quantities_type>(store, static_cast<std::size_t>(i), box,
                                                  {static_cast<number>((double(n) + 0.5) * spacing)});
    }
};

/// Time of some steps of a run that is made for it.
template <class Scene>
timed_contender cost_of(const std::string& name, const Scene& scene, std::size_t steps) {
    using run_type = typename decltype(stage(scene, alone()))::element_type;
    std::shared_ptr<run_type> made = stage(scene, alone());
    constexpr std::size_t calls = 8;
    return {name, static_cast<double>(calls * steps * scene.count()), [made, steps](row_fields& fields) {
                fields.emplace_back("bytes", double(made->memory_bytes()) / double(made->particles().owned_count()));
                return undisturbed_seconds(calls, [&] { made->steps(steps); });
            }};
}

struct sweep {
    std::string name;  // LAW/INTEGRATOR/NUMBER
    std::function<void(row_reporter&, extent)> errors;
    std::function<timed_contender()> cost;
};

template <class Law, class Integrator, class Number>
sweep impact_sweep() {
    const std::string name =
        std::string(impact_case<Law>::name) + "/" + integrator_name<Integrator> + "/" + number_name<Number>;
    return {name,
            [name](row_reporter& report, extent how_much) {
                const double h = impact_case<Law>::exact().duration;
                const auto point = [&](const char* task, double n) {
                    report.counted("dem/" + std::string(task) + "/" + name,
                                   {{"steps", n},
                                    {"time_step", h / n},
                                    {"evaluations", n * Integrator::force_evaluations},
                                    {"error", shown_error(restitution_error<Law, Integrator, Number>(n))}});
                };
                const int last = how_much == extent::quick ? 6 : 8;
                for (int k = 0; k <= last; ++k) point("impact", 5.0 * (1 << k) + 0.37);
                // Up to twice the step at which the contact's spring is unstable, w dt = 2, and beyond.
                if constexpr (std::is_same_v<Number, double>)
                    for (double w_dt = 0.5; w_dt < 4.05; w_dt *= 1.09) point("past", pi / w_dt);
            },
            [name] {
                return cost_of("dem/cost/" + name, row_scene<Law, Integrator, Number>{},
                               40 / Integrator::force_evaluations);
            }};
}

template <class Law, class... Integrators>
void add_integrators(std::vector<sweep>& all) {
    (all.push_back(impact_sweep<Law, Integrators, double>()), ...);
}
template <class Law, class... Numbers>
void add_numbers(std::vector<sweep>& all) {
    (all.push_back(impact_sweep<Law, velocity_verlet, Numbers>()), ...);
}
template <class Law>
void add_law(std::vector<sweep>& all) {
    add_integrators<Law, velocity_verlet, symplectic_euler, pefrl, runge_kutta_4, explicit_euler>(all);
    // Without damping there is nothing to solve for: it would be velocity_verlet.
    if constexpr (Law::normal_type::is_damped) add_integrators<Law, implicit_velocity_verlet>(all);
    add_numbers<Law, float, mixed_precision<double, float>, in_cells<float>, lattice<std::int64_t>,
                lattice<std::int32_t>>(all);
}

}  // namespace bench
