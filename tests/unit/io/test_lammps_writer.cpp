// SPDX-License-Identifier: MIT
#include <tsubu/io/lammps_writer.hpp>

#include "support/catch.hpp"
#include "unit/io/lammps_examples.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using tsubu::input_error;
using tsubu::lammps_header;
using tsubu::lammps_section;
using tsubu::vec;

namespace {

const lammps_header unit_box{.title = "unit", .lo = {0, 0, 0}, .hi = {1, 1, 1}};

/// The rows of a section, without its head.
std::string rows_in(const std::string& text, std::string_view section) {
    const auto head = "\n" + std::string(section) + "\n\n";
    const auto at = text.find(head);
    if (at == std::string::npos) return "no such section";
    const auto rows = text.substr(at + head.size());
    const auto end = rows.find("\n\n");
    return end == std::string::npos ? rows : rows.substr(0, end + 1);
}

/// A store of particles 1 .. n in a random order, with a chain of terms, kept by Newton's rule.
template <class Newton, class Layout = tsubu::soa>
full_store<Layout> chain(std::int64_t n, std::uint64_t seed) {
    full_store<Layout> g;
    tsubu::random_stream random(seed);
    std::vector<std::int64_t> names;
    for (std::int64_t k = 1; k <= n; ++k) names.push_back(k);
    for (auto k = names.size(); k-- > 1;) std::swap(names[k], names[random.below(k + 1)]);
    tsubu::id_map<> where;
    where.rebuild(names);
    for (const auto name : names) {
        tsubu::random_stream of(static_cast<std::uint64_t>(name));
        g.push_back(tsubu::id = name, tsubu::species = 1 + static_cast<std::int32_t>(name % 2),
                    tsubu::mass = static_cast<double>(1 + name % 2), tsubu::charge = of.unit() - 0.5,
                    tsubu::molecule = name / 3, tsubu::position<3> = {of.unit(), of.unit(), of.unit()},
                    tsubu::velocity<3> = {of.unit() - 0.5, of.unit() - 0.5, of.unit() - 0.5},
                    tsubu::image<3> = {name % 3 - 1, 0, 0});
    }
    for (std::int64_t k = 1; k < n; ++k) {
        tsubu::topology<tsubu::bonds, Newton>::insert(g, where, {.type = 1, .ids = {k + 1, k}});
        if (k + 2 <= n) tsubu::topology<tsubu::angles, Newton>::insert(g, where, {.type = 2, .ids = {k, k + 1, k + 2}});
        if (k + 3 <= n) {
            tsubu::topology<tsubu::dihedrals, Newton>::insert(g, where, {.type = 1, .ids = {k, k + 1, k + 2, k + 3}});
            tsubu::topology<tsubu::impropers, Newton>::insert(g, where, {.type = -3, .ids = {k + 3, k + 2, k, k + 1}});
        }
    }
    return g;
}

}  // namespace

TEST_CASE("a file is written as it is read", "[io][lammps_writer][C11]") {
    full_store<> g;
    const auto top = read_text(full_text, g);
    const auto text = text_of(g, top);
    CHECK(rows_in(text, "Atoms # full") == "20 1 2 -0.5 1 0.5 2 0 0 1\n10 1 1 0.25 0.1 0 0 0 -1 0\n"
                                           "40 2 1 0.25 9 -0.5 1 0 0 0\n30 2 1 0 5 0 1 2 0 0\n");
    CHECK(rows_in(text, "Velocities") == "20 2 0 0\n10 1 0 0\n40 4 0 0\n30 3 0 -0.125\n");
    CHECK(rows_in(text, "Bonds") == "1 2 20 10\n2 1 20 30\n3 1 30 40\n");
    CHECK(rows_in(text, "Angles") == "1 1 10 20 30\n2 1 20 30 40\n");
    CHECK(rows_in(text, "Impropers") == "1 3 40 10 20 30\n");
    const std::string head =
        "four of a kind\n\n4 atoms\n2 atom types\n3 bonds\n2 bond types\n2 angles\n1 angle types\n1 dihedrals\n"
        "1 dihedral types\n1 impropers\n3 improper types\n\n0 10 xlo xhi\n-1 1 ylo yhi\n0 2.5 zlo zhi\n\n"
        "Masses\n\n1 1.008\n2 16\n\nAtoms # full\n";
    CHECK(text.substr(0, head.size()) == head);
}

