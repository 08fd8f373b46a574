// SPDX-License-Identifier: MIT
/// @file
/// lammps_reader: particles from a LAMMPS data file.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/io/atom_style.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/detail/atom_row.hpp>
#include <tsubu/io/detail/field_named.hpp>
#include <tsubu/io/detail/header_reader.hpp>
#include <tsubu/io/detail/line_places.hpp>
#include <tsubu/io/detail/line_reader.hpp>
#include <tsubu/io/detail/mass_table.hpp>
#include <tsubu/io/detail/row.hpp>
#include <tsubu/io/detail/term_row.hpp>
#include <tsubu/io/every_particle.hpp>
#include <tsubu/io/lammps_header.hpp>
#include <tsubu/io/lammps_options.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/term.hpp>
#include <tsubu/store/topology.hpp>

#include <algorithm>    // std::copy, std::equal, std::find, std::min
#include <array>        // std::array
#include <cstddef>      // std::ptrdiff_t, std::size_t
#include <cstdint>      // std::int32_t, std::int64_t, std::uint64_t
#include <numeric>      // std::iota
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <type_traits>  // std::is_same_v, std::remove_const_t, std::remove_cv_t
#include <utility>      // std::exchange, std::move
#include <vector>       // std::vector

namespace tsubu {

/// What is in this LAMMPS data file? The header at once, the particles on request; a chunk is held at a time.
///
///     tsubu::lammps_reader file(tsubu::file_source("grains.lmp"));
///     const auto box = file.header().box({true, true, false});
///     const auto mine = tsubu::brick_decomposition(box, ranks).subdomain(rank);
///     file.read(grains, [&](const auto& x) { return mine.owns_extended(box.wrap(x).position); });
///
/// Which columns and sections are stored follows from the fields of the store: id, position, species, and by their
/// names mass, radius, density, charge, molecule, image, velocity, angular_velocity, and the lists bonds, angles,
/// dihedrals, impropers. A field of LAMMPS that the style lacks is an error; fields that LAMMPS does not know, and
/// image flags that the file leaves out, are zero. All of the file is checked, stored or not. Numbers are taken as they
/// stand: the units of the fields hold for files in `units si`.
///
/// A rank that keeps a part cannot tell an id that nobody has from one that another rank keeps; but it tells ids of its
/// own that are repeated or missing, and the number of rows, so that an unknown id is missed by no file: where all
/// ranks together find each of n ids once in n rows, no row is left for another. Terms: compare the sum of
/// topology::count over all ranks with header().
///
/// @tparam Source  a byte_source.
///
/// Invalidates: read ends what it read from: a second read is an error.
/// Source: C3, C5 to C11.
template <byte_source Source>
class lammps_reader {
    using lines_type = detail::line_reader<Source>;
    using row_type = detail::row<lines_type>;

public:
    /// Reads the header.
    /// @throws input_error with file, line number, line and reason.
    explicit lammps_reader(Source source, const lammps_read_options& with = {})
        : with_(with), lines_(std::move(source), with.chunk) {
        is_at_section_ = detail::read_header(lines_, header_, with_.unknown);
    }

    /// What stands at the top; the masses after read.
    [[nodiscard]] const lammps_header& header() const noexcept { return header_; }
    /// The style of the section Atoms; after read. atomic if there is no such section.
    [[nodiscard]] atom_style style() const noexcept { return style_; }
    /// The names of sections that were skipped.
    [[nodiscard]] const std::vector<std::string>& skipped() const noexcept { return skipped_; }

    /// Reads the particles that keep(position) accepts, and the terms that they keep.
    ///
    /// @param store   empty; it owns what is kept, in the order of the file
    /// @param keep    keep(position) of the store's type of position, or vec<3>, as it stands in the file
    /// @tparam Newton  newton_on or newton_off: which particles keep a term
    /// @throws input_error with file, line number, line and reason; if the store is not empty; if the file lacks what
    ///         the store wants; at a second call.
    /// Strong guarantee: the store is as before.
    template <class Newton = newton_on, class Store, class Keep = every_particle>
    void read(Store& store, Keep&& keep = {});

private:
    template <class Store>
    struct reading {
        Store particles;
        std::vector<std::int64_t> ids{};  // in the order of the file
        id_map<> where{};
        std::vector<std::int32_t> types{};  // where masses are to follow from them
        bool keeps_all = true;  // no particle was left to others: every id of the file is known here
        bool has_atoms = false;
        bool has_velocities = false;
    };

    template <class Newton, class Store, class Keep>
    void read_section(reading<Store>& now, Keep& keep);
    template <class Store, class Keep>
    void read_atoms(reading<Store>& now, Keep& keep);
    template <class Store>
    void read_velocities(reading<Store>& now);
    template <class Newton, auto Field, class Store>
    void read_terms(reading<Store>& now, const char* name, lammps_count count);
    void read_masses();
    template <class Store>
    void finish(reading<Store>& now);
    void skip_section();

