// SPDX-License-Identifier: MIT
/// @file
/// sliding_spring: a spring along the surface that yields to friction, as tangential laws with a history have it.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <cstddef>  // std::size_t

namespace tsubu::dem::detail {

/// A spring along the surface, cut off where it would pull more than friction holds: Cundall and Strack's.
/// @param stiffness       of the spring [N/m]
/// @param viscosity       of the dashpot beside it [N s/m]
/// @param[in,out] spring  how long it is [m]
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> sliding_spring(const contact<D, Real>& at,
                                                                     const Real& normal_force, const Real& stiffness,
                                                                     const Real& viscosity, const Real& mu,
                                                                     vec<D, Real>& spring) noexcept {
    const auto slip = slip_of<D, Real>(at);
    vec<D, Real> longer = plus<D, Real>(spring, scaled<D, Real>(slip, at.time_step));
    longer = tangential<D, Real>(longer, at.normal);  // the contact has turned since
    auto pull = vector_of<D, Real>(
        [&](auto k) __attribute__((always_inline)) { return -(stiffness * longer[k] + viscosity * slip[k]); });
    spring = longer;
    const Real square = dot<D, Real>(pull, pull);
    const Real most = mu * lanewise::greatest(normal_force, -normal_force);
    const auto slides = square > most * most;
    if (lanewise::any(slides)) {  // few do where grains rest, and the root and the quotients are dear
        const Real one = constant<Real>(1);
        pull = scaled<D, Real>(pull, lanewise::select(slides, most / lanewise::sqrt(square), one));
        // What the spring holds is the force that is left, less what the dashpot gives.
        const Real softness = one / stiffness;
        spring = vector_of<D, Real>([&](auto k) __attribute__((always_inline)) {
            return lanewise::select(slides, -((pull[k] + viscosity * slip[k]) * softness), longer[k]);
        });
    }
    return pull;
}

}  // namespace tsubu::dem::detail