TEST_CASE("write, read and write again gives the same bytes", "[io][lammps_writer][I11]") {
    const auto g = chain<tsubu::newton_on>(200, 3);
    for (const bool canonical : {false, true}) {
        const auto first = text_of(g, unit_box, {.canonical = canonical});
        full_store<> h;
        const auto top = read_text(first, h);
        CHECK(text_of(h, top, {.canonical = canonical}) == first);
    }
}

TEST_CASE("numbers come back to the bit", "[io][lammps_writer]") {
    constexpr auto most = (std::numeric_limits<double>::max)();
    const std::vector<double> values{0.1 + 0.2,           5e-324, -0.0, most, -most, 1.0 / 3, 2.2250738585072011e-308,
                                     123456789012345680.0};
    using moving = tsubu::particle_store<
        tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3, float>, tsubu::charge, tsubu::image<3>>>;
    moving g;
    std::int64_t name = (std::numeric_limits<std::int64_t>::max)() - 20;
    for (const auto x : values)
        g.push_back(tsubu::id = name++, tsubu::position<3> = {x, 0, -x}, tsubu::charge = x,
                    tsubu::velocity<3, float> = {0.1F + 0.2F, 1e-45F, (std::numeric_limits<float>::max)()},
                    tsubu::image<3> = {(std::numeric_limits<std::int64_t>::min)(), 0, -1});
    moving h;
    read_text(text_of(g, unit_box), h);
    REQUIRE(h.size() == values.size());
    const auto same = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    for (std::size_t i = 0; i < values.size(); ++i) {
        CAPTURE(values[i]);
        CHECK(h[tsubu::id][i] == g[tsubu::id][i]);
        CHECK(same(h[tsubu::position<3>][i][0], values[i]));
        CHECK(same(h[tsubu::position<3>][i][2], -values[i]));
        CHECK(same(h[tsubu::charge][i], values[i]));
        CHECK(h[tsubu::velocity<3, float>][i] == g[tsubu::velocity<3, float>][i]);
        CHECK(h[tsubu::image<3>][i] == g[tsubu::image<3>][i]);
    }
}

TEST_CASE("canonical bytes depend neither on the order of particles nor on Newton's rule", "[io][lammps_writer][C11]") {
    const tsubu::lammps_write_options canonical{.canonical = true};
    const auto expected = text_of(chain<tsubu::newton_on>(60, 1), unit_box, canonical);
    CHECK(rows_in(expected, "Bonds").substr(0, 16) == "1 1 1 2\n2 1 2 3\n");
    CHECK(text_of(chain<tsubu::newton_on>(60, 2), unit_box, canonical) == expected);
    CHECK(text_of<tsubu::newton_off>(chain<tsubu::newton_off>(60, 3), unit_box, canonical) == expected);
    CHECK(text_of(chain<tsubu::newton_on, tsubu::aos>(60, 4), unit_box, canonical) == expected);
    CHECK(text_of<tsubu::newton_off>(chain<tsubu::newton_off, tsubu::aosoa<8>>(60, 5), unit_box, canonical) ==
          expected);
    CHECK(text_of(chain<tsubu::newton_on>(60, 2), unit_box) != expected);
}

TEST_CASE("ranks write their parts one after the other", "[io][lammps_writer][C11]") {
    full_store<> whole;
    auto top = read_text(full_text, whole);
    for (const std::size_t ranks : {1U, 2U, 7U}) {
        std::vector<full_store<>> parts(ranks);
        for (std::size_t rank = 0; rank < ranks; ++rank) {
            std::size_t next = 0;  // particle k of the file goes to rank k modulo ranks
            read_text(full_text, parts[rank], {}, [&](const vec<3>&) { return next++ % ranks == rank; });
        }
        std::string text;
        tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; });
        out.header(top);
        for (const auto section :
             {lammps_section::atom_rows, lammps_section::velocity_rows, lammps_section::bond_rows,
              lammps_section::angle_rows, lammps_section::dihedral_rows, lammps_section::improper_rows}) {
            out.head<full_store<>>(section);
            std::uint64_t k0 = 1;
            for (const auto& part : parts) {
                const auto written = out.rows(section, part, k0);
                CHECK(written == decltype(out)::count(section, part));
                k0 += written;
            }
            const auto expected = decltype(out)::count(section, whole);
            CHECK(k0 - 1 == expected);
        }
        out.flush();
        full_store<> again;
        read_text(text, again);
        const tsubu::lammps_write_options canonical{.canonical = true};
        CHECK(text_of(again, top, canonical) == text_of(whole, top, canonical));
        CHECK(rows_in(text, "Bonds").substr(0, 2) == "1 ");
        CHECK(says(rows_in(text, "Bonds"), "\n3 "));
    }
}

