// SPDX-License-Identifier: MIT
#include <tsubu/domain/rank_grid.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <array>
#include <cstddef>
#include <limits>

using tsubu::rank_grid;
using tsubu::vec;
using grid2 = std::array<std::size_t, 2>;
using grid3 = std::array<std::size_t, 3>;

TEST_CASE("a cube is divided as evenly as the ranks allow, first axis first", "[domain][rank_grid]") {
    const vec<3> cube{1, 1, 1};
    CHECK(rank_grid<3>(1, cube) == grid3{1, 1, 1});
    CHECK(rank_grid<3>(2, cube) == grid3{2, 1, 1});
    CHECK(rank_grid<3>(4, cube) == grid3{2, 2, 1});
    CHECK(rank_grid<3>(6, cube) == grid3{3, 2, 1});
    CHECK(rank_grid<3>(7, cube) == grid3{7, 1, 1});
    CHECK(rank_grid<3>(8, cube) == grid3{2, 2, 2});
    CHECK(rank_grid<3>(12, cube) == grid3{3, 2, 2});
    CHECK(rank_grid<3>(64, cube) == grid3{4, 4, 4});
    CHECK(rank_grid<2>(12, vec<2>{1, 1}) == grid2{4, 3});
    CHECK(rank_grid<1>(5, vec<1>{1}) == std::array<std::size_t, 1>{5});
}

TEMPLATE_TEST_CASE("equal grids are equal whatever was rounded", "[domain][rank_grid]", double, float) {
    for (const double edge : {1.0, 0.1, 0.7, 1.0 / 3, 1e-30, 1e30})
        for (std::size_t ranks = 1; ranks <= 64; ++ranks) {
            vec<3, TestType> cube{};
            cube.fill(static_cast<TestType>(edge));
            vec<2, TestType> square{};
            square.fill(static_cast<TestType>(edge));
            const auto in_space = rank_grid<3>(ranks, cube);
            CAPTURE(edge, ranks, in_space);
            CHECK(in_space == rank_grid<3>(ranks, vec<3, TestType>{1, 1, 1}));
            CHECK((in_space[0] >= in_space[1] && in_space[1] >= in_space[2]));
            CHECK(rank_grid<2>(ranks, square) == rank_grid<2>(ranks, vec<2, TestType>{1, 1}));
        }
}

TEST_CASE("a long box is divided along its length, at every scale", "[domain][rank_grid]") {
    for (const double scale : {1e-300, 1e-7, 1.0, 1e9, 1e300}) {
        CHECK(rank_grid<3>(8, vec<3>{scale, scale, 100 * scale}) == grid3{1, 1, 8});
        CHECK(rank_grid<3>(4, vec<3>{scale, scale, scale / 1000}) == grid3{2, 2, 1});
        CHECK(rank_grid<2>(6, vec<2>{scale, 10 * scale}) == grid2{1, 6});
    }
    CHECK(rank_grid<2>(6, vec<2>{1e-300, 1e300}) == grid2{1, 6});
}

TEST_CASE("no other grid has less surface", "[domain][rank_grid]") {
    for (const auto& extents : {vec<3>{1, 1, 1}, vec<3>{1, 2, 3}, vec<3>{5, 0.3, 1}})
        for (std::size_t ranks = 1; ranks <= 64; ++ranks) {
            const auto surface = [&](const grid3& grid) {
                const double x = extents[0] / static_cast<double>(grid[0]);
                const double y = extents[1] / static_cast<double>(grid[1]);
                const double z = extents[2] / static_cast<double>(grid[2]);
                return x * y + y * z + z * x;
            };
            const auto best = rank_grid<3>(ranks, extents);
            CHECK(best[0] * best[1] * best[2] == ranks);
            for (std::size_t a = 1; a <= ranks; ++a)
                for (std::size_t b = 1; a * b <= ranks; ++b)
                    if (ranks % (a * b) == 0) CHECK(surface(best) <= surface({a, b, ranks / a / b}) * (1 + 1e-13));
        }
}

TEST_CASE("no ranks and no box are refused", "[domain][rank_grid][input]") {
    CHECK(says(thrown<tsubu::input_error>([] {
                   static_cast<void>(rank_grid<2>(0, vec<2>{1, 1}));
               }),
               "tsubu::rank_grid: 0 ranks; ask for at least 1"));
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto text = thrown<tsubu::input_error>([&] { static_cast<void>(rank_grid<2>(2, vec<2>{1, bad})); });
        INFO(text);
        CHECK(says(text, "the extent " + tsubu::detail::shown(bad) + " of axis 1; give finite lengths above 0"));
    }
}

TEST_CASE("the grid of very many ranks is found at once", "[domain][rank_grid]") {
    CHECK(tsubu::rank_grid<1, double>(999'999'937, {1}) == std::array<std::size_t, 1>{999'999'937});
    const auto grid = tsubu::rank_grid<3, double>(367'567'200, {1, 1, 1});
    CHECK(grid[0] * grid[1] * grid[2] == 367'567'200);
    CHECK(grid[0] < 2 * grid[2]);  // close to a cube
}
