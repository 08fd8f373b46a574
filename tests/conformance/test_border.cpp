// SPDX-License-Identifier: MIT
/// @file
/// Does the suite for border policies catch what it is there for?
#include <tsubu/testing/border_conformance.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <set>
#include <string>

namespace {

using tsubu::axis;
using tsubu::cuts;
using tsubu::interval;

/// Closed above: law 1, and since owned_extended is right, law 3.
struct closed_above : tsubu::exact {
    [[nodiscard]] interval<double> owned(const cuts<double>& where, std::size_t part) const noexcept {
        auto range = where.owned(part);
        range.last = std::nextafter(range.last, 1e300);
        return range;
    }
};
/// Outside the box the middle parts reach too far.
struct extended_overlaps : tsubu::exact {
    [[nodiscard]] interval<double> owned_extended(const cuts<double>& where, std::size_t part) const noexcept {
        return {where.owned_extended(part).first, interval<double>::all().last};
    }
};
/// A cut moved by one place for what lies outside: each law about owners is kept, but the two disagree.
struct shifted_when_extended : tsubu::exact {
    [[nodiscard]] interval<double> owned_extended(const cuts<double>& where, std::size_t part) const noexcept {
        auto range = where.owned_extended(part);
        if (part > 0) range.first = std::nextafter(range.first, 1e300);
        if (part + 1 < where.parts()) range.last = std::nextafter(range.last, 1e300);
        return range;
    }
};

/// lo < x <= hi instead of lo <= x < hi: sound by itself, but owner() asks the cuts.
struct closed_upwards : tsubu::exact {
    [[nodiscard]] interval<double> owned(const cuts<double>& where, std::size_t part) const noexcept {
        return shifted(where.owned(part), where, part);
    }
    [[nodiscard]] interval<double> owned_extended(const cuts<double>& where, std::size_t part) const noexcept {
        return shifted(where.owned_extended(part), where, part);
    }
    [[nodiscard]] static interval<double> shifted(interval<double> range, const cuts<double>& where, std::size_t part) {
        if (part > 0) range.first = std::nextafter(range.first, 1e300);
        if (part + 1 < where.parts()) range.last = std::nextafter(range.last, 1e300);
        return range;
    }
};

template <class Border>
std::set<std::string> broken_by(const Border& border, std::size_t parts) {
    std::set<std::string> laws;
    tsubu::testing::check_border(border, axis<double>(-0.1, 0.9, false), parts, [&](bool kept, std::string_view law) {
        if (!kept) laws.insert(std::string(law.substr(0, 5)));
    });
    return laws;
}
using laws = std::set<std::string>;

}  // namespace

TEST_CASE("a broken border policy is caught by the number of its law", "[domain][border][conformance]") {
    CHECK(broken_by(tsubu::exact{}, 5) == laws{});
    CHECK(broken_by(closed_above{}, 5) == laws{"law 1", "law 3"});
    CHECK(broken_by(extended_overlaps{}, 5) == laws{"law 2", "law 3"});
    CHECK(broken_by(shifted_when_extended{}, 5) == laws{"law 3", "law 4"});
    CHECK(broken_by(closed_upwards{}, 5) == laws{"law 4"});
    CHECK(broken_by(tsubu::padded{}, 5) == laws{"law 1", "law 2", "law 3"});
}

TEST_CASE("the text of a broken border law names the coordinate and the parts", "[domain][border][conformance]") {
    std::string first;
    tsubu::testing::check_border(closed_above{}, axis<double>(0, 1, false), 2, [&](bool kept, std::string_view law) {
        if (!kept && first.empty()) first = law;
    });
    INFO(first);
    CHECK(first.find("law 1: one part owns a coordinate inside the axis") == 0);
    CHECK(first.find("x = 0.5 of 2 parts from 0 to 1") != std::string::npos);
}
