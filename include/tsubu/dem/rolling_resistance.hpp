// SPDX-License-Identifier: MIT
/// @file
/// rolling_resistance: a torque against rolling, from a spring and a dashpot.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/normal_laws.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// No torque against rolling.
struct free_rolling {
    static constexpr auto role = contact_role::rolling;
    static constexpr bool resists = false;
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
    void check() const {}
};

/// A torque against rolling: a rotational spring of stiffness k_r = 2.25 k_n (mu_r R*)^2 that yields at mu_r R* |F_n|,
/// and a dashpot until it yields.
///
/// Choose it for heaps of grains that are not round. Needs a law of friction. Bytes: 3 numbers (in 2-D one) for each
/// pair of neighbours.
/// Source: Ai, Chen, Rotter & Ooi 2011, doi:10.1016/j.powtec.2010.09.030, model C, eqs. 13 to 20 (f = 0).
struct rolling_resistance {
    static constexpr auto role = contact_role::rolling;
    static constexpr bool resists = true;
    template <std::size_t D>
    static constexpr std::size_t history_size = contact<D, double>::spins;
    double mu_r;       ///< coefficient of rolling resistance: tan of the steepest slope on which a sphere stays
    double eta_r = 0;  ///< share of the critical damping

    void check() const {
        detail::check_positive("rolling resistance mu_r", mu_r, "");
        detail::check_not_negative("rolling damping eta_r", eta_r, "");
    }
    /// The torque on i.
    /// @param stiffness  of the normal spring [N/m]
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] auto torque(const contact<D, Real>& at, const Real& normal_force,
                                                  const Real& stiffness,
                                                  vec<contact<D, Real>::spins, Real>& spring) const noexcept {
        using number = number_of<Real>;
        constexpr auto spins = contact<D, Real>::spins;
        auto turning = at.turning;
        if constexpr (D == 3) turning = tangential<3, Real>(turning, at.normal);  // twisting is not rolling
        const Real arm = Real(static_cast<number>(mu_r)) * at.radius;
        const Real k_r = Real(number(2.25)) * stiffness * arm * arm;
        // 7/5 m* R*^2 would be a sphere's inertia about the point of contact; of two, the effective one.
        const Real inertia = Real(number(1.4)) * at.mass * at.radius * at.radius;
        const Real damping = Real(static_cast<number>(2 * eta_r)) * lanewise::sqrt(inertia * k_r);
        spring = minus<spins, Real>(spring, scaled<spins, Real>(turning, k_r * at.time_step));
        if constexpr (D == 3) spring = tangential<3, Real>(spring, at.normal);
        const Real strength = lanewise::sqrt(dot<spins, Real>(spring, spring));
        const Real most = arm * lanewise::greatest(normal_force, -normal_force);
        const auto yields = strength > most;
        const Real share = lanewise::select(yields, most / strength, Real(number(1)));
        spring = scaled<spins, Real>(spring, share);
        return vector_of<spins, Real>([&](auto k) __attribute__((always_inline)) {
            return spring[k] - lanewise::select(yields, Real(number(0)), damping * turning[k]);
        });
    }
};

}  // namespace tsubu::dem
