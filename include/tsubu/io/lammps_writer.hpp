// SPDX-License-Identifier: MIT
/// @file
/// lammps_writer: particles to a LAMMPS data file.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/io/atom_style.hpp>
#include <tsubu/io/detail/atom_row.hpp>
#include <tsubu/io/detail/field_named.hpp>
#include <tsubu/io/detail/header_words.hpp>
#include <tsubu/io/detail/store_sections.hpp>
#include <tsubu/io/complete_header.hpp>
#include <tsubu/io/lammps_header.hpp>
#include <tsubu/io/lammps_options.hpp>
#include <tsubu/io/text_sink.hpp>
#include <tsubu/store/term.hpp>
#include <tsubu/store/topology.hpp>

#include <algorithm>  // std::sort, std::swap
#include <cmath>      // std::isfinite
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint64_t
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::in_range, std::move, std::pair
#include <vector>     // std::vector

namespace tsubu {

/// Writes a LAMMPS data file, or the part of it that one rank has: doubles in the shortest form that reads back
/// exactly.
///
///     std::string text;
///     tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; });
///     out.write(grains, top);                                    // all of it; top: title and box
///
/// Ranks write one after the other: rank 0 header() and head(), then each its rows from k0 on, an exclusive scan of
/// count(), section by section.
///
///     out.rows(tsubu::lammps_section::bond_rows, grains, k0);        // returns how many
///
/// What is written follows from the fields of the store, as in lammps_reader; a molecule that the store does not have
/// is 0. Fields that LAMMPS does not know are not written, nor are ghosts. Where no atom style has all fields that
/// LAMMPS knows, one is to be named in the options: its columns are written, and no others.
///
/// @tparam Sink    a text_sink.
/// @tparam Newton  newton_on or newton_off: who keeps the terms of the store, and so which are written (C5 to C10).
///
/// Source: C4 to C11.
template <text_sink Sink, class Newton = newton_on>
class lammps_writer {
public:
    explicit lammps_writer(Sink sink, const lammps_write_options& with = {}, Newton = {})
        : with_(with), out_(std::move(sink), with.chunk) {}

    /// All of a file: header, masses, and the sections that the store has fields for.
    /// @param top  title, box and, if the store does not tell them, masses; counts and types are made no smaller than
    ///             the store needs them
    /// @throws input_error if a number is not finite, an id not above 0, if the store lacks what the style needs, or if
    ///         no style has all that the store has and none is named.
    template <class Store>
    void write(const Store& store, lammps_header top) {
        complete_header<Newton>(top, store, style<Store>());
        header(top);
        for (const auto section : detail::all_sections)
            if (detail::has_section<Store>(section) && count(section, store) != 0) {
                head<Store>(section);
                rows(section, store);
            }
        flush();
    }

    /// Title, counts, box and masses.
    void header(const lammps_header& top);
    /// The name of a section, and the blank lines around it.
    template <class Store>
    void head(lammps_section section) {
        out_.put('\n');
        out_.put(detail::section_names[static_cast<std::size_t>(section)]);
        if (section == lammps_section::atom_rows) {
            out_.put(" # ");
            out_.put(name_of(style<Store>()));
        }
        out_.put("\n\n");
    }
    /// The rows of a section, the terms numbered from k0 on. @return how many: count(section, store).
    template <class Store>
    std::uint64_t rows(lammps_section section, const Store& store, std::uint64_t k0 = 1) {
        return rows(section, std::span<const Store>(&store, 1), k0);
    }
    /// Of several parts, such as those that ranks have sent: one after the other; by the option canonical sorted over
    /// all of them, so that the bytes do not depend on how many there are, and who has what (C11).
    template <class Store>
    std::uint64_t rows(lammps_section section, std::span<const Store> parts, std::uint64_t k0 = 1);
    /// How many rows a section of this store has.
    template <class Store>
    [[nodiscard]] static std::uint64_t count(lammps_section section, const Store& store);
    /// Gives to the sink what is still held. Destruction does not.
    void flush() { out_.flush(); }
    [[nodiscard]] Sink& sink() noexcept { return out_.sink(); }

    /// The style of the options, or the least that has all fields of the store.
    /// @throws input_error if none is named there, and no style has all fields.
    template <class Store>
    [[nodiscard]] atom_style style() const {
        return with_.style ? *with_.style : detail::least_style<Store>();
    }

private:
    template <class Store>
    std::uint64_t write_atoms(std::span<const Store> parts);
    template <class Store>
    std::uint64_t write_velocities(std::span<const Store> parts);
    template <auto Field, class Store>
    std::uint64_t write_terms(std::span<const Store> parts, std::uint64_t k0);