    // Goes through the rows of a section, calls each(row), and stops at the first line of the next section. Whatever
    // goes wrong, settle() is called, and tells first what was wrong with the rows before.
    template <class Each, class Settle>
    void rows(const char* name, std::int64_t count, Each&& each, Settle&& settle) {
        try {
            rows(name, count, each);
        } catch (const input_error&) {
            settle();
            throw;
        }
        settle();
    }
    template <class Each>
    void rows(const char* name, std::int64_t count, Each&& each) {
        std::int64_t read = 0;
        while ((is_at_section_ = lines_.next_content())) {
            row_type next(lines_);
            if (next.is_at_word()) break;
            if (read == count)
                next.fail("row " + std::to_string(read + 1) + " of " + name + ", but the header says " +
                              std::to_string(count),
                          "correct the header");
            each(next);
            ++read;
        }
        if (read != count)
            lines_.fail(std::string(name) + " ends after " + std::to_string(read) + " rows, but the header says " +
                            std::to_string(count),
                        "is the file whole?");
    }
    void choose_style(std::string_view hint);
    [[noreturn]] void refuse_unknown(std::int64_t particle_id, std::uint64_t line) {
        lines_.fail_at(line, "no particle has the id " + std::to_string(particle_id),
                       "correct the id, or add the particle to Atoms");
    }
    static constexpr std::size_t rows_at_once = 512;  // whose ids are looked up together; they stay in the caches

