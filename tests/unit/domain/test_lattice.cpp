// SPDX-License-Identifier: MIT
#include <tsubu/domain/lattice.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/axis.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

using tsubu::axis;
using tsubu::lattice;

namespace {

template <class Int>
constexpr Int lowest = (std::numeric_limits<Int>::min)();
template <class Int>
constexpr Int highest = (std::numeric_limits<Int>::max)();
template <class Int>
const double steps = std::ldexp(1.0, std::numeric_limits<Int>::digits + 1);

}  // namespace

TEMPLATE_TEST_CASE("one past the highest coordinate is the lowest", "[domain][lattice][wrap]", std::int32_t,
                   std::int64_t) {
    const lattice<TestType> top{highest<TestType>};
    const lattice<TestType> bottom{lowest<TestType>};
    CHECK(top + TestType{1} == bottom);
    CHECK(bottom + TestType{-1} == top);
    CHECK(top - bottom == -1);  // the shorter way round
    CHECK(bottom - top == 1);
    CHECK((lattice<TestType>{0} - bottom) == lowest<TestType>);  // half a period: the negative one
    CHECK((bottom - lattice<TestType>{0}) == lowest<TestType>);
    CHECK(bottom < top);
}

TEMPLATE_TEST_CASE("a lattice axis has no outside", "[domain][lattice][B1]", std::int32_t, std::int64_t) {
    const axis<lattice<TestType>> along(-1, 3, true);
    for (const auto value : {lowest<TestType>, TestType{-1}, TestType{0}, highest<TestType>}) {
        CHECK(along.contains({value}));
        CHECK(along.wrap({value}).position == lattice<TestType>{value});
        CHECK(along.wrap({value}).shift == 0);
    }
    const auto text = thrown<tsubu::input_error>([] { static_cast<void>(axis<lattice<TestType>>(0, 1, false)); });
    INFO(text);
    CHECK(says(text, "tsubu::axis: an axis of a lattice that is not periodic; make it periodic"));
    CHECK(says(thrown<tsubu::input_error>([] { static_cast<void>(axis<lattice<TestType>>(1, 0, true)); }), "below"));
}

TEMPLATE_TEST_CASE("real positions round to the nearest coordinate", "[domain][lattice]", std::int32_t, std::int64_t) {
    const axis<lattice<TestType>> along(-1, 3, true);
    CHECK(along.from_real(-1).position == lattice<TestType>{lowest<TestType>});
    CHECK(along.from_real(1).position == lattice<TestType>{0});
    CHECK(along.from_real(3).position == lattice<TestType>{lowest<TestType>});
    CHECK(along.from_real(3).shift == 1);
    CHECK(along.from_real(-1 - 4 * 0x1p-40).shift ==
          (sizeof(TestType) == 4 ? 0 : -1));  // rounds up to the face, or not
    const double half_step = 2 / steps<TestType>;
    tsubu::random_stream random(3);
    for (int i = 0; i < 2000; ++i) {
        const double x = (random.unit() - 0.5) * 40;
        const auto [position, shift] = along.from_real(x);
        const double back = along.to_real(position) + 4.0 * static_cast<double>(shift);
        CHECK(std::abs(back - x) <= half_step + 16 * 0x1p-52);
    }
}

TEST_CASE("32 bits survive the way through double and back", "[domain][lattice]") {
    using coordinate = lattice<std::int32_t>;
    const axis<coordinate> along(0, 1, true);
    tsubu::random_stream random(4);
    for (int i = 0; i < 2000; ++i) {
        const coordinate at{static_cast<std::int32_t>(random())};
        CHECK(along.from_real(along.to_real(at)).position == at);
    }
    for (const std::int32_t value : {lowest<std::int32_t>, lowest<std::int32_t> + 1, -1, 0, 1, highest<std::int32_t>})
        CHECK(along.from_real(along.to_real({value})).position == coordinate{value});
}

