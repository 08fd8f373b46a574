// SPDX-License-Identifier: MIT
#include <tsubu/io/lammps_reader.hpp>

#include "support/catch.hpp"
#include "unit/io/lammps_examples.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using tsubu::input_error;
using tsubu::vec;

namespace {

/// What the reader says of a text.
template <class Store = full_store<>>
std::string refusal(const std::string& text, const tsubu::lammps_read_options& options = {}) {
    Store store;
    const auto message = thrown<input_error>([&] { read_text(text, store, options); });
    CHECK(store.size() == 0);
    return message;
}
std::string refusal_with(std::string_view part, std::string_view replacement) {
    return refusal(with(full_text, part, replacement));
}

const std::string atomic_text =
    "\n1 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms # atomic\n\n1 1 0.5 0.5 0.5\n";
/// Of n particles and some bonds.
std::string heading(std::int64_t n, std::int64_t bonds = 0) {
    return "many\n\n" + std::to_string(n) + " atoms\n1 atom types\n" + std::to_string(bonds) +
           " bonds\n1 bond types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n";
}
using moving_store = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>>>;

const std::string sphere_text =
    "grains\n\n2 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n0.5 0 0.25 xy xz yz\n\n"
    "Atoms # sphere\n\n7 1 0.5 2500 0.1 0.2 0.3\n9 1 0 3 0.4 0.5 0.6\n\n"
    "Velocities\n\n9 1 2 3 4 5 6\n7 -1 -2 -3 -4 -5 -6\n";

}  // namespace

TEMPLATE_TEST_CASE("a file of style full is read whole, into any layout", "[io][lammps_reader][C3]", tsubu::soa,
                   tsubu::aos, tsubu::aosoa<8>) {
    full_store<TestType> g;
    const auto top = read_text(full_text, g);
    CHECK(top.title == "four of a kind");
    CHECK(top.atoms == tsubu::lammps_count{4, 2});
    CHECK(top.impropers == tsubu::lammps_count{1, 3});
    CHECK(top.lo == vec<3>{0, -1, 0});
    CHECK(top.hi == vec<3>{10, 1, 2.5});
    CHECK_FALSE(top.tilt.has_value());
    CHECK(top.masses == std::vector<double>{1.008, 16});
    REQUIRE(g.owned_count() == 4);
    const std::vector<std::int64_t> names{20, 10, 40, 30};
    CHECK(std::equal(names.begin(), names.end(), g[tsubu::id].begin()));
    CHECK(g[tsubu::species][0] == 2);
    CHECK(g[tsubu::mass][0] == 16);
    CHECK(g[tsubu::mass][1] == 1.008);
    CHECK(g[tsubu::molecule][2] == 2);
    CHECK(g[tsubu::charge][0] == -0.5);
    CHECK(g[tsubu::position<3>][2] == vec<3>{9, -0.5, 1});
    CHECK(g[tsubu::image<3>][1] == vec<3, std::int64_t>{0, -1, 0});
    CHECK(g[tsubu::velocity<3>][0] == vec<3>{2, 0, 0});
    CHECK(g[tsubu::velocity<3>][3] == vec<3>{3, 0, -0.125});
    REQUIRE(g[tsubu::bonds][0].size() == 2);
    CHECK(g[tsubu::bonds][0][0] == tsubu::term<2>{2, {20, 10}});
    CHECK(g[tsubu::bonds][0][1] == tsubu::term<2>{1, {20, 30}});
    CHECK(g[tsubu::bonds][1].empty());
    CHECK(g[tsubu::bonds][3].size() == 1);
    CHECK(g[tsubu::angles][0][0] == tsubu::term<3>{1, {10, 20, 30}});
    CHECK(g[tsubu::angles][3][0] == tsubu::term<3>{1, {20, 30, 40}});
    CHECK(g[tsubu::dihedrals][0][0] == tsubu::term<4>{1, {10, 20, 30, 40}});
    CHECK(g[tsubu::impropers][1][0] == tsubu::term<4>{3, {40, 10, 20, 30}});
}

