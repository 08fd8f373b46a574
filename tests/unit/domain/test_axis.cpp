// SPDX-License-Identifier: MIT
#include <tsubu/domain/axis.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <algorithm>
#include <tuple>

using tsubu::axis;
using tsubu::lattice;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double scales[] = {1e-300, 1e-150, 1e-13, 1e-7, 1, 1e5, 134217728, 1e9, 1e15, 1e150, 1e300};

/// How far the image is from x, in units in the last place of the largest number that takes part.
template <class Scalar>
long double ulps_off(const axis<Scalar>& along, Scalar x) {
    const auto [position, shift] = along.wrap(x);
    const long double back =
        static_cast<long double>(position) + static_cast<long double>(shift) * static_cast<long double>(along.length());
    const auto size = std::max({std::abs(x), std::abs(along.lo()), std::abs(along.hi())});
    const long double ulp = static_cast<long double>(size) - std::nextafter(size, Scalar{0});
    return std::abs(back - static_cast<long double>(x)) / ulp;
}

template <class Scalar>
void check_wrapped(const axis<Scalar>& along, Scalar x) {
    const auto [position, shift] = along.wrap(x);
    INFO("x = " << tsubu::detail::shown(x) << " in " << tsubu::detail::shown(along.lo()) << " .. "
                << tsubu::detail::shown(along.hi()) << " became " << tsubu::detail::shown(position) << ", shift "
                << shift);
    CHECK((along.lo() <= position && position < along.hi()));
    const auto again = along.wrap(position);
    CHECK((again.position == position && again.shift == 0));
    if (std::abs(x / along.length()) < 1e15) CHECK(ulps_off(along, x) <= 4);
}

}  // namespace

// B1 -----------------------------------------------------------------------------------------------------------------

TEMPLATE_TEST_CASE("a periodic axis is half-open, any other closed", "[domain][B1]", double, float) {
    using limits = std::numeric_limits<TestType>;
    for (const double scale : scales) {
        const auto hi = static_cast<TestType>(scale);
        if (!(hi > 0) || hi > (limits::max)()) continue;
        for (const TestType lo : {TestType{0}, -hi / 3}) {
            const axis<TestType> periodic(lo, hi, true);
            const axis<TestType> closed(lo, hi, false);
            const auto below = std::nextafter(lo, limits::lowest());
            const auto last = std::nextafter(hi, lo);
            const auto above = std::nextafter(hi, (limits::max)());
            for (const auto& along : {periodic, closed}) {
                CHECK(along.contains(lo));
                CHECK_FALSE(along.contains(below));
                CHECK(along.contains(std::nextafter(lo, hi)));
                CHECK(along.contains(last));
                CHECK_FALSE(along.contains(above));
                for (const auto bad : {limits::quiet_NaN(), limits::infinity(), -limits::infinity()})
                    CHECK_FALSE(along.contains(bad));
            }
            CHECK_FALSE(periodic.contains(hi));
            CHECK(closed.contains(hi));
        }
    }
}

TEST_CASE("an axis of float decides in float", "[domain][B1][F4]") {
    // (float)0.1 lies above 0.1, (float)0.7 below 0.7: a comparison in double would call one outside.
    CHECK(axis<float>(0, 0.1F, false).contains(0.1F));
    CHECK(axis<float>(0, 0.7F, false).contains(0.7F));
    CHECK_FALSE(axis<float>(0, 0.7F, true).contains(0.7F));
    for (const float hi : {0.25F, 1.0F}) CHECK_FALSE(axis<float>(0, hi, false).contains(std::nextafter(hi, 2.0F)));
}

