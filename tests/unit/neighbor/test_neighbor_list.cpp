// SPDX-License-Identifier: MIT
#include <tsubu/neighbor/neighbor_list.hpp>

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/neighbor/pair_list.hpp>
#include <tsubu/neighbor/reach.hpp>

#include "support/catch.hpp"
#include "support/counted_memory.hpp"
#include "unit/neighbor/near_points.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace {

using rows = std::vector<std::vector<tsubu::index_t>>;

template <std::size_t D, class Real, class Reach>
rows by_comparing_all(const near_points::points<D, Real>& x, std::size_t owned, const Reach& reach) {
    rows all(owned);
    for (std::size_t i = 0; i < owned; ++i)
        for (std::size_t j = 0; j < x.size(); ++j)
            if (i != j && near_points::is_near(x, i, j, reach)) all[i].push_back(static_cast<tsubu::index_t>(j));
    return all;
}
rows sorted(const tsubu::neighbor_list& list) {
    rows all(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        all[i].assign(list.of(i).begin(), list.of(i).end());
        std::sort(all[i].begin(), all[i].end());
    }
    return all;
}

/// Not for CHECK to print: all neighbours would fill the screen.
bool is_same(const tsubu::neighbor_list& list, const rows& wanted) { return sorted(list) == wanted; }

TEMPLATE_TEST_CASE_SIG("each owned particle has all of its neighbours", "[neighbor][neighbor_list]",
                       ((std::size_t D, class Real), D, Real), (1, double), (2, double), (3, double), (1, float),
                       (2, float), (3, float)) {
    for (const auto& cloud : near_points::clouds<D, Real>())
        for (const auto owned : near_points::parts_of(cloud.x.size())) {
            INFO(cloud.name << ", " << owned << " owned");
            const tsubu::same_reach reach{cloud.reach};
            tsubu::neighbor_list list;
            list.build(cloud.x, owned, reach);
            CHECK(is_same(list, by_comparing_all(cloud.x, owned, reach)));

            // A pair list is half of it: all pairs of two owned ones are twice here, those with a ghost once.
            tsubu::pair_list half;
            half.build(cloud.x, owned, reach);
            std::size_t sides = 0;
            for (const auto [i, j] : half.pairs()) sides += static_cast<std::size_t>(j) < owned ? 2 : 1;
            CHECK(list.total() == sides);
        }
}

TEMPLATE_TEST_CASE_SIG("neighbours are those within two radii and the skin", "[neighbor][neighbor_list]",
                       ((std::size_t D, class Real), D, Real), (2, float), (3, double)) {
    for (const auto& cloud : near_points::clouds<D, Real>()) {
        if (cloud.reach != 1 || cloud.x.empty()) continue;
        // Radius 0 and no skin: particle 3 is not even near itself.
        const auto radii = near_points::radii<float>(cloud.x.size());
        for (const double skin : {0.0, 0.25}) {
            INFO(cloud.name << ", a skin of " << skin);
            const tsubu::radii_reach<float> reach{radii, skin};
            tsubu::neighbor_list list;
            list.build(cloud.x, cloud.x.size() * 3 / 4, reach);
            CHECK(is_same(list, by_comparing_all(cloud.x, cloud.x.size() * 3 / 4, reach)));
        }
    }
}

TEST_CASE("the order of neighbours depends on the input alone", "[neighbor][neighbor_list]") {
    const auto x = near_points::scattered<3, double>(2000, 8, 9);
    tsubu::neighbor_list list;
    list.build(x, 10, tsubu::same_reach{3});
    list.build(x, 1500, tsubu::same_reach{1});
    tsubu::neighbor_list again;
    again.build(x, 1500, tsubu::same_reach{1});
    REQUIRE(list.size() == 1500);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto one = list.of(i);
        const auto other = again.of(i);
        REQUIRE(std::equal(one.begin(), one.end(), other.begin(), other.end()));
    }
}

TEST_CASE("a neighbour is 4 to 4.5 bytes, a particle 8", "[neighbor][neighbor_list]") {
    const auto x = near_points::scattered<3, double>(20000, 27, 10);
    tsubu::neighbor_list list;
    CHECK(list.memory_bytes() == 0);
    CHECK(list.size() == 0);
    for (const double reach : {1.2, 0.5, 1.2, 1.19}) {
        list.build(x, x.size(), tsubu::same_reach{reach});
        CHECK(list.memory_bytes() >= 4 * list.total() + 8 * x.size());
        CHECK(list.memory_bytes() <= 4 * (list.total() + list.total() / 8) + 8 * x.size());
    }
}

TEST_CASE("a neighbour list that cannot be built stays", "[neighbor][neighbor_list]") {
    auto x = near_points::scattered<3, double>(400, 3, 12);
    tsubu::neighbor_list list;
    const auto check_stays = [&](std::size_t owned, double reach) {
        const auto before = sorted(list);
        const auto total = list.total();
        tsubu::neighbor_list other = list;
        const auto needed = counted_memory::times_asked([&] { other.build(x, owned, tsubu::same_reach{reach}); });
        REQUIRE(needed > 5);
        for (std::size_t given = 0; given < needed; ++given) {
            counted_memory::granted = given;
            bool has_thrown = false;
            try {
                list.build(x, owned, tsubu::same_reach{reach});
            } catch (const std::bad_alloc&) {
                has_thrown = true;
            }
            counted_memory::granted = counted_memory::no_limit;
            REQUIRE(has_thrown);
            REQUIRE(is_same(list, before));
            REQUIRE(list.total() == total);
        }
    };
    list.build(x, 100, tsubu::same_reach{0.5});
    check_stays(400, 2);
    // Of few where there were many, what is found is copied in the end.
    list.build(x, 400, tsubu::same_reach{2});
    check_stays(100, 0.5);

    const auto before = sorted(list);
    x[399][2] = std::numeric_limits<double>::quiet_NaN();
    const auto text = thrown<tsubu::input_error>([&] { list.build(x, 100, tsubu::same_reach{0.5}); });
    CHECK(says(text, "tsubu::neighbor_list::build: coordinate 2 of particle 399 is nan"));
    CHECK(is_same(list, before));
}

}  // namespace