TEST_CASE("with Newton off each particle of a term keeps it", "[io][lammps_reader][C5]") {
    full_store<> g;
    read_text<tsubu::newton_off>(full_text, g);
    CHECK(g[tsubu::bonds][0].size() == 2);
    CHECK(g[tsubu::bonds][1].size() == 1);
    CHECK(g[tsubu::bonds][2].size() == 1);
    CHECK(g[tsubu::bonds][3].size() == 2);
    for (std::size_t i = 0; i < 4; ++i) CHECK(g[tsubu::dihedrals][i].size() == 1);
    CHECK(g[tsubu::angles][2].size() == 1);
}

TEST_CASE("a sphere has a radius, a mass and an angular velocity", "[io][lammps_reader]") {
    using set = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::radius, tsubu::mass, tsubu::density,
                              tsubu::velocity<3>, tsubu::angular_velocity<3>>;
    tsubu::particle_store<set> g;
    const auto top = read_text(sphere_text, g);
    CHECK(top.tilt == vec<3>{0.5, 0, 0.25});
    CHECK(g[tsubu::radius][0] == 0.25);
    CHECK(g[tsubu::density][0] == 2500);
    CHECK(g[tsubu::mass][0] == Approx(2500 * 4.0 / 3 * 3.14159265358979 * 0.25 * 0.25 * 0.25).epsilon(1e-12));
    CHECK(g[tsubu::mass][1] == 3);  // a point: its density is its mass
    CHECK(g[tsubu::velocity<3>][0] == vec<3>{-1, -2, -3});
    CHECK(g[tsubu::angular_velocity<3>][0] == vec<3>{-4, -5, -6});
    CHECK(g[tsubu::angular_velocity<3>][1] == vec<3>{4, 5, 6});
    CHECK(says(thrown<input_error>([&] { static_cast<void>(top.box({})); }), "use tilted_box()"));
    CHECK(top.tilted_box({true, true, true}).edge(1) == vec<3>{0.5, 1, 0});
}

TEST_CASE("a plane takes x and y, and the rotation about z", "[io][lammps_reader]") {
    using set = tsubu::fields<tsubu::id, tsubu::position<2, float>, tsubu::velocity<2>, tsubu::angular_velocity<2>>;
    tsubu::particle_store<set> g;
    read_text(sphere_text, g);
    CHECK(g[tsubu::position<2, float>][1] == vec<2, float>{0.4F, 0.5F});
    CHECK(g[tsubu::velocity<2>][1] == vec<2>{1, 2});
    CHECK(g[tsubu::angular_velocity<2>][1] == vec<1>{6});
}

TEST_CASE("fields that the store has not are checked, and not kept", "[io][lammps_reader]") {
    atomic_store g;
    read_text(full_text, g);
    CHECK(g.owned_count() == 4);
    CHECK(says(refusal<atomic_store>(with(full_text, "10 1 0 0", "10 1 0 x")), "a velocity \"x\" is no finite number"));
    CHECK(says(refusal<atomic_store>(with(full_text, "3 1 30 40", "3 1 30 41")), "no particle has the id 41"));
}

TEST_CASE("fields that the file has not are an error", "[io][lammps_reader]") {
    using tsubu::fields;
    using tsubu::id;
    const auto lacks = [](const std::string& message, const char* field) {
        return says(message,
                    "line 8 \"Atoms # atomic\": atom style atomic has no " + std::string(field) + ", which the store");
    };
    CHECK(lacks(refusal<tsubu::particle_store<fields<id, tsubu::radius>>>(atomic_text), "radius"));
    CHECK(lacks(refusal<tsubu::particle_store<fields<id, tsubu::density>>>(atomic_text), "density"));
    CHECK(lacks(refusal<tsubu::particle_store<fields<id, tsubu::charge>>>(atomic_text), "charge"));
    CHECK(lacks(refusal<tsubu::particle_store<fields<id, tsubu::molecule>>>(atomic_text), "molecule"));
    CHECK(
        lacks(refusal<tsubu::particle_store<fields<id, tsubu::angular_velocity<3>>>>(atomic_text), "angular_velocity"));
    CHECK(says(refusal<tsubu::particle_store<fields<id, tsubu::mass>>>(atomic_text), "there is no section Masses"));
    using moving = tsubu::particle_store<fields<id, tsubu::velocity<3>>>;
    CHECK(says(refusal<moving>(atomic_text), "there is no section Velocities, but the store has them"));
    moving g;
    read_text(atomic_text, g, {.velocities_may_lack = true});
    CHECK(g[tsubu::velocity<3>][0] == vec<3>{});
}

