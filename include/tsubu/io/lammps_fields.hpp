// SPDX-License-Identifier: MIT
/// @file
/// Fields that LAMMPS data files have and most particles have not.
#pragma once

#include <tsubu/store/field.hpp>

#include <cstdint>  // std::int64_t

namespace tsubu {

/// Which molecule the particle belongs to; 0: none.
inline constexpr field<"molecule", std::int64_t> molecule{};
/// In the unit of the file: multiples of the elementary charge in most.
inline constexpr field<"charge", double, "e"> charge{};
/// Of a sphere. A store with this field instead of the mass gives back the bits that were in the file.
inline constexpr field<"density", double, "kg/m^3"> density{};

}  // namespace tsubu
