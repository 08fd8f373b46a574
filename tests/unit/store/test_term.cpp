// SPDX-License-Identifier: MIT
#include <tsubu/store/term.hpp>

#include "support/catch.hpp"

#include <type_traits>

TEST_CASE("terms join two, three or four particles, and compare by type and ids", "[store]") {
    STATIC_REQUIRE(tsubu::term<2>{1, {7, 9}} == tsubu::term<2>{1, {7, 9}});
    STATIC_REQUIRE(tsubu::term<2>{1, {7, 9}} != tsubu::term<2>{1, {9, 7}});
    STATIC_REQUIRE(tsubu::term<3>{1, {7, 9, 8}} < tsubu::term<3>{2, {1, 1, 1}});
    STATIC_REQUIRE(tsubu::term<4>{}.type == 0);
    STATIC_REQUIRE(sizeof(tsubu::term<4>) == 8 + 4 * 8);
    STATIC_REQUIRE(std::has_unique_object_representations_v<tsubu::term<2>>);  // no padding, which files would hold
    STATIC_REQUIRE(std::has_unique_object_representations_v<tsubu::term<3>>);
    STATIC_REQUIRE(std::is_trivially_copyable_v<tsubu::term<4>>);
    STATIC_REQUIRE(decltype(tsubu::bonds)::value_type::element_type::order == 2);
    STATIC_REQUIRE(decltype(tsubu::angles)::value_type::element_type::order == 3);
    STATIC_REQUIRE(decltype(tsubu::dihedrals)::value_type::element_type::order == 4);
    STATIC_REQUIRE_FALSE(std::is_same_v<decltype(tsubu::dihedrals), decltype(tsubu::impropers)>);
}
