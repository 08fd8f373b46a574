// SPDX-License-Identifier: MIT
/// @file
/// A sphere that bounces on a floor.
#pragma once

#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/dem/walls.hpp>

#include <cstdint>  // std::uint64_t
#include <tuple>    // std::tuple

namespace tsubu::dem {

/// A sphere that falls on a floor, again and again: one dimension, one wall, gravity.
///
/// Reference: bouncing_ball.
template <class Law = hooke_dashpot<>, class Integrator = velocity_verlet, class Number = double>
struct bounce_scene {
    using simulation = dem::simulation<1, Number, Integrator, Law, walls, gravity>;

    Law law;
    double time_step;            ///< [s]
    double height = 0.5;         ///< of the centre at the beginning [m]
    double radius = 0.2;         ///< [m]
    double mass = 1;             ///< [kg]
    double acceleration = 9.81;  ///< [m/s^2]

    [[nodiscard]] auto box() const { return scene_box<simulation>({-height}, {3 * height}); }
    [[nodiscard]] options how() const { return {.time_step = time_step, .skin = radius}; }
    [[nodiscard]] auto models() const {
        return std::tuple(law, walls{{{.point = {0}, .normal = {1}}}}, gravity{{-acceleration}},
                          equal_spheres{radius, mass});
    }
    [[nodiscard]] static std::uint64_t count() noexcept { return 1; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t) const {
        add_particle<simulation>(store, box, 1, {height});
    }
};

}  // namespace tsubu::dem
