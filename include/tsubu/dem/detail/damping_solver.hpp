// SPDX-License-Identifier: MIT
/// @file
/// The damping of all contacts at the velocities of the end of a step, which depend on it.
#pragma once

#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/store/field.hpp>

#include <algorithm>  // std::max
#include <cmath>      // std::abs
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <string>     // std::to_string
#include <vector>     // std::vector

namespace tsubu::dem::detail {

/// A damped contact while it is solved for: the force along the normal is `elastic` + `damping`.
template <std::size_t D>
struct damped_contact {
    index_t i;
    index_t j;              ///< absent: a wall
    vec<D, double> normal;  ///< from j to i
    double elastic;         ///< force [N]
    double coefficient;     ///< c of the force -c v [kg/s]
    double inverse_mass;    ///< effective, 1/m* [1/kg]
    double damping = 0;     ///< force [N]
};

/// Adds the damping of all contacts to the forces, as it is with the velocities at the end of a half step, which it
/// changes itself: of each contact in turn the force that fits the others, until none changes.
/// Collective: a forward and a reduction for each round. @throws input_error if that does not come to rest.
template <class Run>
void solve_damping(Run& of, double half_step) {
    using simulation = typename Run::simulation_type;
    using quantities = typename simulation::quantities_type;
    using real = typename simulation::real;
    using law_type = typename simulation::contact_type;
    constexpr auto D = simulation::dimension;
    constexpr auto solved = simulation::integrator_type::template solved<quantities>;
    auto& store = of.store_;
    const auto& law = of.template model<law_type>();

    std::vector<damped_contact<D>> contacts;
    of.each_contact([&](const auto& pair) {
        if (pair.at.mass == 0) return;
        contacts.push_back({pair.i, pair.is_wall ? absent : pair.j, pair.at.normal,
                            law.normal().elastic(pair.at.overlap, pair.at.radius),
                            law.normal().damping(pair.at.overlap, pair.at.mass, pair.at.radius), 1 / pair.at.mass});
    });
    const auto v = store[solved];
    for (std::size_t i = 0; i < store.owned_count(); ++i) {
        const auto a = of.acceleration(i);
        for (std::size_t k = 0; k < D; ++k)
            v[i][k] = store[quantities::velocity][i][k] + static_cast<real>(half_step) * a[k];
    }
    constexpr int most_rounds = 10000;
    for (int round = 0;; ++round) {
        of.near_.forward(store, fields<simulation::integrator_type::template solved<quantities>>{});
        double changes[2] = {0, 0};  // of velocities, and how great these are
        for (auto& one : contacts) {
            double separation = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const double of_j = one.j == absent ? 0 : static_cast<double>(v[one.j][k]);
                separation += one.normal[k] * (static_cast<double>(v[one.i][k]) - of_j);
            }
            const double free = separation - half_step * one.damping * one.inverse_mass;
            double wanted = -one.coefficient * free / (1 + one.coefficient * half_step * one.inverse_mass);
            if constexpr (law_type::release_type::never_pulls) wanted = (std::max)(wanted, -one.elastic);
            const double impulse = half_step * (wanted - one.damping);
            one.damping = wanted;
            for (std::size_t k = 0; k < D; ++k) {
                v[one.i][k] += static_cast<real>(impulse / of.mass(one.i) * one.normal[k]);
                if (one.j != absent) v[one.j][k] -= static_cast<real>(impulse / of.mass(one.j) * one.normal[k]);
            }
            changes[0] = (std::max)(changes[0], std::abs(impulse) * one.inverse_mass);
            // What rounds: velocities, and what the forces of half a step add to them.
            changes[1] = (std::max)({changes[1], std::abs(separation), std::abs(free),
                                     half_step * one.inverse_mass * (std::abs(one.elastic) + std::abs(wanted))});
        }
        of.on().reduce(std::span<double>(changes), reduction::greatest);
        constexpr double tolerance = 4 * static_cast<double>(std::numeric_limits<real>::epsilon());
        // What has all but come to rest moves by denormal numbers, which have no relative precision.
        constexpr double least = static_cast<double>((std::numeric_limits<real>::min)());
        if (!(changes[0] > tolerance * changes[1] + least)) break;
        if (round == most_rounds)
            tsubu::detail::raise<input_error>("dem::implicit_velocity_verlet",
                                              "damping that does not settle in " + std::to_string(most_rounds) +
                                                  " rounds",
                                              "take a smaller time step, or velocity_verlet");
    }
    const auto f = store[quantities::force];
    for (const auto& one : contacts)
        for (std::size_t k = 0; k < D; ++k) {
            f[one.i][k] += static_cast<real>(one.damping * one.normal[k]);
            if (one.j != absent) f[one.j][k] -= static_cast<real>(one.damping * one.normal[k]);
        }
}

}  // namespace tsubu::dem::detail
