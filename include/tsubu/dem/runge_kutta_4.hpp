// SPDX-License-Identifier: MIT
/// @file
/// runge_kutta_4: the classical method of fourth order.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/dem/integrator.hpp>
#include <tsubu/store/field.hpp>

#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// The classical Runge-Kutta method.
///
/// Concept: integrator. Cost: four force evaluations per step; bytes: 4 D numbers, for what the step began with and the
/// sum of its slopes; deterministic.
/// Order: 4 for smooth forces, with velocities too; of a contact what that allows. Energy drifts.
/// Choose it for smooth problems with damping. Do not for collisions, nor for long runs without damping: pefrl. What
/// makes particles spin does not compile with it.
/// Source: Kutta 1901.
struct runge_kutta_4 {
    static constexpr unsigned force_evaluations = 4;
    static constexpr bool moves_spins = false;
    static constexpr bool solves_damping = false;
    /// Numerically, rounded down: 2.62 is the least of all z in (0, 1], at z = .5; beyond, the fast one of two real
    /// modes has to be below 2.785.
    [[nodiscard]] static double stable_until(double z) noexcept {
        if (z == 0) return 2.82;
        return z <= 1 ? 2.62 : 2.785 / (z + std::sqrt(z * z - 1));
    }

    /// What a particle began the step with, and the slopes so far.
    template <class Q>
    struct progress {
        using vector_type = vec<Q::dimension, typename Q::real>;
        vector_type velocity;  ///< at the beginning [m/s]
        vector_type gone;      ///< from the beginning [m]
        vector_type moved;     ///< sum of weighted velocities [m/s]
        vector_type kicked;    ///< sum of weighted accelerations [m/s^2]
    };
    /// What a particle carries from stage to stage: where the step began, and the sums so far.
    template <class Q>
    static constexpr field<"runge_kutta_progress", progress<Q>, "", field_traits{.when = travels::never}> so_far{};
    template <class Q>
    using keeps = fields<so_far<Q>>;

    template <class Run>
    static void advance(Run& run, double h, std::size_t steps) {
        using quantities = typename Run::simulation_type::quantities_type;
        for (std::size_t n = 0; n < steps; ++n) {
            for (auto& one : run.particles().owned()[so_far<quantities>]) one = {};
            stage(run, 1, h / 2, true);
            stage(run, 2, h / 2, false);
            stage(run, 2, h, false);
            finish(run, h);
            run.end_step();
        }
    }

private:
    // Positions move by differences: where a stage is wrapped into the box, the next goes on from there.
    template <class Run>
    static void stage(Run& run, double weight, double duration, bool is_first) {
        using quantities = typename Run::simulation_type::quantities_type;
        using real = typename quantities::real;
        const auto states = run.particles().owned()[so_far<quantities>];
        const auto velocities = run.particles().owned()[quantities::velocity];
        run.displace([&](std::size_t i) {
            auto& one = states[i];
            auto& v = velocities[i];
            if (is_first) one.velocity = v;
            const auto a = run.acceleration(i);
            vec<quantities::dimension, real> step;
            for (std::size_t k = 0; k < quantities::dimension; ++k) {
                one.moved[k] += static_cast<real>(weight) * v[k];
                one.kicked[k] += static_cast<real>(weight) * a[k];
                const auto target = static_cast<real>(duration) * v[k];
                step[k] = target - one.gone[k];
                one.gone[k] = target;
                v[k] = one.velocity[k] + static_cast<real>(duration) * a[k];
            }
            return step;
        });
        run.clear_forces();
        run.evaluate_forces();
    }
    template <class Run>
    static void finish(Run& run, double h) {
        using quantities = typename Run::simulation_type::quantities_type;
        using real = typename quantities::real;
        const auto states = run.particles().owned()[so_far<quantities>];
        const auto velocities = run.particles().owned()[quantities::velocity];
        run.displace([&](std::size_t i) {
            auto& one = states[i];
            auto& v = velocities[i];
            const auto a = run.acceleration(i);
            vec<quantities::dimension, real> step;
            for (std::size_t k = 0; k < quantities::dimension; ++k) {
                step[k] = static_cast<real>(h / 6) * (one.moved[k] + v[k]) - one.gone[k];
                v[k] = one.velocity[k] + static_cast<real>(h / 6) * (one.kicked[k] + a[k]);
            }
            return step;
        });
        run.clear_forces();
        run.evaluate_forces();
    }
};
static_assert(integrator<runge_kutta_4>);

}  // namespace tsubu::dem
