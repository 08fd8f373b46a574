// SPDX-License-Identifier: MIT
/// @file
/// hooke_normal: a linear spring along the normal.
#pragma once

#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>

namespace tsubu::dem {

/// A linear spring: F = k d.
///
/// Concept:       normal_law.
/// Cost:          one product per contact. Reads no velocity: none is sent to ghosts for it.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it for elastic collisions, and wherever the time step is to be long.
/// Do not when the time of contact is to depend on the speed: hertz_normal.
struct hooke_normal {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = false;
    double k;  ///< stiffness [N/m]

    void check() const { detail::check_positive("dem::hooke_normal", "stiffness k", k, "N/m"); }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real&) const noexcept {
        return constant<Real>(k) * overlap;
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real&, const Real&) const noexcept {
        return constant<Real>(k);
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real&) const noexcept {
        return constant<Real>(k / 2) * overlap * overlap;
    }
    template <class Real>
    [[nodiscard]] Real damping(const Real&, const Real&, const Real&) const noexcept {
        return Real(0);
    }
};
static_assert(normal_law<hooke_normal>);

}  // namespace tsubu::dem
