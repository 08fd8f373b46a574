// SPDX-License-Identifier: MIT
#include <tsubu/io/atom_style.hpp>

#include "support/catch.hpp"

using tsubu::atom_style;

TEST_CASE("each atom style has a name, by which it is found", "[io][atom_style]") {
    for (const auto style : {atom_style::atomic, atom_style::sphere, atom_style::bond, atom_style::angle,
                             atom_style::molecular, atom_style::full})
        CHECK(tsubu::atom_style_named(tsubu::name_of(style)) == style);
    CHECK(tsubu::name_of(atom_style::sphere) == "sphere");
    CHECK_FALSE(tsubu::atom_style_named("charge").has_value());
    CHECK_FALSE(tsubu::atom_style_named("").has_value());
}

TEST_CASE("an atom style tells its columns", "[io][atom_style]") {
    CHECK(tsubu::atom_columns(atom_style::atomic) == 5);
    CHECK(tsubu::atom_columns(atom_style::sphere) == 7);
    CHECK(tsubu::atom_columns(atom_style::bond) == 6);
    CHECK(tsubu::atom_columns(atom_style::molecular) == 6);
    CHECK(tsubu::atom_columns(atom_style::full) == 7);
}
