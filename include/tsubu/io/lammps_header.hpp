// SPDX-License-Identifier: MIT
/// @file
/// lammps_header: what stands at the top of a LAMMPS data file.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/io/restart_state.hpp>

#include <array>     // std::array
#include <cstddef>   // std::size_t
#include <cstdint>   // std::int32_t, std::int64_t
#include <optional>  // std::optional
#include <string>    // std::string
#include <utility>   // std::move
#include <vector>    // std::vector

namespace tsubu {

/// How many rows a section has, and how many types there are of what it lists.
struct lammps_count {
    std::int64_t rows = 0;
    std::int32_t types = 0;
    friend constexpr bool operator==(const lammps_count&, const lammps_count&) noexcept = default;
};

/// How many particles and terms there are, and the box.
///
///     tsubu::lammps_header top{.title = "a drop", .lo = {0, 0, 0}, .hi = {2, 2, 5}};
///     auto box = top.box({true, true, false});
struct lammps_header {
    std::string title{};
    /// How many rows each section has, and of how many types.
    lammps_count atoms{};
    lammps_count bonds{};
    lammps_count angles{};
    lammps_count dihedrals{};
    lammps_count impropers{};
    vec<3> lo{};                  ///< lower corner
    vec<3> hi{};                  ///< upper corner, of the box before it is tilted
    std::optional<vec<3>> tilt{};  ///< xy, xz, yz, of a tilted box
    std::vector<double> masses{};  ///< of types 1, 2, ...: [types], or none

    /// For particles in this box: a domain or a triclinic_box; an axis that it has not goes from -0.5 to 0.5, as LAMMPS
    /// wants it of two dimensions.
    template <class Box>
    [[nodiscard]] static lammps_header of(const Box& where, std::string title = {}) {
        const restart_box shape(where);
        lammps_header top{.title = std::move(title)};
        for (std::size_t k = 0; k < 3; ++k) {
            top.lo[k] = k < shape.dimension ? shape.lo[k] : -0.5;
            top.hi[k] = k < shape.dimension ? shape.hi[k] : 0.5;
        }
        if (shape.tilts != vec<3>{}) top.tilt = shape.tilts;
        return top;
    }
    /// The box as a domain. Which axes are periodic, data files do not say.
    /// @throws input_error if the box is tilted (use tilted_box), or no domain.
    [[nodiscard]] domain<3> box(const std::array<bool, 3>& periodic) const {
        if (tilt && *tilt != vec<3>{})
            detail::raise<input_error>("lammps_header::box", "the box is tilted", "use tilted_box()");
        return {lo, hi, {.periodic = periodic}};
    }
    /// The box as a triclinic one, tilted or not. @throws input_error if it is none.
    [[nodiscard]] triclinic_box<3> tilted_box(const std::array<bool, 3>& periodic) const {
        return {lo, {hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]}, tilt.value_or(vec<3>{}), periodic};
    }
    friend bool operator==(const lammps_header&, const lammps_header&) = default;
};

}  // namespace tsubu