TEST_CASE("a file may have comments, blank lines, CRLF, tabs and no last newline", "[io][lammps_reader]") {
    full_store<> plain;
    read_text(full_text, plain);
    std::string crlf;
    for (const char c : full_text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::string busy;
    for (const char c : full_text)
        busy += c == '\n' ? std::string("  \t# a remark\n\n \n") : std::string(1, c == ' ' ? '\t' : c);
    busy = with(busy, "Atoms\t#\tfull  \t# a remark", "Atoms # full");
    auto cut = full_text;
    cut.pop_back();
    for (const auto& text : {crlf, busy, cut})
        for (const std::size_t chunk : {std::size_t{64}, std::size_t{65}, std::size_t{1} << 20}) {
            full_store<> g;
            const auto top = read_text(text, g, {.chunk = chunk});
            CHECK(text_of(g, {.lo = top.lo, .hi = top.hi}) == text_of(plain, {.lo = top.lo, .hi = top.hi}));
        }
}

TEST_CASE("errors name file, line, text and reason", "[io][lammps_reader]") {
    CHECK(refusal_with("10 1 1 0.25 0.1", "10 1 1 0.25 nan") ==
          "tsubu::lammps_reader: some.lmp, line 26 \"10 1 1 0.25 nan 0 0 0 -1 0\": a coordinate \"nan\" is no finite "
          "number; "
          "write it like 1, -2.5 or 3e-7");
    CHECK(says(refusal_with("\n10 1 1 0.25 0.1", "\n10 1 1 0.25 1e400"),
               "a coordinate \"1e400\" is beyond what 64 bits hold"));
    CHECK(says(refusal_with("\n10 1 1", "\n10.5 1 1"), "the id \"10.5\" is no integer"));
    CHECK(says(refusal_with("\n10 1 1", "\n1e1 1 1"), "the id \"1e1\" is no integer"));
    CHECK(says(refusal_with("\n10 1 1", "\n+10 1 1"), "the id \"+10\" is no integer"));
    CHECK(says(refusal_with("\n10 1 1", "\n0x10 1 1"), "the id \"0x10\" is no integer"));
    CHECK(says(refusal_with("\n10 1 1", "\n9223372036854775808 1 1"), "is beyond what 64 bits hold"));
    CHECK(says(refusal_with("\n10 1 1", "\n0 1 1"), "the id 0; it begins with 1"));
    CHECK(says(refusal_with("\n10 1 1", "\n-3 1 1"), "the id -3; it begins with 1"));
    CHECK(says(refusal_with("\n10 1 1", "\n10 1 3"), "type 3, but the header has 2 atom types"));
    CHECK(says(refusal_with("\n10 1 1", "\n10 1 0"), "the type 0"));
    CHECK(
        says(refusal_with("\n10 1 1", "\n20 1 1"),
             "some.lmp, line 26 \"20 1 1 0.25 0.1 0 0 0 -1 0\": a second particle with the id 20, which line 25 has"));
    CHECK(says(refusal_with("0 -1 0\n", "0 -1\n"), "an image flag is missing"));
    CHECK(says(refusal_with("0 -1 0\n", "0 -1 0 0\n"), "\"0\" follows the last column"));
    CHECK(says(refusal_with("0.1 0 0 0 -1 0\n", "0.1 0 0\n"),
               "the first row of Atoms has 10 columns, this one 7; give image flags in all rows or in none"));
    CHECK(says(refusal_with("1 0.5 2 0 0 1\n", "1 0.5 2\n"),
               "line 26 \"10 1 1 0.25 0.1 0 0 0 -1 0\": the first row of Atoms has 7 columns, this one 10"));
    CHECK(says(refusal_with("1 0.5 2 0 0 1\n", "1 0.5 2 0\n"), "line 25 \"20 1 2 -0.5 1 0.5 2 0\": \"0\" follows"));
    CHECK(says(refusal_with("0 -1 0\n", "0 -1.5 0\n"), "an image flag \"-1.5\" is no integer"));
    CHECK(says(refusal_with("0 -1 0\n", "0 -1 0\n10 1 1 0.25 0.1 0 0 0 -1 0\n"),
               "row 5 of Atoms, but the header says 4"));
    CHECK(says(refusal_with("10 1 1 0.25 0.1 0 0 0 -1 0\n", ""),
               "line 29 \"Velocities\": Atoms ends after 3 rows, but the header says 4"));
    CHECK(says(refusal_with("Atoms # full", "Atoms # charge"), "this is no atom style that tsubu reads"));
    CHECK(says(refusal_with("Atoms # full", "Atoms"), "the atom style is not told"));
    CHECK(says(refusal(full_text, {.style = tsubu::atom_style::atomic}), "this is not atom style atomic"));
    CHECK(says(refusal(with(full_text, "Atoms # full", "Atoms"), {.style = tsubu::atom_style::molecular}),
               "has no charge"));
    CHECK(says(refusal_with("Atoms # full", "Atoms\x01 # full"), "\"Atoms? # full\": this is no section"));
}

TEST_CASE("errors show at most 80 characters of a line", "[io][lammps_reader]") {
    const auto message = refusal_with("10 1 1 0.25 0.1", "10 1 1 0.25 nan" + std::string(200, ' '));
    CHECK(says(message, "\"10 1 1 0.25 nan" + std::string(65, ' ') + "...\""));
}

TEST_CASE("velocities are found by id, each exactly once", "[io][lammps_reader][C3]") {
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n11 1 0 0\n"), "line 33 \"11 1 0 0\": no particle has the id 11"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n0 1 0 0\n"), "the id 0"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n-3 1 0 0\n"), "the id -3"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n41 1 0 0\n"), "no particle has the id 41"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n9223372036854775807 1 0 0\n"),
               "no particle has the id 9223372036854775807"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n40 1 0 0\n"), "a second velocity of id 40"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n10 1 0 0 7\n"), "\"7\" follows the last column"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n10 1 0 inf\n"), "a velocity \"inf\" is no finite number"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n"), "Velocities ends after 3 rows, but the header says 4"));
    CHECK(says(refusal_with("\n10 1 0 0\n", "\n10 1 0 0\n10 1 0 0\n"), "a second velocity of id 10"));
    CHECK(says(refusal_with("\n30 3 0 -0.125\n", "\n30 3 0 -0.125\n30 3 0 0\n"), "row 5 of Velocities"));
}

