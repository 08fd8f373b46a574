// SPDX-License-Identifier: MIT
/// @file
/// A face-centred cubic crystal of spheres that touch.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t, std::uint64_t
#include <tuple>    // std::tuple

namespace tsubu::dem {

/// Spheres in a face-centred cubic crystal, pressed together a little, periodic, with small random velocities: elastic
/// contacts that stay, and nothing else.
///
/// Reference: dt_c = 2 / sqrt(8 k / m).
template <class Law = hooke<>, class Integrator = velocity_verlet, class Number = double>
struct crystal_scene {
    using simulation = dem::simulation<3, Number, Integrator, Law>;

    Law law;
    double time_step;           ///< [s]
    std::uint64_t cells = 6;    ///< along each edge, of four spheres each
    double compression = 1e-2;  ///< overlap of neighbours, in diameters
    double speed = 1e-6;        ///< of each component at the beginning, at most [m/s]
    double radius = 0.5;        ///< [m]
    double mass = 1;            ///< [kg]
    bool is_watched = false;    ///< whether a time step past the limit is refused

    [[nodiscard]] double edge() const noexcept { return 2 * radius * (1 - compression) * std::sqrt(2.0); }
    [[nodiscard]] auto box() const {
        const double length = edge() * static_cast<double>(cells);
        return scene_box<simulation>({0, 0, 0}, {length, length, length}, {true, true, true});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = 0.2 * radius, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(law, equal_spheres{radius, mass}); }
    [[nodiscard]] std::uint64_t count() const noexcept { return 4 * cells * cells * cells; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        // A corner and the middles of three faces, a quarter of an edge away from the faces of the box.
        constexpr double basis[4][3] = {{.25, .25, .25}, {.75, .75, .25}, {.75, .25, .75}, {.25, .75, .75}};
        const auto cell = n / 4;
        const std::uint64_t place[3] = {cell % cells, cell / cells % cells, cell / cells / cells};
        vec<3> x{};
        vec<3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = edge() * (static_cast<double>(place[k]) + basis[n % 4][k]);
            const double u = static_cast<double>(splitmix64(8 * n + k) >> 11) * 0x1p-53;
            v[k] = speed * (2 * u - 1);
        }
        add_particle<simulation>(store, box, static_cast<std::int64_t>(n + 1), x, v);
    }
};

}  // namespace tsubu::dem
