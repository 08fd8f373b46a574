// SPDX-License-Identifier: MIT
/// @file
/// cohesionless: nothing pulls bodies together.
#pragma once

#include <tsubu/dem/laws/concepts.hpp>

namespace tsubu::dem {

/// Nothing pulls.
///
/// Concept:       cohesion_law.
/// Cost:          none.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it for grains whose weight is more than what they stick with: dry, and above 0.1 mm.
/// Do not for fine powders: dmt_cohesion.
struct cohesionless {
    static constexpr auto role = contact_role::cohesion;
    static constexpr bool pulls = false;
    template <class Normal>
    static constexpr bool goes_with = true;
    void check() const {}
};
static_assert(cohesion_law<cohesionless>);

}  // namespace tsubu::dem
