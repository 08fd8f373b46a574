// SPDX-License-Identifier: MIT
#include <tsubu/domain/cuts.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

using tsubu::axis;
using tsubu::cuts;
using tsubu::lattice;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Is x in one part, and that the one that part_of names; and inside the axis alone owned?
template <class Scalar>
constexpr bool one_part_has(const cuts<Scalar>& where, Scalar x) {
    std::size_t owners = 0;
    std::size_t extended = 0;
    for (std::size_t part = 0; part < where.parts(); ++part) {
        owners += where.owned(part).contains(x) ? 1U : 0U;
        extended += where.owned_extended(part).contains(x) ? 1U : 0U;
    }
    const auto part = where.part_of(x);
    return extended == 1 && owners == (where.whole().contains(x) ? 1U : 0U) && part < where.parts() &&
           where.owned_extended(part).contains(x);
}

template <class Scalar>
void check_all_borders(const cuts<Scalar>& where) {
    const auto check = [&](Scalar x) {
        CAPTURE(where.parts(), x);
        CHECK(one_part_has(where, x));
    };
    const auto beside = [&](Scalar x) {
        check(std::nextafter(x, std::numeric_limits<Scalar>::lowest()));
        check(x);
        check(std::nextafter(x, (std::numeric_limits<Scalar>::max)()));
    };
    for (std::size_t part = 0; part < where.parts(); ++part) beside(where.begin(part));
    beside(where.whole().hi());
    beside(0);
    beside((std::numeric_limits<Scalar>::max)());
    beside(std::numeric_limits<Scalar>::lowest());
}

}  // namespace

TEST_CASE("the faces of the box are the first and the last face of its parts, bit for bit", "[domain][B2][F3]") {
    // lo + (hi - lo) is 7.6976615897895408 here, not hi.
    const double lo = -3.1794960962080401;
    const double hi = 7.69766158978954;
    REQUIRE(lo + (hi - lo) * 1.0 != hi);
    for (const bool periodic : {false, true})
        for (std::size_t parts = 1; parts <= 64; ++parts) {
            const cuts<double> where(axis<double>(lo, hi, periodic), parts);
            CHECK(where.owned(0).first == lo);
            CHECK(where.owned(parts - 1).last == (periodic ? std::nextafter(hi, lo) : hi));
            check_all_borders(where);
        }
}

TEST_CASE("whatever expression gave a coordinate, one part has it", "[domain][B3][F3]") {
    const auto check = [](double lo, double length, std::size_t parts, std::initializer_list<double> shares) {
        const cuts<double> where(axis<double>(lo, lo + length, false), parts);
        for (const double x : shares)
            for (const double y : {std::nextafter(x, -1e9), x, std::nextafter(x, 1e9)}) {
                CAPTURE(lo, parts, y);
                CHECK(one_part_has(where, y));
            }
    };
    // lo + L (k / P), lo + k (L / P), k / P and k (1 / P) are different doubles.
    check(-0.1, 1, 10, {0.19999999999999998, 0.20000000000000004});
    check(-0.1, 1, 5, {0.5, 0.50000000000000011});
    check(0, 1, 5, {0.6, 0.60000000000000009});
    check(0, 1, 6, {5.0 / 6, 5 * (1.0 / 6)});
    check(0, 1, 7, {5.0 / 7, 5 * (1.0 / 7)});
    check(0, 1, 9, {7.0 / 9, 7 * (1.0 / 9)});
    for (std::size_t parts = 1; parts <= 64; ++parts)
        for (std::size_t k = 0; k <= parts; ++k) {
            const auto p = static_cast<double>(parts);
            const auto n = static_cast<double>(k);
            check(0, 1, parts, {n / p, n * (1 / p), 1 - (p - n) / p});
            check(-0.1, 1, parts, {-0.1 + n / p, -0.1 + n * (1 / p)});
        }
}

TEST_CASE("where the owner by a formula is the part beside", "[domain][B3][F3]") {
    const axis<double> seven(0, 7, false);
    const auto by_formula = [](double x, std::size_t parts) {
        return static_cast<std::size_t>(x / 7 * static_cast<double>(parts));
    };
    for (const auto& [parts, x] :
         {std::pair{3U, 2.333333333333333}, std::pair{3U, 4.6666666666666661}, std::pair{5U, 1.3999999999999999}}) {
        const cuts<double> where(seven, parts);
        CHECK(one_part_has(where, x));
        CHECK(where.owned(where.part_of(x)).contains(x));
        CHECK(by_formula(x, parts) != where.part_of(x));
    }
    // Over all coordinates beside cuts, the formula alone must have been wrong somewhere: else this tests nothing.
    std::size_t wrong = 0;
    for (std::size_t parts = 1; parts <= 64; ++parts) {
        const cuts<double> where(seven, parts);
        for (std::size_t part = 1; part < parts; ++part)
            for (const double x : {std::nextafter(where.begin(part), 0.0), where.begin(part)})
                wrong += by_formula(x, parts) != where.part_of(x) ? 1U : 0U;
    }
    CHECK(wrong > 0);
}

