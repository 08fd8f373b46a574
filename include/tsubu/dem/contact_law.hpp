// SPDX-License-Identifier: MIT
/// @file
/// contact_law: a normal law and what goes with it: friction, rolling, cohesion.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/cohesion.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/dem/normal_laws.hpp>
#include <tsubu/dem/rolling_resistance.hpp>
#include <tsubu/dem/tangential_laws.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/store/field.hpp>

#include <cstddef>      // std::size_t
#include <type_traits>  // std::conditional_t

namespace tsubu::dem {
namespace detail {

/// The part that plays a role, or what stands for it where none is given.
template <contact_role Role, class Default, class... Parts>
struct part_for {
    using type = Default;
};
template <contact_role Role, class Default, class First, class... Rest>
struct part_for<Role, Default, First, Rest...> {
    using type = typename std::conditional_t<First::role == Role, part_for<Role, First>,
                                             part_for<Role, Default, Rest...>>::type;
};
template <contact_role Role, class... Parts>
inline constexpr std::size_t parts_for = (std::size_t{0} + ... + (Parts::role == Role ? 1U : 0U));

}  // namespace detail

/// What a contact does to i; to j it does the opposite, but for the torque of the tangential force, which has j's radius
/// as its arm.
template <std::size_t D, class Real>
struct contact_action {
    vec<D, Real> force;                           ///< on i [N]
    vec<contact<D, Real>::spins, Real> twist;     ///< normal x tangential force: -R_i twist is the torque on i [N]
    vec<contact<D, Real>::spins, Real> rolling;   ///< torque against rolling on i [N m]
};

/// How two bodies that overlap act on each other: a normal law and its parts, each at most once, in any order.
///
///     using glass = tsubu::dem::hertz<tsubu::dem::mindlin_history>;
///     glass law{{.modulus = 2.5e10}, {.shear_modulus = 1.1e10, .mu = 0.3}};
///
/// Reads:  position; velocity if it is damped or slides; angular velocity if it turns; what contacts remember.
/// Writes: force; torque if it turns; what contacts remember.
///
/// @tparam Normal  a normal_law
/// @tparam Parts   frictionless (default), coulomb, linear_history or mindlin_history; free_rolling (default) or
///                 rolling_resistance; cohesionless (default) or dmt_cohesion; until_separation (default) or
///                 without_attraction
template <normal_law Normal, class... Parts>
class contact_law {
    static_assert(detail::parts_for<contact_role::tangential, Parts...> <= 1, "two laws of friction in one contact law");
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
    static constexpr std::size_t history_size = tangential_type::template history_size<D> + rolling_type::template history_size<D>;

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
    /// Any order of the parts. @throws input_error if a parameter is negative, 0 where it may not be, or not finite.
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
    /// @param[in,out] memory  [history_size<D>]
    template <bool IsDamped, std::size_t D, class Real>
    [[nodiscard, gnu::always_inline]] contact_action<D, Real> act(const contact<D, Real>& at,
                                                                  vec<history_size<D>, Real>& memory) const noexcept {
        const Real repulsion = normal_force<IsDamped, D, Real>(at);
        Real along = repulsion;
        if constexpr (cohesion_type::pulls) along = along - cohesion_.pull(at.radius);
        contact_action<D, Real> result;
        result.force = scaled<D, Real>(at.normal, along);
        if constexpr (turns) {
            constexpr auto own = tangential_type::template history_size<D>;
            auto spring =
                vector_of<own, Real>([&](auto k) __attribute__((always_inline)) { return memory[k]; });
            const auto friction = tangential_.template force<D, Real>(
                at, repulsion, normal_.damping(at.overlap, at.mass, at.radius), spring);
            unrolled<own>([&](auto k) __attribute__((always_inline)) { memory[k] = spring[k]; });
            result.force = plus<D, Real>(result.force, friction);
            result.twist = torque_of(at.normal, friction);
            if constexpr (rolling_type::resists) {
                constexpr auto spins = contact<D, Real>::spins;
                auto turn = vector_of<spins, Real>(
                    [&](auto k) __attribute__((always_inline)) { return memory[own + k]; });
                result.rolling = rolling_.template torque<D, Real>(at, repulsion,
                                                                   normal_.stiffness(at.overlap, at.radius), turn);
                unrolled<spins>([&](auto k) __attribute__((always_inline)) { memory[own + k] = turn[k]; });
            }
        }
        return result;
    }

private:
    template <class Part>
    void take(const Part& part) {
        if constexpr (Part::role == contact_role::tangential) tangential_ = part;
        if constexpr (Part::role == contact_role::rolling) rolling_ = part;
        if constexpr (Part::role == contact_role::cohesion) cohesion_ = part;
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
