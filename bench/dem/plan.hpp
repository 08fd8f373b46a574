// SPDX-License-Identifier: MIT
/// @file
/// What the parts of bench_dem share: how long to measure, and who adds which groups.
#pragma once

#include "../support/groups.hpp"
#include "../support/timed_turns.hpp"

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/explicit_euler.hpp>
#include <tsubu/dem/implicit_velocity_verlet.hpp>
#include <tsubu/dem/pefrl.hpp>
#include <tsubu/dem/quantities.hpp>
#include <tsubu/dem/runge_kutta_4.hpp>
#include <tsubu/dem/symplectic_euler.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/domain/lattice.hpp>

#include <cmath>    // std::isfinite
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int32_t, std::int64_t
#include <memory>   // std::shared_ptr
#include <string>   // std::string
#include <vector>   // std::vector

namespace bench {

/// Impacts of two spheres, and of one with a floor: errors over the time step, and what a step costs.
void add_impacts(std::vector<group>& groups, extent how_much);
/// Errors up to and past the limit of stability: a sphere between two walls, a gas, a bed.
void add_limits(std::vector<group>& groups, extent how_much);
/// What each model costs in a dense bed, and loops by hand.
void add_beds(std::vector<group>& groups, extent how_much);
/// LAMMPS, if there is lmp, and two ranks, if there is MPI.
void add_rivals(std::vector<group>& groups, extent how_much);

/// One process; outlives all runs.
[[nodiscard]] inline tsubu::self_transport& alone() {
    static tsubu::self_transport on;
    return on;
}

// Names that rows have.

template <class Number>
inline constexpr const char* number_name = "double";
template <>
inline constexpr const char* number_name<float> = "float";
template <>
inline constexpr const char* number_name<tsubu::dem::mixed_precision<double, float>> = "mixed";
template <>
inline constexpr const char* number_name<tsubu::dem::in_cells<float>> = "in_cells";
template <>
inline constexpr const char* number_name<tsubu::lattice<std::int64_t>> = "lattice64";
template <>
inline constexpr const char* number_name<tsubu::lattice<std::int32_t>> = "lattice32";
template <>
inline constexpr const char* number_name<tsubu::dem::mixed_precision<tsubu::lattice<std::int64_t>, float>> =
    "lattice64_float";

template <class Integrator>
inline constexpr const char* integrator_name = "velocity_verlet";
template <>
inline constexpr const char* integrator_name<tsubu::dem::implicit_velocity_verlet> = "implicit_velocity_verlet";
template <>
inline constexpr const char* integrator_name<tsubu::dem::symplectic_euler> = "symplectic_euler";
template <>
inline constexpr const char* integrator_name<tsubu::dem::explicit_euler> = "explicit_euler";
template <>
inline constexpr const char* integrator_name<tsubu::dem::pefrl> = "pefrl";
template <>
inline constexpr const char* integrator_name<tsubu::dem::runge_kutta_4> = "runge_kutta_4";

/// JSON knows no infinity: an error that is none any more is this.
inline constexpr double lost = 1e9;
[[nodiscard]] inline double shown_error(double error) noexcept {
    return std::isfinite(error) && error < lost ? error : lost;
}

/// The rounds of each extent.
[[nodiscard]] inline std::size_t rounds_of(extent how_much) noexcept {
    constexpr std::size_t rounds[] = {5, 9, 15};
    return rounds[static_cast<int>(how_much)];
}

}  // namespace bench
