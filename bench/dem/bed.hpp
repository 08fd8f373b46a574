// SPDX-License-Identifier: MIT
/// @file
/// A dense bed of spheres, the same for all that is measured in one, and for LAMMPS.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/walls.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/io/lammps_fields.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <string>       // std::string
#include <tuple>        // std::tuple
#include <type_traits>  // std::conditional_t

namespace bench {

using bed_store = tsubu::particle_store<
    tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>, tsubu::angular_velocity<3>,
                  tsubu::radius, tsubu::density>>;

constexpr double bed_edge = 24;    // along x and y, periodic [m]
constexpr double bed_height = 32;  // of the box [m]

/// Where the bed is kept, a LAMMPS data file under the build directory.
[[nodiscard]] const std::string& bed_file();
/// 10000 spheres, d = 1, m = 1, that have settled: made once, and kept.
[[nodiscard]] const bed_store& settled_bed();

/// Where a bed lies.
enum class bed_place {
    on_floor,  ///< gravity, a floor, periodic along x and y
    free,      ///< nothing around it: no ghosts, and nothing but contacts
};

/// The settled bed, with another law, integrator, number, or bodies.
template <class Law, class Integrator, class Number = double, class Bodies = tsubu::dem::equal_spheres,
          bed_place Place = bed_place::on_floor>
struct bed_scene {
    using simulation = std::conditional_t<
        Place == bed_place::free, tsubu::dem::simulation<3, Number, Integrator, Law>,
        tsubu::dem::simulation<3, Number, Integrator, Law, tsubu::dem::walls, tsubu::dem::gravity, Bodies>>;
    static constexpr bool is_free = Place == bed_place::free;

    Law law;
    double time_step = 2e-4;
    double skin = 0.1;

    [[nodiscard]] auto box() const {
        using box_type = typename simulation::box_type;
        using number = typename box_type::real_type;
        constexpr number around = is_free ? 10 : 0;
        return box_type({-around, -around, -1 - around},
                        {number(bed_edge) + around, number(bed_edge) + around, number(bed_height) + around},
                        {.periodic = {!is_free, !is_free, tsubu::is_lattice<typename simulation::coordinate>}});
    }
    [[nodiscard]] tsubu::dem::options how() const {
        return {.time_step = time_step, .skin = skin, .guard = tsubu::dem::no_guards};
    }
    [[nodiscard]] auto models() const {
        if constexpr (is_free) {
            return std::tuple(law, tsubu::dem::equal_spheres{0.5, 1});
        } else {
            const auto bodies = [] {
                if constexpr (Bodies::are_equal)
                    return Bodies{0.5, 1};
                else
                    return Bodies{};
            };
            return std::tuple(law, tsubu::dem::walls{{{.point = {0, 0, 0}, .normal = {0, 0, 1}}}},
                              tsubu::dem::gravity{{0, 0, -1}}, bodies());
        }
    }
    [[nodiscard]] static std::uint64_t count() { return settled_bed().owned_count(); }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        using q = typename simulation::quantities_type;
        const auto& bed = settled_bed();
        const auto& from = bed[tsubu::position<3>][static_cast<std::size_t>(n)];
        typename Box::real_position_type x{};
        tsubu::vec<3, typename simulation::real> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = static_cast<typename Box::real_type>(from[k]);
            v[k] = static_cast<typename simulation::real>(bed[tsubu::velocity<3>][static_cast<std::size_t>(n)][k]);
        }
        const auto name = bed[tsubu::id][static_cast<std::size_t>(n)];
        const auto i = static_cast<std::size_t>(store.push_back(tsubu::id = name, q::velocity = v));
        tsubu::dem::put<q>(store, i, box, x);
        if constexpr (!Bodies::are_equal) {
            store[tsubu::radius][i] = 0.5;
            store[tsubu::mass][i] = 1;
        }
        if constexpr (simulation::turns)
            for (std::size_t k = 0; k < 3; ++k)
                store[q::angular_velocity][i][k] = static_cast<typename simulation::real>(
                    bed[tsubu::angular_velocity<3>][static_cast<std::size_t>(n)][k]);
    }
};

/// Gravity and nothing else: what is left of a scene without contacts.
template <class Integrator>
struct falling_scene {
    using simulation = tsubu::dem::simulation<3, double, Integrator, tsubu::dem::gravity>;

    [[nodiscard]] auto box() const {
        return typename simulation::box_type({0, 0, -1e6}, {bed_edge, bed_edge, bed_height},
                                             {.periodic = {true, true, false}});
    }
    [[nodiscard]] tsubu::dem::options how() const {
        return {.time_step = 2e-4, .skin = 0.1, .guard = tsubu::dem::no_guards};
    }
    [[nodiscard]] auto models() const {
        return std::tuple(tsubu::dem::gravity{{0, 0, -1}}, tsubu::dem::equal_spheres{0.5, 1});
    }
    [[nodiscard]] static std::uint64_t count() { return settled_bed().owned_count(); }
    template <class Store, class Box>
    void place(Store& store, const Box&, std::uint64_t n) const {
        using q = typename simulation::quantities_type;
        store.push_back(tsubu::id = settled_bed()[tsubu::id][static_cast<std::size_t>(n)],
                        q::position = settled_bed()[tsubu::position<3>][static_cast<std::size_t>(n)]);
    }
};

/// The laws of the dense bed, those of the scenes of LAMMPS: E 1e7 Pa, nu .25, so E* = 5.33e6 Pa and G* = 1.14e6 Pa.
constexpr double bed_modulus = 1e7 / (2 * (1 - 0.25 * 0.25));
constexpr double bed_shear_modulus = 1e7 / (4 * (2 - 0.25) * (1 + 0.25));
constexpr double bed_tsuji = 0.05289813379999764;  // the polynomial of Tsuji 1992 at a restitution of .9
constexpr double bed_stiffness = 2e5;

}  // namespace bench
