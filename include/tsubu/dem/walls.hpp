// SPDX-License-Identifier: MIT
/// @file
/// walls: planes that particles touch.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/store/field.hpp>

#include <cmath>    // std::abs, std::sqrt
#include <cstddef>  // std::size_t
#include <string>   // std::to_string
#include <vector>   // std::vector

namespace tsubu::dem {

/// A plane that does not move: particles are on the side that its normal points to.
struct plane {
    vec<3> point;   ///< any point of it [m]; in D dimensions the first D
    vec<3> normal;  ///< of length 1
};

/// Planes that particles touch, by the contact law of the scene: as a sphere of infinite radius and mass.
///
///     tsubu::dem::walls{{{.point = {0, 0, 0}, .normal = {0, 0, 1}}}}
///
/// The box may be larger than what they enclose, and is not periodic where particles would come to their back.
///
/// Concept:       model.
/// Cost:          of each list of neighbours, particles times walls; of each step, a pair for each particle near one.
/// Bytes:         none per particle; 8 for each that is near a wall, and its history.
/// Deterministic: yes.
/// Choose it for floors, faces and slopes that stay where they are.
/// Do not for walls that move, end, or are round: glue them of spheres of infinite mass.
struct walls {
    static constexpr auto role = model_role::walls;
    template <class Q>
    using reads = typename Q::place_fields;
    template <class Q>
    using partner_reads = fields<>;
    template <class Q>
    using writes = fields<Q::force>;

    std::vector<plane> planes;  ///< each pushes to the side that its normal points to

    /// @throws input_error if a normal has not the length 1, to within 1e-12, or a point is not finite.
    void check() const {
        for (std::size_t w = 0; w < planes.size(); ++w) {
            for (const double x : planes[w].point)
                if (!tsubu::detail::is_finite(x))
                    tsubu::detail::raise<input_error>("dem::walls",
                                                      "the point of wall " + std::to_string(w) + " has a coordinate " +
                                                          tsubu::detail::shown(x) + " m",
                                                      "give finite numbers");
            const auto& n = planes[w].normal;
            const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            if (!(std::abs(length - 1) <= 1e-12))
                tsubu::detail::raise<input_error>("dem::walls",
                                                  "the normal of wall " + std::to_string(w) + " has the length " +
                                                      tsubu::detail::shown(length),
                                                  "give a unit vector that points to the particles");
        }
    }
};
static_assert(model<walls>);

}  // namespace tsubu::dem