TEST_CASE("velocities come in any order", "[io][lammps_reader][C3]") {
    constexpr std::int64_t n = 3000;
    const auto head = heading(n);
    std::string atoms = "\nAtoms # atomic\n\n";
    for (std::int64_t k = 0; k < n; ++k) atoms += std::to_string(7 * k + 1) + " 1 0 0 0\n";
    std::vector<std::int64_t> order(static_cast<std::size_t>(n));
    for (std::int64_t k = 0; k < n; ++k) order[static_cast<std::size_t>(k)] = k;
    tsubu::random_stream random(5);
    const auto shuffle = [&](std::size_t first, std::size_t last) {
        for (auto k = last; k > first + 1; --k) std::swap(order[k - 1], order[first + random.below(k - first)]);
    };
    const auto check = [&] {
        std::string rows = "\nVelocities\n\n";
        for (const auto k : order) rows += std::to_string(7 * k + 1) + " " + std::to_string(k) + " 0.5 0\n";
        const auto text = head + atoms + rows;
        moving_store g;
        read_text(text, g);
        bool right = g.size() == static_cast<std::size_t>(n);
        for (std::size_t i = 0; right && i < g.size(); ++i)
            right = g[tsubu::velocity<3>][i] == vec<3>{static_cast<double>(i), 0.5, 0};
        CHECK(right);
        moving_store part;  // what others keep is passed over
        read_text(text, part, {}, [next = 0](const vec<3>&) mutable { return next++ % 3 == 1; });
        right = part.size() == static_cast<std::size_t>(n / 3);
        for (std::size_t i = 0; right && i < part.size(); ++i)
            right = part[tsubu::velocity<3>][i] == vec<3>{static_cast<double>(3 * i + 1), 0.5, 0};
        CHECK(right);
        return text;
    };
    check();
    std::reverse(order.begin(), order.end());
    check();
    std::reverse(order.begin(), order.end());
    shuffle(1000, 1100);  // in the order of Atoms, but for a stretch
    check();
    shuffle(0, order.size());
    const auto text = check();

    // Of some thousand rows the first one that is wrong is told, with its line.
    const auto line_of = [&](std::size_t at) {
        return 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
    };
    const auto section = text.find("Velocities\n\n") + 12;
    const auto refused = [&](const std::string& changed) {
        moving_store g;
        auto message = thrown<input_error>([&] { read_text(changed, g); });
        CHECK(g.size() == 0);
        return message;
    };
    for (const std::int64_t k : {order[0], order[511], order[512], order[1500], order.back()}) {
        const auto row = std::to_string(7 * k + 1) + " " + std::to_string(k) + " 0.5 0";
        const auto at = text.find("\n" + row + "\n", section - 1) + 1;
        const auto where = "some.lmp, line " + std::to_string(line_of(at)) + " \"";
        auto unknown = text;
        unknown.replace(at, row.size(), "5 1 2 3");
        CHECK(says(refused(unknown), where + "5 1 2 3\": no particle has the id 5"));
        const auto last = unknown.rfind(" 0.5 0");
        if (at < last - 40) {  // of two faults the first one, though it is found later
            auto two = unknown;
            two.replace(last, 6, " 0.5 x");
            CHECK(says(refused(two), where + "5 1 2 3\": no particle has the id 5"));
        }
        auto missing = text;
        missing.erase(at, row.size() + 1);
        CHECK(says(refused(missing), "Velocities ends after 2999 rows, but the header says 3000"));
        if (k == order[0]) continue;
        const auto again = std::to_string(7 * order[0] + 1) + " 0 0 0";
        auto repeated = text;
        repeated.replace(at, row.size(), again);
        CHECK(
            says(refused(repeated), where + again + "\": a second velocity of id " + std::to_string(7 * order[0] + 1)));
    }
}

