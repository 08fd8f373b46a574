// SPDX-License-Identifier: MIT
/// @file
/// Do boxes keep their laws, and does the suite catch those that do not?
#include <tsubu/testing/box_conformance.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/domain/wedge.hpp>

#include <cmath>
#include <string>

namespace {

using tsubu::domain;
using tsubu::image_shift;
using tsubu::triclinic_box;
using tsubu::vec;
using tsubu::wedge;

template <class Box>
void check_laws(const Box& where) {
    verdict seen;
    tsubu::testing::check_box(where, 5, 200, seen);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 1000);
}

/// A box with everything right, for twins to spoil. Tilted by half an edge: the nearest fraction is not the nearest
/// image.
struct sound_box : triclinic_box<2> {
    sound_box() : triclinic_box<2>({-0.1, 0.2}, {1, 0.3}, {0.5}, {true, true}) {}
};
/// A margin for rounding at the faces, which the cell does not have.
struct tolerant : sound_box {
    static constexpr const char* breaks = "law 1";
    [[nodiscard]] bool contains(const vec<2>& x) const noexcept {
        const auto at = to_cell(x);
        return at[0] >= -1e-9 && at[0] < 1 + 1e-9 && at[1] >= -1e-9 && at[1] < 1 + 1e-9;
    }
};
/// One period, as if no particle went further in a step.
struct wraps_once : sound_box {
    static constexpr const char* breaks = "law 2";
    [[nodiscard]] tsubu::wrapped<2, double> wrap(const vec<2>& x) const {
        const auto at = to_cell(x);
        const image_shift<2> shift{at[0] >= 1 ? 1 : at[0] < 0 ? -1 : 0, at[1] >= 1 ? 1 : at[1] < 0 ? -1 : 0};
        return {image(x, {-shift[0], -shift[1]}), shift};
    }
};
/// Rounded fractions and back, also where nothing is to be wrapped.
struct rounds_all : sound_box {
    static constexpr const char* breaks = "law 2";
    [[nodiscard]] tsubu::wrapped<2, double> wrap(const vec<2>& x) const {
        const auto at = sound_box::wrap(x);
        return {from_cell(to_cell(at.position)), at.shift};
    }
};
/// Counts the other way.
struct counts_down : sound_box {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] tsubu::wrapped<2, double> wrap(const vec<2>& x) const {
        auto at = sound_box::wrap(x);
        for (auto& n : at.shift) n = -(n % 1000);
        return at;
    }
};
/// The nearest fractions: right in a box with right angles.
struct nearest_fraction : sound_box {
    static constexpr const char* breaks = "law 4";
    [[nodiscard]] vec<2> minimum_image(const vec<2>& a, const vec<2>& b) const noexcept {
        vec<2> d{a[0] - b[0], a[1] - b[1]};
        const auto second = std::nearbyint(d[1] / edge(1)[1]);
        const auto first = std::nearbyint((d[0] - second * edge(1)[0]) / edge(0)[0]);
        return {d[0] - second * edge(1)[0] - first * edge(0)[0], d[1] - second * edge(1)[1]};
    }
};
/// Half a period is always upwards.
struct half_goes_up : domain<2> {
    static constexpr const char* breaks = "law 4";
    half_goes_up() : domain<2>({0, 0}, {1, 1}, {.periodic = {true, true}}) {}
    [[nodiscard]] vec<2> minimum_image(const vec<2>& a, const vec<2>& b) const noexcept {
        auto d = domain<2>::minimum_image(a, b);
        for (auto& component : d)
            if (component == -0.5) component = 0.5;
        return d;
    }
};

}  // namespace

TEMPLATE_TEST_CASE("boxes keep their laws", "[domain][conformance][F4]", double, float) {
    using vec2 = vec<2, TestType>;
    using vec3 = vec<3, TestType>;
    check_laws(domain<1, TestType>({TestType(-0.1)}, {TestType(0.9)}, {.periodic = {true}}));
    check_laws(domain<2, TestType>({TestType(-0.1), 3}, {TestType(0.9), 4}, {.periodic = {true, false}}));
    check_laws(domain<3, TestType>({0, 0, 0}, {TestType(1e-7), 1, 1000}, {.periodic = {true, true, true}}));
    for (const double tilt : {0.0, 0.5, -0.7, 3.3, 20.1}) {
        const auto t = static_cast<TestType>(tilt);
        check_laws(triclinic_box<2, TestType>(vec2{TestType(-0.3), 2}, vec2{1, TestType(0.7)}, {t}, {true, true}));
        check_laws(triclinic_box<3, TestType>(vec3{}, vec3{1, 2, TestType(0.5)}, {t, -t, t / 3}, {true, true, true}));
        check_laws(triclinic_box<3, TestType>(vec3{}, vec3{1, 2, TestType(0.5)}, {t, -t, t / 3}, {true, false, true}));
    }
    for (const std::size_t sectors : {2U, 3U, 5U, 64U})
        for (const bool periodic : {false, true})
            check_laws(wedge<TestType>(sectors, {TestType(0.3), -1}, 2, TestType(-0.2), 1, periodic));
}

TEMPLATE_TEST_CASE("a broken box is caught by the number of its law", "[domain][conformance]", tolerant, wraps_once,
                   rounds_all, counts_down, nearest_fraction, half_goes_up) {
    static_assert(tsubu::box<TestType>);
    verdict seen;
    tsubu::testing::check_box(TestType{}, 1, 300, seen);
    INFO("breaks " << TestType::breaks << ", first caught: " << seen.first);
    CHECK(seen.broken.count(TestType::breaks) == 1);
}

TEST_CASE("the box that the twins spoil is sound", "[domain][conformance]") { check_laws(sound_box{}); }
