// SPDX-License-Identifier: MIT
/// @file
/// How a scene is run: what is no physics.
#pragma once

#include <tsubu/dem/guards.hpp>

namespace tsubu::dem {

/// How a scene is run.
///
///     tsubu::dem::options{.time_step = 1e-5, .skin = 1e-4, .guard = {.time_step = false}}
struct options {
    double time_step = 0;      ///< [s]
    double skin = 0;           ///< neighbours are kept up to the touching distance and this [m]; 0: for one step
    double cutoff = 0;         ///< of the halo [m]; 0: the largest touching distance and the skin
    unsigned check_every = 1;  ///< force evaluations between two looks whether neighbours are due
    unsigned sort_every = 10;  ///< new lists between two sorts along a curve; 0: never
    guards guard{};            ///< what is watched while it runs
};

}  // namespace tsubu::dem
