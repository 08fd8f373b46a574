// SPDX-License-Identifier: MIT
/// @file
/// frictionless: no force along the surface.
#pragma once

#include <tsubu/dem/laws/concepts.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// No force along the surface: nothing turns.
///
/// Concept:       tangential_law.
/// Cost:          none: particles have no spins and no torques.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it where rotation does not matter: gases, waves, the first try of any scene.
/// Do not where a heap is to stand: linear_history, mindlin_history.
struct frictionless {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = false;
    template <class Normal>
    static constexpr bool goes_with = true;
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
    void check() const {}
};
static_assert(tangential_law<frictionless>);

}  // namespace tsubu::dem