    // Owned particles in the order in which they are written: which part, and the index there.
    template <class Store>
    [[nodiscard]] std::vector<std::pair<const Store*, std::size_t>> order_of(std::span<const Store> parts) const {
        std::vector<std::pair<const Store*, std::size_t>> order;
        for (const auto& part : parts)
            for (std::size_t i = 0; i < part.owned_count(); ++i) order.emplace_back(&part, i);
        if (with_.canonical) {
            using id_field = detail::field_named<Store, "id">;
            const auto id_of = [](const auto& at) { return (*at.first)[id_field{}][at.second]; };
            std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) { return id_of(a) < id_of(b); });
        }
        return order;
    }
    template <class Number>
    void put_finite(Number x, std::int64_t particle_id) {
        if (!std::isfinite(x)) [[unlikely]]
            detail::raise<input_error>("lammps_writer",
                                       "a value " + detail::shown(x) + " of the particle with id " +
                                           std::to_string(particle_id),
                                       "a file holds finite numbers");
        out_.put(' ');
        out_.put_number(x);
    }
    template <class Store>
    [[nodiscard]] static std::int64_t id_at(const Store& store, std::size_t i) {
        const auto particle_id = store[detail::field_named<Store, "id">{}][i];
        if (particle_id < 1 || !std::in_range<std::int64_t>(particle_id)) [[unlikely]]
            detail::raise<input_error>("lammps_writer", "the id " + std::to_string(particle_id),
                                       "ids of LAMMPS begin with 1");
        return static_cast<std::int64_t>(particle_id);
    }

    lammps_write_options with_;
    detail::text_buffer<Sink> out_;
};

template <text_sink Sink, class Newton>
void lammps_writer<Sink, Newton>::header(const lammps_header& top) {
    if (top.title.find_first_of("\r\n") != std::string::npos)
        detail::raise<input_error>("lammps_writer::header", "a title of several lines", "give one");
    out_.put(top.title);
    out_.put("\n\n");
    for (const auto& kind : detail::counted_kinds) {
        const auto& number = top.*kind.count;
        if (number == lammps_count{} && kind.count != &lammps_header::atoms) continue;
        out_.put_number(number.rows);
        out_.put(' ');
        out_.put(kind.rows);
        out_.put('\n');
        out_.put_number(number.types);
        out_.put(' ');
        out_.put(kind.types);
        out_.put('\n');
    }
    out_.put('\n');
    for (std::size_t k = 0; k < 3; ++k) {
        if (!std::isfinite(top.lo[k]) || !std::isfinite(top.hi[k]) || !(top.lo[k] < top.hi[k]))
            detail::raise<input_error>("lammps_writer::header",
                                       "a box from " + detail::shown(top.lo) + " to " + detail::shown(top.hi),
                                       "give finite faces, the lower one first");
        out_.put_numbers(top.lo[k], top.hi[k]);
        out_.put(' ');
        out_.put(detail::face_names[k]);
        out_.put('\n');
    }
    if (top.tilt) {
        for (const auto one : *top.tilt)
            if (!std::isfinite(one))
                detail::raise<input_error>("lammps_writer::header", "a tilt of " + detail::shown(*top.tilt),
                                           "give finite ones");
        out_.put_numbers((*top.tilt)[0], (*top.tilt)[1], (*top.tilt)[2]);
        out_.put(" xy xz yz\n");
    }
    if (top.masses.empty()) return;
    if (top.masses.size() != static_cast<std::size_t>(top.atoms.types))
        detail::raise<input_error>("lammps_writer::header",
                                   std::to_string(top.masses.size()) + " masses of " + std::to_string(top.atoms.types) +
                                       " types",
                                   "give one for each type, or none");
    out_.put("\nMasses\n\n");
    for (std::size_t k = 0; k < top.masses.size(); ++k) {
        if (!(top.masses[k] > 0) || !std::isfinite(top.masses[k]))
            detail::raise<input_error>("lammps_writer::header",
                                       "a mass of " + detail::shown(top.masses[k]) + " for type " +
                                           std::to_string(k + 1),
                                       "give each type one above 0");
        out_.put_numbers(k + 1, top.masses[k]);
        out_.put('\n');
    }
}

template <text_sink Sink, class Newton>
template <class Store>
std::uint64_t lammps_writer<Sink, Newton>::count(lammps_section section, const Store& store) {
    if (section == lammps_section::atom_rows || section == lammps_section::velocity_rows)
        return detail::has_section<Store>(section) ? store.owned_count() : 0;
    std::uint64_t found = 0;
    detail::with_terms<Store>(section, [&]<auto Field>() { found = topology<Field, Newton>::count(store); });
    return found;
}

