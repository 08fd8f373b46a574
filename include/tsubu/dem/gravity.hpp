// SPDX-License-Identifier: MIT
/// @file
/// gravity: the same acceleration of all particles.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/store/field.hpp>

namespace tsubu::dem {

/// The same acceleration of all particles.
///
///     tsubu::dem::gravity{{0, 0, -9.81}}
///
/// Concept:       model.
/// Cost:          D additions per particle and step, with the motion.
/// Bytes:         none per particle.
/// Deterministic: yes.
/// Choose it where all particles fall alike.
/// Do not for a field that differs from place to place, or with time: there is none here.
struct gravity {
    static constexpr auto role = model_role::acceleration;
    template <class Q>
    using reads = fields<>;
    template <class Q>
    using partner_reads = fields<>;
    template <class Q>
    using writes = fields<>;

    vec<3> acceleration;  ///< [m/s^2]; in D dimensions the first D

    /// @throws input_error if a component is not finite.
    void check() const {
        for (const double a : acceleration)
            if (!tsubu::detail::is_finite(a))
                tsubu::detail::raise<input_error>("dem::gravity",
                                                  "an acceleration of " + tsubu::detail::shown(a) + " m/s^2",
                                                  "give finite numbers");
    }
};
static_assert(model<gravity>);

}  // namespace tsubu::dem
