// SPDX-License-Identifier: MIT
/// @file
/// contact_law: a normal law and what goes with it: friction, rolling, cohesion.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/lanes.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/unrolled.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/laws/cohesionless.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/laws/coulomb.hpp>
#include <tsubu/dem/laws/dmt_cohesion.hpp>
#include <tsubu/dem/laws/free_rolling.hpp>
#include <tsubu/dem/laws/frictionless.hpp>
#include <tsubu/dem/laws/hertz_dashpot_normal.hpp>
#include <tsubu/dem/laws/hertz_normal.hpp>
#include <tsubu/dem/laws/hertz_tsuji_normal.hpp>
#include <tsubu/dem/laws/hooke_dashpot_normal.hpp>
#include <tsubu/dem/laws/hooke_normal.hpp>
#include <tsubu/dem/laws/linear_history.hpp>
#include <tsubu/dem/laws/mindlin_history.hpp>
#include <tsubu/dem/laws/rolling_resistance.hpp>
#include <tsubu/dem/laws/until_separation.hpp>
#include <tsubu/dem/laws/without_attraction.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/store/field.hpp>

#include <cstddef>      // std::size_t
#include <type_traits>  // std::conditional_t

namespace tsubu::dem {
namespace detail {

/// Whether it plays this role; what is no part of a contact law at all plays none.
template <contact_role Role, class Part>
inline constexpr bool has_role = false;
template <contact_role Role, class Part>
    requires requires { requires Part::role == Role; }
inline constexpr bool has_role<Role, Part> = true;

/// The part that plays a role, or what stands for it where none is given.
template <contact_role Role, class Default, class... Parts>
struct part_for {
    using type = Default;
};
template <contact_role Role, class Default, class First, class... Rest>
struct part_for<Role, Default, First, Rest...> {
    using type = typename std::conditional_t<has_role<Role, First>, part_for<Role, First>,
                                             part_for<Role, Default, Rest...>>::type;
};
template <contact_role Role, class... Parts>
inline constexpr std::size_t parts_for = (std::size_t{0} + ... + (has_role<Role, Parts> ? 1U : 0U));

/// Refuses what is no part; asked of one at a time, and of its role alone, so that the compiler says which and why.
template <class Part>
consteval bool is_part() {
    if constexpr (has_role<contact_role::tangential, Part>)
        static_assert(tangential_law<Part>, "this law of friction lacks what the concept tangential_law asks for");
    else if constexpr (has_role<contact_role::rolling, Part>)
        static_assert(rolling_law<Part>, "this law of rolling lacks what the concept rolling_law asks for");
    else if constexpr (has_role<contact_role::cohesion, Part>)
        static_assert(cohesion_law<Part>, "this law of cohesion lacks what the concept cohesion_law asks for");
    else
        static_assert(contact_part<Part>,
                      "this is no part of a contact law: a law of friction, of rolling, of cohesion or of release is");
    return true;
}

}  // namespace detail

/// What a contact does to i; to j it does the opposite, but for the torque of the tangential force, which has j's
/// radius as its arm.
template <std::size_t D, class Real>
struct contact_action {
    vec<D, Real> force;                ///< on i [N]
    vec<spin_count<D>, Real> twist;    ///< normal x tangential force: -R_i twist is the torque on i [N]
    vec<spin_count<D>, Real> rolling;  ///< torque against rolling on i [N m]
};

/// How two bodies that overlap act on each other: a normal law and its parts, each at most once, in any order.
///
/// Friction and rolling resistance are limited by the force of the normal law alone, repulsion and dashpot: cohesion is
/// subtracted from the force that bodies feel, not from what presses their surfaces together. So |F_t| <= mu
/// |F + pull|, F the force along the normal that is measured from outside. (LAMMPS' pair_style granular adds the pull
/// once more.)
///
///     using glass = tsubu::dem::hertz<tsubu::dem::mindlin_history>;
///     glass law{{.modulus = 2.5e10}, {.shear_modulus = 1.1e10, .mu = 0.3}};
///
/// Reads:  position; velocity if it is damped or slides; angular velocity if it turns; what contacts remember.
/// Writes: force; torque if it turns; what contacts remember.
///
/// @tparam Normal  a normal_law
/// @tparam Parts   each a contact_part: frictionless (default), coulomb, linear_history or mindlin_history;
///                 free_rolling (default) or rolling_resistance; cohesionless (default) or dmt_cohesion;
///                 until_separation (default) or without_attraction
template <normal_law Normal, class... Parts>
class contact_law {
    static_assert((detail::is_part<Parts>() && ...));
    static_assert(detail::parts_for<contact_role::tangential, Parts...> <= 1,
                  "two laws of friction in one contact law");
    static_assert(detail::parts_for<contact_role::rolling, Parts...> <= 1, "two laws of rolling in one contact law");
    static_assert(detail::parts_for<contact_role::cohesion, Parts...> <= 1, "two laws of cohesion in one contact law");
    static_assert(detail::parts_for<contact_role::release, Parts...> <= 1, "two ends of one contact");

public:
    using normal_type = Normal;
    using tangential_type = typename detail::part_for<contact_role::tangential, frictionless, Parts...>::type;
    using rolling_type = typename detail::part_for<contact_role::rolling, free_rolling, Parts...>::type;
    using cohesion_type = typename detail::part_for<contact_role::cohesion, cohesionless, Parts...>::type;
    using release_type = typename detail::part_for<contact_role::release, until_separation, Parts...>::type;

private:
    static_assert(Normal::is_hertzian || tangential_type::template goes_with<Normal>,
                  "mindlin_history is the tangential stiffness of a Hertzian contact; take linear_history with hooke");
    static_assert(!Normal::is_hertzian || tangential_type::template goes_with<Normal>,
                  "linear_history is the tangential stiffness of a linear contact; take mindlin_history with hertz");
    static_assert(cohesion_type::template goes_with<Normal>,
                  "dmt_cohesion belongs to a Hertzian contact; take hertz or hertz_tsuji");
    static_assert(tangential_type::turns || !rolling_type::resists,
                  "rolling_resistance without friction: nothing makes a sphere roll; add a law of friction");
    static_assert(Normal::is_damped || !release_type::never_pulls,
                  "without_attraction is the end of a damped contact; this normal law never pulls");
    static_assert(!cohesion_type::pulls || !release_type::never_pulls, "without_attraction contradicts cohesion");

public:
    static constexpr auto role = model_role::contacts;
    /// Whether particles spin, and whether the force needs velocities.
    static constexpr bool turns = tangential_type::turns;
    static constexpr bool needs_velocity = Normal::is_damped || turns;
    /// Whether what a contact does depends on its past, and how many numbers hold that.
    template <std::size_t D>
    static constexpr std::size_t history_size =
        tangential_type::template history_size<D> + rolling_type::template history_size<D>;

