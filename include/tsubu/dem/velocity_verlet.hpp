// SPDX-License-Identifier: MIT
/// @file
/// velocity_verlet: half a kick, a drift, half a kick.
#pragma once

#include <tsubu/dem/integrator.hpp>
#include <tsubu/store/field.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// Half a kick, a drift, half a kick; damping sees the velocities of the half step, as in LAMMPS.
///
/// Concept: integrator. Cost: one force evaluation per step; bytes: none of its own; deterministic.
/// Order: 2, or what the contact allows; 1 with a dashpot. Stable for omega dt < 2 (sqrt(1 + z^2) - z), z the damping
/// ratio.
/// Choose it unless a measurement says otherwise: at equal cost nothing is more accurate in collisions.
/// Do not when damping is strong (implicit_velocity_verlet), or forces are smooth and errors are to be small (pefrl).
/// Source: Swope, Andersen, Berens & Wilson 1982, doi:10.1063/1.442716.
struct velocity_verlet {
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
            // The end of the last step and the beginning of this one are one pass.
            if (n == 0)
                run.template kick_and_drift<false>(h / 2, h);
            else
                run.template kick_and_drift<true>(h / 2, h);
            run.evaluate_forces();
            run.end_step();
        }
        if (steps != 0) run.kick(h / 2);
    }
};
static_assert(integrator<velocity_verlet>);

}  // namespace tsubu::dem
