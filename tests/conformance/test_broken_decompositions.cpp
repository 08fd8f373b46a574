// SPDX-License-Identifier: MIT
/// @file
/// Does the suite for decompositions catch what it is there for?
#include "broken_decompositions.hpp"

#include <tsubu/testing/decomposition_conformance.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <string>
#include <type_traits>

namespace {

using namespace tsubu::testing;

}  // namespace

TEMPLATE_LIST_TEST_CASE("a broken decomposition is caught by the number of its law", "[domain][conformance]",
                        broken::decomposition_twins) {
    static_assert(tsubu::decomposition<TestType>);
    verdict seen;
    check_decomposition(TestType{}, 1, 300, seen);
    INFO("breaks " << TestType::breaks << ", first caught: " << seen.first);
    CHECK(seen.broken.count(TestType::breaks) == 1);
    // Who breaks a law about points is not blamed for neighbours, and the other way round.
    const bool about_points = TestType::breaks < std::string("law 3");
    if (std::is_same_v<TestType, broken::faces_of_all>) return;  // neighbours are judged by the faces
    CHECK((!about_points || (seen.broken.count("law 3") == 0 && seen.broken.count("law 4") == 0)));
    CHECK((about_points || (seen.broken.count("law 1") == 0 && seen.broken.count("law 2") == 0)));
}

TEST_CASE("a sound decomposition is not blamed", "[domain][conformance]") {
    verdict seen;
    check_decomposition(broken::sound_bricks{}, 1, 1000, seen);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 10'000);
}

TEST_CASE("the text of a broken law names the point, its owners and the seed", "[domain][conformance]") {
    verdict seen;
    check_decomposition(broken::gap_of_one_place{}, 77, 10, seen);
    INFO(seen.first);
    CHECK(seen.first.rfind("law 1: ", 0) == 0);
    CHECK(seen.first.find("x = ") != std::string::npos);
    CHECK(seen.first.find("0 ranks own it, 0 by owns_extended; owner says rank ") != std::string::npos);
    CHECK(seen.first.find("seed 77") != std::string::npos);
}
