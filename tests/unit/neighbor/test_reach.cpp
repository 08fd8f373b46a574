// SPDX-License-Identifier: MIT
#include <tsubu/neighbor/reach.hpp>

#include <tsubu/core/error.hpp>
#include <tsubu/neighbor/pair_list.hpp>

#include "support/catch.hpp"
#include "unit/neighbor/near_points.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

static_assert(tsubu::pair_reach<tsubu::same_reach>);
static_assert(tsubu::pair_reach<tsubu::radii_reach<float>>);
static_assert(!tsubu::pair_reach<double>);

/// A reach of one's own, with no more than the concept asks for: two kinds of particles, of which unlike ones attract
/// each other from afar.
struct by_kind {
    static constexpr double near = 0.5;
    static constexpr double far = 1;

    double greatest(std::size_t) const { return far; }
    template <class Real>
    Real square(tsubu::index_t i, tsubu::index_t j) const noexcept {
        const auto length = static_cast<Real>(i % 2 == j % 2 ? near : far);
        return length * length;
    }
};
static_assert(tsubu::pair_reach<by_kind>);

TEST_CASE("a reach of one's own decides for each pair", "[neighbor][reach]") {
    const auto x = near_points::scattered<3, float>(300, 5, 3);
    tsubu::pair_list list;
    list.build(x, 250, by_kind{});
    const auto all = near_points::by_comparing_all(x, 250, by_kind{});
    REQUIRE(all.size() > 50);
    CHECK(near_points::difference(list, all) == "");
}

TEST_CASE("the greatest reach is that of the two largest", "[neighbor][reach]") {
    const std::vector<double> radii{1, 3, 2, 7};
    const tsubu::radii_reach<> reach{radii, 0.5};
    CHECK(reach.greatest(3) == 6.5);  // what lies behind the particles is not looked at
    CHECK(reach.greatest(4) == 14.5);
    CHECK(reach.greatest(0) == 0.5);
    CHECK(reach.square<double>(0, 1) == 4.5 * 4.5);
    CHECK(reach.square<double>(1, 0) == 4.5 * 4.5);
    CHECK(reach.square<float>(2, 2) == 4.5F * 4.5F);
    CHECK(tsubu::same_reach{2}.greatest(9) == 2);
    CHECK(tsubu::same_reach{2}.square<float>(0, 1) == 4.0F);
}

TEST_CASE("radii that are none are named", "[neighbor][reach]") {
    constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
    const auto refused = [](const std::vector<double>& radii, double skin) {
        return thrown<tsubu::input_error>([&] { static_cast<void>(tsubu::radii_reach<>{radii, skin}.greatest(3)); });
    };
    CHECK(says(refused({1, 1}, 0), "2 radii of 3 particles"));
    CHECK(says(refused({1, 1, -2}, 0), "the radius of particle 2 is -2 m"));
    CHECK(says(refused({1, nan, 1}, 0), "the radius of particle 1 is nan m"));
    CHECK(says(refused({std::numeric_limits<double>::infinity(), 1, 1}, 0), "the radius of particle 0 is inf m"));
    CHECK(says(refused({1, 1, 1}, -0.5), "a skin of -0.5 m"));
    CHECK(says(refused({1, 1, 1}, nan), "a skin of nan m"));

    // No radius and no skin: no reach.
    const std::vector<tsubu::vec<1>> x(3);
    const std::vector<double> points(3, 0.0);
    tsubu::pair_list list;
    CHECK(says(thrown<tsubu::input_error>([&] { list.build(x, 3, tsubu::radii_reach<>{points, 0}); }),
               "tsubu::pair_list::build: neighbours up to a distance of 0"));
}

}  // namespace