TEST_CASE("an axis without length, inverted or not finite is refused", "[domain][input]") {
    const auto message = [](double lo, double hi) {
        return thrown<tsubu::input_error>([&] { static_cast<void>(axis<double>(lo, hi, false)); });
    };
    for (const auto& [lo, hi, what] :
         {std::tuple{1.0, 1.0, "lo = 1 is not below hi = 1"}, std::tuple{2.0, -1.5, "lo = 2 is not below hi = -1.5"},
          std::tuple{0.0, -0.0, "is not below"}, std::tuple{not_a_number, 1.0, "the face nan is not a finite number"},
          std::tuple{0.0, not_a_number, "the face nan is not a finite number"},
          std::tuple{0.0, infinity, "the face inf is not a finite number"},
          std::tuple{-infinity, 0.0, "the face -inf is not a finite number"},
          std::tuple{-1e308, 1e308, "is more than the scalar holds; scale the unit"}}) {
        const auto text = message(lo, hi);
        INFO(text);
        CHECK(says(text, "tsubu::axis: "));
        CHECK(says(text, what));
        CHECK(says(text, "; "));
    }
    CHECK_NOTHROW(axis<double>(0, std::numeric_limits<double>::denorm_min(), true));
    CHECK_NOTHROW(axis<double>(std::numeric_limits<double>::lowest(), 0, true));
}

// wrap ---------------------------------------------------------------------------------------------------------------

TEST_CASE("wrap at the lower face", "[domain][wrap][F4]") {
    const axis<double> unit(0, 1, true);
    const auto just_below = unit.wrap(-1e-17);  // -1e-17 + 1 is 1, the next period's 0
    CHECK((just_below.position == 0 && just_below.shift == 0));
    const auto in_fifty = axis<double>(0, 50, true).wrap(-1e-25);
    CHECK((in_fifty.position == 0 && in_fifty.shift == 0));
    const auto negative_zero = unit.wrap(-0.0);
    CHECK((negative_zero.position == 0 && std::signbit(negative_zero.position) && negative_zero.shift == 0));
    const auto in_float = axis<float>(0, 1, true).wrap(-1e-9F);
    CHECK((in_float.position == 0 && in_float.shift == 0));
}

TEST_CASE("wrap at the upper face", "[domain][wrap][F4]") {
    const axis<double> unit(0, 1, true);
    const auto last = unit.wrap(1 - 0x1p-53);
    CHECK((last.position == 1 - 0x1p-53 && last.shift == 0));
    const auto face = unit.wrap(1);
    CHECK((face.position == 0 && face.shift == 1));
    const auto beyond = unit.wrap(std::nextafter(1.0, 2.0));
    CHECK((beyond.position == 0x1p-52 && beyond.shift == 1));
}

TEST_CASE("hi - L one place below lo is lo", "[domain][wrap][F4]") {
    const axis<double> along(-6.2895345622564376, 6.7267357791353177, true);
    REQUIRE(along.hi() - along.length() < along.lo());
    const auto face = along.wrap(along.hi());
    CHECK((face.position == along.lo() && face.shift == 1));
}

TEST_CASE("the number before lo, moved to hi or beyond, is lo", "[domain][wrap][F4]") {
    const axis<double> along(-0.36154056881660601, 7.0745781019090721, true);
    const auto x = std::nextafter(along.lo(), -infinity);
    REQUIRE(x + along.length() >= along.hi());
    check_wrapped(along, x);
    CHECK(along.wrap(x).position == along.lo());
    CHECK(along.wrap(x).shift == 0);
}

TEST_CASE("where x - floor((x - lo) / L) L leaves the box", "[domain][wrap][F4]") {
    const axis<double> along(5.0877060830571601, 8.9860240578528838, true);
    check_wrapped(along, -2688.6500145007881);
}

