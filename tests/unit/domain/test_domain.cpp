// SPDX-License-Identifier: MIT
#include <tsubu/domain/domain.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

using tsubu::domain;
using tsubu::image_shift;
using tsubu::lattice;
using tsubu::vec;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a point is inside if it is so along every axis", "[domain][B1]") {
    const domain<3> box{{0, 0, 0}, {1, 2, 3}, {.periodic = {true, false, false}}};
    CHECK(box.contains({0, 0, 0}));
    CHECK(box.contains({0.5, 2, 3}));
    CHECK_FALSE(box.contains({1, 2, 3}));  // the image of x = 0
    for (std::size_t k = 0; k < 3; ++k) {
        for (const double bad : {-1e-300, 3.1, not_a_number, infinity, -infinity}) {
            vec<3> x{0.5, 0.5, 0.5};
            x[k] = bad;
            CAPTURE(k, bad);
            CHECK_FALSE(box.contains(x));
        }
    }
    CHECK(domain<1>{{-1}, {1}}.contains({1}));
    CHECK(domain<2, float>{{0, 0}, {0.1F, 0.7F}}.contains({0.1F, 0.7F}));
    const domain<2, lattice<std::int32_t>> around{{0, 0}, {1, 1}, {.periodic = {true, true}}};
    CHECK(around.contains({}));
}

TEST_CASE("wrap goes along every axis", "[domain][wrap]") {
    const domain<3> box{{0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, false}}};
    const auto [y, shift] = box.wrap({1.25, -0.5, 0.5});
    CHECK(y == vec<3>{0.25, 0.5, 0.5});
    CHECK(shift == image_shift<3>{1, -1, 0});
    CHECK(box.unwrap({y, shift}) == vec<3>{1.25, -0.5, 0.5});
    for (std::size_t k = 0; k < 3; ++k)
        for (const double bad : {not_a_number, infinity, -infinity}) {
            vec<3> x{0.5, 0.5, 0.5};
            x[k] = bad;
            CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(box.wrap(x)); }),
                       "tsubu::domain::wrap: the coordinate " + tsubu::detail::shown(bad) + " on axis " +
                           std::to_string(k) + " is not finite"));
        }
}

TEST_CASE("many points are wrapped as each is, and their shifts add up", "[domain][wrap][batch]") {
    const domain<3> box{{0, -0.3, 5}, {1, 0.9, 6}, {.periodic = {true, true, false}}};
    tsubu::random_stream random(11);
    std::vector<vec<3>> rows(3000);
    for (auto& x : rows)
        for (std::size_t k = 0; k < 3; ++k)
            x[k] =
                box.along(k).lo() + (random.below(50) == 0 ? 1e6 * (random.unit() - 0.5) : 1.2 * random.unit() - 0.1);
    std::array<std::vector<double>, 3> column;
    for (const auto& x : rows)
        for (std::size_t k = 0; k < 3; ++k) column[k].push_back(x[k]);
    const auto before = rows;
    const image_shift<3> earlier{3, -2, 0};
    std::vector<image_shift<3>> shift(rows.size(), earlier);
    auto shift_of_columns = shift;
    const auto changed = box.wrap(rows, shift);
    CHECK(box.wrap({{column[0], column[1], column[2]}}, shift_of_columns) == changed);
    CHECK(shift_of_columns == shift);
    std::size_t expected = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto at = box.wrap(before[i]);
        expected += at.position != before[i] ? 1U : 0U;
        REQUIRE(rows[i] == at.position);
        for (std::size_t k = 0; k < 3; ++k) {
            REQUIRE(shift[i][k] == earlier[k] + at.shift[k]);
            REQUIRE(column[k][i] == rows[i][k]);
        }
    }
    CHECK((changed == expected && changed > 300 && changed < 3000));
    CHECK(box.wrap(rows, shift) == 0);  // they are there
}

TEST_CASE("a batch stops at the first point that is not finite, and loses nothing", "[domain][wrap][batch][input]") {
    const domain<2> box{{0, 0}, {1, 1}, {.periodic = {true, false}}};
    std::vector<vec<2>> x = {{1.5, 0.5}, {0.5, 7}, {0.5, not_a_number}, {-0.25, 0.5}};
    std::vector<image_shift<2>> shift(4);
    const auto text = thrown<tsubu::input_error>([&] { box.wrap(x, shift); });
    INFO(text);
    CHECK(says(text, "tsubu::domain::wrap: the coordinate nan on axis 1 of point 2 is not finite; find the particle"));
    CHECK((x[0] == vec<2>{0.5, 0.5} && shift[0] == image_shift<2>{1, 0}));  // wrapped, and said so
    CHECK((x[1] == vec<2>{0.5, 7} && shift[1] == image_shift<2>{}));        // outside for good: left alone
    CHECK((x[3] == vec<2>{-0.25, 0.5} && shift[3] == image_shift<2>{}));    // untouched
    CHECK(says(thrown<tsubu::input_error>([&] { box.wrap(x, std::span(shift).first(3)); }),
               "tsubu::domain::wrap: 3 answers for 4 points"));
}