TEMPLATE_TEST_CASE("parts share every box at every scale", "[domain][B3][B4][B5][I6][I7][F3]", double, float) {
    tsubu::random_stream random(21);
    for (const double scale : {1e-300, 1e-13, 1e-7, 1.0, 1e5, 134217728.0, 1e9, 1e15, 1e300}) {
        if (scale > 1e38 * static_cast<double>(sizeof(TestType) - 3) && sizeof(TestType) == 4) continue;
        if (scale < 1e-37 && sizeof(TestType) == 4) continue;
        for (std::size_t parts = 1; parts <= 64; ++parts) {
            const auto lo = static_cast<TestType>((random.unit() - 0.5) * scale);
            const auto hi = static_cast<TestType>(static_cast<double>(lo) + (random.unit() + 0.1) * scale);
            const cuts<TestType> where(axis<TestType>(lo, hi, random.below(2) == 0), parts);
            check_all_borders(where);
            for (std::size_t part = 1; part < parts; ++part) CHECK(where.begin(part - 1) < where.begin(part));
            for (int i = 0; i < 20; ++i) {
                const auto x = static_cast<TestType>((random.unit() - 0.5) * 3 * scale);
                CHECK(one_part_has(where, x));
            }
        }
    }
}

TEST_CASE("equal parts are equal", "[domain][B3]") {
    const cuts<double> where(axis<double>(0, 1, false), 8);
    for (std::size_t part = 0; part < 8; ++part) CHECK(where.begin(part) == static_cast<double>(part) / 8);
    const axis<lattice<std::int64_t>> around(0, 1, true);
    const cuts<lattice<std::int64_t>> thirds(around, 3);
    CHECK(thirds.begin(1).value == static_cast<std::int64_t>(0x5555555555555555 + (std::uint64_t{1} << 63)));
    CHECK(thirds.begin(2).value == static_cast<std::int64_t>(0xAAAAAAAAAAAAAAAA - (std::uint64_t{1} << 63)));
}

TEST_CASE("given cuts may be very uneven", "[domain][B2][B3]") {
    const axis<double> unit(0, 1, true);
    const cuts<double> where(unit, {1e-300, 1e-17, 0.5, std::nextafter(0.5, 1.0), 1 - 0x1p-53});
    CHECK(where.parts() == 6);
    CHECK(where.owned(5).first == where.owned(5).last);  // one number alone
    check_all_borders(where);
    for (std::size_t part = 0; part < 6; ++part) CHECK(where.part_of(where.begin(part)) == part);
    CHECK(cuts<double>(unit).parts() == 1);
    CHECK(cuts<double>(unit, std::vector<double>{}).parts() == 1);
}

TEST_CASE("beyond the faces the outer parts go on", "[domain][B4][B5][F3]") {
    const axis<double> unit(0, 1, false);
    const cuts<double> one(unit, 1);
    CHECK(one.owned_extended(0).contains(-100));  // "x < hi" alone would have lost it, as would "lo <= x"
    CHECK(one.owned_extended(0).contains(100));
    const cuts<double> two(unit, 2);
    CHECK_FALSE(two.owned_extended(0).contains(0.5));  // one part has the cut, the upper one
    CHECK(two.owned_extended(1).contains(0.5));
    const cuts<double> three(unit, {0.25, 0.75});
    CHECK(three.owned_extended(1).contains(0.25));  // the middle: lower face yes, upper face no
    CHECK_FALSE(three.owned_extended(1).contains(0.75));
    CHECK(three.part_of(-1e300) == 0);
    CHECK(three.part_of(1e300) == 2);
}

TEST_CASE("the upper face of a closed axis is the last part's, of a periodic one nobody's", "[domain][B3][F3]") {
    for (const double hi : {134217728.0, 1e9, 1.0, 0.25, 2e-13, 1e-7}) {
        const cuts<double> closed(axis<double>(0, hi, false), 4);
        CHECK(closed.owned(3).contains(hi));
        CHECK(closed.part_of(hi) == 3);
        CHECK_FALSE(closed.owned(3).contains(std::nextafter(hi, 1e300)));
        CHECK_FALSE(closed.owned(0).contains(-hi / 20));  // 5 % outside is outside: 1e-7 and -5e-9
        const cuts<double> periodic(axis<double>(0, hi, true), 4);
        CHECK_FALSE(periodic.owned(3).contains(hi));
        CHECK(periodic.part_of(periodic.whole().wrap(hi).position) == 0);
    }
    for (const float hi : {0.25F, 1.0F}) {
        const cuts<float> closed(axis<float>(0, hi, false), 4);
        CHECK(closed.owned(3).contains(hi));
        CHECK_FALSE(closed.owned(3).contains(std::nextafter(hi, 2.0F)));
    }
}

