// SPDX-License-Identifier: MIT
/// @file
/// hertz_normal: two elastic spheres.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>

namespace tsubu::dem {

/// Two elastic spheres: F = K d^(3/2), K = 4/3 E* sqrt(R*).
///
/// Concept:       normal_law.
/// Cost:          one root and three products per contact. Reads no velocity: none is sent to ghosts for it.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it where the time of contact is to depend on the speed of impact, as it does: impacts, waves.
/// Do not where only bulk flow counts: a Hookean contact has a time of its own, by which to choose the step.
/// Source:        Hertz 1882, doi:10.1515/crll.1882.92.156.
struct hertz_normal {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = true;
    double modulus;  ///< effective: 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j [Pa]

    void check() const { detail::check_positive("dem::hertz_normal", "effective modulus", modulus, "Pa"); }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real& radius) const noexcept {
        return overlap * lanewise::sqrt(overlap * radius) * constant<Real>(4.0 / 3 * modulus);
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real& overlap, const Real& radius) const noexcept {
        return lanewise::sqrt(overlap * radius) * constant<Real>(2 * modulus);
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real& radius) const noexcept {
        return elastic(overlap, radius) * overlap * constant<Real>(0.4);
    }
    template <class Real>
    [[nodiscard]] Real damping(const Real&, const Real&, const Real&) const noexcept {
        return Real(0);
    }
};
static_assert(normal_law<hertz_normal>);

}  // namespace tsubu::dem
