// SPDX-License-Identifier: MIT
/// @file
/// field_named: the field of a set that has a given name, whatever its dimension and scalar.
#pragma once

#include <tsubu/core/fixed_string.hpp>
#include <tsubu/store/field.hpp>

#include <cstddef>      // std::size_t
#include <tuple>        // std::tuple_element_t
#include <type_traits>  // std::remove_cv_t

namespace tsubu::detail {

template <class Set, fixed_string Name>
struct named_field;
template <auto... F, fixed_string Name>
struct named_field<fields<F...>, Name> {
    static constexpr bool exists = ((std::remove_cv_t<decltype(F)>::name == Name.view()) || ...);
    static constexpr std::size_t find() noexcept {
        std::size_t at = 0;
        std::size_t found = 0;
        (((std::remove_cv_t<decltype(F)>::name == Name.view() ? found = at : found), ++at), ...);
        return found;
    }
    template <bool>
    struct of {
        using type = void;
    };
    template <bool Exists>
        requires(Exists)
    struct of<Exists> {
        using type = std::tuple_element_t<find(), std::tuple<std::remove_cv_t<decltype(F)>...>>;
    };
};

/// Whether the store has a field of this name.
template <class Store, fixed_string Name>
inline constexpr bool has_named = named_field<typename Store::fields_type, Name>::exists;
/// Its type. Precondition: has_named.
template <class Store, fixed_string Name>
using field_named = typename named_field<typename Store::fields_type, Name>::template of<true>::type;
template <class Store, fixed_string Name>
using value_named = typename field_named<Store, Name>::value_type;

/// The scalar of positions (or of another vector field); double if there is no such field.
template <class Store, fixed_string Name>
struct scalar_of_named {
    using type = double;
};
template <class Store, fixed_string Name>
    requires has_named<Store, Name>
struct scalar_of_named<Store, Name> {
    using type = typename value_named<Store, Name>::value_type;
};
template <class Store, fixed_string Name>
using scalar_named = typename scalar_of_named<Store, Name>::type;

/// The value of a particle, or another where the store has no such field.
template <fixed_string Name, class Store, class Value>
[[nodiscard]] auto value_at(const Store& store, std::size_t i, Value otherwise) noexcept {
    if constexpr (has_named<Store, Name>)
        return static_cast<void>(otherwise), store[field_named<Store, Name>{}][i];
    else
        return static_cast<void>(store), static_cast<void>(i), otherwise;
}

}  // namespace tsubu::detail
