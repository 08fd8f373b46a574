// SPDX-License-Identifier: MIT
/// @file
/// What the parts of a contact law are: along the normal, along the surface, against rolling, cohesion, release; and
/// the tables of those that are shipped.
///
/// | normal law           | force                                      | order of e | choose it when                              |
/// |----------------------|--------------------------------------------|------------|---------------------------------------------|
/// | hooke_normal         | k d                                        | 2          | the time step is to be as long as can be    |
/// | hooke_dashpot_normal | k d - gamma m* v                           | 1          | bulk flow with a constant restitution       |
/// | hertz_normal         | 4/3 E* sqrt(R*) d^(3/2)                    | 2.5        | single impacts, waves                       |
/// | hertz_dashpot_normal | a (4/3 E* d - gamma m* v)                  | 1 (1.5)    | to compare with LAMMPS' gran/hertz          |
/// | hertz_tsuji_normal   | that of Hertz - alpha sqrt(m* K) d^(1/4) v | 1 (1.25)   | elastic spheres with a constant restitution |
///
/// The order is that in which the error of the restitution falls with the time step of velocity_verlet; in brackets
/// with implicit_velocity_verlet, whose damping does not see the velocities of the half step.
///
/// | tangential law  | history, numbers | choose it when                                                |
/// |-----------------|------------------|---------------------------------------------------------------|
/// | frictionless    | 0                | there is no rotation                                          |
/// | coulomb         | 0                | everything slides: dilute, rapid flow; a heap creeps with it  |
/// | linear_history  | D                | beds and heaps of Hookean spheres, which are to come to rest  |
/// | mindlin_history | D                | the same of Hertzian spheres                                  |
///
/// | role     | parts                                | history, numbers | choose the second when          |
/// |----------|--------------------------------------|------------------|---------------------------------|
/// | rolling  | free_rolling, rolling_resistance     | 0; 3, in 2-D 1   | grains are not round            |
/// | cohesion | cohesionless, dmt_cohesion           | 0                | the powder is fine and hard     |
/// | release  | until_separation, without_attraction | 0                | a damped contact must not pull  |
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <concepts>  // std::convertible_to, std::same_as, std::semiregular
#include <cstddef>   // std::size_t

