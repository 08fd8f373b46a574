// SPDX-License-Identifier: MIT
/// @file
/// What sizes and masses particles have: the same, or each its own.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>  // std::size_t
#include <limits>   // std::numeric_limits
#include <string>   // std::to_string

namespace tsubu::dem {

/// All particles have the same radius and mass.
///
/// Choose it where they have: 16 bytes per particle, and the loads of them, are saved. Do not where one differs.
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
        if (!(radius > 0) || !(radius <= (std::numeric_limits<double>::max)()))
            tsubu::detail::raise<input_error>("dem::equal_spheres", "a radius of " + tsubu::detail::shown(radius),
                                              "give a finite length above 0");
        if (!(mass > 0) || !(mass <= (std::numeric_limits<double>::max)()))
            tsubu::detail::raise<input_error>("dem::equal_spheres", "a mass of " + tsubu::detail::shown(mass),
                                              "give a finite mass above 0; to hold particles fast take spheres");
    }
};
static_assert(model<equal_spheres>);

/// Each particle has its own radius and mass, in the fields tsubu::radius and tsubu::mass. One of infinite mass stays
/// where it is, or goes on at its velocity.
///
/// Choose it where sizes differ, or some are fixed. Do not where all are alike: equal_spheres.
struct spheres {
    static constexpr auto role = model_role::bodies;
    static constexpr bool are_equal = false;
    template <class Q>
    using reads = fields<tsubu::radius, tsubu::mass>;
    template <class Q>
    using partner_reads = fields<tsubu::radius, tsubu::mass>;
    template <class Q>
    using writes = fields<>;

    void check() const {}
};
static_assert(model<spheres>);

}  // namespace tsubu::dem
