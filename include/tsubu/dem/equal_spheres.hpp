// SPDX-License-Identifier: MIT
/// @file
/// equal_spheres: all particles have the same radius and mass.
#pragma once

#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/store/field.hpp>

namespace tsubu::dem {

/// All particles have the same radius and mass.
///
/// Concept:       model.
/// Cost:          none: radius and mass are constants of the kernels.
/// Bytes:         none per particle.
/// Deterministic: yes.
/// Choose it where they have: 16 bytes per particle, and the loads of them, are saved.
/// Do not where one differs, or is to be held fast: spheres.
struct equal_spheres {
    static constexpr auto role = model_role::bodies;
    static constexpr bool are_equal = true;
    template <class Q>
    using reads = fields<>;
    template <class Q>
    using partner_reads = fields<>;
    template <class Q>
    using writes = fields<>;

    double radius;  ///< [m]
    double mass;    ///< [kg]

    /// @throws input_error if one of them is not a finite number above 0.
    void check() const {
        detail::check_positive("dem::equal_spheres", "radius", radius, "m");
        detail::check_positive("dem::equal_spheres", "mass", mass, "kg",
                               "give a finite number above 0; to hold particles fast take spheres");
    }
};
static_assert(model<equal_spheres>);

}  // namespace tsubu::dem