    lammps_read_options with_;
    lines_type lines_;
    lammps_header header_;
    atom_style style_ = atom_style::atomic;
    std::vector<std::string> skipped_;
    std::vector<std::string> met_;  // sections so far
    bool is_at_section_ = false;
    bool was_read_ = false;
};

template <byte_source Source>
template <class Newton, class Store, class Keep>
void lammps_reader<Source>::read(Store& store, Keep&& keep) {
    static_assert(detail::has_named<Store, "id">,
                  "particles are found by their ids: give the store the field tsubu::id");
    if (store.size() != 0)
        detail::raise<input_error>("lammps_reader::read",
                                   "the store has " + std::to_string(store.size()) + " particles",
                                   "read into an empty one");
    if (was_read_)
        detail::raise<input_error>("lammps_reader::read", std::string(lines_.name()) + " was read before",
                                   "make a new reader");
    was_read_ = true;
    reading<Store> now{store};
    while (is_at_section_) read_section<Newton>(now, keep);
    finish(now);
    now.particles.compact();  // lists that grew have left gaps
    store = std::move(now.particles);
}

template <byte_source Source>
template <class Newton, class Store, class Keep>
void lammps_reader<Source>::read_section(reading<Store>& now, Keep& keep) {
    const auto name = detail::with_single_blanks(lines_.content());
    if (std::find(met_.begin(), met_.end(), name) != met_.end()) lines_.fail("a second section " + name, "join them");
    met_.push_back(name);
    const bool needs_atoms = name == "Velocities" || name == "Bonds" || name == "Angles" || name == "Dihedrals" ||
                             name == "Impropers";
    if (needs_atoms && !now.has_atoms) lines_.fail(name + " before Atoms", "put Atoms in front");
    if (name == "Masses")
        read_masses();
    else if (name == "Atoms")
        read_atoms(now, keep);
    else if (name == "Velocities")
        read_velocities(now);
    else if (name == "Bonds")
        read_terms<Newton, bonds>(now, "Bonds", header_.bonds);
    else if (name == "Angles")
        read_terms<Newton, angles>(now, "Angles", header_.angles);
    else if (name == "Dihedrals")
        read_terms<Newton, dihedrals>(now, "Dihedrals", header_.dihedrals);
    else if (name == "Impropers")
        read_terms<Newton, impropers>(now, "Impropers", header_.impropers);
    else
        skip_section();
}

template <byte_source Source>
template <class Store, class Keep>
void lammps_reader<Source>::read_atoms(reading<Store>& now, Keep& keep) {
    choose_style(lines_.comment());
    if (const auto lacking = detail::lacking_in<Store>(style_); !lacking.empty())
        lines_.fail("atom style " + std::string(name_of(style_)) + " has no " + std::string(lacking) +
                        ", which the store has",
                    "read a file that has it, or a store without");
    using real = detail::scalar_named<Store, "position">;
    std::size_t given = 0;
    auto& ids = now.ids;
    detail::line_places places;
    if constexpr (std::is_same_v<std::remove_const_t<Keep>, every_particle>) {
        constexpr std::size_t shortest_row = 10;  // "1 1 0 0 0", and its end: what the header promises may be too much
        const auto expected = (std::min)(static_cast<std::uint64_t>(header_.atoms.rows),
                                         static_cast<std::uint64_t>(lines_.size() / shortest_row));
        now.particles.reserve(static_cast<std::size_t>(expected));
        ids.reserve(static_cast<std::size_t>(expected));
    }
    rows("Atoms", header_.atoms.rows, [&](row_type& row) {
        if (given == 0) given = detail::count_words(row.rest());
        const auto atom = detail::read_atom<real>(row, style_, given, header_.atoms.types);
        auto& particles = now.particles;
        if constexpr (detail::has_named<Store, "position">) {
            detail::value_named<Store, "position"> at{};
            detail::set_components(at, atom.position);
            if (!keep(at)) {
                now.keeps_all = false;
                return;
            }
        } else if (!keep(atom.position)) {
            now.keeps_all = false;
            return;
        }
        ids.push_back(atom.particle_id);
        places.push_back(lines_.number());
        detail::append_atom(particles, atom, row);
        if constexpr (detail::has_named<Store, "mass">)
            if (!is_sphere(style_)) now.types.push_back(atom.type);
    });
    now.has_atoms = true;
    now.where.rebuild(ids);  // at once: several times faster than id by id, and so are look-ups later
    if (now.where.size() == ids.size()) return;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (const auto first = static_cast<std::size_t>(now.where.find(ids[i])); first != i)
            lines_.fail_at(places[i],
                           "a second particle with the id " + std::to_string(ids[i]) + ", which line " +
                               std::to_string(places[first]) + " has",
                           "give each particle an id of its own");
}

template <byte_source Source>
template <class Store>
void lammps_reader<Source>::read_velocities(reading<Store>& now) {
    using real = detail::scalar_named<Store, "velocity">;
    using angular = detail::scalar_named<Store, "angular_velocity">;
    std::vector<bool> seen(now.ids.size());
    std::size_t expected = 0;  // most files list velocities in the order of atoms: then nothing is to be looked up
    struct {
        std::array<std::int64_t, rows_at_once> ids;
        std::array<std::uint64_t, rows_at_once> lines;
        std::array<vec<3, real>, rows_at_once> v;
        std::array<vec<3, angular>, rows_at_once> w;
        std::size_t count = 0;
    } held;
    std::array<index_t, rows_at_once> places;
    const auto settle = [&] {
        const auto count = std::exchange(held.count, 0);  // first: who throws here is not asked again
        const auto ids = std::span<const std::int64_t>(held.ids).first(count);
        if (count <= now.ids.size() - expected &&
            std::equal(ids.begin(), ids.end(), now.ids.begin() + static_cast<std::ptrdiff_t>(expected)))
            std::iota(places.begin(), places.begin() + count, static_cast<index_t>(expected));
        else
            now.where.find(ids, std::span(places).first(count));
        for (std::size_t k = 0; k < count; ++k) {
            if (places[k] == absent) {
                if (now.keeps_all) refuse_unknown(ids[k], held.lines[k]);
                continue;
            }
            const auto i = static_cast<std::size_t>(places[k]);
            if (seen[i]) [[unlikely]]
                lines_.fail_at(held.lines[k], "a second velocity of id " + std::to_string(ids[k]),
                               "leave one of them");
            seen[i] = true;
            expected = i + 1;
            if constexpr (detail::has_named<Store, "velocity">)
                detail::set_components(now.particles[detail::field_named<Store, "velocity">{}][i], held.v[k]);
            if constexpr (detail::has_named<Store, "angular_velocity">)
                detail::set_components<detail::components::of_rotation>(
                    now.particles[detail::field_named<Store, "angular_velocity">{}][i], held.w[k]);
        }
    };
    const auto each = [&](row_type& row) {
        if (held.count == rows_at_once) settle();
        held.ids[held.count] = row.template next_from<std::int64_t>(1, "the id");
        held.lines[held.count] = lines_.number();
        for (auto& one : held.v[held.count]) one = row.template next<real>("a velocity");
        if (is_sphere(style_))
            for (auto& one : held.w[held.count]) one = row.template next<angular>("an angular velocity");
        row.expect_end();
        ++held.count;
    };
    rows("Velocities", header_.atoms.rows, each, settle);
    if (const auto missed = std::find(seen.begin(), seen.end(), false); missed != seen.end()) {
        const auto i = static_cast<std::size_t>(missed - seen.begin());
        lines_.fail("Velocities, which end here, have none of id " +
                        std::to_string(now.ids[i]),
                    "give each particle one");
    }
    now.has_velocities = true;
}

template <byte_source Source>
template <class Newton, auto Field, class Store>
void lammps_reader<Source>::read_terms(reading<Store>& now, const char* name, lammps_count count) {
    using field_type = std::remove_cv_t<decltype(Field)>;
    using rules = topology<Field, Newton>;
    constexpr auto order = rules::order;
    struct {
        std::array<term<order>, rows_at_once> terms;
        std::array<std::int64_t, rows_at_once * order> ids;
        std::array<std::uint64_t, rows_at_once> lines;
        std::size_t count = 0;
    } held;
    std::array<index_t, rows_at_once * order> places;
    [[maybe_unused]] detail::kept_terms<order> kept;
    const auto settle = [&] {
        const auto terms = std::exchange(held.count, 0);  // first: who throws here is not asked again
        now.where.find(std::span<const std::int64_t>(held.ids).first(terms * order),
                       std::span(places).first(terms * order));
        for (std::size_t t = 0; t < terms; ++t) {
            const auto& one = held.terms[t];
            const auto* const of_term = places.data() + t * order;
            for (std::size_t k = 0; k < order && now.keeps_all; ++k)
                if (of_term[k] == absent) [[unlikely]]
                    refuse_unknown(one.ids[k], held.lines[t]);
            if constexpr (Store::template has<field_type>)
                for (std::size_t k = 0; k < order; ++k)
                    if (of_term[k] != absent && rules::keeps_at(one, k)) kept.add(of_term[k], one);
        }
    };
    const auto each = [&](row_type& row) {
        if (held.count == rows_at_once) settle();
        const auto one = detail::read_term<order>(row, count.types, with_.allows_repeats);
        held.terms[held.count] = one;
        std::copy(one.ids.begin(), one.ids.end(), held.ids.begin() + static_cast<std::ptrdiff_t>(order * held.count));
        held.lines[held.count++] = lines_.number();
    };
    rows(name, count.rows, each, settle);
    if constexpr (Store::template has<field_type>) kept.give(now.particles[Field]);
}

template <byte_source Source>
void lammps_reader<Source>::read_masses() {
    detail::mass_table table;
    rows("Masses", header_.atoms.types, [&](row_type& row) { table.add(row, header_.atoms.types); });
    header_.masses = table.by_type();
}

template <byte_source Source>
void lammps_reader<Source>::skip_section() {
    if (with_.unknown == unknown_lines::refuse)
        lines_.fail("this is no section that tsubu reads",
                    "set lammps_read_options.unknown to unknown_lines::skip, or remove it");
    skipped_.push_back(detail::with_single_blanks(lines_.content()));
    while ((is_at_section_ = lines_.next_content()))
        if (detail::is_letter(lines_.content().front())) return;
}

template <byte_source Source>
void lammps_reader<Source>::choose_style(std::string_view hint) {
    const auto hinted = atom_style_named(hint);
    if (with_.style && !hint.empty() && hinted != with_.style)
        lines_.fail("this is not atom style " + std::string(name_of(*with_.style)),
                    "set lammps_read_options.style to the style of the file");
    if (!with_.style && !hinted)
        lines_.fail(hint.empty() ? "the atom style is not told" : "this is no atom style that tsubu reads",
                    "set lammps_read_options.style, or name it in the file: Atoms # atomic");
    style_ = with_.style ? *with_.style : *hinted;
}

template <byte_source Source>
template <class Store>
void lammps_reader<Source>::finish(reading<Store>& now) {
    const auto expect = [&](const char* name, std::int64_t rows, const char* kind) {
        if (rows != 0 && std::find(met_.begin(), met_.end(), name) == met_.end())
            lines_.fail("the header says " + std::to_string(rows) + kind + ", but there is no section " + name,
                        "is the file whole?");
    };
    expect("Atoms", header_.atoms.rows, " atoms");
    expect("Bonds", header_.bonds.rows, " bonds");
    expect("Angles", header_.angles.rows, " angles");
    expect("Dihedrals", header_.dihedrals.rows, " dihedrals");
    expect("Impropers", header_.impropers.rows, " impropers");
    constexpr bool wants_velocities =
        detail::has_named<Store, "velocity"> || detail::has_named<Store, "angular_velocity">;
    if (wants_velocities && !now.has_velocities && header_.atoms.rows != 0 && !with_.velocities_may_lack)
        lines_.fail("there is no section Velocities, but the store has them",
                    "set lammps_read_options.velocities_may_lack to leave them 0");
    if constexpr (detail::has_named<Store, "mass">) {
        if (is_sphere(style_) || header_.atoms.rows == 0) return;
        if (header_.masses.empty())
            lines_.fail("there is no section Masses, but the store has masses", "give a mass for each type");
        using value = detail::value_named<Store, "mass">;
        const auto masses = now.particles[detail::field_named<Store, "mass">{}];
        for (std::size_t i = 0; i < masses.size(); ++i)
            masses[i] = static_cast<value>(header_.masses[static_cast<std::size_t>(now.types[i] - 1)]);
    }
}

}  // namespace tsubu
