// SPDX-License-Identifier: MIT
#include <tsubu/neighbor/pair_list.hpp>

#include <tsubu/core/error.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/neighbor/detail/growing.hpp>
#include <tsubu/neighbor/reach.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "support/counted_memory.hpp"
#include "unit/neighbor/near_points.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <vector>

namespace {

template <std::size_t D, class Real>
using points = near_points::points<D, Real>;

static_assert(tsubu::point_positions<points<3, double>>);
static_assert(tsubu::point_positions<std::span<const tsubu::vec<1, float>>>);
static_assert(tsubu::point_positions<std::span<const double[2]>>);
static_assert(!tsubu::point_positions<points<4, double>>);
static_assert(!tsubu::point_positions<points<3, int>>);
static_assert(!tsubu::point_positions<std::vector<double>>);
static_assert(!tsubu::point_positions<int>);

TEMPLATE_TEST_CASE_SIG("a pair list has each pair once, of which one is owned", "[neighbor][pair_list]",
                       ((std::size_t D, class Real), D, Real), (1, double), (2, double), (3, double), (1, float),
                       (2, float), (3, float)) {
    for (const auto& cloud : near_points::clouds<D, Real>())
        for (const auto owned : near_points::parts_of(cloud.x.size())) {
            INFO(cloud.name << ", " << owned << " owned");
            const tsubu::same_reach reach{cloud.reach};
            tsubu::pair_list list;
            list.build(cloud.x, owned, reach);
            // Strictly: a list that had a pair twice, or j before i, or a ghost first, is another.
            CHECK(near_points::difference(list, near_points::by_comparing_all(cloud.x, owned, reach)) == "");
            CHECK(list.size() == list.pairs().size());
        }
}

TEMPLATE_TEST_CASE_SIG("a pair list reaches as far as two radii and the skin", "[neighbor][pair_list]",
                       ((std::size_t D, class Real), D, Real), (2, double), (3, double), (3, float)) {
    for (const auto& cloud : near_points::clouds<D, Real>()) {
        if (cloud.reach != 1 || cloud.x.empty()) continue;
        const auto radii = near_points::radii<double>(cloud.x.size());
        for (const double skin : {0.0, 0.25}) {
            INFO(cloud.name << ", a skin of " << skin);
            const tsubu::radii_reach<> reach{radii, skin};
            tsubu::pair_list list;
            list.build(cloud.x, cloud.x.size() * 3 / 4, reach);
            const auto wanted = near_points::by_comparing_all(cloud.x, cloud.x.size() * 3 / 4, reach);
            CHECK(near_points::difference(list, wanted) == "");
        }
    }
}

// Where the number of a cell is rounded, two points may be put two cells apart that are nearer than the reach: one just
// below the border of a cell, the other as far above it as is near.
TEMPLATE_TEST_CASE("pairs just inside the reach are found wherever they are", "[neighbor][pair_list]", float, double) {
    using limits = std::numeric_limits<TestType>;
    for (const auto start : {TestType(0), TestType(1000), TestType(-3e6)})
        for (const auto reach : {TestType(0.1), TestType(1) / 3, TestType(0.7), TestType(1) + limits::epsilon()}) {
            points<1, TestType> x{{start}};
            for (int cell = 1; cell < 1000; ++cell) {
                auto below = start + static_cast<TestType>(cell) * reach;
                for (int places = 0; places < 3; ++places) {
                    auto above = below + reach;
                    while (!((above - below) * (above - below) < reach * reach))
                        above = std::nextafter(above, -limits::infinity());
                    x.push_back({below});
                    x.push_back({above});
                    below = std::nextafter(below, -limits::infinity());
                }
            }
            tsubu::pair_list list;
            list.build(x, x.size(), tsubu::same_reach{static_cast<double>(reach)});
            INFO("from " << start << ", reach " << reach);
            const auto found = near_points::sorted(list);
            std::size_t missing = 0;
            for (std::size_t i = 1; i < x.size(); i += 2)
                missing += !std::binary_search(found.begin(), found.end(), near_points::pair(i, i + 1));
            CHECK(missing == 0);
        }
}

TEST_CASE("sorted points have sorted pairs, and the order depends on the input alone", "[neighbor][pair_list]") {
    auto x = near_points::scattered<1, double>(500, 200, 8);
    std::sort(x.begin(), x.end());
    tsubu::pair_list list;
    list.build(x, x.size(), tsubu::same_reach{1});
    REQUIRE(list.size() > 500);
    for (std::size_t p = 1; p < list.size(); ++p) REQUIRE(list.pairs()[p - 1].i <= list.pairs()[p].i);

    const auto y = near_points::scattered<3, double>(2000, 8, 9);
    list.build(y, 1500, tsubu::same_reach{1});
    tsubu::pair_list again;
    again.build(y, 1500, tsubu::same_reach{1});
    REQUIRE(list.size() == again.size());
    for (std::size_t p = 0; p < list.size(); ++p) {
        REQUIRE(list.pairs()[p].i == again.pairs()[p].i);
        REQUIRE(list.pairs()[p].j == again.pairs()[p].j);
    }
}

/// Counts how often two are compared.
struct counted_reach {
    double distance;
    std::size_t* count;

