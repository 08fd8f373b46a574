// SPDX-License-Identifier: MIT
/// @file
/// hertz_tsuji_normal: two elastic spheres whose restitution does not depend on the speed.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/laws/hertz_normal.hpp>

namespace tsubu::dem {

/// Two spheres whose restitution does not depend on the speed: F = K d^(3/2) - alpha sqrt(m* K) d^(1/4) v.
///
/// e = exp(-pi b / sqrt(1 - b^2)), b = alpha / sqrt 5.
///
/// Concept:       normal_law.
/// Cost:          two roots and ten products per contact in 3-D; the velocities of ghosts are sent.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it for Hertzian spheres that lose energy.
/// Do not expect an order above 1.25 of any integrator, or above 1 of velocity_verlet: the damping begins with an
/// infinite slope.
/// Source:        Tsuji, Tanaka & Ishida 1992, doi:10.1016/0032-5910(92)88030-L; Antypov & Elliott 2011,
///                doi:10.1209/0295-5075/94/50004.
struct hertz_tsuji_normal {
    static constexpr bool is_damped = true;
    static constexpr bool is_hertzian = true;
    double modulus;  ///< effective, as in hertz_normal [Pa]
    double alpha;    ///< damping, without a unit

    void check() const {
        detail::check_positive("dem::hertz_tsuji_normal", "effective modulus", modulus, "Pa");
        detail::check_not_negative("dem::hertz_tsuji_normal", "damping alpha", alpha, "");
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
        // sqrt(m* K) d^(1/4), K = 4/3 E* sqrt(R*)
        const Real root = lanewise::sqrt(radius * overlap);
        return constant<Real>(alpha) * lanewise::sqrt(mass * constant<Real>(4.0 / 3 * modulus) * root);
    }
};
static_assert(normal_law<hertz_tsuji_normal>);

}  // namespace tsubu::dem
