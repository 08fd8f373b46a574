// SPDX-License-Identifier: MIT
#include <tsubu/domain/interval.hpp>

#include "support/catch.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/lattice.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

using tsubu::interval;
namespace detail = tsubu::detail;

TEMPLATE_TEST_CASE("the numbers beside a number are those of nextafter", "[domain][interval]", float, double) {
    using limits = std::numeric_limits<TestType>;
    const auto check = [](TestType x) {
        CAPTURE(x);
        CHECK(detail::next_above(x) == std::nextafter(x, (limits::max)()));
        CHECK(detail::next_below(x) == std::nextafter(x, limits::lowest()));
        CHECK(detail::at_ordinal<TestType>(detail::ordinal(x)) == x);
        if (x < (limits::max)()) CHECK(detail::ordinal(detail::next_above(x)) == detail::ordinal(x) + 1);
    };
    for (const auto x : {TestType{0}, limits::denorm_min(), (limits::min)(), TestType{1}, TestType{2}, (limits::max)(),
                         limits::epsilon()}) {
        check(x);
        check(-x);
        check(std::nextafter(x, TestType{0}));
        check(-std::nextafter(x, TestType{0}));
    }
    tsubu::random_stream random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto place =
            static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(detail::ordinal((limits::max)()))));
        check(detail::at_ordinal<TestType>(place));
        check(detail::at_ordinal<TestType>(-place));
    }
}

TEMPLATE_TEST_CASE("an interval has both ends, and never what is not finite", "[domain][interval][B3]", float, double) {
    using limits = std::numeric_limits<TestType>;
    const interval<TestType> some{-1, 2};
    CHECK((some.contains(-1) && some.contains(2) && some.contains(-0.0F)));
    CHECK_FALSE(some.contains(std::nextafter(TestType{-1}, TestType{-2})));
    CHECK_FALSE(some.contains(std::nextafter(TestType{2}, TestType{3})));
    const auto all = interval<TestType>::all();
    CHECK((all.contains(limits::lowest()) && all.contains((limits::max)()) && all.contains(0)));
    for (const auto bad : {limits::quiet_NaN(), limits::infinity(), -limits::infinity()}) {
        CHECK_FALSE(some.contains(bad));
        CHECK_FALSE(all.contains(bad));
        CHECK_FALSE(detail::is_finite(bad));
    }
    CHECK(detail::is_finite((limits::max)()));
    CHECK(detail::is_finite(limits::denorm_min()));
}

static_assert(detail::next_above(0.0) == 4.9406564584124654e-324 && detail::next_below(1.0) == 1 - 0x1p-53);
static_assert(detail::next_below(0.0F) < 0 && detail::next_above(detail::next_below(0.0F)) == 0);
static_assert(interval<tsubu::lattice<std::int32_t>>::all().contains({-2147483647 - 1}));
