// SPDX-License-Identifier: MIT
/// @file
/// field: what a particle carries, by name; and sets of fields.
#pragma once

#include <tsubu/core/fixed_string.hpp>

#include <concepts>     // std::convertible_to
#include <cstddef>      // std::size_t
#include <string_view>  // std::string_view
#include <type_traits>  // std::is_same_v
#include <utility>      // std::move

namespace tsubu {

/// When a field is sent to the copies of a particle on other ranks.
enum class travels {
    never,        ///< it stays with its owner, and goes along when that changes
    on_creation,  ///< once, when the ghost is made: what does not change from step to step
    every_step,   ///< whenever ghosts are updated
};
/// What a periodic image does to the value.
enum class under_image {
    invariant,   ///< nothing: an id, a radius
    translates,  ///< moves with the box: a position
    rotates,     ///< turns where images are turned, in a wedge: a velocity, a force
};
/// How what ghosts have collected is added to the owner's value.
enum class ghosts_add {
    sum,       ///< added: a force, a torque
    least,     ///< the owner keeps the least of all
    greatest,  ///< the owner keeps the greatest of all
    nothing,   ///< ghosts give nothing back: an id, a position
};

/// How a field travels between ranks, by the names of what differs from the default:
///
///     inline constexpr tsubu::field<"flux", tsubu::vec<3>, "W",
///                                   tsubu::field_traits{.when = tsubu::travels::never,
///                                                       .image = tsubu::under_image::rotates,
///                                                       .reverse = tsubu::ghosts_add::sum}>
///         flux{};
struct field_traits {
    travels when = travels::on_creation;         ///< to ghosts; default: once, when the ghost is made
    under_image image = under_image::invariant;  ///< on the way to a periodic image; default: unchanged
    ghosts_add reverse = ghosts_add::nothing;    ///< from ghosts to the owner; default: nothing comes back
};

template <class Field>
struct field_value;

/// What a particle carries: a name, a type, a unit, and how it travels. An object without state; its type says it all.
///
///     inline constexpr tsubu::field<"temperature", double, "K"> temperature{};
///     inline constexpr tsubu::field<"heat", double, "J", tsubu::field_traits{.when = tsubu::travels::never}> heat{};
///
/// @tparam Value  trivially copyable, or list_of<T> for as many values as each particle has, or bonus_of<T> for a value
///                that only some particles have.
template <fixed_string Name, class Value, fixed_string Unit = "", field_traits Traits = field_traits{}>
struct field {
    using value_type = Value;
    static constexpr std::string_view name = Name.view();
    static constexpr std::string_view unit = Unit.view();
    static constexpr field_traits traits = Traits;
    static constexpr bool rotates_with_images = Traits.image == under_image::rotates;

    /// The value of this field, for push_back: `g.push_back(tsubu::radius = 0.5)`.
    constexpr field_value<field> operator=(Value value) const { return {std::move(value)}; }
};

/// A value and the field that it is of.
template <class Field>
struct field_value {
    using field_type = Field;
    typename Field::value_type value;
};

/// A type of field objects.
template <class Field>
concept particle_field = requires {
    typename Field::value_type;
    { Field::name } -> std::convertible_to<std::string_view>;
    { Field::unit } -> std::convertible_to<std::string_view>;
    { Field::traits } -> std::convertible_to<field_traits>;
};

/// A set of fields, in an order: fields<tsubu::id, tsubu::position<3>, tsubu::radius>. A type without state.
template <auto... Fields>
struct fields {
    static_assert((particle_field<std::remove_cv_t<decltype(Fields)>> && ...),
                  "tsubu::fields takes field objects, such as tsubu::id and tsubu::position<3>");
    static constexpr std::size_t count = sizeof...(Fields);
    template <class Field>
    static constexpr std::size_t times =
        (std::size_t{0} + ... + (std::is_same_v<decltype(Fields), Field> ? std::size_t{1} : std::size_t{0}));
    static_assert(((times<decltype(Fields)> == 1) && ...), "tsubu::fields names a field twice; name each once");
    /// How many fields of the set have the name of this one.
    template <class Field>
    static constexpr std::size_t namesakes =
        (std::size_t{0} + ... + (decltype(Fields)::name == Field::name ? std::size_t{1} : std::size_t{0}));
    static_assert(((namesakes<decltype(Fields)> == 1) && ...),
                  "two fields of a set have the same name; files and messages tell them by it: give each its own");

    template <class Field>
    static constexpr bool has = (std::is_same_v<std::remove_cv_t<decltype(Fields)>, std::remove_cv_t<Field>> || ...);
    /// The place of a field in the set. Precondition: has<Field>.
    template <class Field>
    [[nodiscard]] static constexpr std::size_t place() noexcept {
        std::size_t at = 0;
        std::size_t found = count;
        ((std::is_same_v<std::remove_cv_t<decltype(Fields)>, std::remove_cv_t<Field>> ? void(found = at++)
                                                                                     : void(++at)),
         ...);
        return found;
    }
    /// Calls body(field) for each.
    template <class Body>
    static constexpr void each(Body&& body) {
        (body(Fields), ...);
    }
};

namespace detail {

template <class Set, class Other>
struct united;
template <auto... A>
struct united<fields<A...>, fields<>> {
    using type = fields<A...>;
};
template <auto... A, auto First, auto... Rest>
struct united<fields<A...>, fields<First, Rest...>> {
    using next = std::conditional_t<fields<A...>::template has<decltype(First)>, fields<A...>, fields<A..., First>>;
    using type = typename united<next, fields<Rest...>>::type;
};

template <class Set, class Keep, class Done = fields<>>
struct kept;
template <class Keep, class Done>
struct kept<fields<>, Keep, Done> {
    using type = Done;
};
template <auto First, auto... Rest, class Keep, auto... Done>
struct kept<fields<First, Rest...>, Keep, fields<Done...>> {
    using next = std::conditional_t<Keep::template keeps<std::remove_cv_t<decltype(First)>>, fields<Done..., First>,
                                    fields<Done...>>;
    using type = typename kept<fields<Rest...>, Keep, next>::type;
};

template <class Other>
struct if_in {
    template <class Field>
    static constexpr bool keeps = Other::template has<Field>;
};
template <class Other>
struct if_not_in {
    template <class Field>
    static constexpr bool keeps = !Other::template has<Field>;
};
template <travels When>
struct if_travels {
    template <class Field>
    static constexpr bool keeps = Field::traits.when >= When;
};

}  // namespace detail

/// The fields of both sets, those of the first in front.
template <class Set, class Other>
using union_of = typename detail::united<Set, Other>::type;
/// The fields of the first set that the second has too.
template <class Set, class Other>
using intersection_of = typename detail::kept<Set, detail::if_in<Other>>::type;
/// The fields of the first set that the second has not.
template <class Set, class Other>
using difference_of = typename detail::kept<Set, detail::if_not_in<Other>>::type;
/// The fields that a new ghost gets.
template <class Set>
using fields_on_creation = typename detail::kept<Set, detail::if_travels<travels::on_creation>>::type;
/// The fields that ghosts get every step.
template <class Set>
using fields_every_step = typename detail::kept<Set, detail::if_travels<travels::every_step>>::type;

}  // namespace tsubu
