// SPDX-License-Identifier: MIT
/// @file
/// without_attraction: a damped contact ends where the dashpot would begin to pull.
#pragma once

#include <tsubu/dem/laws/concepts.hpp>

namespace tsubu::dem {

/// A damped contact ends where the dashpot would begin to pull: the other definition of restitution.
///
/// Concept:       release_law.
/// Cost:          one comparison per contact.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it where dry grains must not stick for a moment as they part.
/// Do not with cohesion, nor with a normal law without damping (neither compiles).
/// Source:        Schwager & Poschel 2007, doi:10.1007/s10035-007-0065-z.
struct without_attraction {
    static constexpr auto role = contact_role::release;
    static constexpr bool never_pulls = true;
    void check() const {}
};
static_assert(release_law<without_attraction>);

}  // namespace tsubu::dem
