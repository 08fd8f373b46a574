// SPDX-License-Identifier: MIT
/// @file
/// What a scene counts in: the number types of positions and of all else, and the fields in them.
///
/// | number                         | position, bytes per axis  | all else | error of a position | choose it when              |
/// |--------------------------------|---------------------------|----------|---------------------|-----------------------------|
/// | double                         | double, 8                 | double   | 2^-53 of its distance from the origin | you do not know |
/// | mixed_precision<double, float> | double, 8                 | float    | the same            | memory and bandwidth count  |
/// | float                          | float, 4                  | float    | 2^-24 of that distance | to see it fail           |
/// | in_cells<float>                | cell and float in it, 6   | float    | 2^-41 of the box    | memory counts, and the origin may be far |
/// | lattice<std::int64_t>          | 64 bits of the box, 8     | double   | 2^-65 of the box    | results are not to depend on the origin |
/// | lattice<std::int32_t>          | 32 bits of the box, 4     | double   | 2^-33 of the box    | likewise, and memory counts |
///
/// lattice and in_cells need a box that is periodic along all axes; mixed_precision<lattice<Int>, float> is one too.
#pragma once

#include <tsubu/core/vec.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/list_of.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <concepts>     // std::floating_point
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int16_t, std::int32_t, std::int64_t
#include <type_traits>  // std::conditional_t

namespace tsubu::dem {

/// Positions in one type, velocities, forces and all else in another.
///
/// @tparam Coordinate  float, double, or lattice<Int>
/// @tparam Real        float or double
template <class Coordinate, std::floating_point Real>
    requires(std::floating_point<Coordinate> || is_lattice<Coordinate>)
struct mixed_precision {};

/// Positions as the nearest point of a coarse lattice, which decides whose a particle is, and the distance from it; all
/// else in the type of that distance.
///
/// @tparam Real  float or double
/// @tparam Int   of the lattice: 2^16 cells along each axis by default
template <std::floating_point Real, class Int = std::int16_t>
struct in_cells {};

/// The types that a number policy stands for.
template <class Number>
struct number_traits;
template <std::floating_point Number>
struct number_traits<Number> {
    using coordinate = Number;
    using real = Number;
    static constexpr bool has_offsets = false;
};
template <class Int>
struct number_traits<lattice<Int>> {
    using coordinate = lattice<Int>;
    using real = double;
    static constexpr bool has_offsets = false;
};
template <class Coordinate, class Real>
struct number_traits<mixed_precision<Coordinate, Real>> {
    using coordinate = Coordinate;
    using real = Real;
    static constexpr bool has_offsets = false;
};
template <class Real, class Int>
struct number_traits<in_cells<Real, Int>> {
    using coordinate = lattice<Int>;
    using real = Real;
    static constexpr bool has_offsets = true;
};
/// double, float, mixed_precision<Coordinate, Real>, lattice<Int>, or in_cells<Real>.
template <class Number>
concept number_policy = requires {
    typename number_traits<Number>::coordinate;
    typename number_traits<Number>::real;
};
static_assert(number_policy<double> && number_policy<mixed_precision<double, float>> &&
              number_policy<lattice<std::int32_t>> && number_policy<in_cells<float>>);

/// The history of a contact, as a particle carries it: with whom, and the history that the laws have there.
///
/// @tparam Count  how many numbers
template <class Real, std::size_t Count>
struct past_contact {
    std::int64_t partner;  ///< the id of the other particle; of wall w it is -1 - w
    vec<Count, Real> history;
};

/// The quantities of a scene: their types, and the fields that hold them.
template <std::size_t D, number_policy Number>
struct quantities {
    using coordinate = typename number_traits<Number>::coordinate;
    using real = typename number_traits<Number>::real;
    static constexpr std::size_t dimension = D;
    static constexpr bool has_offsets = number_traits<Number>::has_offsets;
    /// Numbers of an angular velocity or a torque.
    static constexpr std::size_t spins = spin_count<D>;

    static constexpr auto position = tsubu::position<D, coordinate>;
    /// From `position`, where that is the middle of a cell [m].
    static constexpr field<"offset", vec<D, real>, "m", field_traits{.when = travels::every_step}> offset{};
    /// All that says where a particle is.
    using place_fields = std::conditional_t<has_offsets, fields<position, offset>, fields<position>>;
    static constexpr auto velocity = tsubu::velocity<D, real>;
    static constexpr auto force = tsubu::force<D, real>;
    static constexpr auto angular_velocity = tsubu::angular_velocity<D, real>;
    static constexpr auto torque = tsubu::torque<D, real>;
    template <std::size_t Count>
    static constexpr field<"contacts", list_of<past_contact<real, Count>>, "", field_traits{.when = travels::never}>
        contacts{};
};

/// Particle i is at x [m], in the fields that a scene has for that; wrapped into the box.
/// @throws input_error if x is not finite.
template <class Quantities, class Store, class Box>
void put(Store& store, std::size_t i, const Box& box, const typename Box::real_position_type& x) {
    const auto at = box.from_real(x);
    store[Quantities::position][i] = at.position;
    if constexpr (Quantities::has_offsets) {
        const auto wrapped = box.image(at.position, at.shift);
        for (std::size_t k = 0; k < Quantities::dimension; ++k)
            store[Quantities::offset][i][k] = static_cast<typename Quantities::real>(x[k] - wrapped[k]);
    }
}

}  // namespace tsubu::dem
