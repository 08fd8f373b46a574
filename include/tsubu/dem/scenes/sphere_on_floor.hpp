// SPDX-License-Identifier: MIT
/// @file
/// One sphere that slides, rolls or bounces on a floor, or lies on a slope.
#pragma once

#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/dem/walls.hpp>

#include <cmath>    // std::cos, std::sin
#include <cstdint>  // std::uint64_t
#include <tuple>    // std::tuple

namespace tsubu::dem {

/// A sphere (a disk's motion with a sphere's inertia) that hits a floor at an angle: two dimensions, rotation,
/// friction, one wall, no gravity.
///
/// Reference: oblique_impact; Chung & Ooi 2011, doi:10.1007/s10035-011-0277-0.
template <class Law = hooke<linear_history>, class Integrator = velocity_verlet, class Number = double>
struct oblique_scene {
    using simulation = dem::simulation<2, Number, Integrator, Law, walls>;

    Law law;
    double time_step;         ///< [s]
    double normal_speed = 1;  ///< towards the floor [m/s]
    double along_speed = 1;   ///< along it [m/s]
    double radius = 0.5;      ///< [m]
    double mass = 1;          ///< [kg]
    double phase = 0.5;       ///< share of a step from the beginning to the touch
    bool is_watched = true;   ///< whether a time step past the limit is refused

    [[nodiscard]] auto box() const {
        return scene_box<simulation>({-100 * radius, -2 * radius}, {100 * radius, 10 * radius});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = radius, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const {
        return std::tuple(law, walls{{{.point = {0, 0}, .normal = {0, 1}}}}, equal_spheres{radius, mass});
    }
    [[nodiscard]] static std::uint64_t count() noexcept { return 1; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t) const {
        add_particle<simulation>(store, box, 1, {0, radius + normal_speed * time_step * phase},
                                 {along_speed, -normal_speed});
    }
};

/// A sphere on a floor under gravity, which may be a slope: it begins at rest or sliding, pressed in as far as its
/// weight presses it.
///
/// Reference: slip_to_roll; on a slope it rolls, at 5/7 g sin(theta). Kept from rolling by rolling_resistance it creeps
/// at g sin(theta) / gamma_t with coulomb, and rests with linear_history.
template <class Law = hooke_dashpot<coulomb>, class Integrator = velocity_verlet, class Number = double>
struct floor_scene {
    using simulation = dem::simulation<2, Number, Integrator, Law, walls, gravity>;

    Law law;
    double time_step;            ///< [s]
    double speed = 1;            ///< along the floor at the beginning [m/s]
    double slope = 0;            ///< [rad]
    double acceleration = 9.81;  ///< [m/s^2]
    double stiffness = 2e5;      ///< of the normal spring, for how far its weight presses it in [N/m]
    double radius = 0.5;         ///< [m]
    double mass = 1;             ///< [kg]
    bool is_watched = true;      ///< whether a time step past the limit is refused

    [[nodiscard]] auto box() const {
        return scene_box<simulation>({-1000 * radius, -2 * radius}, {1000 * radius, 10 * radius});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = radius, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const {
        return std::tuple(law, walls{{{.point = {0, 0}, .normal = {0, 1}}}},
                          gravity{{acceleration * std::sin(slope), -acceleration * std::cos(slope)}},
                          equal_spheres{radius, mass});
    }
    [[nodiscard]] static std::uint64_t count() noexcept { return 1; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t) const {
        const double pressed = mass * acceleration * std::cos(slope) / stiffness;
        add_particle<simulation>(store, box, 1, {0, radius - pressed}, {speed, 0});
    }
};

}  // namespace tsubu::dem
