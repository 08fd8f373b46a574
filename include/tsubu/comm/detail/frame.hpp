// SPDX-License-Identifier: MIT
/// @file
/// What a periodic image does to the fields of a particle: positions move, vectors turn where images are turned.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t
#include <limits>       // std::numeric_limits
#include <type_traits>  // std::is_same_v, std::remove_cv_t

namespace tsubu::detail {

template <std::size_t D>
[[nodiscard]] constexpr image_shift<D> opposite(image_shift<D> shift) noexcept {
    // What counting has ended at (see axis::wrap) has no opposite of its own.
    for (auto& one : shift)
        one = one == (std::numeric_limits<std::int64_t>::min)() ? (std::numeric_limits<std::int64_t>::max)() : -one;
    return shift;
}

/// The rules for a box whose images are turned.
template <class Box>
concept turning_box = requires(const Box& where, const vec<Box::dimension, typename Box::scalar_type>& v,
                               const image_shift<Box::dimension>& shift) { where.rotate(v, shift); };

/// Whether an image has another value at all. A lattice has no numbers outside the box: minimum_image finds the image.
template <class Field, class Box>
inline constexpr bool changes_in_image =
    (Field::traits.image == under_image::translates && !is_lattice<typename Box::scalar_type>) ||
    (Field::traits.image == under_image::rotates && turning_box<Box>);

/// The value of a field in an image.
template <class Field, class Box>
    requires(changes_in_image<Field, Box>)
[[nodiscard]] typename Field::value_type value_in_image(const Box& where, const typename Field::value_type& value,
                                                        const image_shift<Box::dimension>& shift) {
    using value_type = typename Field::value_type;
    constexpr auto D = Box::dimension;
    if constexpr (Field::traits.image == under_image::translates) {
        static_assert(std::is_same_v<value_type, vec<D, typename Box::scalar_type>>,
                      "a field that moves with images has the type of a position in the box");
        return where.image(value, shift);
    } else {
        static_assert(std::is_same_v<value_type, vec<D, typename Box::scalar_type>>,
                      "a field that turns with images is a vector of as many numbers as the box has dimensions");
        return where.rotate(value, shift);
    }
}

/// The position that decides, and what a wrap does to all fields of a particle.
template <class Store, class Box>
struct frame {
    static constexpr auto D = Box::dimension;
    static constexpr auto position = tsubu::position<D, typename Box::scalar_type>;
    using position_field = std::remove_cv_t<decltype(position)>;
    static_assert(Store::template has<position_field>, "the store has no position<D, Scalar> of this box");

    /// Particle i is where a wrap has brought it.
    static void settle(Store& store, const Box& where, index_t i, const wrapped<D, typename Box::scalar_type>& fresh) {
        settle_fields(store, where, static_cast<std::size_t>(i), fresh, typename Store::fields_type{});
    }

private:
    template <auto... F>
    static void settle_fields(Store& store, const Box& where, std::size_t i,
                              const wrapped<D, typename Box::scalar_type>& fresh, fields<F...>) {
        const auto back = opposite(fresh.shift);
        (settle_field<std::remove_cv_t<decltype(F)>>(store, where, i, fresh, back), ...);
    }
    template <class Field>
    static void settle_field(Store& store, const Box& where, std::size_t i,
                             const wrapped<D, typename Box::scalar_type>& fresh, const image_shift<D>& back) {
        if constexpr (std::is_same_v<Field, position_field>) {
            store[Field{}][i] = fresh.position;
        } else if constexpr (std::is_same_v<Field, std::remove_cv_t<decltype(tsubu::image<D>)>>) {
            auto& periods = store[Field{}][i];
            for (std::size_t k = 0; k < D; ++k) periods[k] = saturated_sum(periods[k], fresh.shift[k]);
        } else if constexpr (changes_in_image<Field, Box>) {
            auto& value = store[Field{}][i];
            value = value_in_image<Field>(where, value, back);
        }
    }
};

}  // namespace tsubu::detail
