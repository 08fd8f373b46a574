// SPDX-License-Identifier: MIT
/// @file
/// free_rolling: no torque against rolling.
#pragma once

#include <tsubu/dem/laws/concepts.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// No torque against rolling.
///
/// Concept:       rolling_law.
/// Cost:          none.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it for spheres that are round.
/// Do not for heaps of grains that are not: rolling_resistance.
struct free_rolling {
    static constexpr auto role = contact_role::rolling;
    static constexpr bool resists = false;
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
    void check() const {}
};
static_assert(rolling_law<free_rolling>);

}  // namespace tsubu::dem