TEST_CASE("far away a result comes at once, in the box", "[domain][wrap][F4]") {
    const axis<double> unit(0, 1, true);
    const axis<double> odd(-0.1, 0.6, true);
    for (const double x : {1e17, 1e22, 1e300, std::numeric_limits<double>::max(), 0x1p53, 0x1p62, 0x1p63, 0x1p64})
        for (const auto& along : {unit, odd}) {
            check_wrapped(along, x);
            check_wrapped(along, -x);
        }
    CHECK(unit.wrap(1e17).position == 0);
    CHECK(unit.wrap(1e17).shift == 100'000'000'000'000'000);
    CHECK(unit.wrap(-0x1p62).shift == -(std::int64_t{1} << 62));
    CHECK(unit.wrap(1e300).shift == (std::numeric_limits<std::int64_t>::max)());
    CHECK(unit.wrap(-1e300).shift == (std::numeric_limits<std::int64_t>::min)());
    CHECK(unit.wrap(0x1p63).shift == (std::numeric_limits<std::int64_t>::max)());
    CHECK(unit.wrap(-0x1p63).shift == (std::numeric_limits<std::int64_t>::min)());
}

TEST_CASE("many periods away", "[domain][wrap][F4]") {
    for (const auto& along : {axis<double>(0, 1, true), axis<double>(-0.1, 0.9, true), axis<double>(5, 7.5, true),
                              axis<double>(1e9, 1e9 + 3, true), axis<double>(-3e-7, 4e-7, true)})
        for (const std::int64_t k : {1, 2, 50, 512, 513, 1'000'000, (1 << 20) - 1, 1 << 20, (1 << 20) + 1})
            for (const std::int64_t n : {k, -k}) {
                const double x = along.lo() + along.length() / 2 + static_cast<double>(n) * along.length();
                check_wrapped(along, x);
                // In the middle of the box no rounding decides: no counter has an end at 512 or 2^20.
                CHECK(along.wrap(x).shift == n);
                CHECK(std::abs(along.unwrap(along.wrap(x)) - x) <= 4 * std::abs(std::nextafter(x, infinity) - x));
                const double face = along.lo() + static_cast<double>(n) * along.length();
                for (const double beside : {std::nextafter(face, -infinity), face, std::nextafter(face, infinity)})
                    check_wrapped(along, beside);
            }
}

TEMPLATE_TEST_CASE("wrap: in the box, within a few units in the last place, idempotent", "[domain][wrap][I8]", double,
                   float) {
    tsubu::random_stream random(11);
    for (const double scale : scales) {
        if (static_cast<double>((std::numeric_limits<TestType>::max)()) < scale * 1e3 ||
            static_cast<double>(std::numeric_limits<TestType>::denorm_min()) > scale * 1e-9)
            continue;
        for (int box = 0; box < 20; ++box) {
            const auto lo = static_cast<TestType>((random.unit() - 0.5) * scale);
            const auto hi = lo + static_cast<TestType>((random.unit() + 0.001) * scale);
            const axis<TestType> along(lo, hi, true);
            for (const auto x : {lo, hi, along.length(), -along.length(), TestType{0}}) {
                check_wrapped(along, std::nextafter(x, -(std::numeric_limits<TestType>::max)()));
                check_wrapped(along, x);
                check_wrapped(along, std::nextafter(x, (std::numeric_limits<TestType>::max)()));
            }
            for (int i = 0; i < 20; ++i) {
                check_wrapped(along, static_cast<TestType>(lo + (random.unit() - 0.5) * 5 * scale));
                check_wrapped(along, static_cast<TestType>((random.unit() - 0.5) * scale * 1000));
            }
        }
    }
}

TEST_CASE("any finite number wraps into any box", "[domain][wrap][I8]") {
    tsubu::random_stream random(12);
    const auto any = [&] {
        const auto place = static_cast<std::int64_t>(random.below(0x7ff0000000000000U));
        return tsubu::detail::at_ordinal<double>(random.below(2) == 0 ? place : -place);
    };
    for (int i = 0; i < 2000; ++i) {
        const auto a = any() / 2;
        const auto b = any() / 2;
        if (!(a < b) && !(b < a)) continue;
        const axis<double> along(std::min(a, b), std::max(a, b), true);
        for (int j = 0; j < 10; ++j) {
            const auto x = any();
            const auto [position, shift] = along.wrap(x);
            CAPTURE(along.lo(), along.hi(), x, position, shift);
            REQUIRE(along.contains(position));
            REQUIRE(along.wrap(position).position == position);
        }
    }
}

TEST_CASE("what is not finite is an error, on every kind of axis", "[domain][wrap][F4]") {
    for (const bool periodic : {false, true})
        for (const double x : {not_a_number, infinity, -infinity}) {
            const auto text =
                thrown<tsubu::input_error>([&] { static_cast<void>(axis<double>(0, 1, periodic).wrap(x)); });
            INFO(text);
            CHECK(says(text, "tsubu::axis::wrap: the coordinate " + tsubu::detail::shown(x) + " is not finite"));
            CHECK(says(text, "; find the particle"));
        }
}

TEST_CASE("an axis that is not periodic leaves x alone", "[domain][wrap]") {
    const axis<double> closed(0, 1, false);
    for (const double x : {-1e300, -0.5, 0.0, 1.0, 7.5, 1e300}) {
        CHECK(closed.wrap(x).position == x);
        CHECK(closed.wrap(x).shift == 0);
        CHECK(closed.minimum_image(x) == x);
    }
}

// minimum image ------------------------------------------------------------------------------------------------------

TEST_CASE("the nearest image of d is the opposite of that of -d", "[domain][minimum_image][F4]") {
    tsubu::random_stream random(13);
    for (const double length : {1.0, 0.7, 2.6, 1e-300, 1e300, 1e-7}) {
        const axis<double> along(0, length, true);
        const auto check = [&](double d) {
            const auto image = along.minimum_image(d);
            CAPTURE(length, d, image);
            CHECK(along.minimum_image(-d) == -image);
            CHECK(std::abs(image) <= length / 2);
            CHECK(std::remainder(d - image, length) == Approx(0).margin(std::abs(d) * 1e-14));
        };
        for (const double periods : {0.5, 0.5 - 0x1p-54, 0.5 + 0x1p-53, 1.0, 1.5, 1.6, 2.5, 16.1, 1e6 + 0.5})
            check(periods * length);
        if (length < 1e200) check(1e30 * length);
        for (int i = 0; i < 500; ++i) check((random.unit() - 0.5) * 8 * length);
    }
}

TEST_CASE("half a period stays half a period, either sign", "[domain][minimum_image][F4]") {
    const axis<double> unit(0, 1, true);
    CHECK(unit.minimum_image(0.5) == 0.5);
    CHECK(unit.minimum_image(-0.5) == -0.5);
    CHECK(unit.minimum_image(1.5) == -0.5);  // 1.5 - 2
    CHECK(unit.minimum_image(-1.5) == 0.5);
    CHECK(unit.minimum_image(1.6) == Approx(-0.4));
    CHECK(unit.minimum_image(16.1) == Approx(0.1));
    CHECK(unit.minimum_image(1e30) == 0);
    CHECK(std::isnan(unit.minimum_image(not_a_number)));
    CHECK(std::isnan(unit.minimum_image(infinity)));
}

TEST_CASE("float has nearest images too", "[domain][minimum_image]") {
    const axis<float> along(0, 0.7F, true);
    for (int i = -2000; i <= 2000; ++i) {
        const float d = static_cast<float>(i) * 0.00137F;
        CHECK(along.minimum_image(-d) == -along.minimum_image(d));
        CHECK(std::abs(along.minimum_image(d)) <= 0.35F);
    }
}

// constant expressions -----------------------------------------------------------------------------------------------

namespace {

/// Every float from three periods below to three above, in a box of 64 numbers: denormal ones, where no rounding hides.
constexpr bool every_number_wraps() {
    constexpr float step = std::numeric_limits<float>::denorm_min();
    for (const int lo : {-17, 0, 5}) {
        const axis<float> along(static_cast<float>(lo) * step, static_cast<float>(lo + 64) * step, true);
        for (int i = lo - 64; i < lo + 128; ++i) {
            const auto [position, shift] = along.wrap(static_cast<float>(i) * step);
            const int periods = i < lo ? -1 : i < lo + 64 ? 0 : 1;
            if (shift != periods || position != static_cast<float>(i - 64 * periods) * step) return false;
            if (!along.contains(position)) return false;
        }
    }
    return true;
}
static_assert(every_number_wraps());

}  // namespace

TEST_CASE("the nearest image of points whose distance overflows", "[domain][minimum_image][F4]") {
    const axis<double> unit(0, 1, true);
    CHECK(std::abs(unit.minimum_image(1e308, -1e308)) <= 0.5);
    CHECK(unit.minimum_image(1e308, -1e308) == -unit.minimum_image(-1e308, 1e308));
}
