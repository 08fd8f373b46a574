// SPDX-License-Identifier: MIT
/// @file
/// Spheres that settle on a floor.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/dem/walls.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <tuple>        // std::tuple
#include <type_traits>  // std::is_same_v

namespace tsubu::dem {

/// Spheres fall onto a floor and come to rest: gravity, a floor, periodic along x and y.
///
/// Reference, of the default: LAMMPS' gran/hooke/history, kinetic energy 1386.7640192413, energy of rotation
/// 45.855867894931 and mean height 14.981043924235 at step 1000; a packing of .591 with 4.65 contacts in the end.
template <class Law = hooke_dashpot<linear_history>, class Integrator = velocity_verlet, class Number = double>
struct settle_scene {
    using simulation = dem::simulation<3, Number, Integrator, Law, walls, gravity>;

    Law law = default_law();
    double time_step = 2e-4;                         ///< [s]
    std::array<std::uint64_t, 3> cells{20, 20, 25};  ///< particles along x, y, z at the beginning
    double skin = 0.1;                               ///< [m]
    bool is_watched = true;                          ///< whether guards watch

    static constexpr double spacing = 1.2;  ///< [m]

    /// k_n 2e5, k_t 2/7 k_n, gamma_n 50, mu .5, where the law is of this kind.
    [[nodiscard]] static Law default_law() {
        if constexpr (std::is_same_v<Law, hooke_dashpot<linear_history>>)
            return Law{{.k = 2e5, .gamma = 50}, {.k_t = 2e5 * 2 / 7, .mu = 0.5}};
        else if constexpr (std::is_same_v<Law, hooke_dashpot<>>)
            return Law{{.k = 2e5, .gamma = 50}};
        else
            return Law{};
    }
    [[nodiscard]] auto box() const {
        return scene_box<simulation>({0, 0, -1},
                                     {spacing * static_cast<double>(cells[0]), spacing * static_cast<double>(cells[1]),
                                      spacing * static_cast<double>(cells[2]) + 2},
                                     {true, true, false});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = skin, .guard = is_watched ? guards{} : no_guards};
    }
    [[nodiscard]] auto models() const {
        return std::tuple(law, walls{{{.point = {0, 0, 0}, .normal = {0, 0, 1}}}}, gravity{{0, 0, -1}},
                          equal_spheres{.radius = 0.5, .mass = 1});
    }
    [[nodiscard]] std::uint64_t count() const noexcept { return cells[0] * cells[1] * cells[2]; }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        const auto id = n + 1;
        const std::uint64_t cell[3] = {n % cells[0], n / cells[0] % cells[1], n / cells[0] / cells[1]};
        vec<3> x{};
        vec<3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto signed_unit = [&](std::size_t c) {
                return 2 * (static_cast<double>(splitmix64(12345 + 8 * id + c) >> 11) * 0x1p-53) - 1;
            };
            x[k] = (static_cast<double>(cell[k]) + 0.5) * spacing + 0.08 * signed_unit(k);
            v[k] = 0.5 * signed_unit(3 + k);
        }
        add_particle<simulation>(store, box, static_cast<std::int64_t>(id), x, v);
    }
};

}  // namespace tsubu::dem
