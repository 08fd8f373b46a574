// SPDX-License-Identifier: MIT
/// @file
/// spheres: each particle has its own radius and mass.
#pragma once

#include <tsubu/dem/model.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/standard_fields.hpp>

namespace tsubu::dem {

/// Each particle has its own radius and mass, in the fields tsubu::radius and tsubu::mass. One of infinite mass stays
/// where it is, or goes on at its velocity.
///
/// Concept:       model.
/// Cost:          four loads and two to four quotients per contact, of the effective radius and mass.
/// Bytes:         16 per particle.
/// Deterministic: yes.
/// Choose it where sizes differ, or some are fixed.
/// Do not where all are alike: equal_spheres.
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
