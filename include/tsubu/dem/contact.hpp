// SPDX-License-Identifier: MIT
/// @file
/// contact: two bodies that overlap, as the laws see them; and the tables of the laws.
///
/// | normal law           | force                                  | order of e | choose it when                            |
/// |----------------------|----------------------------------------|------------|-------------------------------------------|
/// | hooke_normal         | k d                                    | 2          | the time step is to be as long as can be  |
/// | hooke_dashpot_normal | k d - gamma m* v                       | 1          | bulk flow with a constant restitution     |
/// | hertz_normal         | 4/3 E* sqrt(R*) d^(3/2)                | 2.5        | single impacts, waves                     |
/// | hertz_dashpot_normal | a (4/3 E* d - gamma m* v)              | 1 (1.5)    | to compare with LAMMPS' gran/hertz        |
/// | hertz_tsuji_normal   | that of Hertz - alpha sqrt(m* K) d^(1/4) v | 1 (1.25) | elastic spheres with a constant restitution |
///
/// The order is that in which the error of the restitution falls with the time step of velocity_verlet; in brackets with
/// implicit_velocity_verlet, whose damping does not see the velocities of the half step.
///
/// | tangential law  | remembers  | choose it when                                                     |
/// |-----------------|------------|--------------------------------------------------------------------|
/// | frictionless    | nothing    | there is no rotation                                               |
/// | coulomb         | nothing    | everything slides: dilute, rapid flow; a heap creeps with it       |
/// | linear_history  | a spring   | beds and heaps of Hookean spheres, which are to come to rest       |
/// | mindlin_history | a spring   | the same of Hertzian spheres                                       |
///
/// Besides: without_attraction (a damped contact never pulls), rolling_resistance, dmt_cohesion.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>

#include <cstddef>   // std::size_t
#include <concepts>  // std::convertible_to, std::same_as

namespace tsubu::dem {

/// Two bodies i and j that overlap. Of a wall, which is j, mass and radius are infinite: the effective ones are those
/// of the particle.
///
/// @tparam Real  a number, or lanes of numbers: laws are written for either.
template <std::size_t D, class Real>
struct contact {
    static constexpr std::size_t spins = D == 3 ? 3 : D == 2 ? 1 : 0;

    Real overlap;              ///< R_i + R_j - r, positive [m]
    Real mass;                 ///< effective: m_i m_j / (m_i + m_j) [kg]
    Real radius;               ///< effective: R_i R_j / (R_i + R_j) [m]
    Real time_step;            ///< [s]
    vec<D, Real> normal;       ///< unit vector from j to i
    vec<D, Real> velocity;     ///< of the centre of i relative to that of j [m/s]
    vec<spins, Real> sliding;  ///< R_i omega_i + R_j omega_j [m/s]
    vec<spins, Real> turning;  ///< omega_i - omega_j [rad/s]
};

/// What a part of a contact law stands for.
enum class contact_role { tangential, rolling, cohesion, release };

/// The force along the normal.
///  1. elastic(d, R*) is 0 at d = 0 and does not fall; stiffness is its derivative, energy its integral;
///  2. damping(d, m*, R*) is not negative, and 0 if is_damped is false: the force is elastic - damping v, v the velocity of
///     separation;
///  3. lanes of numbers have the same results as the numbers, bit for bit.
/// is_hertzian: the contact widens as sqrt(R* d), and so do its other springs.
template <class Law>
concept normal_law = requires(const Law& law, double number) {
    { Law::is_damped } -> std::convertible_to<bool>;
    { Law::is_hertzian } -> std::convertible_to<bool>;
    { law.elastic(number, number) } -> std::same_as<double>;
    { law.stiffness(number, number) } -> std::same_as<double>;
    { law.energy(number, number) } -> std::same_as<double>;
    { law.damping(number, number, number) } -> std::same_as<double>;
    law.check();
};

}  // namespace tsubu::dem
