// SPDX-License-Identifier: MIT
/// @file
/// springs: permanent bonds.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/dem/model.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/term.hpp>

#include <cstddef>  // std::size_t
#include <string>   // std::to_string
#include <vector>   // std::vector

namespace tsubu::dem {

/// One kind of spring.
struct spring {
    double k;       ///< stiffness [N/m]
    double length;  ///< at rest [m]
};

/// Springs between pairs of particles, which stay: F = k (r - length). The field tsubu::bonds says between which, as
/// topology<bonds, newton_off> keeps it: each of the two has the bond, and computes its own force.
///
///     tsubu::dem::springs{{{.k = 1, .length = 1}}}     // of bonds of type 1
///
/// The halo must reach as far as they stretch: options::cutoff.
///
/// Concept:       model.
/// Cost:          one look-up of an id per bond and list of neighbours; a root and a quotient per bond, side and step.
/// Bytes:         a bond with each of its two particles.
/// Deterministic: yes.
/// Choose it for chains and networks whose bonds do not break.
/// Do not for contacts, which come and go: contact_law.
struct springs {
    static constexpr auto role = model_role::springs;
    template <class Q>
    using reads = union_of<typename Q::place_fields, fields<tsubu::bonds>>;
    template <class Q>
    using partner_reads = typename Q::place_fields;
    template <class Q>
    using writes = fields<Q::force>;

    std::vector<spring> kinds;  ///< kinds[type - 1]

    /// @throws input_error if a stiffness or a length is negative or not finite.
    void check() const {
        for (std::size_t n = 0; n < kinds.size(); ++n)
            if (!(kinds[n].k >= 0) || !(kinds[n].length >= 0) || !(kinds[n].k * kinds[n].length < 1e308))
                tsubu::detail::raise<input_error>("dem::springs",
                                                  "springs of type " + std::to_string(n + 1) + " with k = " +
                                                      tsubu::detail::shown(kinds[n].k) + " N/m and length " +
                                                      tsubu::detail::shown(kinds[n].length) + " m",
                                                  "give finite numbers of at least 0");
    }
};
static_assert(model<springs>);

}  // namespace tsubu::dem
