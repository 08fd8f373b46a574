// SPDX-License-Identifier: MIT
/// @file
/// What scenes hold, send and keep, and what they do not: derived from their models at compile time.
#include <tsubu/dem/scenes.hpp>

#include <tsubu/dem/implicit_velocity_verlet.hpp>
#include <tsubu/dem/pefrl.hpp>
#include <tsubu/dem/runge_kutta_4.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace {

using namespace tsubu::dem;

template <class Scene, const auto& Field>
inline constexpr bool has = Scene::store_type::template has<std::remove_cvref_t<decltype(Field)>>;
template <class Set, const auto&... Fields>
inline constexpr bool is_set = std::is_same_v<Set, tsubu::fields<Fields...>>;

/// Spins, torques and memory: what friction brings.
template <class Scene>
inline constexpr bool is_frictionless =
    !Scene::turns && !Scene::has_history && Scene::history_size == 0 && !has<Scene, tsubu::torque<Scene::dimension>> &&
    !has<Scene, tsubu::angular_velocity<Scene::dimension>>;
template <class Scene>
inline constexpr bool is_of_equal_spheres = !has<Scene, tsubu::radius> && !has<Scene, tsubu::mass>;

// pair: one dimension, one normal law, no rotation, friction, history, gravity, walls.
using pair = pair_scene<>::simulation;
static_assert(pair::dimension == 1 && !pair::has_gravity && !pair::has_walls && !pair::has_springs);
static_assert(is_frictionless<pair> && is_of_equal_spheres<pair> && !has<pair, tsubu::bonds>);
static_assert(pair::bytes_per_particle == 8 + 3 * 8);  // id, position, velocity, force

// bounce: one dimension, gravity, one wall.
using bounce = bounce_scene<>::simulation;
static_assert(bounce::dimension == 1 && bounce::has_gravity && bounce::has_walls && !bounce::has_springs);
static_assert(is_frictionless<bounce> && is_of_equal_spheres<bounce> && bounce::bytes_per_particle == 8 + 3 * 8);

// chain: springs, and masses of which two are held.
using chain = chain_scene<>::simulation;
static_assert(chain::dimension == 1 && chain::has_springs && !chain::has_contacts && !chain::has_gravity &&
              !chain::has_walls);
static_assert(is_frictionless<chain> && has<chain, tsubu::bonds> && has<chain, tsubu::mass>);

// crystal and gas: space, contacts, and nothing else.
using crystal = crystal_scene<>::simulation;
using gas = gas_scene<>::simulation;
static_assert(std::is_same_v<crystal, gas>);
static_assert(gas::dimension == 3 && !gas::has_gravity && !gas::has_walls && !gas::has_springs);
static_assert(is_frictionless<gas> && is_of_equal_spheres<gas> && gas::bytes_per_particle == 8 + 9 * 8);
// An elastic contact sees no velocity: none is sent.
static_assert(is_set<gas::forward_fields, tsubu::position<3>>);
using damped_gas = gas_scene<hooke_dashpot<>>::simulation;
static_assert(is_set<damped_gas::forward_fields, tsubu::position<3>, tsubu::velocity<3>>);
static_assert(damped_gas::bytes_per_particle == gas::bytes_per_particle);

// disks: two dimensions: no z.
using disks = disks_scene<>::simulation;
static_assert(disks::dimension == 2 && is_frictionless<disks> && disks::bytes_per_particle == 8 + 6 * 8);
static_assert(!has<disks, tsubu::position<3>> && !has<disks, tsubu::velocity<3>> && !has<disks, tsubu::force<3>>);

// oblique: rotation, friction, history, wall; no gravity.
using oblique = oblique_scene<>::simulation;
static_assert(oblique::dimension == 2 && oblique::has_walls && !oblique::has_gravity && oblique::turns);
static_assert(oblique::has_history && oblique::history_size == 2 && is_of_equal_spheres<oblique>);
// In a plane a spin is one number.
static_assert(has<oblique, tsubu::angular_velocity<2>> && oblique::quantities_type::spins == 1);
static_assert(is_set<oblique::forward_fields, tsubu::position<2>, tsubu::velocity<2>, tsubu::angular_velocity<2>>);

// slip to roll: friction without memory.
using roll = floor_scene<>::simulation;
static_assert(roll::turns && !roll::has_history && roll::has_gravity && roll::has_walls);
static_assert(roll::bytes_per_particle == 8 + 6 * 8 + 2 * 8);

// settle: all of it, but no cohesion, rolling or bonds.
using settle = settle_scene<>::simulation;
static_assert(settle::turns && settle::has_history && settle::history_size == 3 && settle::has_gravity && settle::has_walls);
static_assert(!settle::has_springs && is_of_equal_spheres<settle> && !has<settle, tsubu::bonds>);
static_assert(std::is_same_v<settle::contact_type::rolling_type, free_rolling>);
static_assert(std::is_same_v<settle::contact_type::cohesion_type, cohesionless>);

static_assert(is_set<settle::forward_fields, tsubu::position<3>, tsubu::velocity<3>, tsubu::angular_velocity<3>>);
// Forces and torques are computed anew after a migration; a restart begins with them.
static_assert(is_set<settle::migration_fields, tsubu::id, tsubu::position<3>, tsubu::velocity<3>,
                     tsubu::angular_velocity<3>, settle::quantities_type::contacts<3>>);
static_assert(std::is_same_v<settle::restart_fields, settle::fields>);
static_assert(
    is_set<tsubu::difference_of<settle::restart_fields, settle::migration_fields>, tsubu::force<3>, tsubu::torque<3>>);
static_assert(is_set<gas::migration_fields, tsubu::id, tsubu::position<3>, tsubu::velocity<3>>);

// Sizes of their own are carried, and migrate, but do not travel each step: they do not change.
using mixture = simulation<3, double, velocity_verlet, hooke<>, spheres>;
static_assert(has<mixture, tsubu::radius> && has<mixture, tsubu::mass> &&
              mixture::bytes_per_particle == gas::bytes_per_particle + 16);
static_assert(is_set<mixture::forward_fields, tsubu::position<3>>);
static_assert(
    std::is_same_v<mixture::ghost_fields,
                   tsubu::union_of<tsubu::fields<tsubu::radius, tsubu::mass>, tsubu::fields<tsubu::position<3>>>>);

// An integrator's own are carried where it is.
using implicit_gas = gas_scene<hooke_dashpot<>, implicit_velocity_verlet>::simulation;
static_assert(implicit_gas::bytes_per_particle == gas::bytes_per_particle + 3 * sizeof(double));
static_assert(gas_scene<hooke<>, runge_kutta_4>::simulation::bytes_per_particle ==
              gas::bytes_per_particle + 12 * sizeof(double));
static_assert(gas_scene<hooke<>, pefrl>::simulation::bytes_per_particle == gas::bytes_per_particle);

// Numbers: what each policy takes.
template <class Number>
inline constexpr std::size_t bytes = gas_scene<hooke<>, velocity_verlet, Number>::simulation::bytes_per_particle;
static_assert(bytes<double> == 8 + 3 * 24 && bytes<tsubu::lattice<std::int64_t>> == 8 + 3 * 24);
static_assert(bytes<tsubu::lattice<std::int32_t>> == 8 + 12 + 48 &&
              bytes<mixed_precision<double, float>> == 8 + 24 + 24);
static_assert(bytes<float> == 8 + 3 * 12 && bytes<in_cells<float>> == 8 + 6 + 3 * 12);

}  // namespace