TEST_CASE("canonical bytes do not depend on the number of parts", "[io][lammps_writer][C11]") {
    const tsubu::lammps_write_options canonical{.canonical = true};
    full_store<> whole = chain<tsubu::newton_on>(60, 1);
    auto top = unit_box;
    tsubu::complete_header<tsubu::newton_on>(top, whole, tsubu::atom_style::full);
    const auto file_of = [&]<class Newton>(Newton, const std::vector<full_store<>>& parts,
                                           const tsubu::lammps_write_options& options) {
        std::string text;
        tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; }, options, Newton{});
        out.header(top);
        for (const auto section : tsubu::detail::all_sections) {
            out.template head<full_store<>>(section);
            std::uint64_t expected = 0;
            for (const auto& part : parts) expected += decltype(out)::count(section, part);
            CHECK(out.rows(section, std::span<const full_store<>>(parts)) == expected);
        }
        out.flush();
        return text;
    };
    const auto split = [&](auto newton, std::size_t ranks) {
        const auto text = text_of<decltype(newton)>(chain<decltype(newton)>(60, 9), unit_box);
        std::vector<full_store<>> parts(ranks);
        for (std::size_t rank = 0; rank < ranks; ++rank) {
            std::size_t next = 0;
            read_text<decltype(newton)>(text, parts[rank], {}, [&](const vec<3>&) { return next++ % ranks == rank; });
        }
        return parts;
    };
    const auto expected = text_of(whole, unit_box, canonical);
    for (const std::size_t ranks : {1U, 2U, 3U, 7U}) {
        CAPTURE(ranks);
        CHECK(file_of(tsubu::newton_on{}, split(tsubu::newton_on{}, ranks), canonical) == expected);
        CHECK(file_of(tsubu::newton_off{}, split(tsubu::newton_off{}, ranks), canonical) == expected);
    }
    auto with_empty = split(tsubu::newton_on{}, 2);
    with_empty.insert(with_empty.begin() + 1, full_store<>{});
    CHECK(file_of(tsubu::newton_on{}, with_empty, canonical) == expected);
    // Without the option parts follow one another, and row numbers go on.
    const auto plain = file_of(tsubu::newton_on{}, split(tsubu::newton_on{}, 3), {});
    CHECK(plain != expected);
    full_store<> again;
    const auto read = read_text(plain, again);
    CHECK(text_of(again, read, canonical) == expected);
    CHECK(says(rows_in(plain, "Bonds"), "\n59 "));
}

TEST_CASE("row numbers have 64 bits", "[io][lammps_writer][C11]") {
    full_store<> g;
    read_text(full_text, g);
    std::string text;
    tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; });
    const std::uint64_t far = (std::uint64_t{1} << 40) - 1;
    CHECK(out.rows(lammps_section::bond_rows, g, far) == 3);
    out.flush();
    CHECK(text == "1099511627775 2 20 10\n1099511627776 1 20 30\n1099511627777 1 30 40\n");
}

TEST_CASE("terms of type 0 are skipped, negative types lose their sign, doubles stay", "[io][lammps_writer][C5]") {
    constexpr auto lowest = (std::numeric_limits<std::int32_t>::min)();
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::bonds, tsubu::angles>> g;
    for (std::int64_t name = 1; name <= 3; ++name) g.push_back(tsubu::id = name);
    for (const auto& one : {tsubu::term<2>{0, {1, 2}}, tsubu::term<2>{-7, {1, 3}}, tsubu::term<2>{-7, {1, 3}}})
        g[tsubu::bonds][0].push_back(one);
    g[tsubu::angles][1].push_back({-2, {1, 2, 3}});
    const auto text = text_of(g, unit_box);
    CHECK(rows_in(text, "Bonds") == "1 7 1 3\n2 7 1 3\n");
    CHECK(rows_in(text, "Angles") == "1 2 1 2 3\n");
    CHECK(says(text, "2 bonds\n7 bond types\n1 angles\n2 angle types\n"));
    CHECK(says(text, "\nAtoms # angle\n\n1 0 1 0 0 0\n"));
    g[tsubu::bonds][1].push_back({lowest, {2, 3}});
    CHECK(says(thrown<input_error>([&] { text_of(g, unit_box); }), "a term of type 2147483648"));
}

