// SPDX-License-Identifier: MIT
/// @file
/// guards: what is watched while a scene runs, since nothing else would tell.
#pragma once

namespace tsubu::dem {

/// What is watched while a scene runs. A scene that is unstable need not explode: in a dense bed past the limit nothing
/// is lost, and only the energy does not decay. Each is an error that says the step, the values and the remedy.
///
/// Cost: a pass over contacts or particles every so many steps.
struct guards {
    unsigned every = 1000;    ///< steps between two looks, the first at the start; 0: there only
    bool time_step = true;    ///< not above longest_time_step
    bool overlap = true;      ///< no two particles overlap by more than the smaller radius
    /// No particle crosses the box in a step; if the fastest one flies freely, v dt is above half a unit in the last
    /// place of its position.
    bool coordinates = true;
    /// [J] Once the kinetic energy was below, it stays below 10 times that; 0: not watched. Velocities are those that
    /// the integrator has at the end of a step: with velocity_verlet half a step old.
    double energy_floor = 0;
};

/// Nothing is watched: to see what happens past a limit.
inline constexpr guards no_guards{.every = 0, .time_step = false, .overlap = false, .coordinates = false};

}  // namespace tsubu::dem
