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
#include <tsubu/store/standard_fields.hpp>

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
    double time_step;              ///< [s]
    std::uint64_t cells = 6;       ///< along each edge, of four spheres each
    double compression = 1e-2;     ///< overlap of neighbours, in diameters
    double speed = 1e-6;           ///< of each component at the beginning, at most [m/s]
    double radius = 0.5;           ///< [m]
    double mass = 1;               ///< [kg]
    bool is_watched = false;       ///< whether a time step past the limit is refused

    [[nodiscard]] double edge() const noexcept { return 2 * radius * (1 - compression) * std::sqrt(2.0); }
    [[nodiscard]] auto box() const {
        const double length = edge() * static_cast<double>(cells);
        return typename simulation::box_type({0, 0, 0}, {length, length, length}, {.periodic = {true, true, true}});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step,
                .skin = 0.2 * radius,
                .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(law, equal_spheres{radius, mass}); }
    [[nodiscard]] std::uint64_t count() const noexcept { return 4 * cells * cells * cells; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        using real = typename simulation::real;
        // A corner and the middles of three faces, a quarter of an edge away from the faces of the box.
        constexpr double basis[4][3] = {{.25, .25, .25}, {.75, .75, .25}, {.75, .25, .75}, {.25, .75, .75}};
        const auto cell = n / 4;
        const std::uint64_t place[3] = {cell % cells, cell / cells % cells, cell / cells / cells};
        vec<3> x{};
        vec<3, real> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = edge() * (static_cast<double>(place[k]) + basis[n % 4][k]);
            const double u = static_cast<double>(splitmix64(8 * n + k) >> 11) * 0x1p-53;
            v[k] = static_cast<real>(speed * (2 * u - 1));
        }
        using position = typename Box::real_position_type;
        position at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<typename position::value_type>(x[k]);
        const auto i = store.push_back(tsubu::id = static_cast<std::int64_t>(n + 1),
                                       simulation::quantities_type::velocity = v);
        put<typename simulation::quantities_type>(store, static_cast<std::size_t>(i), box, at);
    }
};

}  // namespace tsubu::dem