TEST_CASE("ghosts are not written", "[io][lammps_writer]") {
    full_store<> g;
    const auto top = read_text(full_text, g);
    const auto before = text_of(g, top);
    const auto ghost = static_cast<std::size_t>(g.push_back_ghost(tsubu::id = 20, tsubu::species = 9));
    g[tsubu::bonds][ghost].push_back({1, {20, 30}});
    CHECK(text_of(g, top) == before);
}

TEST_CASE("the style follows from the fields, or from the option", "[io][lammps_writer]") {
    using tsubu::fields;
    using tsubu::id;
    using tsubu::position;
    const auto style_of = [](auto store) {
        store.push_back(id = 1);
        const auto text = text_of(store, unit_box);
        const auto at = text.find("Atoms # ") + 8;
        return text.substr(at, text.find('\n', at) - at);
    };
    CHECK(style_of(tsubu::particle_store<fields<id, position<3>>>()) == "atomic");
    CHECK(style_of(tsubu::particle_store<fields<id, position<3>, tsubu::molecule>>()) == "bond");
    CHECK(style_of(tsubu::particle_store<fields<id, position<3>, tsubu::bonds>>()) == "bond");
    CHECK(style_of(tsubu::particle_store<fields<id, position<3>, tsubu::impropers>>()) == "molecular");
    tsubu::particle_store<fields<id, position<3>, tsubu::charge>> charged;
    charged.push_back(id = 1, tsubu::charge = -1.0);
    CHECK(says(text_of(charged, unit_box), "Atoms # full\n\n1 0 1 -1 0 0 0\n"));
    CHECK(says(text_of(charged, unit_box, {.style = tsubu::atom_style::molecular}),
               "Atoms # molecular\n\n1 0 1 0 0 0\n"));
    CHECK(says(thrown<input_error>([&] { text_of(charged, unit_box, {.style = tsubu::atom_style::sphere}); }),
               "atom style sphere tells a radius, which the store lacks"));
    tsubu::particle_store<fields<id, position<3>, tsubu::radius>> light;
    light.push_back(id = 1);
    CHECK(says(thrown<input_error>([&] { text_of(light, unit_box); }), "tells a mass or density"));
    CHECK(says(thrown<input_error>([&] { text_of(light, unit_box, {.style = tsubu::atom_style::full}); }),
               "tells a charge"));
}

TEST_CASE("fields that no style has together are refused, unless a style is named", "[io][lammps_writer]") {
    using tsubu::fields;
    using tsubu::id;
    using tsubu::position;
    tsubu::particle_store<fields<id, position<3>, tsubu::radius, tsubu::density, tsubu::angular_velocity<3>,
                                 tsubu::bonds>>
        chained;
    chained.push_back(id = 1, tsubu::radius = 0.5, tsubu::density = 2.0);
    CHECK(says(thrown<input_error>([&] { text_of(chained, unit_box); }),
               "no atom style has radius and bonds; name one in lammps_write_options.style, or write a store without"));
    CHECK(says(text_of(chained, unit_box, {.style = tsubu::atom_style::sphere}), "Atoms # sphere\n\n1 1 1 2 0 0 0\n"));
    CHECK(says(text_of(chained, unit_box, {.style = tsubu::atom_style::bond}), "Atoms # bond\n\n1 0 1 0 0 0\n"));
    tsubu::particle_store<fields<id, position<3>, tsubu::radius, tsubu::mass, tsubu::charge>> charged;
    CHECK(says(thrown<input_error>([&] { text_of(charged, unit_box); }), "no atom style has radius and charge"));
    tsubu::particle_store<fields<id, position<3>, tsubu::angular_velocity<3>, tsubu::molecule>> turning;
    CHECK(says(thrown<input_error>([&] { text_of(turning, unit_box); }),
               "no atom style has angular_velocity and molecule"));
    tsubu::particle_store<fields<id, position<3>, tsubu::angular_velocity<3>>> points;
    points.push_back(id = 1);
    CHECK(says(thrown<input_error>([&] { text_of(points, unit_box); }),
               "atom style sphere tells a radius, which the store lacks; set lammps_write_options.style to another"));
}

