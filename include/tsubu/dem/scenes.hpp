// SPDX-License-Identifier: MIT
/// @file
/// All scenes, for tests, benchmarks and examples.
///
/// | scene         | needs                                              | must not contain                            |
/// |---------------|----------------------------------------------------|---------------------------------------------|
/// | pair_scene    | D = 1, one normal law                              | rotation, friction, history, gravity, walls |
/// | bounce_scene  | D = 1, gravity, one wall                           | everything else                             |
/// | chain_scene   | D = 1, springs, fixed ends                         | rotation, friction, damping                 |
/// | crystal_scene | D = 3, contacts, periodic                          | the same                                    |
/// | floor_scene   | D = 2, rotation, friction, wall, gravity           | cohesion, periodicity                       |
/// | oblique_scene | D = 2, rotation, friction, history, wall           | gravity, cohesion                           |
/// | gas_scene     | D = 3, periodic, frictionless                      | rotation, gravity, walls, history           |
/// | disks_scene   | D = 2, periodic, frictionless                      | z, rotation                                 |
/// | settle_scene  | D = 3, gravity, floor, friction, history, rotation | side walls, cohesion, rolling, springs      |
#pragma once

#include <tsubu/dem/scenes/bounce.hpp>
#include <tsubu/dem/scenes/chain.hpp>
#include <tsubu/dem/scenes/crystal.hpp>
#include <tsubu/dem/scenes/gas.hpp>
#include <tsubu/dem/scenes/pair.hpp>
#include <tsubu/dem/scenes/settle.hpp>
#include <tsubu/dem/scenes/sphere_on_floor.hpp>
