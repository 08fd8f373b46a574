// SPDX-License-Identifier: MIT
/// @file
/// model: what a scene is made of.
#pragma once

#include <tsubu/dem/quantities.hpp>

#include <concepts>  // std::convertible_to

namespace tsubu::dem {

/// What a model of a scene stands for; of each kind a scene has at most one.
enum class model_role {
    contacts,      ///< what particles that overlap do to each other
    walls,         ///< planes that particles touch
    springs,       ///< permanent bonds
    acceleration,  ///< of all particles
    bodies,        ///< what sizes and masses particles have
};

/// The roles are closed: contact_law, walls, springs, gravity, equal_spheres and spheres are the models that there are.
/// What is open are the parts of a contact law (laws/concepts.hpp) and integrators.
///
/// A model states which fields it needs, in the quantities Q of a scene. From these follow what the store holds, what
/// travels to ghosts, and what a migration takes along:
///  1. reads<Q> are the fields of the particle itself, writes<Q> those that it changes;
///  2. partner_reads<Q> are those of the other particle of a pair, which may be a ghost;
///  3. check() throws input_error if a parameter is not what it may be.
template <class Model>
concept model = requires(const Model& one) {
    one.check();
    { Model::role } -> std::convertible_to<model_role>;
    typename Model::template reads<quantities<3, double>>;
    typename Model::template partner_reads<quantities<3, double>>;
    typename Model::template writes<quantities<3, double>>;
};

}  // namespace tsubu::dem