TEST_CASE("spheres are written with diameter, density and angular velocity", "[io][lammps_writer]") {
    using grain = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<2>, tsubu::radius, tsubu::density,
                                                      tsubu::velocity<2>, tsubu::angular_velocity<2>, tsubu::image<2>>>;
    grain g;
    g.push_back(tsubu::id = 5, tsubu::radius = 0.15, tsubu::density = 2500.1, tsubu::position<2> = {0.5, 0.25},
                tsubu::velocity<2> = {1, 2}, tsubu::angular_velocity<2> = {3}, tsubu::image<2> = {-1, 2});
    const auto text = text_of(g, {.title = "", .lo = {0, 0, 0}, .hi = {1, 1, 1}, .tilt = vec<3>{0.5, 0, 0.1}});
    CHECK(says(text, "0.5 0 0.1 xy xz yz\n"));
    CHECK(says(text, "Atoms # sphere\n\n5 1 0.3 2500.1 0.5 0.25 0 -1 2 0\n"));
    CHECK(says(text, "Velocities\n\n5 1 2 0 0 0 3\n"));
    CHECK_FALSE(says(text, "Masses"));
    grain h;
    const auto top = read_text(text, h);
    CHECK(text_of(h, top) == text);
    CHECK(says(text_of(g, unit_box, {.images = false}), "5 1 0.3 2500.1 0.5 0.25 0\n"));
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::radius, tsubu::mass>> heavy;
    heavy.push_back(tsubu::id = 1, tsubu::radius = 0.0, tsubu::mass = 3.5);  // a point
    CHECK(says(text_of(heavy, unit_box), "1 1 0 3.5 0 0 0\n"));
}

TEST_CASE("what a file cannot tell is refused", "[io][lammps_writer]") {
    const auto refused = [](auto... given) {
        full_store<> g;
        g.push_back(tsubu::id = 1, tsubu::species = 1, tsubu::mass = 1.0);
        g.push_back(given...);
        return thrown<input_error>([&] { text_of(g, unit_box); });
    };
    constexpr auto infinity = std::numeric_limits<double>::infinity();
    using tsubu::id;
    using tsubu::mass;
    using tsubu::species;
    CHECK(refused(id = 2, species = 1, mass = 1.0) == "nothing was thrown");
    CHECK(says(refused(id = 0, species = 1, mass = 1.0), "the id 0; ids of LAMMPS begin with 1"));
    CHECK(says(refused(id = 2, species = 0, mass = 1.0), "the species 0; types of LAMMPS begin with 1"));
    CHECK(says(refused(id = 2, species = 1, mass = 2.0), "particles of type 1 with masses 1 and 2"));
    CHECK(says(refused(id = 2, species = 1 << 30, mass = 2.0), "do not tell the masses of 1073741824 types"));
    CHECK(says(refused(id = 2, species = 2, mass = 0.0), "a particle of type 2 with the mass 0; masses are"));
    CHECK(says(refused(id = 2, species = 1, mass = 1.0, tsubu::charge = infinity),
               "a value inf of the particle with id 2"));
    CHECK(says(refused(id = 2, species = 1, mass = 1.0, tsubu::velocity<3> = {0, 0, -infinity}), "a value -inf"));
    full_store<> none;
    CHECK(says(thrown<input_error>([&] { text_of(none, {.title = "a\nb", .lo = {0, 0, 0}, .hi = {1, 1, 1}}); }),
               "a title of several lines"));
    CHECK(says(thrown<input_error>([&] { text_of(none, {.title = "", .lo = {0, 0, 0}, .hi = {1, 0, 1}}); }),
               "a box from (0, 0, 0) to (1, 0, 1)"));
    CHECK(says(thrown<input_error>([&] {
                   text_of(none, {.title = "", .lo = {0, 0, 0}, .hi = {1, infinity, 1}});
               }),
               "a box"));
    auto top = unit_box;
    top.atoms.types = 2;
    full_store<> of_one_type;
    for (const std::int64_t k : {1, 2}) of_one_type.push_back(tsubu::id = k, tsubu::species = 2, tsubu::mass = 1.0);
    CHECK(says(thrown<input_error>([&] { text_of(of_one_type, top); }),
               "no particle tells the mass of type 1; give the masses in the header"));
    top.masses = {1, 1};
    top.tilt = vec<3>{0.5, infinity, 0};
    CHECK(says(thrown<input_error>([&] { text_of(none, top); }), "a tilt of (0.5, inf, 0); give finite ones"));
    top.tilt.reset();
    top.masses = {1};
    CHECK(says(thrown<input_error>([&] { text_of(none, top); }), "1 masses of 2 types"));
    top.masses = {1, 0};
    CHECK(says(thrown<input_error>([&] { text_of(none, top); }), "a mass of 0 for type 2"));
}

