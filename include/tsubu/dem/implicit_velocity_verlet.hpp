// SPDX-License-Identifier: MIT
/// @file
/// implicit_velocity_verlet: velocity Verlet whose damping sees the velocities of the full step.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/dem/integrator.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/store/field.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// Velocity Verlet whose damping sees the velocities at the end of the step, which it solves for: of one contact
/// v = (v_half + h/2 f_elastic) / (1 + h/2 c), of several by going round them until nothing changes.
///
/// Concept: integrator. Cost: one force evaluation per step, and a round of the contacts per digit or so: five to ten
/// times velocity_verlet's step where many touch; bytes: D numbers; deterministic on so many ranks.
/// Order of the restitution: min(p + 1, q + 1, 2), p and q the powers of the overlap in force and damping: 1.25 with
/// hertz_tsuji, 1 with a dashpot, which begins with a jump. Stable for omega dt < 2 whatever the damping.
/// Choose it where damping is strong, or restitution is to be accurate. Do not in large beds, whose bulk does not tell
/// the two apart. Friction does not compile with it.
struct implicit_velocity_verlet {
    static constexpr unsigned force_evaluations = 1;
    static constexpr bool moves_spins = false;
    static constexpr bool solves_damping = true;
    [[nodiscard]] static double stable_until(double) noexcept { return 2; }
    /// Velocities at the end of the step, while they are solved for.
    template <class Q>
    static constexpr field<"solved_velocity", vec<Q::dimension, typename Q::real>, "m/s",
                           field_traits{.when = travels::every_step, .image = under_image::rotates}>
        solved{};
    template <class Q>
    using keeps = fields<solved<Q>>;

    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        velocity_verlet::advance(run, h, steps);
    }
};
static_assert(integrator<implicit_velocity_verlet>);

}  // namespace tsubu::dem
