// SPDX-License-Identifier: MIT
#include <tsubu/domain/wedge.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

using tsubu::vec;
using tsubu::wedge;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::size_t, 5> numbers_of_sectors{2, 3, 4, 7, 12};

/// Anywhere in the body, and on the axis, the rim, the faces between sectors, and one step beside them.
template <class Scalar>
vec<3, Scalar> some_point(const wedge<Scalar>& body, tsubu::random_stream& random, double r_most = 1.2) {
    const auto r_max = body.cell().along(1).hi();
    vec<3, Scalar> at{static_cast<Scalar>(random.unit() * static_cast<double>(body.sectors())),
                      r_max * static_cast<Scalar>(r_most * random.unit()), static_cast<Scalar>(3 * random.unit() - 1)};
    if (random.below(2) == 0) at[0] = std::floor(at[0] * 2) / 2;
    const auto special = random.below(8);
    if (special == 0) at[1] = 0;
    if (special == 1) at[1] = r_max;
    if (special == 2) at[2] = 1;
    auto x = body.from_cell(at);
    if (special == 3)
        for (auto& coordinate : x)
            coordinate = std::nextafter(coordinate, static_cast<Scalar>(random.below(2) == 0 ? -100 : 100));
    return x;
}
template <class Scalar>
double length(const vec<3, Scalar>& d) {
    return std::hypot(static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2]));
}

struct velocity {
    static constexpr bool rotates_with_images = true;
};
struct heat_flux {
    static constexpr bool rotates_with_images = false;
};
struct radius {};

}  // namespace

static_assert(tsubu::rotates_with_images<velocity>);
static_assert(!tsubu::rotates_with_images<heat_flux>);
static_assert(!tsubu::rotates_with_images<radius>);
static_assert(!tsubu::rotates_with_images<double>);

TEST_CASE("a quarter of a body", "[domain][wedge]") {
    const wedge<> body(4, {1, 2}, 3, 0, 1, true);
    CHECK(body.sectors() == 4);
    CHECK(body.contains({1, 2, 0}));
    CHECK(body.contains({4, 2, 0.5}));
    CHECK(body.contains({2, 3, 0.5}));
    CHECK_FALSE(body.contains({1, 3, 0.5}));  // on the face to the next sector
    CHECK_FALSE(body.contains({2, 1, 0.5}));
    CHECK_FALSE(body.contains({4.1, 2, 0.5}));
    CHECK_FALSE(body.contains({2, 3, 1}));
    const auto at = body.wrap({1, 3, 1.25});
    CHECK(at.position == vec<3>{2, 2, 0.25});
    CHECK(at.shift == tsubu::image_shift<3>{1, 0, 1});
    CHECK(body.unwrap(at) == vec<3>{1, 3, 1.25});
    CHECK(body.rotate({1, 0, 5}, {1, 0, 7}) == vec<3>{0, 1, 5});
    CHECK(body.rotate({1, 0, 5}, {-1, 0, 0}) == vec<3>{0, -1, 5});
    CHECK(body.rotate({1, 0, 5}, {4, 0, 0}) == vec<3>{1, 0, 5});
    CHECK(body.minimum_image({2, 2, 0.875}, {1, 3, 0.125}) == vec<3>{0, 0, -0.25});
}

TEMPLATE_TEST_CASE("of 1 to 7 bricks of the sector exactly one owns a point inside, none any other",
                   "[domain][wedge][B3]", double, float) {
    tsubu::random_stream random(41);
    for (const auto sectors : numbers_of_sectors)
        for (const bool z_periodic : {true, false}) {
            const wedge<TestType> body(sectors, {TestType(0.3), -7}, TestType(1.7), 0, 1, z_periodic);
            for (std::size_t ranks = 1; ranks <= 7; ++ranks) {
                const tsubu::cell_decomposition parts(body,
                                                      tsubu::brick_decomposition<3, TestType>(body.cell(), ranks));
                for (int i = 0; i < 150; ++i) {
                    const auto x = some_point(body, random);
                    const auto y = body.wrap(x).position;
                    for (const auto& point : {x, y}) {
                        std::size_t owners = 0;
                        for (std::size_t rank = 0; rank < ranks; ++rank)
                            owners += parts.subdomain(rank).owns(point) ? 1U : 0U;
                        REQUIRE(owners == (body.contains(point) ? 1U : 0U));
                        if (owners == 1) REQUIRE(parts.subdomain(parts.owner(point)).owns(point));
                    }
                }
            }
        }
}

