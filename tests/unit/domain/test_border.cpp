// SPDX-License-Identifier: MIT
#include <tsubu/domain/border.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/testing/border_conformance.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

using tsubu::axis;
using tsubu::cuts;
using tsubu::exact;
using tsubu::padded;

namespace {

/// The first characters of each law that was broken: "law 1".
template <class Border, class Scalar>
std::set<std::string> broken(const Border& border, const cuts<Scalar>& where) {
    std::set<std::string> laws;
    tsubu::testing::check_border(border, where, [&](bool kept, std::string_view law) {
        if (!kept) laws.insert(std::string(law.substr(0, 5)));
    });
    return laws;
}
using laws = std::set<std::string>;

}  // namespace

TEMPLATE_TEST_CASE("exact keeps all laws at every scale", "[domain][border][B2][B3][B4][B5]", double, float) {
    for (const double scale : {1e-300, 1e-150, 1e-13, 1e-7, 1.0, 1e5, 134217728.0, 1e9, 1e15, 1e150, 1e300}) {
        if (sizeof(TestType) == 4 && (scale < 1e-37 || scale > 1e37)) continue;
        const auto hi = static_cast<TestType>(scale);
        for (const bool periodic : {false, true})
            for (std::size_t parts = 1; parts <= 64; ++parts)
                for (const TestType lo : {TestType{0}, -hi / 3, hi / 4}) {
                    CAPTURE(scale, parts, lo, periodic);
                    CHECK(broken(exact{}, cuts<TestType>(axis<TestType>(lo, hi, periodic), parts)).empty());
                }
    }
}

TEMPLATE_TEST_CASE("exact keeps all laws on lattices", "[domain][border][B3][B4]", std::int32_t, std::int64_t) {
    using coordinate = tsubu::lattice<TestType>;
    for (std::size_t parts = 1; parts <= 64; ++parts)
        CHECK(broken(exact{}, cuts<coordinate>(axis<coordinate>(-1, 2, true), parts)).empty());
}

TEST_CASE("padded: the upper face has no owner where epsilon vanishes beside it", "[domain][border][B2][F3]") {
    for (const double hi : {134217728.0, 1e9}) {
        const cuts<double> where(axis<double>(0, hi, false), 4);
        CHECK(where.whole().contains(hi));
        for (std::size_t part = 0; part < 4; ++part) {
            CHECK_FALSE(padded{}.owned(where, part).contains(hi));
            CHECK(exact{}.owned(where, part).contains(hi) == (part == 3));
        }
        CHECK(broken(padded{}, where).count("law 1") == 1);
    }
    // One place lower in double 1e-8 still counts; in float it has vanished at 0.25.
    CHECK(padded{}.owned(cuts<double>(axis<double>(0, 67108864, false), 4), 3).contains(67108864));
    for (const float hi : {0.25F, 1.0F}) {
        const cuts<float> where(axis<float>(0, hi, false), 4);
        CHECK_FALSE(padded{}.owned(where, 3).contains(hi));
        CHECK(exact{}.owned(where, 3).contains(hi));
    }
}

TEST_CASE("padded: points outside are owned where epsilon is not small against the box", "[domain][border][B2][F3]") {
    const cuts<double> small(axis<double>(0, 1e-7, false), 4);
    CHECK(padded{}.owned(small, 0).contains(-5e-9));  // 5 % outside
    CHECK_FALSE(exact{}.owned(small, 0).contains(-5e-9));
    CHECK_FALSE(small.whole().contains(-5e-9));
    const cuts<double> tiny(axis<double>(0, 2e-13, false), 4);
    CHECK(padded{}.owned(tiny, 0).contains(-9e-9));  // 45 000 boxes away
    CHECK(padded{}.owned(tiny, 3).contains(9e-9));
    CHECK(broken(padded{}, small).count("law 1") == 1);
    CHECK(broken(padded{}, tiny).count("law 1") == 1);
}

TEST_CASE("padded: a cut has two extended owners, the low side of one part none", "[domain][border][B4][B5][F3]") {
    const axis<double> unit(0, 1, false);
    const cuts<double> two(unit, 2);
    CHECK(padded{}.owned_extended(two, 0).contains(0.5));
    CHECK(padded{}.owned_extended(two, 1).contains(0.5));
    CHECK(broken(padded{}, two).count("law 2") == 1);
    const cuts<double> one(unit, 1);
    CHECK_FALSE(padded{}.owned_extended(one, 0).contains(-100));
    CHECK(broken(padded{}, one).count("law 2") == 1);
    CHECK(broken(exact{}, one) == laws{});
    CHECK(broken(exact{}, two) == laws{});
}

TEST_CASE("padded breaks laws 1 and 2 at every scale, exact nowhere", "[domain][border][B2]") {
    for (const double hi : {1e-300, 2e-13, 1e-7, 1.0, 134217728.0, 1e9, 1e300})
        for (std::size_t parts = 2; parts <= 16; ++parts) {
            const cuts<double> where(axis<double>(0, hi, false), parts);
            CAPTURE(hi, parts);
            CHECK(broken(padded{}, where).count("law 1") == 1);
            CHECK(broken(padded{}, where).count("law 2") == 1);
            CHECK(broken(exact{}, where) == laws{});
        }
}

TEST_CASE("padding of no width is the exact one inside, half-open above", "[domain][border][B2]") {
    const cuts<double> where(axis<double>(0, 1, true), 4);
    for (std::size_t part = 0; part < 4; ++part) {
        CHECK(padded(0).owned(where, part).first == exact{}.owned(where, part).first);
        CHECK(padded(0).owned(where, part).last == exact{}.owned(where, part).last);
    }
    const cuts<double> closed(axis<double>(0, 1, false), 4);
    CHECK_FALSE(padded(0).owned(closed, 3).contains(1));
    CHECK(exact{}.owned(closed, 3).contains(1));
}

TEST_CASE("a padding that is negative or not a number is refused", "[domain][border][input]") {
    CHECK(says(thrown<tsubu::input_error>([] { padded(-1); }), "tsubu::padded: epsilon = -1; give a finite length"));
    CHECK(says(thrown<tsubu::input_error>([] { padded(std::nan("")); }), "tsubu::padded: epsilon = nan"));
}
