// SPDX-License-Identifier: MIT
/// @file
/// integrator: how velocities and positions follow from forces; and the table of the models.
///
/// | integrator               | forces per step | order: smooth, damped | stable up to omega dt   | choose it when |
/// |--------------------------|-----------------|-----------------------|-------------------------|----------------|
/// | velocity_verlet          | 1               | 2, 1                  | 2 (sqrt(1 + z^2) - z)   | you do not know |
/// | implicit_velocity_verlet | 1, and rounds   | 2, 2                  | 2 for all z             | damping is strong |
/// | symplectic_euler         | 1               | 1, 1                  | 2 (sqrt(1 + z^2) - z)   | to be like other codes |
/// | pefrl                    | 4               | 4, 1                  | 2.98; less with damping | smooth, not damped |
/// | runge_kutta_4            | 4               | 4, 4                  | 2.82; 2.62 for z <= 1   | smooth and damped |
/// | explicit_euler           | 1               | 1, 1                  | 0; 2 z with damping     | to see why not |
///
/// z is the damping ratio. Of collisions none is more accurate than velocity_verlet at equal cost: where a contact
/// begins and ends caps the order.
#pragma once

#include <tsubu/dem/quantities.hpp>

#include <concepts>  // std::convertible_to, std::same_as
#include <cstddef>   // std::size_t

namespace tsubu::dem {
namespace detail {

struct any_run;  // an integrator takes every run

}  // namespace detail

/// How velocities and positions follow from forces.
///  1. advance(run, h, steps) brings a run from one step to the next by its members kick, drift, kick_and_drift,
///     displace,
///     clear_forces and evaluate_forces, and calls end_step after each; forces are those of the positions before and
///     after;
///  2. force_evaluations of a step; moves_spins: whether what turns particles is moved; solves_damping: whether the
///     damping of contacts is left to it;
///  3. keeps<Q> are fields of its own, in the quantities Q of a scene;
///  4. an oscillator of frequency omega and damping ratio z does not grow at steps h with omega h < stable_until(z).
/// testing::check_integrator judges one of your own.
template <class Integrator>
concept integrator = requires(double damping_ratio, detail::any_run& run, double time_step, std::size_t steps) {
    Integrator::advance(run, time_step, steps);
    { Integrator::force_evaluations } -> std::convertible_to<unsigned>;
    { Integrator::moves_spins } -> std::convertible_to<bool>;
    { Integrator::solves_damping } -> std::convertible_to<bool>;
    { Integrator::stable_until(damping_ratio) } -> std::same_as<double>;
    typename Integrator::template keeps<quantities<3, double>>;
};

}  // namespace tsubu::dem