TEMPLATE_TEST_CASE("wrap returns a point of the sector, that wraps to itself, and unwraps to where it was",
                   "[domain][wedge][I8]", double, float) {
    tsubu::random_stream random(42);
    constexpr auto epsilon = std::numeric_limits<TestType>::epsilon();
    for (const auto sectors : {std::size_t{2}, std::size_t{3}, std::size_t{4}, std::size_t{7}, std::size_t{12},
                               std::size_t{1000}, std::size_t{65536}})
        for (const TestType off : {TestType(0), TestType(0.3), TestType(-1000), TestType(0.01) / epsilon}) {
            const wedge<TestType> body(sectors, {off, 2 * off}, TestType(1.7), 0, 1, true);
            for (int i = 0; i < 3000; ++i) {
                const auto x = some_point(body, random);
                const auto at = body.wrap(x);
                const auto cell = body.to_cell(at.position);
                REQUIRE((cell[0] >= 0 && cell[0] < 1));
                REQUIRE((cell[2] >= 0 && cell[2] < 1));
                if (body.to_cell(x)[1] <= TestType(1.7)) REQUIRE(body.contains(at.position));
                const auto again = body.wrap(at.position);
                REQUIRE(again.position == at.position);
                REQUIRE(again.shift == tsubu::image_shift<3>{});
                const auto back = body.unwrap(at);
                const auto tolerance = 32 * epsilon * (3 + 3 * std::abs(off));
                for (std::size_t k = 0; k < 3; ++k) REQUIRE(std::abs(back[k] - x[k]) <= tolerance);
            }
        }
}

TEST_CASE("the axis, and signed zeros, are in the sector", "[domain][wedge][B1]") {
    for (const auto sectors : numbers_of_sectors) {
        const wedge<> body(sectors, {0, 0}, 1, 0, 1, false);
        for (const double x : {0.0, -0.0})
            for (const double y : {0.0, -0.0}) {
                CHECK(body.contains({x, y, 0.5}));
                CHECK(body.wrap({x, y, 0.5}).shift == tsubu::image_shift<3>{});
            }
        CHECK(body.contains({1, -0.0, 0.5}));
        CHECK(body.wrap({-1, -0.0, 0.5}).position == body.wrap({-1, 0.0, 0.5}).position);
        CHECK(body.contains({1, -1e-17, 0.5}));
    }
}

TEST_CASE("the images of a point in n sectors are n places, the n-th the first", "[domain][wedge]") {
    tsubu::random_stream random(43);
    for (const auto sectors : numbers_of_sectors) {
        const wedge<> body(sectors, {0.3, -7}, 1.7, 0, 1, true);
        const auto n = static_cast<std::int64_t>(sectors);
        for (int i = 0; i < 200; ++i) {
            const auto x = some_point(body, random, 1);
            for (std::int64_t k = -2 * n; k <= 2 * n; ++k) {
                const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
                const auto y = body.image(x, {k, 0, 2});
                CHECK(y[0] - 0.3 ==
                      Approx(std::cos(angle) * (x[0] - 0.3) - std::sin(angle) * (x[1] + 7)).margin(1e-13));
                CHECK(y[1] + 7 == Approx(std::sin(angle) * (x[0] - 0.3) + std::cos(angle) * (x[1] + 7)).margin(1e-13));
                CHECK(y[2] == Approx(x[2] + 2));
                CHECK(body.image(x, {k + n, 0, 2}) == y);
                const auto v = body.rotate({1, 2, 3}, {k, 0, 2});
                const auto back = body.rotate(v, {-k, 0, 0});
                CHECK(back[0] == Approx(1));
                CHECK(back[1] == Approx(2));
                CHECK(v[2] == 3);
            }
        }
    }
}

TEMPLATE_TEST_CASE("the minimum image is the shortest over all sectors and periods", "[domain][wedge]", double, float) {
    tsubu::random_stream random(44);
    for (const auto sectors : numbers_of_sectors)
        for (const bool z_periodic : {true, false}) {
            const wedge<TestType> body(sectors, {TestType(0.3), -7}, TestType(1.7), 0, 1, z_periodic);
            const auto n = static_cast<std::int64_t>(sectors);
            for (int i = 0; i < 500; ++i) {
                const auto a = some_point(body, random);
                const auto b = some_point(body, random);
                double least = infinity;
                for (std::int64_t k = 0; k < n; ++k)
                    for (std::int64_t m = -3; m <= 3; ++m) {
                        if (!z_periodic && m != 0) continue;
                        auto d = body.image(a, {k, 0, m});
                        for (std::size_t j = 0; j < 3; ++j) d[j] -= b[j];
                        least = (std::min)(least, length(d));
                    }
                const auto tolerance = 64 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
                const auto there = body.minimum_image(a, b);
                REQUIRE(std::abs(length(there) - least) <= tolerance);
                REQUIRE(std::abs(length(body.minimum_image(b, a)) - least) <= tolerance);
            }
        }
}

