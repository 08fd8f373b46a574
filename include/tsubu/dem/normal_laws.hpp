// SPDX-License-Identifier: MIT
/// @file
/// Forces along the normal of a contact: Hooke, Hooke with a dashpot, Hertz, Hertz with the damping of Tsuji.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/lanes.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/domain/interval.hpp>

#include <string>  // std::string

namespace tsubu::dem {
namespace detail {

inline void check_positive(const char* what, double value, const char* unit) {
    if (!(value > 0) || !tsubu::detail::is_finite(value))
        tsubu::detail::raise<input_error>("dem", std::string(what) + " = " + tsubu::detail::shown(value) + " " + unit,
                                          "give a finite number above 0");
}
inline void check_not_negative(const char* what, double value, const char* unit) {
    if (!(value >= 0) || !tsubu::detail::is_finite(value))
        tsubu::detail::raise<input_error>("dem", std::string(what) + " = " + tsubu::detail::shown(value) + " " + unit,
                                          "give a finite number of at least 0");
}

}  // namespace detail

/// A linear spring: F = k d.
///
/// Concept: normal_law. Reads no velocity: none is sent to ghosts for it.
/// Choose it for elastic collisions, and wherever the time step is to be long. Do not when the time of contact is to
/// depend on the speed: hertz_normal.
struct hooke_normal {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = false;
    double k;  ///< stiffness [N/m]

    void check() const { detail::check_positive("stiffness k", k, "N/m"); }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(k)) * overlap;
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real&, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(k));
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(k / 2)) * overlap * overlap;
    }
    template <class Real>
    [[nodiscard]] Real damping(const Real&, const Real&, const Real&) const noexcept {
        return Real(0);
    }
};
static_assert(normal_law<hooke_normal>);

/// A linear spring and a dashpot: F = k d - gamma m* v.
///
/// Concept: normal_law. Choose it where all collisions are to have the same restitution, whatever their speed: e =
/// exp(-beta t_c), t_c = pi / sqrt(k/m* - beta^2), beta = gamma / 2. Do not for an accuracy beyond 1e-2: a jump
/// at the touch makes every scheme first order.
/// Source: Cundall & Strack 1979, doi:10.1680/geot.1979.29.1.47; gamma as LAMMPS' pair_style gran/hooke has it.
struct hooke_dashpot_normal {
    static constexpr bool is_damped = true;
    static constexpr bool is_hertzian = false;
    double k;      ///< stiffness [N/m]
    double gamma;  ///< damping per effective mass [1/s]

    void check() const {
        detail::check_positive("stiffness k", k, "N/m");
        detail::check_not_negative("damping gamma", gamma, "1/s");
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(k)) * overlap;
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real&, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(k));
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(k / 2)) * overlap * overlap;
    }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real damping(const Real&, const Real& mass, const Real&) const noexcept {
        return Real(static_cast<number_of<Real>>(gamma)) * mass;
    }
};
static_assert(normal_law<hooke_dashpot_normal>);

/// Two elastic spheres: F = K d^(3/2), K = 4/3 E* sqrt(R*).
///
/// Concept: normal_law. Choose it where the time of contact is to depend on the speed of impact, as it does: impacts,
/// waves. Do not for large beds of soft spheres: a Hookean contact costs no root, and allows a longer step.
/// Source: Hertz 1882, doi:10.1515/crll.1882.92.156.
struct hertz_normal {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = true;
    double modulus;  ///< effective: 1/E* = (1 - nu_i^2)/E_i + (1 - nu_j^2)/E_j [Pa]

    void check() const { detail::check_positive("effective modulus", modulus, "Pa"); }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real elastic(const Real& overlap, const Real& radius) const noexcept {
        return overlap * lanewise::sqrt(overlap * radius) * Real(static_cast<number_of<Real>>(4.0 / 3 * modulus));
    }
    template <class Real>
    [[nodiscard]] Real stiffness(const Real& overlap, const Real& radius) const noexcept {
        return lanewise::sqrt(overlap * radius) * Real(static_cast<number_of<Real>>(2 * modulus));
    }
    template <class Real>
    [[nodiscard]] Real energy(const Real& overlap, const Real& radius) const noexcept {
        return elastic(overlap, radius) * overlap * Real(static_cast<number_of<Real>>(0.4));
    }
    template <class Real>
    [[nodiscard]] Real damping(const Real&, const Real&, const Real&) const noexcept {
        return Real(0);
    }
};
static_assert(normal_law<hertz_normal>);

/// Two spheres with a dashpot that grows with their contact: F = a (4/3 E* d - gamma m* v), a = sqrt(R* d) the radius of
/// the contact.
///
/// Concept: normal_law. Choose it to compare with LAMMPS' gran/hertz/history, or for an order of 1.5. Do not where the
/// restitution is to be the same at all speeds: hertz_tsuji_normal.
/// Source: Brilliantov, Spahn, Hertzsch & Poschel 1996, doi:10.1103/PhysRevE.53.5382.
struct hertz_dashpot_normal {
    static constexpr bool is_damped = true;
    static constexpr bool is_hertzian = true;
    double modulus;  ///< effective [Pa]
    double gamma;    ///< damping per effective mass and contact radius [1/(m s)]

    void check() const {
        detail::check_positive("effective modulus", modulus, "Pa");
        detail::check_not_negative("damping gamma", gamma, "1/(m s)");
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
        return Real(static_cast<number_of<Real>>(gamma)) * mass * lanewise::sqrt(radius * overlap);
    }
};
static_assert(normal_law<hertz_dashpot_normal>);

/// Two spheres whose restitution does not depend on the speed: F = K d^(3/2) - alpha sqrt(m* K) d^(1/4) v.
///
/// e = exp(-pi b / sqrt(1 - b^2)), b = alpha / sqrt 5.
///
/// Concept: normal_law. Choose it for Hertzian spheres that lose energy. Do not expect an order above 1.25 of any
/// integrator: the damping begins with an infinite slope.
/// Source: Tsuji, Tanaka & Ishida 1992, doi:10.1016/0032-5910(92)88030-L; Antypov & Elliott 2011,
/// doi:10.1209/0295-5075/94/50004.
struct hertz_tsuji_normal {
    static constexpr bool is_damped = true;
    static constexpr bool is_hertzian = true;
    double modulus;  ///< effective [Pa]
    double alpha;    ///< damping, without a unit

    void check() const {
        detail::check_positive("effective modulus", modulus, "Pa");
        detail::check_not_negative("damping alpha", alpha, "");
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
        return Real(static_cast<number_of<Real>>(alpha)) *
               lanewise::sqrt(mass * Real(static_cast<number_of<Real>>(4.0 / 3 * modulus)) * lanewise::sqrt(radius * overlap));
    }
};
static_assert(normal_law<hertz_tsuji_normal>);

}  // namespace tsubu::dem