TEST_CASE("parts that cannot be told apart are refused", "[domain][input][F3]") {
    const auto message = [](auto&&... arguments) {
        return thrown<tsubu::input_error>([&] { static_cast<void>(cuts<double>(arguments...)); });
    };
    const auto few = message(axis<double>(1e16, 1e16 + 4, true), std::size_t{8});
    INFO(few);
    CHECK(says(few, "tsubu::cuts: uniform cuts: part "));
    CHECK(says(few, " of 8 begins at 1e+16"));
    CHECK(says(few, "at most as many parts as it has numbers"));
    CHECK(says(message(axis<double>(0, 1, true), std::size_t{0}), "an axis in 0 parts; divide it into at least 1"));
    const axis<double> unit(0, 1, true);
    using list = std::vector<double>;
    for (const auto& given : {list{0}, list{1}, list{-0.1}, list{0.5, 0.5}, list{0.6, 0.5}, list{not_a_number},
                              list{0.5, not_a_number, 0.7}, list{std::numeric_limits<double>::infinity()}, list{1.5}}) {
        const auto text = message(unit, given);
        INFO(text);
        CHECK(says(text, "tsubu::cuts: given cuts: part "));
        CHECK(says(text, "give cuts that increase inside the axis"));
    }
    CHECK_THROWS_AS(cuts<double>(axis<double>(0, 1, false), list{1}), tsubu::input_error);  // a part of no width
    CHECK_THROWS_AS(cuts<lattice<std::int8_t>>(axis<lattice<std::int8_t>>(0, 1, true), 257), tsubu::input_error);
}

// Proofs by exhaustion ----------------------------------------------------------------------------------------------

namespace {

/// Every coordinate of the smallest lattice.
template <std::size_t Parts>
constexpr bool lattice_parts_share_all() {
    const cuts<lattice<std::int8_t>> where(axis<lattice<std::int8_t>>(0, 1, true), Parts);
    for (int x = -128; x < 128; ++x)
        if (!one_part_has(where, lattice<std::int8_t>{static_cast<std::int8_t>(x)})) return false;
    return true;
}
/// Every float in and around a box that has 48 of them.
template <std::size_t Parts, bool Periodic>
constexpr bool float_parts_share_all() {
    constexpr float step = std::numeric_limits<float>::denorm_min();
    const cuts<float> where(axis<float>(-5 * step, 43 * step, Periodic), Parts);
    for (int x = -8; x < 46; ++x)
        if (!one_part_has(where, static_cast<float>(x) * step)) return false;
    return one_part_has(where, (std::numeric_limits<float>::max)()) &&
           one_part_has(where, std::numeric_limits<float>::lowest());
}
/// One evaluation each: compilers limit its steps.
template <std::size_t Parts>
struct proof {
    static_assert(lattice_parts_share_all<Parts>());
    static_assert(float_parts_share_all<Parts, false>());
    static_assert(float_parts_share_all<Parts, true>());
};
template <std::size_t... Parts>
constexpr std::size_t size_of_proofs(std::index_sequence<Parts...>) {
    return (sizeof(proof<Parts + 1>) + ...);
}
static_assert(size_of_proofs(std::make_index_sequence<16>{}) == 16);

}  // namespace

TEST_CASE("every coordinate of a small axis, every number of parts that it admits", "[domain][B3][B4][I6][I7]") {
    const axis<lattice<std::int8_t>> around(0, 1, true);
    for (std::size_t parts = 1; parts <= 256; ++parts) {
        const cuts<lattice<std::int8_t>> where(around, parts);
        bool shared = true;
        for (int x = -128; x < 128; ++x)
            shared = shared && one_part_has(where, lattice<std::int8_t>{static_cast<std::int8_t>(x)});
        CHECK(shared);
    }
}

TEST_CASE("one cut in braces is a cut, not a number of parts", "[domain][cuts]") {
    CHECK(cuts<double>(axis<double>(0, 2, false), {0.5}).parts() == 2);
    CHECK(cuts<double>(axis<double>(0, 2, false), {1}).begin(1) == 1);
    CHECK(cuts<double>(axis<double>(0, 2, false), 3).parts() == 3);
}
