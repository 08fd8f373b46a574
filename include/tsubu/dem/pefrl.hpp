// SPDX-License-Identifier: MIT
/// @file
/// pefrl: a symplectic method of fourth order.
#pragma once

#include <tsubu/dem/integrator.hpp>
#include <tsubu/store/field.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// Drifts and kicks in turn, four of these, with coefficients that keep the error of fourth order small.
///
/// Concept: integrator. Cost: four force evaluations per step; bytes: none of its own; deterministic.
/// Order: 4 for smooth forces; of a contact what that allows: 2 to 2.5. Damping sees the velocities of the stages.
/// Choose it for smooth problems at high accuracy: modes of bonded chains. Do not for collisions: at equal cost
/// velocity_verlet is more accurate. Contacts that remember do not compile with it.
/// Source: Omelyan, Mryglod & Folk 2002, eqs. 20 and 22, doi:10.1016/S0010-4655(02)00451-4.
struct pefrl {
    static constexpr unsigned force_evaluations = 4;
    static constexpr bool moves_spins = true;
    static constexpr bool solves_damping = false;
    /// Numerically, rounded down: it is not smooth in z. 2.55 is the least of all z in (0, .25], at z = .1; beyond, it
    /// is above 1.16 times that of velocity_verlet.
    [[nodiscard]] static double stable_until(double z) noexcept {
        if (z == 0) return 2.98;
        return z <= 0.25 ? 2.55 : 1.16 * 2 / (std::sqrt(1 + z * z) + z);
    }
    template <class Q>
    using keeps = fields<>;

    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        constexpr double xi = 0.1786178958448091;
        constexpr double lambda = -0.2123418310626054;
        constexpr double chi = -0.06626458266981849;
        for (std::size_t n = 0; n < steps; ++n) {
            stage(run, xi * h, (1 - 2 * lambda) * h / 2);
            stage(run, chi * h, lambda * h);
            stage(run, (1 - 2 * (chi + xi)) * h, lambda * h);
            stage(run, chi * h, (1 - 2 * lambda) * h / 2);
            run.drift(xi * h);
            run.end_step();
        }
        run.clear_forces();
        run.evaluate_forces();  // of the positions that are left
    }

private:
    template <class Run>
    static void stage(Run& run, double drifted, double kicked) {
        run.drift(drifted);
        run.clear_forces();
        run.evaluate_forces();
        run.kick(kicked);
    }
};
static_assert(integrator<pefrl>);

}  // namespace tsubu::dem
