// SPDX-License-Identifier: MIT
/// @file
/// Two spheres that collide head on.
#pragma once

#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include <cstdint>  // std::int64_t, std::uint64_t
#include <tuple>    // std::tuple

namespace tsubu::dem {

/// Two equal spheres that collide head on: one normal law and nothing else.
///
/// Reference: dashpot_impact, hertz_impact, tsuji_restitution.
template <class Law = hooke<>, class Integrator = velocity_verlet, class Number = double>
struct pair_scene {
    using simulation = dem::simulation<1, Number, Integrator, Law>;

    Law law;
    double time_step;     ///< [s]
    double speed = 1;     ///< of approach [m/s]
    double phase = 0.5;   ///< share of a step from the beginning to the touch, and some whole ones
    double radius = 0.5;  ///< [m]
    double mass = 1;      ///< [kg]
    double origin = 0;    ///< where the middle is [m]
    std::int64_t first_id = 1;  ///< that of the first particle; the other follows
    bool is_watched = true;  ///< whether a time step past the limit is refused

    [[nodiscard]] auto box() const { return scene_box<simulation>({origin - 4 * radius}, {origin + 4 * radius}); }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = radius, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(law, equal_spheres{radius, mass}); }
    [[nodiscard]] static std::uint64_t count() noexcept { return 2; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        const double side = n == 0 ? -1 : 1;
        const double gap = speed * time_step * phase;
        add_particle<simulation>(store, box, first_id + static_cast<std::int64_t>(n),
                                 {origin + side * (radius + gap / 2)}, {-side * speed / 2});
    }
};

}  // namespace tsubu::dem