TEST_CASE("64 bits near the lower face are as fine as double is there", "[domain][lattice]") {
    const axis<lattice<std::int64_t>> along(0, 1, true);
    for (const std::int64_t k : {1, 2, 15, 1023, 1 << 20}) {
        const auto at = along.from_real(static_cast<double>(k) * 0x1p-64).position;
        CHECK(at.value == lowest<std::int64_t> + k);
        CHECK(along.to_real(at) == static_cast<double>(k) * 0x1p-64);
    }
    CHECK(along.from_real(1 - 0x1p-53).position.value == highest<std::int64_t> - 2047);
    CHECK(along.to_real({highest<std::int64_t>}) == 1);  // as near as double comes
}

TEMPLATE_TEST_CASE("conversion is total over finite positions", "[domain][lattice][wrap]", std::int32_t, std::int64_t) {
    const axis<lattice<TestType>> along(-0.1, 0.6, true);
    for (const double x : {1e17, 1e22, 1e300, (std::numeric_limits<double>::max)()})
        for (const double signed_x : {x, -x}) CHECK_NOTHROW(along.from_real(signed_x));
    for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()})
        CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(along.from_real(x)); }), "is not finite"));
}

TEMPLATE_TEST_CASE("nearest images of a lattice are exact and antisymmetric", "[domain][lattice][minimum_image][F4]",
                   std::int32_t, std::int64_t) {
    const axis<lattice<TestType>> along(-1, 3, true);
    using coordinate = lattice<TestType>;
    const coordinate low{lowest<TestType>};
    const coordinate middle{0};
    CHECK(along.minimum_image(middle, low) == 2);  // half a period, both signs
    CHECK(along.minimum_image(low, middle) == -2);
    tsubu::random_stream random(5);
    for (int i = 0; i < 2000; ++i) {
        const coordinate a{static_cast<TestType>(random())};
        const coordinate b = i % 3 == 0 ? a + lowest<TestType> : coordinate{static_cast<TestType>(random())};
        CHECK(along.minimum_image(a, b) == -along.minimum_image(b, a));
        CHECK(std::abs(along.minimum_image(a, b)) <= 2);
    }
    CHECK(along.minimum_image({lowest<TestType>}, {highest<TestType>}) == Approx(4 / steps<TestType>));
}

namespace {

// All pairs of the smallest lattice, in eighths: compilers limit the steps of an evaluation.
template <int Eighth>
constexpr bool differences_are_shortest() {
    using coordinate = lattice<std::int8_t>;
    for (int a = -128 + 32 * Eighth; a < -96 + 32 * Eighth; ++a)
        for (int b = -128; b < 128; ++b) {
            const coordinate from{static_cast<std::int8_t>(b)};
            const coordinate to{static_cast<std::int8_t>(a)};
            const std::int8_t way = to - from;
            if (from + way != to) return false;
            const int distance = way < 0 ? -way : way;
            const int other = a > b ? a - b : b - a;
            if (distance != (other < 256 - other ? other : 256 - other)) return false;
        }
    return true;
}
template <int Eighth>
struct proof_of_differences {
    static_assert(differences_are_shortest<Eighth>());
};
template <int... Eighths>
constexpr bool proved(std::integer_sequence<int, Eighths...>) {
    return ((sizeof(proof_of_differences<Eighths>) == 1) && ...);
}
static_assert(proved(std::make_integer_sequence<int, 8>{}));

}  // namespace

TEST_CASE("no lattice coordinate lies above the box, whatever rounds", "[domain][lattice][F3]") {
    const tsubu::axis<lattice<std::int64_t>> along(-3.1794960962080401, 7.69766158978954, true);
    CHECK(along.to_real({std::numeric_limits<std::int64_t>::max()}) <= 7.69766158978954);
    CHECK(along.to_real({std::numeric_limits<std::int64_t>::min()}) == -3.1794960962080401);
}

TEST_CASE("a lattice is as fine in the smallest of boxes", "[domain][lattice][F3]") {
    for (const double length : {1e-290, 1e-300, 1e-305}) {
        const tsubu::axis<lattice<std::int64_t>> along(0, length, true);
        const auto at = along.from_real(0.75 * length).position;
        CHECK(along.to_real(at) == Approx(0.75 * length).epsilon(1e-12));
        CHECK(along.minimum_image(at, along.from_real(0.5 * length).position) == Approx(0.25 * length).epsilon(1e-12));
    }
}