TEST_CASE("a file is read alike, whatever its pieces are", "[io][lammps_reader][C3]") {
    constexpr std::int64_t n = 1500;
    const auto name = [](std::int64_t k) { return std::to_string(1 + 37 * k % n); };  // in another order
    auto text = heading(n, n - 1) + "\nAtoms # full\n\n";
    for (std::int64_t k = 0; k < n; ++k) text += name(k) + " 2 1 0.25 " + std::to_string(k) + ".125 -1e-3 0 1 0 -1\n";
    text += "\nVelocities\n\n";
    for (std::int64_t k = n; k-- > 0;) text += name(k) + " " + std::to_string(k) + " 0.1 -7\n";
    text += "\nBonds\n\n";
    for (std::int64_t k = 1; k < n; ++k)
        text += std::to_string(k) + " 1 " + std::to_string(k) + " " + std::to_string(k + 1) + "\n";
    using bonded = tsubu::particle_store<
        tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::charge, tsubu::image<3>, tsubu::bonds>>;
    bonded whole;
    const auto top = read_text(text, whole);
    const auto expected = text_of(whole, top);
    REQUIRE(whole.size() == static_cast<std::size_t>(n));
    CHECK(tsubu::topology<tsubu::bonds, tsubu::newton_on>::count(whole) == n - 1);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const auto known = std::int64_t(1 + 37 * std::int64_t(i) % n);
        CHECK(whole[tsubu::velocity<3>][i][0] == static_cast<double>(i));
        REQUIRE(whole[tsubu::bonds][i].size() == (known == n ? 0U : 1U));
        if (known != n) CHECK(whole[tsubu::bonds][i][0] == tsubu::term<2>{1, {known, known + 1}});
    }
    for (const std::size_t chunk : {1U, 7U, 64U, 4096U}) {
        CAPTURE(chunk);
        bonded g;
        CHECK(read_text(text, g, {.chunk = chunk}) == top);
        CHECK(text_of(g, top) == expected);
        bonded none;  // and faults are told alike
        const auto wrong = with(text, "\n1200 1 1200 1201\n", "\n1200 1 1200 9999\n");
        CHECK(says(thrown<input_error>([&] { read_text(wrong, none, {.chunk = chunk}); }),
                   "some.lmp, line " +
                       std::to_string(1 + std::count(wrong.begin(),
                                                     wrong.begin() + std::ptrdiff_t(wrong.find("1200 1 1200")), '\n')) +
                       " \"1200 1 1200 9999\": no particle has the id 9999"));
    }
}

