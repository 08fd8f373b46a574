// SPDX-License-Identifier: MIT
/// @file
/// until_separation: a damped contact ends where the bodies part.
#pragma once

#include <tsubu/dem/laws/concepts.hpp>

namespace tsubu::dem {

/// A damped contact ends where the bodies part, even if the dashpot has pulled before.
///
/// Concept:       release_law.
/// Cost:          none.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it to compare with LAMMPS, and with formulas of the restitution that take the time of contact from the
/// overlap.
/// Do not where a dry contact must not pull: without_attraction.
struct until_separation {
    static constexpr auto role = contact_role::release;
    static constexpr bool never_pulls = false;
    void check() const {}
};
static_assert(release_law<until_separation>);

}  // namespace tsubu::dem
