// SPDX-License-Identifier: MIT
/// @file
/// simulation: a scene declares its models, and the compiler derives what particles carry and what travels.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/equal_spheres.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/integrator.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/dem/quantities.hpp>
#include <tsubu/dem/spheres.hpp>
#include <tsubu/dem/walls.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>      // std::size_t
#include <tuple>        // std::tuple
#include <type_traits>  // std::conditional_t, std::is_void_v, std::type_identity

namespace tsubu::dem {
namespace detail {

/// The model that plays a role, or void.
template <model_role Role, class... Models>
struct model_for {
    using type = void;
};
template <model_role Role, class First, class... Rest>
struct model_for<Role, First, Rest...> {
    using type =
        typename std::conditional_t<First::role == Role, std::type_identity<First>, model_for<Role, Rest...>>::type;
};
template <model_role Role, class... Models>
inline constexpr std::size_t models_for = (std::size_t{0} + ... + (Models::role == Role ? 1U : 0U));

template <class... Sets>
struct union_of_all {
    using type = fields<>;
};
template <class First, class... Rest>
struct union_of_all<First, Rest...> {
    using type = union_of<First, typename union_of_all<Rest...>::type>;
};

}  // namespace detail

/// A scene: a type. What its models read and write decides at compile time which fields the store has, what goes to
/// ghosts, and what a migration and a restart take along; what no model needs is neither stored, sent nor computed.
///
///     using scene = tsubu::dem::simulation<3, double, tsubu::dem::velocity_verlet,
///                                          tsubu::dem::hooke<tsubu::dem::frictionless>, tsubu::dem::gravity>;
///     static_assert(!scene::store_type::has<decltype(tsubu::torque<3>)>);
///
/// @tparam D           1, 2 or 3
/// @tparam Number      a number_policy: double, mixed_precision<double, float>, lattice<std::int64_t>, ...
/// @tparam Integrator  velocity_verlet, implicit_velocity_verlet, symplectic_euler, explicit_euler, runge_kutta_4 or
///                     pefrl
/// @tparam Models      each at most once: a contact_law, walls, springs, gravity, and equal_spheres (default) or
///                     spheres
template <std::size_t D, number_policy Number, integrator Integrator, model... Models>
struct simulation {
    static_assert(D >= 1 && D <= 3, "a scene has 1, 2 or 3 dimensions");
    static_assert(detail::models_for<model_role::contacts, Models...> <= 1, "a scene has one contact law");
    static_assert(detail::models_for<model_role::walls, Models...> <= 1, "a scene has its walls in one model");
    static_assert(detail::models_for<model_role::springs, Models...> <= 1, "a scene has one law for its springs");
    static_assert(detail::models_for<model_role::acceleration, Models...> <= 1, "a scene has one gravity");
    static_assert(detail::models_for<model_role::bodies, Models...> <= 1, "particles are equal_spheres or spheres");

    static constexpr std::size_t dimension = D;
    using number_type = Number;
    using integrator_type = Integrator;
    using quantities_type = quantities<D, Number>;
    using coordinate = typename quantities_type::coordinate;
    using real = typename quantities_type::real;
    using decomposition_type = brick_decomposition<D, coordinate>;
    using box_type = typename decomposition_type::box_type;

    using contact_type = typename detail::model_for<model_role::contacts, Models...>::type;
    using walls_type = typename detail::model_for<model_role::walls, Models...>::type;
    using springs_type = typename detail::model_for<model_role::springs, Models...>::type;
    using gravity_type = typename detail::model_for<model_role::acceleration, Models...>::type;
    using given_bodies = typename detail::model_for<model_role::bodies, Models...>::type;
    using bodies_type = std::conditional_t<std::is_void_v<given_bodies>, equal_spheres, given_bodies>;
    /// Whether a model says what size and mass the particles have; else they are equal_spheres.
    static constexpr bool names_bodies = !std::is_void_v<given_bodies>;
    /// The parameters of the models, in the order of a run's arguments.
    using models_type =
        std::conditional_t<names_bodies, std::tuple<Models...>, std::tuple<Models..., equal_spheres>>;
    template <model_role Role>
    static constexpr bool has_model = detail::models_for<Role, Models...> != 0;
    static constexpr bool has_contacts = has_model<model_role::contacts>;
    static constexpr bool has_walls = has_model<model_role::walls>;
    static constexpr bool has_springs = has_model<model_role::springs>;
    static constexpr bool has_gravity = has_model<model_role::acceleration>;
    static constexpr bool has_pairs = has_contacts || has_springs;

    static_assert(!has_walls || has_contacts, "walls act by the contact law of the scene; add one, such as hooke<>");

    /// Whether particles spin: some model turns them.
    static constexpr bool turns = [] {
        if constexpr (has_contacts)
            return contact_type::turns;
        else
            return false;
    }();
    static_assert(D > 1 || !turns, "friction in one dimension: there is no direction along the surface");
    /// How many numbers each contact remembers.
    static constexpr std::size_t history_size = [] {
        if constexpr (has_contacts)
            return contact_type::template history_size<D>;
        else
            return std::size_t{0};
    }();
    static constexpr bool has_history = history_size != 0;
    static_assert(!has_history || Integrator::force_evaluations == 1,
                  "a contact that remembers takes one step per force; take velocity_verlet or an Euler method");

    static_assert(!turns || Integrator::moves_spins,
                  "this integrator moves centres only, and friction turns particles; take velocity_verlet");
    static_assert(!Integrator::solves_damping || has_contacts, "there is no damping to solve for; add a contact law");

    /// What the motion itself reads and changes.
    using motion_fields =
        union_of<union_of<typename quantities_type::place_fields,
                          tsubu::fields<quantities_type::velocity, quantities_type::force>>,
                 std::conditional_t<turns, tsubu::fields<quantities_type::angular_velocity, quantities_type::torque>,
                                    tsubu::fields<>>>;
    using moved_fields =
        union_of<union_of<typename quantities_type::place_fields, tsubu::fields<quantities_type::velocity>>,
                 std::conditional_t<turns, tsubu::fields<quantities_type::angular_velocity>, tsubu::fields<>>>;
    /// What each force evaluation writes anew.
    using summed_fields = union_of<tsubu::fields<quantities_type::force>,
                                   std::conditional_t<turns, tsubu::fields<quantities_type::torque>, tsubu::fields<>>>;

    /// What a particle carries.
    using fields = typename detail::union_of_all<
        tsubu::fields<tsubu::id>, motion_fields, typename Integrator::template keeps<quantities_type>,
        typename bodies_type::template reads<quantities_type>, typename Models::template reads<quantities_type>...,
        typename Models::template writes<quantities_type>...>::type;
    /// What pairs read of a ghost.
    using ghost_fields =
        typename detail::union_of_all<typename std::conditional_t<has_pairs, bodies_type, equal_spheres>::template
                                      partner_reads<quantities_type>,
                                      typename Models::template partner_reads<quantities_type>...>::type;
    /// What goes to ghosts every step: what pairs read of them, and the motion changes.
    using forward_fields = intersection_of<ghost_fields, moved_fields>;
    /// What goes along when a particle changes its rank: all but what the next force evaluation writes anew.
    using migration_fields = difference_of<fields, summed_fields>;
    /// What a restart holds: all, since the next step begins with the forces of the last.
    using restart_fields = fields;

    using store_type = particle_store<fields>;
    static constexpr std::size_t bytes_per_particle = store_type::bytes_per_particle;
};

}  // namespace tsubu::dem
