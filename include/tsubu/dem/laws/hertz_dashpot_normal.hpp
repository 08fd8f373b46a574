// SPDX-License-Identifier: MIT
/// @file
/// hertz_dashpot_normal: two elastic spheres with a dashpot that grows with their contact.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/laws/hertz_normal.hpp>

namespace tsubu::dem {

/// Two spheres with a dashpot that grows with their contact: F = a (4/3 E* d - gamma m* v), a = sqrt(R* d) the
/// radius of the contact.
///
/// Concept:       normal_law.
/// Cost:          one root and eight products per contact in 3-D; the velocities of ghosts are sent.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it to compare with LAMMPS' gran/hertz/history, or, with implicit_velocity_verlet,
/// for an order of 1.5.
/// Do not where the restitution is to be the same at all speeds: hertz_tsuji_normal.
/// Source:        Brilliantov, Spahn, Hertzsch & Poschel 1996, doi:10.1103/PhysRevE.53.5382.
struct hertz_dashpot_normal {
    static constexpr bool is_damped = true;
    static constexpr bool is_hertzian = true;
    double modulus;  ///< effective, as in hertz_normal [Pa]
    double gamma;    ///< damping per effective mass and contact radius [1/(m s)]

    void check() const {
        detail::check_positive("dem::hertz_dashpot_normal", "effective modulus", modulus, "Pa");
        detail::check_not_negative("dem::hertz_dashpot_normal", "damping gamma", gamma, "1/(m s)");
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real& radius) const noexcept {
        return hertz_normal{modulus}.elastic(overlap, radius);
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real& overlap, const Real& radius) const noexcept {
        return hertz_normal{modulus}.stiffness(overlap, radius);
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real& radius) const noexcept {
        return hertz_normal{modulus}.energy(overlap, radius);
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real damping(const Real& overlap, const Real& mass,
                                                   const Real& radius) const noexcept {
        return constant<Real>(gamma) * mass * lanewise::sqrt(radius * overlap);
    }
};
static_assert(normal_law<hertz_dashpot_normal>);

}  // namespace tsubu::dem
