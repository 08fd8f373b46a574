// SPDX-License-Identifier: MIT
/// @file
/// dmt_cohesion: the pull of stiff, small spheres while they touch.
#pragma once

#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/detail/parameter_checks.hpp>
#include <tsubu/dem/laws/concepts.hpp>

#include <numbers>  // std::numbers::pi

namespace tsubu::dem {

/// The pull of stiff, small spheres: 2 pi w R* for as long as they touch.
///
/// Concept:       cohesion_law.
/// Cost:          one product per contact.
/// Bytes:         none per contact.
/// Deterministic: yes.
/// Choose it for fine, hard powders, with a Hertzian normal law: it is what remains of the adhesion of that.
/// Do not for soft or large grains, whose necks stretch before they part: there the pull outlasts the touch.
/// Source:        Derjaguin, Muller & Toporov 1975, doi:10.1016/0021-9797(75)90018-1.
struct dmt_cohesion {
    static constexpr auto role = contact_role::cohesion;
    static constexpr bool pulls = true;
    template <class Normal>
    static constexpr bool goes_with = Normal::is_hertzian;
    double work;  ///< of adhesion w [J/m^2]: twice the surface energy

    void check() const { detail::check_not_negative("dem::dmt_cohesion", "work of adhesion", work, "J/m^2"); }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real pull(const Real& radius) const noexcept {
        return constant<Real>(2 * std::numbers::pi * work) * radius;
    }
};
static_assert(cohesion_law<dmt_cohesion>);

}  // namespace tsubu::dem
