// SPDX-License-Identifier: MIT
/// @file
/// contact: two bodies that overlap, as the laws see them.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// Two bodies i and j that overlap. Of a wall, which is j, mass and radius are infinite: the effective ones are those
/// of the particle.
///
/// @tparam Real  a number, or lanes of numbers: laws are written for either.
template <std::size_t D, class Real>
struct contact {
    static constexpr std::size_t spins = spin_count<D>;

    Real overlap;              ///< R_i + R_j - r, positive [m]
    Real mass;                 ///< effective: m_i m_j / (m_i + m_j) [kg]
    Real radius;               ///< effective: R_i R_j / (R_i + R_j) [m]
    Real time_step;            ///< [s]
    vec<D, Real> normal;       ///< unit vector from j to i
    vec<D, Real> velocity;     ///< of the centre of i relative to that of j [m/s]
    vec<spins, Real> sliding;  ///< R_i omega_i + R_j omega_j [m/s]
    vec<spins, Real> turning;  ///< omega_i - omega_j [rad/s]
};

/// The velocity of i's surface relative to j's, along the surface [m/s].
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> slip_of(const contact<D, Real>& at) noexcept {
    return minus<D, Real>(tangential<D, Real>(at.velocity, at.normal), spin_across(at.sliding, at.normal));
}

/// A parameter of a law in the numbers that the law is asked in: in each of the lanes the same.
template <class Real>
[[nodiscard, gnu::always_inline]] inline Real constant(double value) noexcept {
    return Real(static_cast<number_of<Real>>(value));
}

}  // namespace tsubu::dem
