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
/// Where the particle is: sent at every step, moved with an image.
template <std::size_t D, class Scalar = double>
inline constexpr field<"position", vec<D, Scalar>, "m",
                       field_traits{.when = travels::every_step, .image = under_image::translates}>
    position{};
/// How fast it goes: sent at every step, turned with an image.
template <std::size_t D, class Scalar = double>
inline constexpr field<"velocity", vec<D, Scalar>, "m/s",
                       field_traits{.when = travels::every_step, .image = under_image::rotates}>
    velocity{};
/// What acts on it: what ghosts have is added to their owners'.
template <std::size_t D, class Scalar = double>
inline constexpr field<"force", vec<D, Scalar>, "N",
                       field_traits{.when = travels::never, .image = under_image::rotates, .reverse = ghosts_add::sum}>
    force{};
/// How fast it spins; in two dimensions one number, about z.
template <std::size_t D, class Scalar = double>
inline constexpr field<"angular_velocity", vec<D == 2 ? 1 : 3, Scalar>, "rad/s",
                       field_traits{.when = travels::every_step, .image = under_image::rotates}>
    angular_velocity{};
/// What turns it, about its middle; in two dimensions one number, about z.
template <std::size_t D, class Scalar = double>
inline constexpr field<"torque", vec<D == 2 ? 1 : 3, Scalar>, "N m",
                       field_traits{.when = travels::never, .image = under_image::rotates, .reverse = ghosts_add::sum}>
    torque{};
/// Of a sphere, or in two dimensions of a disk.
inline constexpr field<"radius", double, "m"> radius{};
/// Force over acceleration.
inline constexpr field<"mass", double, "kg"> mass{};
/// How many periods of the box the particle has gone along each axis: position + shift L is where it would
/// be unwrapped.
template <std::size_t D>
inline constexpr field<"image", vec<D, std::int64_t>, "", field_traits{.when = travels::never}> image{};

}  // namespace tsubu
