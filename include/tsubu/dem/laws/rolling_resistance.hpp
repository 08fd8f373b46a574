// SPDX-License-Identifier: MIT
/// @file
/// rolling_resistance: a torque against rolling, from a spring and a dashpot.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// A torque against rolling: a rotational spring of stiffness k_r = 2.25 k_n (mu_r R*)^2 that yields at mu_r R* |F_n|,
/// and a dashpot until it yields.
///
/// Concept:       rolling_law.
/// Cost:          two roots, one quotient and some 40 products per contact in 3-D.
/// Bytes:         3 numbers, in 2-D one, for each pair of neighbours.
/// Deterministic: yes.
/// Choose it for heaps of grains that are not round. Needs a law of friction.
/// Do not against twisting, about the normal: it does not feel that.
/// Source:        Ai, Chen, Rotter & Ooi 2011, doi:10.1016/j.powtec.2010.09.030, model C, eqs. 13 to 20 (f = 0).
struct rolling_resistance {
    static constexpr auto role = contact_role::rolling;
    static constexpr bool resists = true;
    template <std::size_t D>
    static constexpr std::size_t history_size = spin_count<D>;
    double mu_r;       ///< coefficient of rolling resistance: tan of the steepest slope on which a sphere stays
    double eta_r = 0;  ///< share of the critical damping

    void check() const {
        detail::check_positive("dem::rolling_resistance", "coefficient mu_r", mu_r, "");
        detail::check_not_negative("dem::rolling_resistance", "damping eta_r", eta_r, "");
    }
    /// Of the rotational spring [N m/rad].
    [[nodiscard]] double stiffness(double normal_stiffness, double radius) const noexcept {
        return 2.25 * normal_stiffness * mu_r * radius * mu_r * radius;
    }
    /// Of its dashpot [N m s/rad].
    [[nodiscard]] double viscosity(double normal_stiffness, double mass, double radius) const noexcept {
        return 2 * eta_r * std::sqrt(1.4 * mass * radius * radius * stiffness(normal_stiffness, radius));
    }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<spin_count<D>, Real> torque(const contact<D, Real>& at,
                                                                      const Real& normal_force, const Real& stiffness,
                                                                      vec<spin_count<D>, Real>& spring) const noexcept {
        constexpr auto spins = spin_count<D>;
        auto turning = at.turning;
        if constexpr (D == 3) turning = tangential<3, Real>(turning, at.normal);  // twisting is not rolling
        const Real arm = constant<Real>(mu_r) * at.radius;
        const Real k_r = constant<Real>(2.25) * stiffness * arm * arm;
        // 7/5 m* R*^2 would be a sphere's inertia about the point of contact; of two, the effective one.
        const Real inertia = constant<Real>(1.4) * at.mass * at.radius * at.radius;
        const Real damping = constant<Real>(2 * eta_r) * lanewise::sqrt(inertia * k_r);
        spring = minus<spins, Real>(spring, scaled<spins, Real>(turning, k_r * at.time_step));
        if constexpr (D == 3) spring = tangential<3, Real>(spring, at.normal);
        const Real strength = lanewise::sqrt(dot<spins, Real>(spring, spring));
        const Real most = arm * lanewise::greatest(normal_force, -normal_force);
        const auto yields = strength > most;
        const Real share = lanewise::select(yields, most / strength, constant<Real>(1));
        spring = scaled<spins, Real>(spring, share);
        return vector_of<spins, Real>([&](auto k) __attribute__((always_inline)) {
            return spring[k] - lanewise::select(yields, constant<Real>(0), damping * turning[k]);
        });
    }
};
static_assert(rolling_law<rolling_resistance>);

}  // namespace tsubu::dem
