// SPDX-License-Identifier: MIT
/// @file
/// Masses on springs, between fixed ends.
#pragma once

#include <tsubu/dem/references.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/spheres.hpp>
#include <tsubu/dem/springs.hpp>
#include <tsubu/dem/stage.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/term.hpp>

#include <cmath>    // std::sin
#include <cstdint>  // std::int64_t, std::uint64_t
#include <limits>   // std::numeric_limits
#include <tuple>    // std::tuple

namespace tsubu::dem {

/// Masses in a row on springs, between two that are held fast, displaced along one mode: no contacts, no damping.
///
/// Reference: chain_frequency, verlet_frequency.
template <class Integrator = velocity_verlet, class Number = double>
struct chain_scene {
    using simulation = dem::simulation<1, Number, Integrator, springs, spheres>;

    double time_step;           ///< [s]
    std::uint64_t masses = 64;  ///< that move
    std::uint64_t mode = 1;     ///< 1 .. masses
    double amplitude = 1e-3;    ///< [m]
    double k = 1;               ///< [N/m]
    double mass = 1;            ///< [kg]
    double spacing = 1;         ///< [m]

    [[nodiscard]] auto box() const {
        return scene_box<simulation>({-spacing}, {spacing * static_cast<double>(masses + 2)});
    }
    [[nodiscard]] options how() const {
        return {.time_step = time_step, .skin = spacing / 2, .cutoff = 2 * spacing, .guard = no_guards};
    }
    [[nodiscard]] auto models() const { return std::tuple(springs{{{.k = k, .length = spacing}}}, spheres{}); }
    [[nodiscard]] std::uint64_t count() const noexcept { return masses + 2; }
    /// The displacement of mass n = 1 .. masses in the mode, for an amplitude of 1.
    [[nodiscard]] double shape(std::uint64_t n) const noexcept {
        return std::sin(static_cast<double>(mode * n) * pi / static_cast<double>(masses + 1));
    }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        const bool is_end = n == 0 || n == masses + 1;
        const double moved = is_end ? 0 : amplitude * shape(n);
        const auto id = static_cast<std::int64_t>(n);
        const auto i = add_particle<simulation>(store, box, id, {spacing * static_cast<double>(n) + moved});
        store[tsubu::radius][i] = spacing / 4;
        store[tsubu::mass][i] = is_end ? std::numeric_limits<double>::infinity() : mass;
        const auto bonds = store[tsubu::bonds][i];
        if (n > 0) bonds.push_back({.type = 1, .ids = {id - 1, id}});
        if (n <= masses) bonds.push_back({.type = 1, .ids = {id, id + 1}});
    }
};

}  // namespace tsubu::dem
