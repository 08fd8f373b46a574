// SPDX-License-Identifier: MIT
/// @file
/// linear_history: a linear spring along the surface, and friction.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/detail/sliding_spring.hpp>
#include <tsubu/dem/laws/concepts.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// A linear spring along the surface, and friction: |F_t| <= mu |F_n|.
///
/// Concept:       sticking_law.
/// Cost:          some 60 products per contact in 3-D; a root and two quotients where one of a group of contacts
///                slides; spins and velocities of ghosts are sent.
/// Bytes:         D numbers for each pair of neighbours; spins and torques per particle.
/// Deterministic: yes.
/// Choose it where something is to come to rest, with a linear normal law.
/// Do not with a Hertzian one (does not compile): mindlin_history. Nor under an integrator of several stages.
/// Source:        Cundall & Strack 1979, doi:10.1680/geot.1979.29.1.47; cut off and turned as in LAMMPS'
///                gran/hooke/history.
struct linear_history {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = true;
    template <class Normal>
    static constexpr bool goes_with = !Normal::is_hertzian;
    template <std::size_t D>
    static constexpr std::size_t history_size = D;
    double k_t;          ///< stiffness along the surface [N/m]; 2/7 of the normal one keeps their times in step
    double mu;           ///< coefficient of friction
    double gamma_t = 0;  ///< damping per effective mass [1/s]

    void check() const {
        detail::check_positive("dem::linear_history", "stiffness k_t", k_t, "N/m");
        detail::check_not_negative("dem::linear_history", "friction mu", mu, "");
        detail::check_not_negative("dem::linear_history", "damping gamma_t", gamma_t, "1/s");
    }
    [[nodiscard]] double stiffness(double, double) const noexcept { return k_t; }
    [[nodiscard]] double viscosity(double mass, double) const noexcept { return gamma_t * mass; }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force,
                                                         const Real&, vec<D, Real>& spring) const noexcept {
        return detail::sliding_spring<D, Real>(at, normal_force, constant<Real>(k_t),
                                               constant<Real>(gamma_t) * at.mass, constant<Real>(mu), spring);
    }
};
static_assert(sticking_law<linear_history>);

}  // namespace tsubu::dem
