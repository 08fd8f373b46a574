// SPDX-License-Identifier: MIT
/// @file
/// coulomb: sliding friction without a history.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// Sliding friction, regularised by a viscosity at low speed: |F_t| = min(gamma_t m* v_t, mu |F_n|).
///
/// Concept:       tangential_law.
/// Cost:          one root, one quotient and some 40 products per contact in 3-D; spins and velocities of ghosts are
///                sent.
/// Bytes:         none per contact; spins and torques per particle.
/// Deterministic: yes.
/// Choose it in rapid flow, where contacts slide; with any normal law.
/// Do not where something is to rest on a slope: what does not roll creeps at g sin(theta) / gamma_t.
/// Source:        Haff & Werner 1986, Powder Technology 48, 239.
struct coulomb {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = true;
    template <class Normal>
    static constexpr bool goes_with = true;
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
    double mu;       ///< coefficient of friction
    double gamma_t;  ///< damping per effective mass [1/s], above 0 if mu is

    void check() const {
        detail::check_not_negative("dem::coulomb", "friction mu", mu, "");
        detail::check_not_negative("dem::coulomb", "damping gamma_t", gamma_t, "1/s");
        if (mu > 0 && gamma_t == 0)
            detail::refuse_parameter("dem::coulomb", "damping gamma_t", gamma_t, "1/s",
                                     "give a finite number above 0, some times the inverse duration of a contact: "
                                     "without it there is no friction, whatever mu");
    }
    [[nodiscard]] double viscosity(double mass, double) const noexcept { return gamma_t * mass; }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force,
                                                         const Real&, vec<0, Real>&) const noexcept {
        const auto slip = slip_of<D, Real>(at);
        const Real square = dot<D, Real>(slip, slip);
        const Real speed = lanewise::sqrt(square);
        const Real viscous = constant<Real>(gamma_t) * at.mass;
        const Real most = constant<Real>(mu) * lanewise::greatest(normal_force, -normal_force);
        const Real per_speed = lanewise::select(viscous * speed > most, most / speed, viscous);
        return scaled<D, Real>(slip, -per_speed);
    }
};
static_assert(tangential_law<coulomb>);

}  // namespace tsubu::dem
