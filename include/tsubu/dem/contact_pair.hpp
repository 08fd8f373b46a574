// SPDX-License-Identifier: MIT
/// @file
/// contact_pair: two bodies that touch, as they are shown to whoever walks the contacts.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/neighbor/pair_list.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t
#include <span>     // std::span

namespace tsubu::dem {

/// Two bodies that touch: i is an owned particle; j may be a ghost, or, if it is a wall, its number.
template <std::size_t D>
struct contact_pair {
    index_t i;
    index_t j;
    bool is_wall;
    contact<D, double> at;  ///< with velocities, and without spins and time step
};

namespace detail {

/// body(contact_pair) for each pair of the lists that overlaps; of the pairs across a border each side has one.
template <class Simulation, class Body>
void each_contact(const columns<Simulation>& of, std::span<const index_pair> pairs,
                   std::span<const index_pair> near_walls, std::span<const wall_plane<Simulation::dimension>> walls,
                   Body&& body) {
    constexpr auto D = Simulation::dimension;
    const auto velocity = [&](index_t i, std::size_t k) { return static_cast<double>(of.v[i][k]); };
    for (const auto [i, j] : pairs) {
        vec<D, double> d;
        double square = 0;
        for (std::size_t k = 0; k < D; ++k) {
            d[k] = static_cast<double>(of.apart(k, i, j));
            square += d[k] * d[k];
        }
        const double r_i = static_cast<double>(of.radius_at(i));
        const double r_j = static_cast<double>(of.radius_at(j));
        if (!(square < (r_i + r_j) * (r_i + r_j))) continue;
        const double distance = std::sqrt(square);
        contact_pair<D> pair{i, j, false, {}};
        pair.at.overlap = r_i + r_j - distance;
        pair.at.mass = effective_mass(static_cast<double>(of.mass_at(i)), static_cast<double>(of.mass_at(j)));
        pair.at.radius = r_i * r_j / (r_i + r_j);
        for (std::size_t k = 0; k < D; ++k) {
            pair.at.normal[k] = d[k] / distance;
            pair.at.velocity[k] = velocity(i, k) - velocity(j, k);
        }
        body(pair);
    }
    for (const auto [i, w] : near_walls) {
        const auto& wall = walls[static_cast<std::size_t>(w)];
        const double radius = static_cast<double>(of.radius_at(i));
        const double distance = wall.distance(of.real_position(i));
        if (!(distance < radius)) continue;
        contact_pair<D> pair{i, w, true, {}};
        pair.at.overlap = radius - distance;
        pair.at.mass = effective_mass(static_cast<double>(of.mass_at(i)), mass_of_wall);
        pair.at.radius = radius;
        for (std::size_t k = 0; k < D; ++k) {
            pair.at.normal[k] = wall.normal[k];
            pair.at.velocity[k] = velocity(i, k);
        }
        body(pair);
    }
}

}  // namespace detail
}  // namespace tsubu::dem