TEST_CASE("many points are inside, or near a face, as each is", "[domain][B1][B9][batch]") {
    const domain<2, float> box{{0, 0}, {1, 1}, {.periodic = {true, false}}};
    tsubu::random_stream random(2);
    std::vector<vec<2, float>> x(500);
    for (auto& at : x)
        for (auto& coordinate : at)
            coordinate = random.below(20) == 0 ? std::numeric_limits<float>::quiet_NaN()
                                               : static_cast<float>(1.4 * random.unit() - 0.2);
    std::vector<unsigned char> inside(x.size());
    std::vector<unsigned char> near(x.size());
    box.contains(x, inside);
    box.near_periodic_face(x, 0.1F, near);
    for (std::size_t i = 0; i < x.size(); ++i) {
        CHECK((inside[i] != 0) == box.contains(x[i]));
        CHECK((near[i] != 0) == box.near_periodic_face(x[i], 0.1F));
    }
    CHECK_THROWS_AS(box.contains(x, std::span(inside).first(3)), tsubu::input_error);
    CHECK_THROWS_AS(box.near_periodic_face(x, 0.1F, std::span(near).first(3)), tsubu::input_error);
}

TEST_CASE("image counters stop at their ends, in a batch too", "[domain][wrap][batch]") {
    const domain<1> box{{0}, {1}, {.periodic = {true}}};
    std::vector<vec<1>> x = {{1e300}, {-1e300}, {1.5}};
    std::vector<image_shift<1>> shift = {{1}, {-1}, {std::numeric_limits<std::int64_t>::max()}};
    CHECK(box.wrap(x, shift) == 3);
    CHECK(shift[0][0] == std::numeric_limits<std::int64_t>::max());
    CHECK(shift[1][0] == std::numeric_limits<std::int64_t>::min());
    CHECK(shift[2][0] == std::numeric_limits<std::int64_t>::max());
}

TEST_CASE("an image is moved by whole periods", "[domain][image]") {
    const domain<2> box{{0, 0}, {2, 0.5}, {.periodic = {true, true}}};
    CHECK(box.image({0.5, 0.25}, {-1, 3}) == vec<2>{-1.5, 1.75});
    const domain<1, lattice<std::int32_t>> around{{0}, {2}, {.periodic = {true}}};
    CHECK(around.image(around.from_real({0.5}).position, {-1}) == vec<1>{-1.5});
}

TEST_CASE("a box for narrower positions lies inside the wider one", "[domain][F4]") {
    const domain<2> wide{{0.1, -0.7}, {0.7, 0.1}, {.periodic = {false, true}}};
    const domain<2, float> narrow(wide);
    for (std::size_t k = 0; k < 2; ++k) {
        const auto lo = narrow.along(k).lo();
        const auto hi = narrow.along(k).hi();
        CHECK((double{lo} >= wide.along(k).lo() && double{hi} <= wide.along(k).hi()));
        // One step further out would be outside.
        CHECK(double{std::nextafter(lo, -1.0F)} < wide.along(k).lo());
        CHECK(double{std::nextafter(hi, 1.0F)} > wide.along(k).hi());
        CHECK(narrow.along(k).is_periodic() == wide.along(k).is_periodic());
    }
    CHECK_FALSE(narrow.contains({0.7F, 0.1F}));  // (float)0.1 > 0.1
    CHECK(wide.contains({0.7, 0.0999}));
    CHECK_THROWS_AS((domain<1, float>(domain<1>{{0.1}, {std::nextafter(0.1, 1)}})), tsubu::input_error);
}

TEST_CASE("image counters have no end at 512 or 2^20", "[domain][wrap][F4]") {
    const domain<2> box{{0, -0.1}, {1, 0.9}, {.periodic = {true, true}}};
    for (const std::int64_t n : {-513, -512, -511, 510, 511, 512, -(1 << 20) - 1, 1 << 20, (1 << 20) + 1}) {
        const vec<2> x{0.25 + static_cast<double>(n), 0.25 - static_cast<double>(n)};
        const auto at = box.wrap(x);
        CHECK(at.shift == image_shift<2>{n, -n});
        const auto back = box.unwrap(at);
        for (std::size_t k = 0; k < 2; ++k) CHECK(back[k] == Approx(x[k]).epsilon(1e-15));
    }
}

