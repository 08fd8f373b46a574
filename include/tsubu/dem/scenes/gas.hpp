// SPDX-License-Identifier: MIT
/// @file
/// A gas of spheres, or of disks, that collide.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include <array>    // std::array
#include <cmath>    // std::cbrt, std::sqrt
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t, std::uint64_t
#include <tuple>    // std::tuple

namespace tsubu::dem {

/// Frictionless spheres (in 2-D disks) in a periodic box, on a jittered grid at the beginning, with random velocities
/// of variance 1 for each component.
///
/// Reference: energy and momentum if it is elastic; haff_cooling if not.
template <class Law = hooke<>, class Integrator = velocity_verlet, class Number = double, std::size_t D = 3>
struct gas_scene {
    using simulation = dem::simulation<D, Number, Integrator, Law>;

    Law law;
    double time_step;             ///< [s]
    std::uint64_t per_edge = 22;  ///< particles along each edge
    double fraction = 0.05;       ///< of the volume (in 2-D of the area) that is filled; above .065 (in 2-D .196)
                                  ///< some overlap at the beginning
    double skin = 0.3;            ///< [m]
    double radius = 0.5;          ///< [m]
    double mass = 1;              ///< [kg]
    double origin = 0;            ///< the lower face of the box along each axis [m]
    std::int64_t first_id = 1;    ///< that of the first particle; the others follow
    bool is_watched = true;  ///< whether a time step past the limit, and coordinates that freeze, are refused

    /// The distance of neighbours on the grid [m].
    [[nodiscard]] double spacing() const noexcept {
        const double d = 2 * radius;
        if constexpr (D == 3) return d * std::cbrt(pi / 6 / fraction);
        if constexpr (D == 2) return d * std::sqrt(pi / 4 / fraction);
        return d / fraction;
    }
    [[nodiscard]] auto box() const {
        vec<D> lo{};
        vec<D> hi{};
        std::array<bool, D> periodic{};
        lo.fill(origin);
        hi.fill(origin + spacing() * static_cast<double>(per_edge));
        periodic.fill(true);
        return scene_box<simulation>(lo, hi, periodic);
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = skin, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(law, equal_spheres{radius, mass}); }
    [[nodiscard]] std::uint64_t count() const noexcept {
        std::uint64_t all = 1;
        for (std::size_t k = 0; k < D; ++k) all *= per_edge;
        return all;
    }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        vec<D> x{};
        vec<D> v{};
        auto rest = n;
        for (std::size_t k = 0; k < D; ++k) {
            // 2 u - 1 with 53 random bits of particle and component
            const auto signed_unit = [&](std::size_t c) {
                return 2 * (static_cast<double>(splitmix64(12345 + 8 * (n + 1) + c) >> 11) * 0x1p-53) - 1;
            };
            const double cell = static_cast<double>(rest % per_edge);
            rest /= per_edge;
            x[k] = origin + ((cell + 0.5) * spacing() + 0.25 * spacing() * signed_unit(k));
            v[k] = std::sqrt(3.0) * signed_unit(3 + k);
        }
        add_particle<simulation>(store, box, first_id + static_cast<std::int64_t>(n), x, v);
    }
};

/// Disks: two dimensions, no spin.
template <class Law = hooke<>, class Integrator = velocity_verlet, class Number = double>
using disks_scene = gas_scene<Law, Integrator, Number, 2>;

}  // namespace tsubu::dem
