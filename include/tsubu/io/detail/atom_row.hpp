// SPDX-License-Identifier: MIT
/// @file
/// atom_row: a row of Atoms, and which of it goes into which field of a store.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/io/atom_style.hpp>
#include <tsubu/io/detail/field_named.hpp>
#include <tsubu/io/detail/row.hpp>

#include <cmath>        // std::isfinite
#include <concepts>     // std::floating_point
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t
#include <numbers>      // std::numbers::pi
#include <type_traits>  // std::is_same_v
#include <utility>      // std::in_range

namespace tsubu::detail {

template <class Real>
struct atom_row {
    std::int64_t name = 0;
    std::int64_t of_molecule = 0;
    std::int32_t type = 0;
    double electric = 0;
    double diameter = 0;
    double dense = 0;
    vec<3, Real> at{};
    vec<3, std::int64_t> periods{};
};

/// Volume of a sphere; of a point (diameter 0) 1, since LAMMPS takes its density as its mass.
[[nodiscard]] inline double volume_of(double diameter) noexcept {
    const auto half = 0.5 * diameter;
    return diameter == 0 ? 1.0 : 4.0 / 3.0 * std::numbers::pi * half * half * half;
}

/// @param with_images  whether three image flags follow
template <class Real, class Row>
[[nodiscard]] atom_row<Real> read_atom(Row& from, atom_style style, bool with_images, std::int32_t types) {
    atom_row<Real> atom;
    atom.name = from.template next_from<std::int64_t>(1, "the id");
    if (has_molecule(style)) atom.of_molecule = from.template next<std::int64_t>("the molecule");
    atom.type = from.template next_from<std::int32_t>(1, "the type");
    if (atom.type > types) [[unlikely]]
        from.fail("type " + std::to_string(atom.type) + ", but the header has " + std::to_string(types) + " atom types",
                  "correct one of them");
    if (is_sphere(style)) {
        atom.diameter = from.template next<double>("the diameter");
        atom.dense = from.template next<double>("the density");
        if (atom.diameter < 0 || atom.dense <= 0) [[unlikely]]
            from.fail("a diameter below 0, or a density not above 0", "give 0 for a point, and a density above 0");
    }
    if (has_charge(style)) atom.electric = from.template next<double>("the charge");
    for (auto& x : atom.at) x = from.template next<Real>("a coordinate");
    if (with_images)
        for (auto& n : atom.periods) n = from.template next<std::int64_t>("an image flag");
    from.expect_end();
    return atom;
}

/// `value` as the type of a field. Fails the row if it does not fit.
template <class To, class From, class Row>
[[nodiscard]] To fitted(From value, const char* what, const Row& row) {
    if constexpr (std::floating_point<To>) {
        const auto narrow = static_cast<To>(value);
        if (!std::isfinite(narrow)) [[unlikely]]
            row.fail(std::string(what) + " does not fit the field of the store", "give the field a wider type");
        return narrow;
    } else {
        if (!std::in_range<To>(value)) [[unlikely]]
            row.fail(std::string(what) + " does not fit the field of the store", "give the field a wider type");
        return static_cast<To>(value);
    }
}

/// What a position, a velocity, an angular velocity of a store takes of three components: all; x and y; or z, for a
/// rotation in the plane.
template <class Vector, class Real>
void set_components(Vector& to, const vec<3, Real>& from) noexcept {
    constexpr auto count = std::tuple_size_v<Vector>;
    if constexpr (count == 1)
        to[0] = static_cast<typename Vector::value_type>(from[2]);
    else
        for (std::size_t k = 0; k < count; ++k) to[k] = static_cast<typename Vector::value_type>(from[k]);
}
template <class Real, class Vector>
[[nodiscard]] vec<3, Real> three_components(const Vector& from) noexcept {
    constexpr auto count = std::tuple_size_v<Vector>;
    vec<3, Real> to{};
    if constexpr (count == 1)
        to[2] = from[0];
    else
        for (std::size_t k = 0; k < count; ++k) to[k] = from[k];
    return to;
}

/// Adds the particle to the store, in those fields that the file and the store have.
template <class Store, class Real, class Row>
void append_atom(Store& store, const atom_row<Real>& atom, const Row& row) {
    const auto i = store.add_owned(1);
    const auto set = [&]<fixed_string Name>(auto value, const char* what) {
        if constexpr (has_named<Store, Name>)
            store[field_named<Store, Name>{}][i] = fitted<value_named<Store, Name>>(value, what, row);
    };
    set.template operator()<"id">(atom.name, "the id");
    set.template operator()<"molecule">(atom.of_molecule, "the molecule");
    set.template operator()<"species">(atom.type, "the type");
    set.template operator()<"charge">(atom.electric, "the charge");
    set.template operator()<"radius">(0.5 * atom.diameter, "the diameter");
    set.template operator()<"density">(atom.dense, "the density");
    set.template operator()<"mass">(atom.dense * volume_of(atom.diameter), "the mass");
    if constexpr (has_named<Store, "position">)
        set_components(store[field_named<Store, "position">{}][i], atom.at);
    if constexpr (has_named<Store, "image">) {
        auto& periods = store[field_named<Store, "image">{}][i];
        for (std::size_t k = 0; k < periods.size(); ++k) periods[k] = atom.periods[k];
    }
}

/// The field of the store that files of this style do not have, or "".
template <class Store>
[[nodiscard]] constexpr std::string_view lacking_in(atom_style style) noexcept {
    if (!is_sphere(style)) {
        if (has_named<Store, "radius">) return "radius";
        if (has_named<Store, "density">) return "density";
        if (has_named<Store, "angular_velocity">) return "angular_velocity";
    }
    if (!has_charge(style) && has_named<Store, "charge">) return "charge";
    if (!has_molecule(style) && has_named<Store, "molecule">) return "molecule";
    return {};
}

}  // namespace tsubu::detail