TEST_CASE("terms are checked", "[io][lammps_reader]") {
    CHECK(says(refusal_with("3 1 30 40\n", "3 1 30 30\n"), "the id 30 twice in a term"));
    CHECK(says(refusal_with("2 1 20 30 40\n", "2 1 40 30 40\n"), "the id 40 twice in a term"));
    CHECK(says(refusal_with("3 1 30 40\n", "3 3 30 40\n"), "type 3, but the header has 2 of this kind"));
    CHECK(says(refusal_with("3 1 30 40\n", "3 1 30 8.5\n"), "the id \"8.5\" is no integer"));
    CHECK(says(refusal_with("3 1 30 40\n", "3 1 30 50\n"), "no particle has the id 50"));
    CHECK(says(refusal_with("3 1 30 40\n", "3 1 30\n"), "the id is missing"));
    CHECK(says(refusal_with("3 1 30 40\n", "3 1 30 40 10\n"), "\"10\" follows the last column"));
    CHECK(says(refusal_with("3 1 30 40\n", ""), "Bonds ends after 2 rows, but the header says 3"));
    CHECK(says(refusal_with("Impropers\n\n1 3 40 10 20 30\n", ""), "1 impropers, but there is no section Impropers"));
    full_store<> g;
    read_text(with(full_text, "3 1 30 40\n", "3 1 30 30\n"), g, {.allows_repeats = true});
    CHECK(g[tsubu::bonds][3][0] == tsubu::term<2>{1, {30, 30}});
}

TEST_CASE("masses are checked", "[io][lammps_reader]") {
    CHECK(says(refusal_with("1 1.008", "2 1.008"), "a second mass of type 2"));
    CHECK(says(refusal_with("1 1.008", "3 1.008"), "type 3, but the header has 2 atom types"));
    CHECK(says(refusal_with("1 1.008", "1 0"), "a mass that is not above 0"));
    CHECK(says(refusal_with("1 1.008", "1 1.008 2"), "\"2\" follows the last column"));
    CHECK(says(refusal_with("1 1.008\n", ""), "Masses ends after 1 rows, but the header says 2"));
}

