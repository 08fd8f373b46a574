// SPDX-License-Identifier: MIT
/// @file
/// atom_style: which columns a row of the section Atoms has.
#pragma once

#include <tsubu/version.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <optional>     // std::optional
#include <string_view>  // std::string_view

namespace tsubu {

/// The atom styles of LAMMPS that tsubu reads and writes. Three image flags may follow in each.
///
/// | style                   | columns                               |
/// |-------------------------|---------------------------------------|
/// | atomic                  | id type x y z                         |
/// | sphere                  | id type diameter density x y z        |
/// | bond, angle, molecular  | id molecule type x y z                |
/// | full                    | id molecule type charge x y z         |
enum class atom_style { atomic, sphere, bond, angle, molecular, full };

namespace detail {

inline constexpr std::array<std::string_view, 6> atom_style_names{"atomic", "sphere",    "bond",
                                                                  "angle",  "molecular", "full"};

}  // namespace detail

/// As LAMMPS calls it.
[[nodiscard]] constexpr std::string_view name_of(atom_style style) noexcept {
    return detail::atom_style_names[static_cast<std::size_t>(style)];
}
/// The style that LAMMPS calls so, if it is one of these.
[[nodiscard]] constexpr std::optional<atom_style> atom_style_named(std::string_view name) noexcept {
    for (std::size_t k = 0; k < detail::atom_style_names.size(); ++k)
        if (detail::atom_style_names[k] == name) return static_cast<atom_style>(k);
    return std::nullopt;
}

/// What columns a style has besides id, type and position.
[[nodiscard]] constexpr bool is_sphere(atom_style style) noexcept { return style == atom_style::sphere; }
[[nodiscard]] constexpr bool has_charge(atom_style style) noexcept { return style == atom_style::full; }
[[nodiscard]] constexpr bool has_molecule(atom_style style) noexcept {
    return style != atom_style::atomic && style != atom_style::sphere;
}
/// Columns of a row of Atoms, without image flags.
[[nodiscard]] constexpr std::size_t atom_columns(atom_style style) noexcept {
    return 5U + (is_sphere(style) ? 2U : 0U) + (has_molecule(style) ? 1U : 0U) + (has_charge(style) ? 1U : 0U);
}

}  // namespace tsubu