template <text_sink Sink, class Newton>
template <class Store>
std::uint64_t lammps_writer<Sink, Newton>::rows(lammps_section section, std::span<const Store> parts,
                                                std::uint64_t k0) {
    static_assert(detail::has_named<Store, "id"> && detail::has_named<Store, "position">,
                  "files tell ids and positions: give the store the fields tsubu::id and tsubu::position");
    if (!detail::has_section<Store>(section)) return 0;
    if (section == lammps_section::atom_rows) return write_atoms(parts);
    if (section == lammps_section::velocity_rows) return write_velocities(parts);
    std::uint64_t written = 0;
    detail::with_terms<Store>(section, [&]<auto Field>() { written = write_terms<Field>(parts, k0); });
    return written;
}

template <text_sink Sink, class Newton>
template <class Store>
std::uint64_t lammps_writer<Sink, Newton>::write_atoms(std::span<const Store> parts) {
    using detail::value_at;
    const auto written = style<Store>();
    detail::check_style<Store>(written);
    const auto order = order_of(parts);
    for (const auto& [part, i] : order) {
        const auto& store = *part;
        const auto particle_id = id_at(store, i);
        out_.put_number(particle_id);
        if (has_molecule(written)) {
            out_.put(' ');
            out_.put_number(value_at<"molecule">(store, i, 0));
        }
        out_.put(' ');
        out_.put_number(detail::type_at(store, i));
        if (is_sphere(written)) {
            const auto diameter = 2 * static_cast<double>(value_at<"radius">(store, i, 0.0));
            put_finite(diameter, particle_id);
            if constexpr (detail::has_named<Store, "density">)
                put_finite(static_cast<double>(value_at<"density">(store, i, 0.0)), particle_id);
            else
                put_finite(static_cast<double>(value_at<"mass">(store, i, 0.0)) / detail::volume_of(diameter),
                           particle_id);
        }
        if (has_charge(written)) put_finite(static_cast<double>(value_at<"charge">(store, i, 0.0)), particle_id);
        using real = detail::scalar_named<Store, "position">;
        for (const auto x : detail::three_components<real>(store[detail::field_named<Store, "position">{}][i]))
            put_finite(x, particle_id);
        if constexpr (detail::has_named<Store, "image">)
            if (with_.images) {
                const auto flags = detail::three_components<std::int64_t>(value_at<"image">(store, i, 0));
                for (const auto n : flags) {
                    out_.put(' ');
                    out_.put_number(n);
                }
            }
        out_.put('\n');
    }
    return order.size();
}

template <text_sink Sink, class Newton>
template <class Store>
std::uint64_t lammps_writer<Sink, Newton>::write_velocities(std::span<const Store> parts) {
    using real = detail::scalar_named<Store, "velocity">;
    using angular = detail::scalar_named<Store, "angular_velocity">;
    const bool with_angular = is_sphere(style<Store>());
    const auto order = order_of(parts);
    for (const auto& [part, i] : order) {
        const auto& store = *part;
        const auto particle_id = id_at(store, i);
        out_.put_number(particle_id);
        for (const auto v : detail::three_components<real>(detail::value_at<"velocity">(store, i, vec<3, real>{})))
            put_finite(v, particle_id);
        if (with_angular)
            for (const auto w : detail::three_components<angular, detail::components::of_rotation>(
                     detail::value_at<"angular_velocity">(store, i, vec<3, angular>{})))
                put_finite(w, particle_id);
        out_.put('\n');
    }
    return order.size();
}

template <text_sink Sink, class Newton>
template <auto Field, class Store>
std::uint64_t lammps_writer<Sink, Newton>::write_terms(std::span<const Store> parts, std::uint64_t k0) {
    using terms = topology<Field, Newton>;
    using particle_ids = typename terms::particle_ids;
    auto k = k0;
    const auto put = [&](std::int64_t type, const particle_ids& ids) {
        out_.put_numbers(k, type);
        for (const auto one : ids) {
            if (one < 1)
                detail::raise<input_error>("lammps_writer", "a term of particle " + std::to_string(one),
                                           "LAMMPS numbers particles from 1");
            out_.put(' ');
            out_.put_number(one);
        }
        out_.put('\n');
        ++k;
    };
    if (!with_.canonical) {
        for (const auto& part : parts) terms::rows(part, put);
        return k - k0;
    }
    std::vector<std::pair<particle_ids, std::int64_t>> all;
    for (const auto& part : parts)
        terms::rows(part, [&](std::int64_t type, particle_ids ids) {
            if (terms::order == 2 && ids[1] < ids[0]) std::swap(ids[0], ids[1]);  // a bond has no direction
            all.emplace_back(ids, type);
        });
    std::sort(all.begin(), all.end());
    for (const auto& [ids, type] : all) put(type, ids);
    return k - k0;
}

}  // namespace tsubu
