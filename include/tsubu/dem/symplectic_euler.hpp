// SPDX-License-Identifier: MIT
/// @file
/// symplectic_euler: a kick, then a drift.
#pragma once

#include <tsubu/dem/integrator.hpp>
#include <tsubu/store/field.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// A kick with the forces of the old positions, then a drift with the new velocities.
///
/// Concept: integrator. Cost: one force evaluation per step; bytes: none of its own; deterministic.
/// Order: 1; energy does not drift.
/// Choose it to reproduce codes that have it. Do not otherwise: velocity_verlet costs the same and has order 2.
struct symplectic_euler {
    static constexpr unsigned force_evaluations = 1;
    static constexpr bool moves_spins = true;
    static constexpr bool solves_damping = false;
    /// 2 (sqrt(1 + z^2) - z), as a quotient: the difference rounds to 0.
    [[nodiscard]] static double stable_until(double z) noexcept { return 2 / (std::sqrt(1 + z * z) + z); }
    template <class Q>
    using keeps = fields<>;

    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        for (std::size_t n = 0; n < steps; ++n) {
            run.template kick_and_drift<false>(h, h);
            run.evaluate_forces();
            run.end_step();
        }
    }
};
static_assert(integrator<symplectic_euler>);

}  // namespace tsubu::dem
