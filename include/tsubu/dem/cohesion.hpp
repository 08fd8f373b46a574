// SPDX-License-Identifier: MIT
/// @file
/// Cohesion: what pulls bodies together while they touch.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/normal_laws.hpp>

namespace tsubu::dem {

/// Nothing pulls.
struct cohesionless {
    static constexpr auto role = contact_role::cohesion;
    static constexpr bool pulls = false;
    template <class Normal>
    static constexpr bool goes_with = true;
    void check() const {}
};

/// The pull of stiff, small spheres: 2 pi w R* for as long as they touch.
///
/// Choose it for fine, hard powders. With hertz_normal or hertz_tsuji_normal only: it is what remains of their elastic
/// adhesion.
/// Source: Derjaguin, Muller & Toporov 1975, doi:10.1016/0021-9797(75)90018-1.
struct dmt_cohesion {
    static constexpr auto role = contact_role::cohesion;
    static constexpr bool pulls = true;
    template <class Normal>
    static constexpr bool goes_with = Normal::is_hertzian;
    double work;  ///< of adhesion w [J/m^2]: twice the surface energy

    void check() const { detail::check_not_negative("work of adhesion", work, "J/m^2"); }
    template <class Real>
    [[nodiscard, gnu::always_inline]] Real pull(const Real& radius) const noexcept {
        constexpr double two_pi = 6.283185307179586477;
        return Real(static_cast<number_of<Real>>(two_pi * work)) * radius;
    }
};

/// When a damped contact ends: where the bodies part, even if the dashpot has pulled before.
struct until_separation {
    static constexpr auto role = contact_role::release;
    static constexpr bool never_pulls = false;
    void check() const {}
};
/// It ends where the dashpot would begin to pull: the other definition of restitution.
/// Source: Schwager & Poschel 2007, doi:10.1007/s10035-007-0065-z.
struct without_attraction {
    static constexpr auto role = contact_role::release;
    static constexpr bool never_pulls = true;
    void check() const {}
};

}  // namespace tsubu::dem
