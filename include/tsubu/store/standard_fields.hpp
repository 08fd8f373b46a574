// SPDX-License-Identifier: MIT
/// @file
/// The fields that most particles carry, in SI units.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/store/field.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::int32_t, std::int64_t

namespace tsubu {

/// The global name of a particle; how ghosts find their owner. Never changes.
inline constexpr field<"id", std::int64_t> id{};
/// Which material, or kind of atom.
inline constexpr field<"species", std::int32_t> species{};
template <std::size_t D, class Scalar = double>
inline constexpr field<"position", vec<D, Scalar>, "m",
                       field_traits{.when = travels::every_step, .image = under_image::translates}>
    position{};
template <std::size_t D, class Scalar = double>
inline constexpr field<"velocity", vec<D, Scalar>, "m/s",
                       field_traits{.when = travels::every_step, .image = under_image::rotates}>
    velocity{};
template <std::size_t D, class Scalar = double>
inline constexpr field<"force", vec<D, Scalar>, "N",
                       field_traits{.when = travels::never, .image = under_image::rotates, .reverse = ghosts_add::sum}>
    force{};
/// In two dimensions one number, about z.
template <std::size_t D, class Scalar = double>
inline constexpr field<"angular_velocity", vec<D == 2 ? 1 : 3, Scalar>, "rad/s",
                       field_traits{.when = travels::every_step, .image = under_image::rotates}>
    angular_velocity{};
template <std::size_t D, class Scalar = double>
inline constexpr field<"torque", vec<D == 2 ? 1 : 3, Scalar>, "N m",
                       field_traits{.when = travels::never, .image = under_image::rotates, .reverse = ghosts_add::sum}>
    torque{};
inline constexpr field<"radius", double, "m"> radius{};
inline constexpr field<"mass", double, "kg"> mass{};
/// How many periods of the box the particle has gone along each axis: position + shift L is where it would
/// be unwrapped.
template <std::size_t D>
inline constexpr field<"image", vec<D, std::int64_t>, "", field_traits{.when = travels::never}> image{};

}  // namespace tsubu
