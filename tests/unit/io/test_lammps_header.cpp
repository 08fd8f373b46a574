// SPDX-License-Identifier: MIT
#include <tsubu/io/lammps_header.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>

#include <cstddef>
#include <optional>

using tsubu::lammps_header;
using tsubu::vec;

TEST_CASE("the header of a box gives the box back", "[io][lammps_header]") {
    const tsubu::domain<3> box({-1, 0.1, 2}, {1, 0.3, 1e9}, {.periodic = {true, false, true}});
    const auto top = lammps_header::of(box, "a box");
    CHECK(top.title == "a box");
    CHECK_FALSE(top.tilt.has_value());
    const auto again = top.box({true, false, true});
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(again.along(k).lo() == box.along(k).lo());
        CHECK(again.along(k).hi() == box.along(k).hi());
    }

    const tsubu::triclinic_box<3> tilted({-1, 0, 2}, {4, 3, 2}, {0.5, -0.25, 0.125}, {true, true, true});
    const auto of_tilted = lammps_header::of(tilted);
    REQUIRE(of_tilted.tilt.has_value());
    CHECK(*of_tilted.tilt == vec<3>{0.5, -0.25, 0.125});
    const auto tilted_again = of_tilted.tilted_box({true, true, true});
    CHECK(tilted_again.lo() == tilted.lo());
    for (std::size_t k = 0; k < 3; ++k) CHECK(tilted_again.edge(k) == tilted.edge(k));
    CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(of_tilted.box({true, true, true})); }), "tilted"));
}

TEST_CASE("axes that a box lacks are those of a flat LAMMPS box", "[io][lammps_header]") {
    const auto top = lammps_header::of(tsubu::domain<2>({0, 1}, {2, 3}, {}));
    CHECK(top.lo == vec<3>{0, 1, -0.5});
    CHECK(top.hi == vec<3>{2, 3, 0.5});
    const auto sheared = lammps_header::of(tsubu::triclinic_box<2>({0, 0}, {2, 3}, {0.5}, {true, true}));
    REQUIRE(sheared.tilt.has_value());
    CHECK(*sheared.tilt == vec<3>{0.5, 0, 0});
}
