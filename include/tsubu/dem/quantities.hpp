// SPDX-License-Identifier: MIT
/// @file
/// What a scene counts in: the number types of positions and of all else, and the fields in them.
///
/// | number                   | position            | all else | error of a position        | choose it when               |
/// |--------------------------|---------------------|----------|----------------------------|------------------------------|
/// | double                   | double              | double   | 2^-53 of its distance from the origin | you do not know   |
/// | mixed_precision<double, float>     | double              | float    | the same                   | memory and bandwidth count   |
/// | float                    | float               | float    | 2^-24 of that distance     | to see it fail               |
/// | lattice<std::int64_t>    | 64 bits of the box  | double   | 2^-65 of the box           | results are not to depend on the origin |
/// | lattice<std::int32_t>    | 32 bits of the box  | double   | 2^-33 of the box           | likewise, and memory counts  |
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/list_of.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <concepts>  // std::floating_point
#include <cstddef>   // std::size_t
#include <cstdint>   // std::int64_t

namespace tsubu::dem {

/// Positions in one type, velocities, forces and all else in another.
///
/// @tparam Coordinate  float, double, or lattice<Int>
/// @tparam Real        float or double
template <class Coordinate, std::floating_point Real>
struct mixed_precision {};

/// The types that a number policy stands for.
template <class Number>
struct number_traits;
template <std::floating_point Number>
struct number_traits<Number> {
    using coordinate = Number;
    using real = Number;
};
template <class Int>
struct number_traits<lattice<Int>> {
    using coordinate = lattice<Int>;
    using real = double;
};
template <class Coordinate, class Real>
struct number_traits<mixed_precision<Coordinate, Real>> {
    using coordinate = Coordinate;
    using real = Real;
};
/// double, float, mixed_precision<Coordinate, Real>, or lattice<Int>.
template <class Number>
concept number_policy = requires {
    typename number_traits<Number>::coordinate;
    typename number_traits<Number>::real;
};
static_assert(number_policy<double> && number_policy<mixed_precision<double, float>> && number_policy<lattice<std::int32_t>>);

/// What a particle remembers of a contact: with whom, and the springs that the laws have stretched there.
///
/// @tparam Count  how many numbers
template <class Real, std::size_t Count>
struct remembered_contact {
    std::int64_t partner;  ///< the id of the other particle; of wall w it is -1 - w
    vec<Count, Real> springs;
};

/// The quantities of a scene: their types, and the fields that hold them.
template <std::size_t D, number_policy Number>
struct quantities {
    using coordinate = typename number_traits<Number>::coordinate;
    using real = typename number_traits<Number>::real;
    static constexpr std::size_t dimension = D;
    /// Numbers of an angular velocity or a torque: in two dimensions one, about z; in one dimension none.
    static constexpr std::size_t spins = D == 3 ? 3 : D == 2 ? 1 : 0;

    static constexpr auto position = tsubu::position<D, coordinate>;
    static constexpr auto velocity = tsubu::velocity<D, real>;
    static constexpr auto force = tsubu::force<D, real>;
    static constexpr auto angular_velocity = tsubu::angular_velocity<D, real>;
    static constexpr auto torque = tsubu::torque<D, real>;
    template <std::size_t Count>
    static constexpr field<"contacts", list_of<remembered_contact<real, Count>>, "",
                           field_traits{.when = travels::never}>
        contacts{};
};

}  // namespace tsubu::dem
