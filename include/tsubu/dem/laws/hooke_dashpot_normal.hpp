// SPDX-License-Identifier: MIT
/// @file
/// hooke_dashpot_normal: a linear spring and a dashpot along the normal.
#pragma once

#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/laws/hooke_normal.hpp>

namespace tsubu::dem {

/// A linear spring and a dashpot: F = k d - gamma m* v.
///
/// Concept:       normal_law.
/// Cost:          four products per contact in 2-D, five in 3-D; the velocities of ghosts are sent.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it where all collisions are to have the same restitution, whatever their speed: e = exp(-beta t_c),
/// t_c = pi / sqrt(k/m* - beta^2), beta = gamma / 2.
/// Do not where it is to be accurate in few steps per contact: the jump at the touch makes every scheme first
/// order.
/// Source:        Cundall & Strack 1979, doi:10.1680/geot.1979.29.1.47; gamma as LAMMPS' pair_style gran/hooke has it.
struct hooke_dashpot_normal {
    static constexpr bool is_damped = true;
    static constexpr bool is_hertzian = false;
    double k;      ///< stiffness [N/m]
    double gamma;  ///< damping per effective mass [1/s]

    void check() const {
        detail::check_positive("dem::hooke_dashpot_normal", "stiffness k", k, "N/m");
        detail::check_not_negative("dem::hooke_dashpot_normal", "damping gamma", gamma, "1/s");
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real& radius) const noexcept {
        return hooke_normal{k}.elastic(overlap, radius);
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real& overlap, const Real& radius) const noexcept {
        return hooke_normal{k}.stiffness(overlap, radius);
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real& radius) const noexcept {
        return hooke_normal{k}.energy(overlap, radius);
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real damping(const Real&, const Real& mass, const Real&) const noexcept {
        return constant<Real>(gamma) * mass;
    }
};
static_assert(normal_law<hooke_dashpot_normal>);

}  // namespace tsubu::dem