    template <class Q>
    using partner_reads = union_of<typename Q::place_fields,
                                   union_of<std::conditional_t<needs_velocity, fields<Q::velocity>, fields<>>,
                                            std::conditional_t<turns, fields<Q::angular_velocity>, fields<>>>>;
    template <class Q>
    using history = std::conditional_t<history_size<Q::dimension> != 0,
                                       fields<Q::template contacts<history_size<Q::dimension>>>, fields<>>;
    template <class Q>
    using reads = union_of<partner_reads<Q>, history<Q>>;
    template <class Q>
    using writes = union_of<fields<Q::force>,
                            union_of<std::conditional_t<turns, fields<Q::torque>, fields<>>, history<Q>>>;

    contact_law() = default;
    /// @throws input_error if a parameter is negative, 0 where it may not be, or not finite; or if friction is to share
    ///                     the damping of a normal law that has none.
    explicit contact_law(const Normal& normal, const Parts&... parts) : normal_(normal) {
        (take(parts), ...);
        check();
    }
    /// @throws input_error as the constructor.
    void check() const {
        normal_.check();
        tangential_.check();
        rolling_.check();
        cohesion_.check();
        if constexpr (!Normal::is_damped && damping_sharing_law<tangential_type>)
            if (tangential_.damping != 0)
                tsubu::detail::raise<input_error>("dem::contact_law",
                                                  "friction takes a share of " +
                                                      tsubu::detail::shown(tangential_.damping) +
                                                      " of the normal law's damping, and this one has none",
                                                  "take hertz_tsuji or hertz_dashpot, or a share of 0");
    }

