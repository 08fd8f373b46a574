// SPDX-License-Identifier: MIT
/// @file
/// Forces at right angles to the normal of a contact: none, Coulomb, and springs that remember.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/normal_laws.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// The velocity of i's surface relative to j's, along the surface [m/s].
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> slip_of(const contact<D, Real>& at) noexcept {
    return minus<D, Real>(tangential<D, Real>(at.velocity, at.normal), spin_across(at.sliding, at.normal));
}

/// The force along the surface.
///  1. force(contact, F_n, damping of the normal law, springs) acts on i, at right angles to the normal, and changes `springs`
///     [history_size<D>], which are 0 when the contact begins.
/// A law without memory has history_size<D> == 0; goes_with<Normal> tells which normal laws have its stiffness.
///
/// No force: nothing turns then.
struct frictionless {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = false;
    template <class Normal>
    static constexpr bool goes_with = true;
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
    void check() const {}
};

/// Sliding friction, regularised by a viscosity at low speed: |F_t| = min(gamma_t m* v_t, mu |F_n|).
///
/// Choose it in rapid flow, where contacts slide. Do not where something is to rest on a slope: it creeps at a speed of
/// g sin(theta) / gamma_t.
struct coulomb {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = true;
    template <class Normal>
    static constexpr bool goes_with = true;
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
    double mu;       ///< coefficient of friction
    double gamma_t;  ///< damping per effective mass [1/s]

    void check() const {
        detail::check_not_negative("friction mu", mu, "");
        detail::check_not_negative("damping gamma_t", gamma_t, "1/s");
    }
    /// [kg/s]
    [[nodiscard]] double viscosity(double mass, double) const noexcept { return gamma_t * mass; }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force,
                                                         const Real&, vec<0, Real>&) const noexcept {
        using number = number_of<Real>;
        const auto slip = slip_of<D, Real>(at);
        const Real square = dot<D, Real>(slip, slip);
        const Real speed = lanewise::sqrt(square);
        const Real viscous = Real(static_cast<number>(gamma_t)) * at.mass;
        const Real most = Real(static_cast<number>(mu)) * lanewise::greatest(normal_force, -normal_force);
        const Real per_speed = lanewise::select(viscous * speed > most, most / speed, viscous);
        return scaled<D, Real>(slip, -per_speed);
    }
};

namespace detail {

/// A spring along the surface, cut off where it would pull more than friction holds: Cundall and Strack's.
/// @param stiffness  of the spring [N/m]
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> sliding_spring(const contact<D, Real>& at,
                                                                     const Real& normal_force, const Real& stiffness,
                                                                     const Real& viscosity, const Real& mu,
                                                                     vec<D, Real>& spring) noexcept {
    const auto slip = slip_of<D, Real>(at);
    vec<D, Real> longer = plus<D, Real>(spring, scaled<D, Real>(slip, at.time_step));
    longer = tangential<D, Real>(longer, at.normal);  // the contact has turned since
    auto pull = vector_of<D, Real>(
        [&](auto k) __attribute__((always_inline)) { return -(stiffness * longer[k] + viscosity * slip[k]); });
    spring = longer;
    const Real square = dot<D, Real>(pull, pull);
    const Real most = mu * lanewise::greatest(normal_force, -normal_force);
    const auto slides = square > most * most;
    if (lanewise::any(slides)) {  // few do where grains rest, and the root and the quotients are dear
        const Real one(static_cast<number_of<Real>>(1));
        pull = scaled<D, Real>(pull, lanewise::select(slides, most / lanewise::sqrt(square), one));
        // What the spring holds is the force that is left, less what the dashpot gives.
        const Real softness = one / stiffness;
        spring = vector_of<D, Real>([&](auto k) __attribute__((always_inline)) {
            return lanewise::select(slides, -((pull[k] + viscosity * slip[k]) * softness), longer[k]);
        });
    }
    return pull;
}

}  // namespace detail

/// A linear spring along the surface, and friction: |F_t| <= mu |F_n|.
///
/// Choose it where something is to come to rest. Bytes: D numbers for each pair of neighbours.
/// Source: Cundall & Strack 1979, doi:10.1680/geot.1979.29.1.47; cut off and turned as in LAMMPS' gran/hooke/history.
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
        detail::check_positive("stiffness k_t", k_t, "N/m");
        detail::check_not_negative("friction mu", mu, "");
        detail::check_not_negative("damping gamma_t", gamma_t, "1/s");
    }
    /// [N/m]
    [[nodiscard]] double stiffness(double, double) const noexcept { return k_t; }
    /// [kg/s]
    [[nodiscard]] double viscosity(double mass, double) const noexcept { return gamma_t * mass; }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force,
                                                         const Real&, vec<D, Real>& spring) const noexcept {
        using number = number_of<Real>;
        return detail::sliding_spring<D, Real>(at, normal_force, Real(static_cast<number>(k_t)),
                                               Real(static_cast<number>(gamma_t)) * at.mass,
                                               Real(static_cast<number>(mu)), spring);
    }
};

/// A spring along the surface that stiffens with the contact: k_t = 8 G* sqrt(R* d), and friction.
///
/// Choose it with hertz_normal, or hertz_tsuji_normal, whose damping it shares. Does not compile with a linear spring.
/// Bytes: D numbers for each pair of neighbours.
/// Source: Mindlin 1949, without the partial slip of Mindlin & Deresiewicz 1953; Di Renzo & Di Maio 2005,
/// doi:10.1016/j.ces.2004.10.004.
struct mindlin_history {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = true;
    template <class Normal>
    static constexpr bool goes_with = Normal::is_hertzian;
    template <std::size_t D>
    static constexpr std::size_t history_size = D;
    double shear_modulus;  ///< effective: 1/G* = (2 - nu_i)/G_i + (2 - nu_j)/G_j [Pa]
    double mu;             ///< coefficient of friction
    double damping = 0;    ///< share of the normal damping, without a unit

    void check() const {
        detail::check_positive("effective shear modulus", shear_modulus, "Pa");
        detail::check_not_negative("friction mu", mu, "");
        detail::check_not_negative("share of damping", damping, "");
    }
    /// [N/m]
    [[nodiscard]] double stiffness(double overlap, double radius) const noexcept {
        return 8 * shear_modulus * std::sqrt(radius * overlap);
    }
    /// [kg/s]
    [[nodiscard]] double viscosity(double, double normal_damping) const noexcept { return damping * normal_damping; }
    template <std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] vec<D, Real> force(const contact<D, Real>& at, const Real& normal_force,
                                                         const Real& normal_damping,
                                                         vec<D, Real>& spring) const noexcept {
        using number = number_of<Real>;
        const Real stiffness = Real(static_cast<number>(8 * shear_modulus)) * lanewise::sqrt(at.radius * at.overlap);
        return detail::sliding_spring<D, Real>(at, normal_force, stiffness,
                                               Real(static_cast<number>(damping)) * normal_damping,
                                               Real(static_cast<number>(mu)), spring);
    }
};

}  // namespace tsubu::dem
