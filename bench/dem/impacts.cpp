// SPDX-License-Identifier: MIT
/// @file
/// Impacts of two spheres, and of one with a floor.

#include "impact_sweep.hpp"

#include <tsubu/dem/scenes/sphere_on_floor.hpp>

namespace bench {

void add_hertz(std::vector<sweep>& all);  // in hertz_impacts.cpp

namespace {

// ---------------------------------------------------------------------------------------------------------------
// A sphere that hits a floor at 45 degrees

struct rolls {
    static constexpr const char* name = "rolls";  // friction holds: 1 <= 3.5 mu
    static constexpr double mu = 0.5;
};
struct slides {
    static constexpr const char* name = "slides";
    static constexpr double mu = 0.2;
};

/// rms over the phases of the errors of the velocity along the floor and of that of the surface, by those before.
template <class Case, class Integrator, class Number>
double oblique_error(double steps_per_contact) {
    using law_type = hooke<linear_history>;
    const auto exact = oblique_impact(1, 1, Case::mu, 0.5);
    const double h = pi / std::sqrt(stiffness) / steps_per_contact;  // the floor does not move: m* is the mass
    double sum = 0;
    for (int p = 0; p < phases; ++p) {
        using scene = oblique_scene<law_type, Integrator, Number>;
        auto run = stage(scene{.law = law_type{{stiffness}, {stiffness * 2 / 7, Case::mu}},
                               .time_step = h,
                               .phase = (p + 0.5) / phases,
                               .is_watched = false},
                         alone());
        run->steps(static_cast<std::size_t>(1.3 * steps_per_contact) + 5);
        using q = typename scene::simulation::quantities_type;
        const double along = static_cast<double>(run->particles()[q::velocity][0][0]) - exact.tangential;
        const double spin = std::abs(static_cast<double>(run->particles()[q::angular_velocity][0][0])) - exact.spin;
        sum += along * along + 0.25 * spin * spin;
    }
    return std::sqrt(sum / phases);
}
template <class Case, class Integrator, class Number = double>
void oblique(row_reporter& report, extent how_much) {
    const int last = how_much == extent::quick ? 5 : 8;
    for (int k = 0; k <= last; ++k) {
        const double n = 5.0 * (1 << k) + 0.37;
        report.counted("dem/oblique/" + std::string(Case::name) + "/" + integrator_name<Integrator> + "/" +
                           number_name<Number>,
                       {{"steps", n},
                        {"evaluations", n * Integrator::force_evaluations},
                        {"error", shown_error(oblique_error<Case, Integrator, Number>(n))}});
    }
}

/// Spheres that lie beside each other on the floor: the simulation of one that hits it, large enough to time.
template <class Integrator, class Number>
struct floor_row_scene {
    using law_type = hooke<linear_history>;
    using simulation = typename oblique_scene<law_type, Integrator, Number>::simulation;
    static constexpr std::uint64_t spheres = 4096;

    [[nodiscard]] auto box() const {
        return typename simulation::box_type({-2, -2}, {2 + 1.2 * double(spheres), 2});
    }
    [[nodiscard]] tsubu::dem::options how() const { return {.time_step = 1e-5, .skin = 0.1, .guard = no_guards}; }
    [[nodiscard]] auto models() const {
        return std::tuple(law_type{{stiffness}, {stiffness * 2 / 7, 0.5}}, walls{{{.point = {0, 0}, .normal = {0, 1}}}},
                          equal_spheres{0.5, 1});
    }
    [[nodiscard]] static std::uint64_t count() noexcept { return spheres; }
    template <class Store, class Box>
    void place(Store& store, const Box&, std::uint64_t n) const {
        using real = typename simulation::real;
        store.push_back(tsubu::id = static_cast<std::int64_t>(n),
                        simulation::quantities_type::position = {1.2 * double(n), 0.495},
                        simulation::quantities_type::velocity = {real(1e-6), real(0)});
    }
};
template <class Integrator, class Number = double>
timed_contender oblique_cost() {
    return cost_of("dem/oblique_cost/all/" + std::string(integrator_name<Integrator>) + "/" + number_name<Number>,
                   floor_row_scene<Integrator, Number>{}, 40);
}

}  // namespace

void add_impacts(std::vector<group>& groups, extent how_much) {
    std::vector<sweep> all;
    add_law<hooke<>>(all);
    add_law<hooke_dashpot<>>(all);
    add_hertz(all);
    groups.push_back({"dem/impact", how_much == extent::quick ? 0.3 : 2.0, [all, how_much](row_reporter& report) {
                          for (const auto& one : all) one.errors(report, how_much);
                      }});
    groups.push_back({"dem/cost", how_much == extent::quick ? 3.0 : 5.0, [all, how_much](row_reporter& report) {
                          std::vector<timed_contender> costs;
                          for (const auto& one : all) costs.push_back(one.cost());
                          take_turns(report, costs, rounds_of(how_much));
                      }});
    groups.push_back({"dem/oblique", how_much == extent::quick ? 0.3 : 1.0, [how_much](row_reporter& report) {
                          const auto of = [&]<class Case>(Case) {
                              oblique<Case, velocity_verlet>(report, how_much);
                              oblique<Case, symplectic_euler>(report, how_much);
                              oblique<Case, explicit_euler>(report, how_much);
                              oblique<Case, velocity_verlet, mixed_precision<double, float>>(report, how_much);
                          };
                          of(rolls{});
                          of(slides{});
                          take_turns(report,
                                     {oblique_cost<velocity_verlet>(), oblique_cost<symplectic_euler>(),
                                      oblique_cost<explicit_euler>(),
                                      oblique_cost<velocity_verlet, mixed_precision<double, float>>()},
                                     rounds_of(how_much));
                      }});
}

}  // namespace bench