    [[nodiscard]] const Normal& normal() const noexcept { return normal_; }
    [[nodiscard]] const tangential_type& tangential() const noexcept { return tangential_; }
    [[nodiscard]] const rolling_type& rolling() const noexcept { return rolling_; }
    [[nodiscard]] const cohesion_type& cohesion() const noexcept { return cohesion_; }

    /// The force along the normal, positive if it repels [N].
    /// @tparam IsDamped  false: damping is left to the integrator
    template <bool IsDamped, std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] Real normal_force(const contact<D, Real>& at) const noexcept {
        Real force = normal_.elastic(at.overlap, at.radius);
        if constexpr (Normal::is_damped && IsDamped)
            force = force - normal_.damping(at.overlap, at.mass, at.radius) * dot<D, Real>(at.velocity, at.normal);
        if constexpr (release_type::never_pulls && IsDamped) force = lanewise::greatest(force, Real(0));
        return force;
    }
    /// What the contact does, and what it remembers then.
    /// @param[in,out] past  [history_size<D>]
    template <bool IsDamped, std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] contact_action<D, Real> act(const contact<D, Real>& at,
                                                                  vec<history_size<D>, Real>& past) const noexcept {
        const Real repulsion = normal_force<IsDamped, D, Real>(at);
        Real along = repulsion;
        if constexpr (cohesion_type::pulls) along = along - cohesion_.pull(at.radius);
        contact_action<D, Real> result;
        result.force = scaled<D, Real>(at.normal, along);
        if constexpr (turns) {
            constexpr auto own = tangential_type::template history_size<D>;
            auto spring = vector_of<own, Real>([&](auto k) __attribute__((always_inline)) { return past[k]; });
            const auto friction = tangential_.template force<D, Real>(
                at, repulsion, normal_.damping(at.overlap, at.mass, at.radius), spring);
            unrolled<own>([&](auto k) __attribute__((always_inline)) { past[k] = spring[k]; });
            result.force = plus<D, Real>(result.force, friction);
            result.twist = torque_of(at.normal, friction);
            if constexpr (rolling_type::resists) {
                constexpr auto rest = rolling_type::template history_size<D>;
                auto turn =
                    vector_of<rest, Real>([&](auto k) __attribute__((always_inline)) { return past[own + k]; });
                result.rolling = rolling_.template torque<D, Real>(at, repulsion,
                                                                   normal_.stiffness(at.overlap, at.radius), turn);
                unrolled<rest>([&](auto k) __attribute__((always_inline)) { past[own + k] = turn[k]; });
            }
        }
        return result;
    }

private:
    template <class Part>
    void take(const Part& part) {
        if constexpr (detail::has_role<contact_role::tangential, Part>) tangential_ = part;
        if constexpr (detail::has_role<contact_role::rolling, Part>) rolling_ = part;
        if constexpr (detail::has_role<contact_role::cohesion, Part>) cohesion_ = part;
    }

    Normal normal_{};
    tangential_type tangential_{};
    rolling_type rolling_{};
    cohesion_type cohesion_{};
};

template <class... Parts>
using hooke = contact_law<hooke_normal, Parts...>;
static_assert(model<hooke<>>);
template <class... Parts>
using hooke_dashpot = contact_law<hooke_dashpot_normal, Parts...>;
template <class... Parts>
using hertz = contact_law<hertz_normal, Parts...>;
template <class... Parts>
using hertz_dashpot = contact_law<hertz_dashpot_normal, Parts...>;
template <class... Parts>
using hertz_tsuji = contact_law<hertz_tsuji_normal, Parts...>;

template <class Law>
inline constexpr bool is_contact_law = false;
template <class Normal, class... Parts>
inline constexpr bool is_contact_law<contact_law<Normal, Parts...>> = true;

}  // namespace tsubu::dem
