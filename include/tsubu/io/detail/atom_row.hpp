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
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view
#include <tuple>        // std::tuple_size_v
#include <utility>      // std::in_range

namespace tsubu::detail {

template <class Real>
struct atom_row {
    std::int64_t particle_id = 0;
    std::int64_t molecule = 0;
    std::int32_t type = 0;
    double charge = 0;
    double diameter = 0;
    double density = 0;
    vec<3, Real> position{};
    vec<3, std::int64_t> image{};
};

/// Volume of a sphere; of a point (diameter 0) 1, since LAMMPS takes its density as its mass.
[[nodiscard]] inline double volume_of(double diameter) noexcept {
    const auto half = 0.5 * diameter;
    return diameter == 0 ? 1.0 : 4.0 / 3.0 * std::numbers::pi * half * half * half;
}

/// @param columns  of the first row: three more than the style has if image flags follow
template <class Real, class Row>
[[nodiscard]] atom_row<Real> read_atom(Row& from, atom_style style, std::size_t columns, std::int32_t types) {
    const auto all = from.rest();
    const bool with_images = columns == atom_columns(style) + 3;
    atom_row<Real> atom;
    atom.particle_id = from.template next_from<std::int64_t>(1, "the id");
    if (has_molecule(style)) atom.molecule = from.template next<std::int64_t>("the molecule");
    atom.type = from.template next_from<std::int32_t>(1, "the type");
    if (atom.type > types) [[unlikely]]
        from.fail("type " + std::to_string(atom.type) + ", but the header has " + std::to_string(types) + " atom types",
                  "correct one of them");
    if (is_sphere(style)) {
        atom.diameter = from.template next<double>("the diameter");
        atom.density = from.template next<double>("the density");
        if (atom.diameter < 0 || atom.density <= 0) [[unlikely]]
            from.fail("a diameter below 0, or a density not above 0", "give 0 for a point, and a density above 0");
    }
    if (has_charge(style)) atom.charge = from.template next<double>("the charge");
    for (auto& x : atom.position) x = from.template next<Real>("a coordinate");
    if (from.is_at_end() == with_images) [[unlikely]]
        if (const auto here = count_words(all); here != columns)
            from.fail("the first row of Atoms has " + std::to_string(columns) + " columns, this one " +
                          std::to_string(here),
                      "give image flags in all rows or in none");
    if (with_images)
        for (auto& n : atom.image) n = from.template next<std::int64_t>("an image flag");
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

/// Which of three components a vector of a store has: as many as its own, from x on; one of a rotation is about z.
enum class components { of_vector, of_rotation };
template <components Which, class Vector>
inline constexpr std::size_t first_component =
    Which == components::of_rotation && std::tuple_size_v<Vector> == 1 ? 2 : 0;

template <components Which = components::of_vector, class Vector, class Real>
void set_components(Vector& to, const vec<3, Real>& from) noexcept {
    constexpr auto count = std::tuple_size_v<Vector>;
    static_assert(count >= 1 && count <= 3, "LAMMPS has vectors of up to three components");
    for (std::size_t k = 0; k < count; ++k)
        to[k] = static_cast<typename Vector::value_type>(from[first_component<Which, Vector> + k]);
}
template <class Real, components Which = components::of_vector, class Vector>
[[nodiscard]] vec<3, Real> three_components(const Vector& from) noexcept {
    constexpr auto count = std::tuple_size_v<Vector>;
    static_assert(count >= 1 && count <= 3, "LAMMPS has vectors of up to three components");
    vec<3, Real> to{};
    for (std::size_t k = 0; k < count; ++k) to[first_component<Which, Vector> + k] = from[k];
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
    set.template operator()<"id">(atom.particle_id, "the id");
    set.template operator()<"molecule">(atom.molecule, "the molecule");
    set.template operator()<"species">(atom.type, "the type");
    set.template operator()<"charge">(atom.charge, "the charge");
    set.template operator()<"radius">(0.5 * atom.diameter, "the diameter");
    set.template operator()<"density">(atom.density, "the density");
    set.template operator()<"mass">(atom.density * volume_of(atom.diameter), "the mass");
    if constexpr (has_named<Store, "position">)
        set_components(store[field_named<Store, "position">{}][i], atom.position);
    if constexpr (has_named<Store, "image">) {
        auto& flags = store[field_named<Store, "image">{}][i];
        static_assert(std::tuple_size_v<std::remove_reference_t<decltype(flags)>> <= 3,
                      "LAMMPS has image flags of up to three axes");
        for (std::size_t k = 0; k < flags.size(); ++k) flags[k] = atom.image[k];
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
