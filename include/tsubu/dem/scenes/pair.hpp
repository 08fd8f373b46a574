// SPDX-License-Identifier: MIT
/// @file
/// Two spheres that collide head on.
#pragma once

#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>  // std::size_t
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
    double time_step;             ///< [s]
    double speed = 1;             ///< of approach [m/s]
    double phase = 0.5;           ///< share of a step from the beginning to the touch, and some whole ones
    double radius = 0.5;          ///< [m]
    double mass = 1;              ///< [kg]
    double origin = 0;            ///< where the middle is [m]
    std::int64_t first_id = 1;
    bool is_watched = true;       ///< whether a time step past the limit is refused

    [[nodiscard]] auto box() const {
        // A lattice is periodic: the spheres are far from its faces.
        const bool is_periodic = is_lattice<typename simulation::coordinate>;
        using number = typename simulation::box_type::real_type;
        return typename simulation::box_type({static_cast<number>(origin - 4 * radius)},
                                             {static_cast<number>(origin + 4 * radius)}, {.periodic = {is_periodic}});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = radius, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(law, equal_spheres{radius, mass}); }
    [[nodiscard]] static std::uint64_t count() noexcept { return 2; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        using real = typename simulation::real;
        using number = typename Box::real_type;
        const double side = n == 0 ? -1 : 1;
        const double gap = speed * time_step * phase;
        const auto i = store.push_back(
            tsubu::id = first_id + static_cast<std::int64_t>(n),
            simulation::quantities_type::velocity = {static_cast<real>(-side * speed / 2)});
        put<typename simulation::quantities_type>(store, static_cast<std::size_t>(i), box,
                                                  {static_cast<number>(origin + side * (radius + gap / 2))});
    }
};

}  // namespace tsubu::dem
