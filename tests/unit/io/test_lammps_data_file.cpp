// SPDX-License-Identifier: MIT
#include <tsubu/io/lammps_data_file.hpp>

#include "support/catch.hpp"
#include "unit/io/lammps_examples.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <array>
#include <limits>
#include <string>

TEST_CASE("a file is written and read in one call each", "[io][lammps_data_file]") {
    const scratch_folder folder;
    const auto path = folder / "full.lmp";
    full_store<> g;
    const auto top = read_text<tsubu::newton_off>(full_text, g);
    tsubu::write_lammps<tsubu::newton_off>(path, g, top);
    const auto written = bytes_of(path);
    CHECK(written == text_of<tsubu::newton_off>(g, top));
    full_store<> h;
    CHECK(tsubu::read_lammps<tsubu::newton_off>(path, h) == top);
    CHECK(text_of<tsubu::newton_off>(h, top) == written);

    g[tsubu::charge][3] = std::numeric_limits<double>::infinity();
    CHECK(says(thrown<tsubu::input_error>([&] { tsubu::write_lammps(path, g, top); }), "a value inf"));
    CHECK(bytes_of(path) == written);  // as it was
    CHECK(folder.files() == 1);
    full_store<> none;
    const auto nowhere = folder / "nowhere.lmp";
    CHECK(says(thrown<tsubu::file_error>([&] { tsubu::read_lammps(nowhere, none); }), nowhere + ": No such file"));
}

TEST_CASE("a file is read in pieces far smaller than it is", "[io][lammps_data_file]") {
    const scratch_folder folder;
    const auto path = folder / "many.lmp";
    atomic_store g;
    for (std::int64_t name = 1; name <= 20000; ++name)
        g.push_back(tsubu::id = name, tsubu::species = 1,
                    tsubu::position<3> = {1.0 / static_cast<double>(name), 0.5, 0.5});
    tsubu::write_lammps(path, g, {.title = "many", .lo = {0, 0, 0}, .hi = {1, 1, 1}}, {.chunk = 1024});
    atomic_store h;
    tsubu::read_lammps(path, h, {.chunk = 100});
    REQUIRE(h.size() == g.size());
    bool same = true;
    for (std::size_t i = 0; i < g.size(); ++i)
        same = same && h[tsubu::id][i] == g[tsubu::id][i] && h[tsubu::position<3>][i] == g[tsubu::position<3>][i];
    CHECK(same);
}

TEST_CASE("any text is read or refused", "[io][lammps_data_file][fuzz]") {
    // Every prefix of a file, and every file with one character changed, ends in a store or in an input_error.
    for (std::size_t length = 0; length < full_text.size(); ++length) {
        full_store<> g;
        const auto message = thrown<tsubu::input_error>([&] { read_text(full_text.substr(0, length), g); });
        // Without its last characters the last number is another one, but a number.
        CHECK((message != "nothing was thrown" || length + 2 > full_text.size()));
        for (const char c : {'\n', ' ', '#', '-', '9', 'e', '\0', '\xff'}) {
            auto text = full_text;
            text[length] = c;
            full_store<> h;
            static_cast<void>(thrown<tsubu::input_error>([&] {
                read_text(text, h, {.unknown = tsubu::unknown_lines::skip, .allows_repeats = true, .chunk = 64});
            }));
        }
    }
}
