// SPDX-License-Identifier: MIT
/// @file
/// explicit_euler: why not.
#pragma once

#include <tsubu/dem/integrator.hpp>
#include <tsubu/store/field.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// A drift with the old velocities, and a kick with the old forces.
///
/// Concept: integrator. Cost: one force evaluation per step; bytes: none of its own; deterministic.
/// Order: 1; each contact gains energy, by (omega dt)^2 per step: without damping it is stable for no time step.
/// Choose it to see that. Do not otherwise.
struct explicit_euler {
    static constexpr unsigned force_evaluations = 1;
    static constexpr bool moves_spins = true;
    static constexpr bool solves_damping = false;
    /// Not at all, without damping.
    [[nodiscard]] static double stable_until(double z) noexcept {
        return z < 1 ? 2 * z : 2 / (z + std::sqrt(z * z - 1));
    }
    template <class Q>
    using keeps = fields<>;

    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        for (std::size_t n = 0; n < steps; ++n) {
            run.drift(h);
            run.kick(h);
            run.clear_forces();
            run.evaluate_forces();
            run.end_step();
        }
    }
};
static_assert(integrator<explicit_euler>);

}  // namespace tsubu::dem