TEST_CASE("a wedge that is none is refused", "[domain][wedge]") {
    CHECK_THROWS_AS(wedge<>(0, {0, 0}, 1, 0, 1, true), tsubu::input_error);
    const auto text = [](auto&& make) { return thrown<tsubu::input_error>(make); };
    CHECK(says(text([] { wedge<>(1, {0, 0}, 1, 0, 1, true); }), "tsubu::wedge: 1 sectors; give 2 to 65536"));
    CHECK(says(text([] { wedge<>(65537, {0, 0}, 1, 0, 1, true); }), "tsubu::wedge: 65537 sectors; give 2 to 65536"));
    CHECK(says(text([] { wedge<>(6, {0, 0}, -1, 0, 1, true); }), "tsubu::wedge: r_max = -1; give a finite length"));
    CHECK(says(text([] { static_cast<void>(wedge<>(6, {0, 0}, 1, 0, 1, true).wrap({0, not_a_number, 0})); }),
               "tsubu::wedge::wrap: the coordinate nan on axis 1 is not finite; find the particle"));
    CHECK(says(text([] { static_cast<void>(wedge<>(6, {0, 0}, 1, 0, 1, true).wrap({1.7e308, 1.7e308, 0})); }),
               "is farther from the axis than the scalar tells"));
    for (const double r_max : {0.0, -1.0, infinity, not_a_number})
        CHECK_THROWS_AS(wedge<>(6, {0, 0}, r_max, 0, 1, true), tsubu::input_error);
    for (const double at : {1e16, infinity, not_a_number})
        CHECK_THROWS_AS(wedge<>(6, {0, at}, 1, 0, 1, true), tsubu::input_error);
    CHECK_THROWS_AS(wedge<>(6, {0, 0}, 1, 1, 1, true), tsubu::input_error);
    CHECK_THROWS_AS(wedge<>(6, {0, 0}, 1, 0, not_a_number, true), tsubu::input_error);
}

TEST_CASE("a point that is not finite is refused, any other has an image", "[domain][wedge]") {
    const wedge<> body(6, {0, 0}, 1, 0, 1, false);
    for (const double x : {infinity, -infinity, not_a_number})
        for (std::size_t k = 0; k < 3; ++k) {
            vec<3> point{0.5, 0.25, 0.5};
            point[k] = x;
            CHECK_THROWS_AS(body.wrap(point), tsubu::input_error);
            CHECK_FALSE(body.contains(point));
        }
    tsubu::random_stream random(45);
    for (int i = 0; i < 2000; ++i) {
        vec<3> x{};
        for (auto& c : x) c = std::ldexp(2 * random.unit() - 1, static_cast<int>(random.below(2000)) - 1000);
        const auto at = body.wrap(x);
        const auto cell = body.to_cell(at.position);
        CHECK((cell[0] >= 0 && cell[0] < 1));
        CHECK(at.position[2] == x[2]);
        CHECK(body.wrap(at.position).position == at.position);
    }
}

TEMPLATE_TEST_CASE("beside an axis that lies far away, where directions are few, each point has an image",
                   "[domain][wedge]", double, float) {
    const TestType far = sizeof(TestType) == 8 ? TestType(630734234.13414097) : TestType(53.239658);
    const wedge<TestType> body(7, {far, far / 2}, TestType(0.2), -1, 1, true);
    for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) {
            vec<3, TestType> x{far, far / 2, 0};
            for (int step = 0; step < std::abs(i); ++step) x[0] = std::nextafter(x[0], i < 0 ? TestType(0) : 2 * far);
            for (int step = 0; step < std::abs(j); ++step) x[1] = std::nextafter(x[1], j < 0 ? TestType(0) : 2 * far);
            const auto [y, shift] = body.wrap(x);
            CAPTURE(i, j);
            CHECK(body.contains(y));
            const auto back = body.image(y, shift);
            for (std::size_t k = 0; k < 2; ++k)
                CHECK(std::abs(back[k] - x[k]) <= 4 * std::numeric_limits<TestType>::epsilon() * far);
        }
}