    double greatest(std::size_t) const { return distance; }
    template <class Real>
    Real square(tsubu::index_t, tsubu::index_t) const noexcept {
        ++*count;
        return static_cast<Real>(distance * distance);
    }
};

// Cells that all of them fit in would have most particles in one of them.
TEMPLATE_TEST_CASE("a few far away do not make the others be compared with each other", "[neighbor][pair_list]", float,
                   double) {
    const auto near = near_points::scattered<3, TestType>(4000, 16, 13);
    std::size_t least = 0;
    tsubu::pair_list list;
    list.build(near, near.size(), counted_reach{1, &least});
    CHECK(least < 30 * near.size());
    for (const double away : {1e2, 1e4, 1e9, 1e30}) {
        auto x = near;
        for (std::size_t i = 0; i < 20; ++i) x[i * 100][i % 3] = static_cast<TestType>(i < 15 ? away : -away * 1e-2);
        std::size_t count = 0;
        list.build(x, x.size(), counted_reach{1, &count});
        INFO(away);
        CHECK(count < 2 * least);
        CHECK(near_points::difference(list, near_points::by_comparing_all(x, x.size(), tsubu::same_reach{1})) == "");
    }
}

TEST_CASE("a pair list takes the columns of a store, and arrays", "[neighbor][pair_list]") {
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>>, tsubu::aos> grains;
    for (int i = 0; i < 4; ++i) grains.push_back(tsubu::id = i, tsubu::position<3> = {0.9 * i, 0, 0});
    tsubu::pair_list list;
    list.build(grains[tsubu::position<3>], grains.owned_count(), tsubu::same_reach{1});
    CHECK(list.size() == 3);

    const float plain[3][2] = {{0, 0}, {0, 1}, {1, 1}};
    list.build(std::span<const float[2]>(plain), 3, tsubu::same_reach{1.1});
    CHECK(list.size() == 2);
}

TEST_CASE("memory is 8 to 9 bytes per pair", "[neighbor][pair_list]") {
    const auto x = near_points::scattered<3, double>(20000, 27, 10);
    tsubu::pair_list list;
    CHECK(list.memory_bytes() == 0);
    for (const double reach : {1.2, 0.5, 1.2, 1.19}) {
        list.build(x, x.size(), tsubu::same_reach{reach});
        CHECK(list.memory_bytes() >= 8 * list.size());
        CHECK(list.memory_bytes() <= 9 * list.size() + 600);
    }
    list.build(x, 0, tsubu::same_reach{1});
    CHECK(list.memory_bytes() == 0);
}

TEST_CASE("what is refused is named, and the list stays", "[neighbor][pair_list]") {
    constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
    constexpr auto infinite = std::numeric_limits<double>::infinity();
    const points<2, double> x{{0, 0}, {0, 1}, {3, 3}, {3, 2.5}};
    tsubu::pair_list list;
    list.build(x, 3, tsubu::same_reach{1.5});
    const auto before = near_points::sorted(list);
    REQUIRE(before.size() == 2);
    const auto refused = [&](const auto& points, std::size_t owned, double reach) {
        return thrown<tsubu::input_error>([&] { list.build(points, owned, tsubu::same_reach{reach}); });
    };
    for (const double wrong : {nan, infinite, -infinite})
        for (const std::size_t i : {0U, 2U, 3U})
            for (const std::size_t k : {0U, 1U}) {
                auto y = x;
                y[i][k] = wrong;
                const auto text = refused(y, 2, 1);
                CHECK(says(text, "tsubu::pair_list::build"));
                CHECK(says(text, "coordinate " + std::to_string(k) + " of particle " + std::to_string(i) + " is "));
                CHECK(says(text, std::isnan(wrong) ? "nan" : "inf"));
            }
    CHECK(says(refused(x, 2, 0), "a distance of 0"));
    CHECK(says(refused(x, 2, -1), "a distance of -1"));
    CHECK(says(refused(x, 2, nan), "a distance of nan"));
    CHECK(says(refused(x, 2, infinite), "a distance of inf"));
    // Squares that are no numbers would find no pairs at all.
    CHECK(says(refused(x, 2, 1e-200), "1e-200, of which the square"));
    CHECK(says(refused(x, 2, 1e200), "1e+200, of which the square"));
    CHECK(says(refused(points<1, float>{{0}, {1e-25F}}, 2, 1e-24), "1e-24, of which the square"));
    CHECK(says(refused(x, 5, 1), "5 owned particles of 4"));
    CHECK(says(thrown<tsubu::limit_error>([] {
                   tsubu::detail::check_list<double>("pair_list::build", std::size_t{1} << 31, 0, 1);
               }),
               "2147483648 particles on one rank; take more ranks"));
    CHECK(says(refused(points<1, double>{{-1.5e308}, {1.5e308}}, 2, 1), "coordinate 0 from -1.5e+308 to 1.5e+308"));
    CHECK(near_points::difference(list, before) == "");
}

TEST_CASE("a list that finds no memory stays", "[neighbor][pair_list]") {
    const auto x = near_points::scattered<3, double>(400, 3, 12);  // crowded: room is made anew, twice
    tsubu::pair_list list;
    list.build(x, 100, tsubu::same_reach{0.5});
    const auto before = near_points::sorted(list);
    tsubu::pair_list other = list;
    const auto needed = counted_memory::times_asked([&] { other.build(x, 400, tsubu::same_reach{2}); });
    REQUIRE(needed > 5);
    for (std::size_t given = 0; given < needed; ++given) {
        counted_memory::granted = given;
        bool has_thrown = false;
        try {
            list.build(x, 400, tsubu::same_reach{2});
        } catch (const std::bad_alloc&) {
            has_thrown = true;
        }
        counted_memory::granted = counted_memory::no_limit;
        REQUIRE(has_thrown);
        REQUIRE(near_points::difference(list, before) == "");
    }
}

// 2^32 pairs take 32 GiB: what counts them is tried with a lower limit.
TEST_CASE("more neighbours than a list can number are refused before they are written", "[neighbor][pair_list]") {
    tsubu::detail::growing<int> values(4, 10, "pair_list::build", "pairs");
    for (int round = 0; round < 3; ++round) {
        auto* to = values.room(3);
        for (int k = 0; k < 3; ++k) *to++ = round;
        values.up_to(to);
    }
    const auto text = thrown<tsubu::limit_error>([&] { static_cast<void>(values.room(2)); });
    CHECK(says(text, "tsubu::pair_list::build: more than 10 pairs on one rank"));
    values.up_to(values.room(1) + 1);
    CHECK(values.size() == 10);
    const auto all = values.take();
    REQUIRE(all.size() == 10);
    CHECK((all[0] == 0 && all[8] == 2));
}

}  // namespace
