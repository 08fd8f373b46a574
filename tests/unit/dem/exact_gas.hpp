// SPDX-License-Identifier: MIT
/// @file
/// A gas whose box and positions can be told exactly at all origins up to 1e9: they are multiples of 2^-20.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/dem/scenes/gas.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

template <class Law, class Number>
struct exact_gas : tsubu::dem::gas_scene<Law, tsubu::dem::velocity_verlet, Number> {
    using simulation = typename tsubu::dem::gas_scene<Law, tsubu::dem::velocity_verlet, Number>::simulation;

    double pitch = 2;    ///< of the grid; its product with per_edge is a multiple of 2^-20 [m]
    double jitter = .4;  ///< about it [m]

    [[nodiscard]] auto box() const {
        const double lo = this->origin;
        const double hi = lo + pitch * static_cast<double>(this->per_edge);
        return tsubu::dem::scene_box<simulation>({lo, lo, lo}, {hi, hi, hi}, {true, true, true});
    }
    template <class Store, class Box>
    void place(Store& store, const Box& box, std::uint64_t n) const {
        tsubu::vec<3> x{};
        tsubu::vec<3> v{};
        auto rest = n;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto signed_unit = [&](std::uint64_t c) {
                return 2 * (static_cast<double>(tsubu::splitmix64(8 * n + c) >> 11) * 0x1p-53) - 1;
            };
            const double at = pitch * (static_cast<double>(rest % this->per_edge) + .5) + jitter * signed_unit(k);
            rest /= this->per_edge;
            x[k] = this->origin + std::nearbyint(at * 0x1p20) * 0x1p-20;
            v[k] = signed_unit(3 + k);
        }
        tsubu::dem::add_particle<simulation>(store, box, this->first_id + static_cast<std::int64_t>(n), x, v);
    }
};