TEST_CASE("an empty store is a file too", "[io][lammps_writer]") {
    full_store<> none;
    const auto text = text_of(none, unit_box);
    CHECK(text == "unit\n\n0 atoms\n0 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n");
    full_store<> again;
    CHECK(read_text(text, again) == unit_box);
}

TEST_CASE("a buffer gives its text before it is full", "[io][text_sink]") {
    std::vector<std::string> given;
    tsubu::detail::text_buffer out([&](std::string_view part) { given.emplace_back(part); }, 1024);
    out.put(std::string(1022, 'a'));
    out.put("bcd");
    CHECK(given == std::vector<std::string>{std::string(1022, 'a')});
    out.put(std::string(1021, 'e'));
    CHECK(given.size() == 1);
    out.put(std::string(2000, 'f'));  // longer than the buffer: as it is
    REQUIRE(given.size() == 3);
    CHECK(given[1] == "bcd" + std::string(1021, 'e'));
    CHECK(given[2] == std::string(2000, 'f'));
    out.put('g');
    out.flush();
    CHECK(given.back() == "g");
}

TEST_CASE("chunks of any size give the same text", "[io][lammps_writer]") {
    full_store<> g;
    const auto top = read_text(full_text, g);
    const auto expected = text_of(g, top);
    for (const std::size_t chunk : {1U, 1024U, 1025U, 1100U}) {
        std::string text;
        std::size_t longest = 0;
        tsubu::lammps_writer out(
            [&](std::string_view part) {
                text += part;
                longest = (std::max)(longest, part.size());
            },
            {.chunk = chunk});
        out.write(g, top);
        CHECK(text == expected);
        CHECK(longest <= (std::max)(chunk, std::size_t{1024}));
    }
}

TEST_CASE("what LAMMPS cannot read back is not written", "[io][lammps_writer]") {
    lammps_header top{.title = "", .lo = {0, 0, 0}, .hi = {1, 1, 1}};
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::bonds>> g;
    g.push_back(tsubu::id = 1, tsubu::species = 1);
    g[tsubu::bonds][0].push_back({1, {1, 0}});
    CHECK(says(thrown<tsubu::input_error>([&] { text_of(g, top); }), "a term of particle 0"));

    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::mass>> h;
    for (const double weight : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
        h.clear();
        h.push_back(tsubu::id = 1, tsubu::species = 1, tsubu::mass = weight);
        h.push_back(tsubu::id = 2, tsubu::species = 1, tsubu::mass = 5);
        CHECK(says(thrown<tsubu::input_error>([&] { text_of(h, top); }), "with the mass"));
    }
}

TEST_CASE("one dimension is along x, one rotation about z", "[io][lammps_writer]") {
    lammps_header top{.title = "", .lo = {0, 0, 0}, .hi = {9, 1, 1}};
    using line = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<1>, tsubu::velocity<1>,
                                                     tsubu::image<1>>>;
    line g;
    g.push_back(tsubu::id = 1, tsubu::species = 1, tsubu::position<1> = {3.5}, tsubu::velocity<1> = {-2},
                tsubu::image<1> = {5});
    const auto text = text_of(g, top);
    CHECK(says(text, "1 1 3.5 0 0 5 0 0"));
    CHECK(says(text, "1 -2 0 0"));
    line again;
    read_text(text, again);
    CHECK(again[tsubu::position<1>][0] == g[tsubu::position<1>][0]);
    CHECK(again[tsubu::velocity<1>][0] == g[tsubu::velocity<1>][0]);
    CHECK(again[tsubu::image<1>][0] == g[tsubu::image<1>][0]);
}
