// SPDX-License-Identifier: MIT
#include <tsubu/core/lanes.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

namespace {

template <class Real>
std::vector<Real> many_numbers() {
    using limits = std::numeric_limits<Real>;
    return {Real(0),
            -Real(0),
            Real(1),
            Real(-2.5),
            Real(1) / 3,
            limits::min(),
            limits::max(),
            limits::denorm_min(),
            -limits::infinity(),
            limits::infinity(),
            Real(7e-20),
            Real(3e20)};
}
template <class Real>
bool same_number(Real a, Real b) {
    return (a != a && b != b) || (a == b && std::signbit(a) == std::signbit(b));
}
/// Lanes that differ, so that one that takes another's number shows.
template <class Real>
tsubu::lanes<Real> lanes_from(const std::vector<Real>& numbers, std::size_t first) {
    tsubu::lanes<Real> result;
    for (std::size_t l = 0; l < tsubu::lanes<Real>::count; ++l) result.set(l, numbers[(first + l) % numbers.size()]);
    return result;
}

}  // namespace

TEMPLATE_TEST_CASE("what is done to lanes is done to each number", "[core][lanes]", float, double) {
    using V = tsubu::lanes<TestType>;
    static_assert(V::count * sizeof(TestType) == tsubu::lane_bytes);
    static_assert(std::is_same_v<tsubu::number_of<V>, TestType> &&
                  std::is_same_v<tsubu::number_of<TestType>, TestType>);
    const auto numbers = many_numbers<TestType>();
    for (std::size_t p = 0; p < numbers.size(); ++p)
        for (std::size_t q = 0; q < numbers.size(); ++q) {
            const V a = lanes_from(numbers, p);
            const V b = lanes_from(numbers, q);
            V sum = a;
            V difference = a;
            V product = a;
            sum += b;
            difference -= b;
            product = product * b;
            for (std::size_t l = 0; l < V::count; ++l) {
                const TestType x = a[l];
                const TestType y = b[l];
                INFO(x << " and " << y << " in lane " << l);
                CHECK(same_number((a + b)[l], static_cast<TestType>(x + y)));
                CHECK(same_number((a - b)[l], static_cast<TestType>(x - y)));
                CHECK(same_number((a * b)[l], static_cast<TestType>(x * y)));
                if (y != 0) CHECK(same_number((a / b)[l], static_cast<TestType>(x / y)));
                CHECK(same_number((-a)[l], static_cast<TestType>(-x)));
                CHECK(same_number(sum[l], (a + b)[l]));
                CHECK(same_number(difference[l], (a - b)[l]));
                CHECK(same_number(product[l], (a * b)[l]));
                CHECK(((a < b).bits() >> l & 1U) == (x < y ? 1U : 0U));
                CHECK(((a > b).bits() >> l & 1U) == (x > y ? 1U : 0U));
                CHECK((((a < b) & (b > a)).bits() >> l & 1U) == (x < y ? 1U : 0U));
                CHECK((((a < b) | (a > b)).bits() >> l & 1U) == (x < y || x > y ? 1U : 0U));
                CHECK(same_number(tsubu::lanewise::select(a < b, a, b)[l], tsubu::lanewise::select(x < y, x, y)));
                CHECK(same_number(tsubu::lanewise::greatest(a, b)[l], tsubu::lanewise::greatest(x, y)));
                if (!(x < 0)) CHECK(same_number(tsubu::lanewise::sqrt(a)[l], static_cast<TestType>(std::sqrt(x))));
            }
            CHECK((a < b).bits() >> V::count == 0U);
        }
}
TEMPLATE_TEST_CASE("one number is in all lanes", "[core][lanes]", float, double) {
    using V = tsubu::lanes<TestType>;
    for (const auto one : many_numbers<TestType>()) {
        const V all = one;
        // A zero loses its sign: the number is added to zeros.
        for (std::size_t l = 0; l < V::count; ++l) CHECK(all[l] == one);
    }
}
TEST_CASE("not a number is neither less nor greater, and stays", "[core][lanes]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const tsubu::lanes<double> a = nan;
    const tsubu::lanes<double> b = 1.0;
    CHECK((a < b).bits() == 0);
    CHECK((a > b).bits() == 0);
    CHECK(std::isnan(tsubu::lanewise::sqrt(a)[0]));
    CHECK(std::isnan((a + b)[1]));
}
