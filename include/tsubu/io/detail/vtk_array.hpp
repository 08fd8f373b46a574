// SPDX-License-Identifier: MIT
/// @file
/// What of a field a VTK file shows: type, components, and numbers.
#pragma once

#include <tsubu/store/bonus_of.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/list_of.hpp>

#include <array>        // std::array
#include <concepts>     // std::floating_point
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint8_t, std::uint32_t
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <type_traits>  // std::is_arithmetic_v, std::underlying_type_t

namespace tsubu::detail {

/// Numbers that VTK has a type for: up to 64 bits.
template <class Number>
concept vtk_number = std::is_arithmetic_v<Number> && sizeof(Number) <= 8;

template <class Number>
struct vtk_scalar {
    using type = Number;
};
template <>
struct vtk_scalar<bool> {
    using type = std::uint8_t;
};

/// Of a value that is no number, such as a record, nothing is shown.
template <class Value>
struct vtk_value {
    static constexpr std::size_t components = 0;
};
template <vtk_number Value>
struct vtk_value<Value> {
    static constexpr std::size_t components = 1;
    using scalar = typename vtk_scalar<Value>::type;
    static void put(scalar* to, Value value) noexcept { *to = static_cast<scalar>(value); }
};
template <class Value>
    requires std::is_enum_v<Value>
struct vtk_value<Value> : vtk_value<std::underlying_type_t<Value>> {
    using number = std::underlying_type_t<Value>;
    static void put(typename vtk_scalar<number>::type* to, Value value) noexcept {
        vtk_value<number>::put(to, static_cast<number>(value));
    }
};
/// Two components get a third one, 0: what VTK takes for a vector has three.
template <vtk_number Number, std::size_t N>
struct vtk_value<std::array<Number, N>> {
    static constexpr std::size_t components = N == 2 ? 3 : N;
    using scalar = typename vtk_scalar<Number>::type;
    static void put(scalar* to, const std::array<Number, N>& value) noexcept {
        for (std::size_t k = 0; k < components; ++k) to[k] = k < N ? static_cast<scalar>(value[k]) : scalar{0};
    }
};
/// How many elements.
template <class Element>
struct vtk_value<list_of<Element>> {
    static constexpr std::size_t components = 1;
    using scalar = std::uint32_t;
    template <class List>
    static void put(scalar* to, const List& list) noexcept {
        *to = static_cast<scalar>(list.size());
    }
};
/// 1 if the particle has one.
template <class Element>
struct vtk_value<bonus_of<Element>> {
    static constexpr std::size_t components = 1;
    using scalar = std::uint8_t;
    template <class Bonus>
    static void put(scalar* to, const Bonus& bonus) noexcept {
        *to = bonus ? 1 : 0;
    }
};
/// A point has three components, whatever the dimension.
template <class Value>
struct vtk_point;
template <std::floating_point Scalar, std::size_t D>
struct vtk_point<std::array<Scalar, D>> {
    static_assert(D <= 3 && sizeof(Scalar) <= 8);
    static constexpr std::size_t components = 3;
    using scalar = Scalar;
    static void put(Scalar* to, const std::array<Scalar, D>& value) noexcept {
        for (std::size_t k = 0; k < 3; ++k) to[k] = k < D ? value[k] : Scalar{0};
    }
};

/// A type of numbers, as VTK names it: Float64, UInt8.
struct vtk_type {
    const char* kind;
    std::size_t bytes;
};
template <class Scalar>
inline constexpr vtk_type vtk_type_of{
    std::is_floating_point_v<Scalar> ? "Float" : std::is_signed_v<Scalar> ? "Int" : "UInt", sizeof(Scalar)};
[[nodiscard]] inline std::string name_of(vtk_type type) { return type.kind + std::to_string(8 * type.bytes); }

/// Text as it stands in an attribute or an element.
[[nodiscard]] inline std::string in_xml(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '&': safe += "&amp;"; break;
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '"': safe += "&quot;"; break;
            // Other control characters XML cannot hold.
            default: safe += static_cast<unsigned char>(c) < ' ' ? '?' : c;
        }
    }
    return safe;
}

/// Calls body(field, shown) for each field of a set that a file shows as values of the points: all but the position and
/// records.
template <class Position, auto... F, class Body>
void each_vtk_field(fields<F...>, Body&& body) {
    const auto one = [&]<class Field>(Field field) {
        if constexpr (!std::is_same_v<Field, Position> && vtk_value<typename Field::value_type>::components != 0)
            body(field, vtk_value<typename Field::value_type>{});
    };
    (one(F), ...);
}

}  // namespace tsubu::detail