TEST_CASE("the nearest image from b to a is the opposite of that from a to b", "[domain][minimum_image][F4]") {
    const domain<3> box{{0, 0, 0}, {1, 0.7, 2}, {.periodic = {true, true, false}}};
    tsubu::random_stream random(7);
    for (int i = 0; i < 2000; ++i) {
        const vec<3> a{random.unit(), random.unit() * 0.7, random.unit() * 2};
        vec<3> b{random.unit(), random.unit() * 0.7, random.unit() * 2};
        if (i % 4 == 0) b[0] = a[0] < 0.5 ? a[0] + 0.5 : a[0] - 0.5;
        const auto there = box.minimum_image(a, b);
        const auto back = box.minimum_image(b, a);
        for (std::size_t k = 0; k < 3; ++k) CHECK(there[k] == -back[k]);
        CHECK((std::abs(there[0]) <= 0.5 && std::abs(there[1]) <= 0.35));
        CHECK(there[2] == a[2] - b[2]);
    }
}

TEST_CASE("the shortest edge, of equal ones the first", "[domain][B7][B8][F3]") {
    const auto shortest = [](double x, double y, double z) { return domain<3>{{0, 0, 0}, {x, y, z}}.min_extent(); };
    CHECK((shortest(1, 1, 2).axis == 0 && shortest(1, 1, 2).width == 1));
    CHECK(shortest(1, 2, 1).axis == 0);
    CHECK(shortest(2, 1, 1).axis == 1);
    CHECK(shortest(1, 1, 1).axis == 0);
    CHECK(shortest(3, 2, 1).axis == 2);
    CHECK((shortest(1, 1, 1e-9).axis == 2 && shortest(1, 1, 1e-9).width == 1e-9));
    CHECK(domain<2>{{0, 0}, {1, 2}}.min_extent().axis == 0);  // no thin z in two dimensions
}

TEST_CASE("near a periodic face, on either side of it", "[domain][B9]") {
    const domain<2> box{{0, 0}, {1, 1}, {.periodic = {true, false}}};
    for (const double x : {-0.05, 0.0, 0.0999, 0.9001, 1.0, 1.05}) CHECK(box.near_periodic_face({x, 0.5}, 0.1));
    for (const double x : {0.1, 0.5, 0.9}) CHECK_FALSE(box.near_periodic_face({x, 0.01}, 0.1));
    CHECK(box.near_periodic_face({0.5, 0.5}, 0.75));  // above half a box: everywhere
    CHECK_FALSE(box.near_periodic_face({0.5, 0.5}, 0));
    CHECK(box.near_periodic_face({-100, 0.5}, 0.1));  // beyond it
    CHECK(box.near_periodic_face({0.5, 0.5}, infinity));
    CHECK_FALSE(domain<1>{{0}, {1}}.near_periodic_face({0}, 10));
    for (const double bad : {-1.0, -1e-300, not_a_number}) {
        const auto text = thrown<tsubu::input_error>([&] { static_cast<void>(box.near_periodic_face({0, 0}, bad)); });
        INFO(text);
        CHECK(
            says(text, "tsubu::domain::near_periodic_face: cutoff = " + tsubu::detail::shown(bad) + "; give a length"));
    }
}

TEST_CASE("a bad box is refused, whichever axis is bad", "[domain][input]") {
    for (std::size_t k = 0; k < 3; ++k)
        for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
            vec<3> hi{1, 1, 1};
            hi[k] = bad;
            const auto text = thrown<tsubu::input_error>([&] { static_cast<void>(domain<3>{{0, 0, 0}, hi}); });
            INFO(text);
            CHECK(says(text, "tsubu::axis: "));
            CHECK(says(text, "(axis " + std::to_string(k) + " of the domain)"));
        }
    using fixed = domain<2, lattice<std::int64_t>>;
    CHECK_THROWS_AS((fixed{{0, 0}, {1, 1}, {.periodic = {true, false}}}), tsubu::input_error);
}

TEST_CASE("a lattice domain converts from and to real positions", "[domain][lattice]") {
    const domain<2, lattice<std::int32_t>> box{{0, -1}, {1, 1}, {.periodic = {true, true}}};
    const auto [at, shift] = box.from_real({1.25, -1.5});
    CHECK(shift == image_shift<2>{1, -1});
    CHECK(box.to_real(at) == vec<2>{0.25, 0.5});
    CHECK(box.minimum_image(at, box.from_real({0.5, -0.75}).position) == vec<2>{-0.25, -0.75});
    CHECK(box.min_extent().width == 1);
    CHECK(domain<1>{{0}, {1}}.to_real({0.3}) == vec<1>{0.3});
}