TEST_CASE("the header is checked", "[io][lammps_reader]") {
    CHECK(says(refusal(""), "some.lmp, line 0 \"\": the file is empty"));
    CHECK(says(refusal("only a title"), "has no line \"xlo xhi\""));
    CHECK(says(refusal_with("0 10 xlo xhi", "10 0 xlo xhi"), "the faces are not in order"));
    CHECK(says(refusal_with("0 10 xlo xhi", "0 0 xlo xhi"), "the faces are not in order"));
    CHECK(says(refusal_with("0 10 xlo xhi", "0 1e999 xlo xhi"), "the upper face \"1e999\" is beyond"));
    CHECK(says(refusal_with("0 10 xlo xhi", "0 xlo xhi"), "the upper face \"xlo\" is no finite number"));
    CHECK(says(refusal_with("0 10 xlo xhi", "0 1 2 xlo xhi"), "\"2 xlo xhi\" where \"xlo xhi\" was expected"));
    CHECK(says(refusal_with("0 10 xlo xhi\n", ""), "has no line \"xlo xhi\""));
    CHECK(says(refusal_with("4 atoms", "4.0 atoms"), "a number of rows \"4.0\" is no integer"));
    CHECK(says(refusal_with("4 atoms", "-4 atoms"), "a number of rows -4; it begins with 0"));
    CHECK(says(refusal_with("2 atom types", "3000000000 atom types"), "is beyond what 32 bits hold"));
    CHECK(says(refusal_with("4 atoms", "4 atoms\n4 atoms"), "a second line of this kind"));
    CHECK(says(refusal_with("4 atoms", "4 ellipsoids"), "\"4 ellipsoids\": this is no line of a header"));
    CHECK(says(refusal_with("4 atoms", "4"), "this is no line of a header"));
    CHECK(says(refusal_with("4 atoms", "9000000000000000000 atoms"), "Atoms ends after 4 rows"));
    full_store<> g;
    CHECK(read_text(with(full_text, "4 atoms", "4   atoms\n2 extra bond per atom"), g).atoms.rows == 4);
}

TEST_CASE("unknown sections are refused, or skipped on request", "[io][lammps_reader]") {
    const auto text = with(with(full_text, "Bonds\n", "Pair Coeffs # lj/cut\n\n1 0.5 1\n2 0.5 1\n\nBonds\n"), "4 atoms",
                           "4 atoms\n7 crossterms");
    CHECK(says(refusal(with(full_text, "Bonds\n", "Pair Coeffs # lj/cut\n\n1 0.5 1\n\nBonds\n")),
               "line 37 \"Pair Coeffs # lj/cut\": this is no section that tsubu reads"));
    full_store<> g;
    tsubu::lammps_reader<tsubu::memory_source> file(tsubu::memory_source(text),
                                                    {.unknown = tsubu::unknown_lines::skip});
    file.read(g);
    CHECK(file.skipped() == std::vector<std::string>{"Pair Coeffs"});
    CHECK(file.style() == tsubu::atom_style::full);
    CHECK(g[tsubu::bonds][0].size() == 2);
}

TEST_CASE("what is read of a title can be written", "[io][lammps_reader]") {
    full_store<> g;
    const auto top = read_text(with(full_text, "four of a kind", " four\rof a\tkind \r"), g);
    CHECK(top.title == "four of a\tkind");
    CHECK(text_of(g, top).starts_with("four of a\tkind\n"));
}

TEST_CASE("sections come once, and Atoms first", "[io][lammps_reader]") {
    CHECK(says(refusal(full_text + "\nMasses\n\n1 1\n2 1\n"), "\"Masses\": a second section Masses"));
    CHECK(says(refusal_with("Masses\n", "Bonds\n\n1 1 10 20\n\nMasses\n"), "\"Bonds\": Bonds before Atoms"));
    const auto atoms_at = full_text.find("Atoms # full");
    CHECK(says(refusal(full_text.substr(0, atoms_at)), "the header says 4 atoms, but there is no section Atoms"));
}

TEST_CASE("a reader reads once, into an empty store", "[io][lammps_reader]") {
    atomic_store g;
    tsubu::lammps_reader<tsubu::memory_source> file(tsubu::memory_source(full_text), {});
    file.read(g);
    CHECK(says(thrown<input_error>([&] { file.read(g); }), "the store has 4 particles; read into an empty one"));
    atomic_store other;
    CHECK(says(thrown<input_error>([&] { file.read(other); }), "memory was read before"));
}