namespace tsubu::dem {

/// What a part of a contact law stands for.
enum class contact_role { tangential, rolling, cohesion, release };

namespace detail {

template <class Law, class Real>
concept normal_law_of = requires(const Law& law, const Real& number) {
    { law.elastic(number, number) } -> std::same_as<Real>;
    { law.stiffness(number, number) } -> std::same_as<Real>;
    { law.damping(number, number, number) } -> std::same_as<Real>;
};
template <class Law, std::size_t D, class Real>
concept tangential_law_of = requires(const Law& law, const contact<D, Real>& at, const Real& number,
                                     vec<Law::template history_size<D>, Real>& history) {
    { law.template force<D, Real>(at, number, number, history) } -> std::same_as<vec<D, Real>>;
};
template <class Law, std::size_t D, class Real>
concept rolling_law_of = requires(const Law& law, const contact<D, Real>& at, const Real& number,
                                  vec<Law::template history_size<D>, Real>& history) {
    { law.template torque<D, Real>(at, number, number, history) } -> std::same_as<vec<spin_count<D>, Real>>;
};
/// Of every number that a law is asked in.
template <class Law>
concept bends_forces =
    tangential_law_of<Law, 2, double> && tangential_law_of<Law, 3, double> && tangential_law_of<Law, 3, float> &&
    tangential_law_of<Law, 3, lanes<double>> && tangential_law_of<Law, 3, lanes<float>> &&
    requires(const Law& law, double number) {
        { law.mu } -> std::convertible_to<double>;
        { law.viscosity(number, number) } -> std::same_as<double>;
    };
template <class Law>
concept gives_torques =
    rolling_law_of<Law, 2, double> && rolling_law_of<Law, 3, double> && rolling_law_of<Law, 3, float> &&
    rolling_law_of<Law, 3, lanes<double>> && rolling_law_of<Law, 3, lanes<float>> &&
    requires(const Law& law, double number) {
        { law.mu_r } -> std::convertible_to<double>;
        { law.stiffness(number, number) } -> std::same_as<double>;
        { law.viscosity(number, number, number) } -> std::same_as<double>;
    };
template <class Law, class Real>
concept pulls_by = requires(const Law& law, const Real& number) {
    { law.pull(number) } -> std::same_as<Real>;
};
template <class Law>
concept pulls_bodies = pulls_by<Law, double> && pulls_by<Law, float> && pulls_by<Law, lanes<double>> &&
                       pulls_by<Law, lanes<float>>;

/// Stands for any normal law, where it is asked which of them a part goes with.
struct some_normal {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = false;
};
template <class Part, contact_role Role>
concept plays = std::semiregular<Part> && requires(const Part& part) {
    requires Part::role == Role;
    part.check();
};
template <class Part>
concept has_history_size = requires {
    { Part::template history_size<2> } -> std::convertible_to<std::size_t>;
    { Part::template history_size<3> } -> std::convertible_to<std::size_t>;
};
template <class Part>
concept chooses_normals = requires {
    { Part::template goes_with<some_normal> } -> std::convertible_to<bool>;
};

}  // namespace detail

/// The force along the normal.
///  1. elastic(d, R*) is 0 at d = 0 and does not fall [N]; stiffness is its derivative [N/m], energy its integral [J];
///  2. damping(d, m*, R*) is not negative, and 0 if is_damped is false [N s/m]: the force is elastic - damping v, v the
///     velocity of separation;
///  3. lanes of numbers have the same results as the numbers, bit for bit: each function but energy is a template of
///     its number type, which is double, float, or lanes of either.
/// is_hertzian: the contact widens as sqrt(R* d), and so do its other springs. check() throws input_error if a
/// parameter cannot be.
template <class Law>
concept normal_law = std::semiregular<Law> && detail::normal_law_of<Law, double> && detail::normal_law_of<Law, float> &&
                     detail::normal_law_of<Law, lanes<double>> && detail::normal_law_of<Law, lanes<float>> &&
                     requires(const Law& law, double number) {
                         { Law::is_damped } -> std::convertible_to<bool>;
                         { Law::is_hertzian } -> std::convertible_to<bool>;
                         { law.energy(number, number) } -> std::same_as<double>;
                         law.check();
                     };

/// The force along the surface, of a law that turns bodies (`turns`); one that does not has no force.
///  1. force<D>(contact, F_n, damping, history) acts on i, at right angles to the normal [N]; F_n is the force of the
///     normal law [N], without cohesion and with damping unless the integrator solves for that, damping the normal
///     law's [N s/m];
///  2. |force| <= mu |F_n|;
///  3. without history it does not drive the slip, and without slip there is none;
///  4. history [history_size<D>] is 0 when a contact begins, and changes with the way alone: asked again after no time,
///     the law answers the same;
///  5. seen from j, with normal, velocity and history the other way round, force and history are the opposite,
///     exactly: across a border between ranks each computes its own side;
///  6. lanes of numbers have the same results as the numbers, bit for bit, unless built to fuse products;
///  7. viscosity(m*, damping) is the force per slip without history and below the limit [N s/m]: it limits the time
///     step (longest_time_step).
/// goes_with<Normal>: whether that normal law has its stiffness.
template <class Law>
concept tangential_law =
    detail::plays<Law, contact_role::tangential> && detail::has_history_size<Law> && detail::chooses_normals<Law> &&
    requires { { Law::turns } -> std::convertible_to<bool>; } && (!Law::turns || detail::bends_forces<Law>);

/// A tangential law whose contacts can stick:
///  8. stiffness(d, R*) is that of its spring [N/m], which limits the time step as well.
template <class Law>
concept sticking_law = tangential_law<Law> && requires(const Law& law, double number) {
    { law.stiffness(number, number) } -> std::same_as<double>;
};

/// A tangential law that takes a share of the normal law's damping: there has to be some.
template <class Law>
concept damping_sharing_law = tangential_law<Law> && requires(const Law& law) {
    { law.damping } -> std::convertible_to<double>;
};

/// The torque against rolling, of a law that resists (`resists`).
///  1. torque<D>(contact, F_n, stiffness, history) acts on i [N m]; in 3-D it is at right angles to the normal. F_n is
///     that of tangential_law, stiffness the normal law's [N/m];
///  2. what it holds where nothing turns is no more than mu_r R* |F_n|;
///  3. without history it does not drive the rolling, and without rolling there is none: turning about the normal is
///     not rolling;
///  4. history [history_size<D>] is 0 when a contact begins, and changes with the angle alone: asked again after no
///     time, the law leaves it as it is;
///  5. seen from j, with normal, turning and history the other way round, torque and history are the opposite, exactly;
///  6. lanes of numbers have the same results as the numbers, bit for bit, unless built to fuse products.
template <class Law>
concept rolling_law = detail::plays<Law, contact_role::rolling> && detail::has_history_size<Law> &&
                      requires { { Law::resists } -> std::convertible_to<bool>; } &&
                      (!Law::resists || detail::gives_torques<Law>);

/// What pulls bodies together while they touch, of a law that does (`pulls`).
///  1. pull(R*) [N] is not negative;
///  2. lanes of numbers have the same results as the numbers, bit for bit, unless built to fuse products.
/// Friction does not feel it: its limit is mu times the force of the normal law alone, so that a contact in equilibrium
/// with its pull still holds sideways. goes_with<Normal>: whether it belongs to such a contact.
template <class Law>
concept cohesion_law = detail::plays<Law, contact_role::cohesion> && detail::chooses_normals<Law> &&
                       requires { { Law::pulls } -> std::convertible_to<bool>; } &&
                       (!Law::pulls || detail::pulls_bodies<Law>);

/// When a damped contact ends.
///  1. never_pulls: the force of the normal law is cut off where it would begin to pull; if not, it is left as it is.
template <class Law>
concept release_law = detail::plays<Law, contact_role::release> &&
                      requires { { Law::never_pulls } -> std::convertible_to<bool>; };

/// What a contact law has beside its normal law: one of each role at most.
template <class Part>
concept contact_part = tangential_law<Part> || rolling_law<Part> || cohesion_law<Part> || release_law<Part>;

}  // namespace tsubu::dem
