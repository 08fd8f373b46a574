// SPDX-License-Identifier: MIT
/// @file
/// mindlin_history: a spring along the surface that stiffens with the contact, and friction.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/detail/sliding_spring.hpp>
#include <tsubu/dem/laws/concepts.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// A spring along the surface that stiffens with the contact, k_t = 8 G* sqrt(R* d), and friction: |F_t| <= mu |F_n|.
///
/// The stiffness of the moment pulls on the whole of the spring, as in LAMMPS' `mindlin`: while a contact unloads with
/// its spring stretched, energy is lost, and gained while it loads.
///
/// Concept:       sticking_law, damping_sharing_law.
/// Cost:          a root and some 60 products per contact in 3-D; one more root and two quotients where one of a
///                group of contacts slides; spins and velocities of ghosts are sent.
/// Bytes:         D numbers for each pair of neighbours; spins and torques per particle.
/// Deterministic: yes.
/// Choose it with hertz_normal, or hertz_tsuji_normal, whose damping it shares.
/// Do not with a linear spring (does not compile): linear_history. Nor under an integrator of several stages.
/// Source:        Mindlin 1949, doi:10.1115/1.4009973, without the partial slip of Mindlin & Deresiewicz 1953,
///                doi:10.1115/1.4010702; Di Renzo & Di Maio 2005, doi:10.1016/j.ces.2004.10.004.
struct mindlin_history {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = true;
    template <class Normal>
    static constexpr bool goes_with = Normal::is_hertzian;
    template <std::size_t D>
    static constexpr std::size_t history_size = D;
    double shear_modulus;  ///< effective: 1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j [Pa]
    double mu;             ///< coefficient of friction
    double damping = 0;    ///< share of the normal damping, without a unit; 0 if the normal law has none

    void check() const {
        detail::check_positive("dem::mindlin_history", "effective shear modulus", shear_modulus, "Pa");
        detail::check_not_negative("dem::mindlin_history", "friction mu", mu, "");
        detail::check_not_negative("dem::mindlin_history", "share of damping", damping, "");
    }
    [[nodiscard]] double stiffness(double overlap, double radius) const noexcept {
        return 8 * shear_modulus * std::sqrt(radius * overlap);
    }
    [[nodiscard]] double viscosity(double, double normal_damping) const noexcept { return damping * normal_damping; }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force,
                                                         const Real& normal_damping,
                                                         vec<D, Real>& spring) const noexcept {
        const Real stiffness = constant<Real>(8 * shear_modulus) * lanewise::sqrt(at.radius * at.overlap);
        return detail::sliding_spring<D, Real>(at, normal_force, stiffness, constant<Real>(damping) * normal_damping,
                                               constant<Real>(mu), spring);
    }
};
static_assert(sticking_law<mindlin_history> && damping_sharing_law<mindlin_history>);

}  // namespace tsubu::dem