TEST_CASE("numbers that a narrow field does not hold are refused", "[io][lammps_reader]") {
    static constexpr tsubu::field<"id", std::int32_t> narrow_id{};
    static constexpr tsubu::field<"charge", float> narrow_charge{};
    using narrow = tsubu::particle_store<tsubu::fields<narrow_id, narrow_charge, tsubu::position<3, float>>>;
    narrow g;
    read_text(full_text, g);
    CHECK(g[narrow_id][0] == 20);
    CHECK(g[narrow_charge][0] == -0.5F);
    CHECK(says(refusal<narrow>(with(full_text, "20 1 2", "3000000000 1 2")), "the id does not fit the field"));
    CHECK(says(refusal<narrow>(with(full_text, "20 1 2 -0.5", "20 1 2 -1e200")), "the charge does not fit the field"));
    CHECK(
        says(refusal<narrow>(with(full_text, "20 1 2 -0.5 1 ", "20 1 2 -0.5 1e200 ")), "is beyond what 32 bits hold"));
}

TEST_CASE("each rank keeps its part, and all ranks together everything", "[io][lammps_reader]") {
    full_store<> whole;
    const auto top = read_text(full_text, whole);
    const auto box = top.box({true, false, false});
    for (const tsubu::rank_t ranks : {1U, 2U, 4U}) {
        const tsubu::brick_decomposition bricks(box, {ranks, 1, 1});
        std::vector<std::int64_t> seen;
        std::uint64_t bonds_kept = 0;
        std::uint64_t angles_kept = 0;
        std::uint64_t halves_kept = 0;
        for (tsubu::rank_t rank = 0; rank < ranks; ++rank) {
            const auto mine = bricks.subdomain(rank);
            full_store<> part;
            const auto keep = [&](const vec<3>& x) { return mine.owns_extended(x); };
            read_text(full_text, part, {}, keep);
            for (std::size_t i = 0; i < part.size(); ++i) {
                seen.push_back(part[tsubu::id][i]);
                CHECK(part[tsubu::velocity<3>][i][0] == static_cast<double>(part[tsubu::id][i]) / 10);
            }
            bonds_kept += tsubu::topology<tsubu::bonds, tsubu::newton_on>::count(part);
            angles_kept += tsubu::topology<tsubu::angles, tsubu::newton_on>::count(part);
            full_store<> half;
            read_text<tsubu::newton_off>(full_text, half, {}, keep);
            halves_kept += tsubu::topology<tsubu::bonds, tsubu::newton_off>::count(half);
        }
        std::sort(seen.begin(), seen.end());
        CHECK(seen == std::vector<std::int64_t>{10, 20, 30, 40});
        CHECK(bonds_kept == 3);
        CHECK(angles_kept == 2);
        CHECK(halves_kept == 3);
    }
    full_store<> none;
    read_text(full_text, none, {}, [](const vec<3>&) { return false; });
    CHECK(none.size() == 0);
}

TEST_CASE("a rank that keeps a part misses velocities of its own, and repeated ones", "[io][lammps_reader]") {
    const auto low = [](const vec<3>& x) { return x[0] < 2; };  // ids 20 and 10
    const auto refused = [&](const std::string& text) {
        full_store<> g;
        return thrown<input_error>([&] { read_text(text, g, {}, low); });
    };
    CHECK(refused(full_text) == "nothing was thrown");
    CHECK(says(refused(with(full_text, "\n10 1 0 0\n", "\n77 1 0 0\n")), "which end here, have none of id 10"));
    CHECK(says(refused(with(full_text, "\n10 1 0 0\n", "\n20 1 0 0\n")), "a second velocity of id 20"));
    CHECK(says(refused(with(full_text, "\n10 1 1 0.25", "\n20 1 1 0.25")),
               "line 26 \"20 1 1 0.25 0.1 0 0 0 -1 0\": a second particle"));
    CHECK(
        says(refused(with(full_text, "\n40 4 0 0\n", "\n40 4 0 x\n")), "is no finite number"));  // checked, kept or not
}
