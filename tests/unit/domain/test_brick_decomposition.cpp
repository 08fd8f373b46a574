// SPDX-License-Identifier: MIT
#include <tsubu/domain/brick_decomposition.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using tsubu::brick_decomposition;
using tsubu::cuts;
using tsubu::domain;
using tsubu::image_shift;
using tsubu::lattice;
using tsubu::neighbor_rank;
using tsubu::vec;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
using grid3 = std::array<std::size_t, 3>;

const domain<3> closed_cube{{0, 0, 0}, {1, 1, 1}};
const domain<3> periodic_cube{{0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, true}}};

template <std::size_t D>
std::size_t count_of(const std::vector<neighbor_rank<D>>& found, tsubu::rank_t rank, const image_shift<D>& shift) {
    return static_cast<std::size_t>(std::count(found.begin(), found.end(), neighbor_rank<D>{rank, shift}));
}

}  // namespace

TEST_CASE("ranks are numbered with the last axis fastest", "[domain][brick]") {
    const brick_decomposition<3> bricks(closed_cube, grid3{2, 3, 4});
    CHECK(bricks.ranks() == 24);
    CHECK(bricks.rank_at({1, 2, 3}) == 23);
    CHECK(bricks.rank_at({0, 1, 0}) == 4);
    for (std::size_t rank = 0; rank < 24; ++rank) CHECK(bricks.rank_at(bricks.place(rank)) == rank);
    CHECK(bricks.subdomain(23).lo() == vec<3>{0.5, bricks.along(1).begin(2), 0.75});
    CHECK(bricks.subdomain(23).hi() == vec<3>{1, 1, 1});
    CHECK(brick_decomposition<3>(closed_cube, 12).along(0).parts() == 3);
}

TEST_CASE("a point beyond the box has one extended owner", "[domain][brick][B4][B5][F3]") {
    const brick_decomposition<3> two(closed_cube, grid3{2, 1, 1});
    const vec<3> on_the_cut{0.5, 0.5, 0.5};
    CHECK_FALSE(two.subdomain(0).owns_extended(on_the_cut));
    CHECK(two.subdomain(1).owns_extended(on_the_cut));
    CHECK(two.owner(on_the_cut) == 1);
    const brick_decomposition<3> one(closed_cube, 1);
    CHECK(one.subdomain(0).owns_extended({-100, 0.5, 7}));
    CHECK_FALSE(one.subdomain(0).owns({-100, 0.5, 7}));
    const brick_decomposition<1> three({{0}, {3}}, 3);
    CHECK(three.subdomain(1).owns_extended({1}));
    CHECK_FALSE(three.subdomain(1).owns_extended({2}));
    CHECK(three.owner({-1e300}) == 0);
    CHECK(three.owner({1e300}) == 2);
}

TEST_CASE("x at the upper face: of a closed axis the last rank's, of a periodic one the first's",
          "[domain][brick][B3][F3]") {
    for (const double hi : {1.0, 134217728.0, 1e9, 2e-13, 1e-7}) {
        const brick_decomposition<1> closed({{0}, {hi}}, 4);
        CHECK(closed.subdomain(3).owns({hi}));
        CHECK(closed.owner({hi}) == 3);
        const domain<1> around{{0}, {hi}, {.periodic = {true}}};
        const brick_decomposition<1> periodic(around, 4);
        for (std::size_t rank = 0; rank < 4; ++rank) CHECK_FALSE(periodic.subdomain(rank).owns({hi}));
        CHECK(periodic.owner(around.wrap({hi}).position) == 0);
    }
}

TEST_CASE("two ranks on a periodic axis meet at both faces", "[domain][brick][neighbors][F4]") {
    const brick_decomposition<1> two({{0}, {1}, {.periodic = {true}}}, 2);
    const auto found = two.neighbors(0, 0.1);
    CHECK(found == std::vector<neighbor_rank<1>>{{1, {-1}}, {1, {0}}});  // left and right, once each
    CHECK(two.neighbors(1, 0.1) == std::vector<neighbor_rank<1>>{{0, {0}}, {0, {1}}});
}

TEST_CASE("one rank on a periodic axis is its own neighbour, shifted; on a closed one alone",
          "[domain][brick][neighbors][F4]") {
    const brick_decomposition<1> periodic({{0}, {1}, {.periodic = {true}}}, 1);
    CHECK(periodic.neighbors(0, 0) == std::vector<neighbor_rank<1>>{{0, {-1}}, {0, {1}}});
    CHECK(periodic.neighbors(0, 0.6) == std::vector<neighbor_rank<1>>{{0, {-1}}, {0, {1}}});
    CHECK(periodic.neighbors(0, 2.3).size() == 6);  // three images on each side
    const brick_decomposition<1> closed({{0}, {1}}, 1);
    for (const double cutoff : {0.0, 0.6, 2.3, 1e300}) CHECK(closed.neighbors(0, cutoff).empty());
}

TEST_CASE("cutoffs below, at and above a sub-box", "[domain][brick][neighbors][F4]") {
    const brick_decomposition<1> eight({{0}, {1}, {.periodic = {true}}}, 8);
    CHECK(eight.neighbors(3, 0) == std::vector<neighbor_rank<1>>{{2, {0}}, {4, {0}}});
    CHECK(eight.neighbors(3, 0.12) == std::vector<neighbor_rank<1>>{{2, {0}}, {4, {0}}});
    CHECK(eight.neighbors(3, 0.125).size() == 4);  // exactly: the next but one touches
    CHECK(eight.neighbors(3, 2.5 * 0.125).size() == 6);
    CHECK(eight.neighbors(3, 0.51).size() == 10);  // rank 7 on both sides, above half a box
    CHECK(count_of(eight.neighbors(3, 0.51), 7, {0}) == 1);
    CHECK(count_of(eight.neighbors(3, 0.51), 7, {-1}) == 1);
    CHECK(count_of(eight.neighbors(3, 1.0), 3, {1}) == 1);
}

TEST_CASE("corners are neighbours as far as the cutoff, no farther", "[domain][brick][neighbors]") {
    const brick_decomposition<3> bricks(periodic_cube, grid3{4, 4, 4});
    const auto middle = bricks.rank_at({1, 1, 1});
    CHECK(bricks.neighbors(middle, 0.1).size() == 26);
    // Two bricks on along two axes: a gap of 0.25 along each, 0.354 in all.
    CHECK(count_of(bricks.neighbors(middle, 0.3), bricks.rank_at({3, 3, 1}), {0, 0, 0}) == 0);
    CHECK(count_of(bricks.neighbors(middle, 0.36), bricks.rank_at({3, 3, 1}), {0, 0, 0}) == 1);
    const auto corner = bricks.neighbors(0, 0.1);
    CHECK(count_of(corner, bricks.rank_at({3, 3, 3}), {-1, -1, -1}) == 1);
    CHECK(count_of(corner, bricks.rank_at({3, 0, 1}), {-1, 0, 0}) == 1);
}

TEST_CASE("a thin axis that is not periodic does not limit the cutoff", "[domain][brick][neighbors]") {
    const domain<3> film{{0, 0, 0}, {1, 1, 1e-9}, {.periodic = {true, true, false}}};
    CHECK(brick_decomposition<3>(film, grid3{4, 4, 1}).neighbors(0, 0.1).size() == 8);
}

TEST_CASE("a cutoff that is negative, not a number or too many periods is refused",
          "[domain][brick][neighbors][input]") {
    const brick_decomposition<3> bricks(periodic_cube, 4);
    for (const double bad : {-1.0, -1e-300, not_a_number, infinity}) {
        const auto text = thrown<tsubu::input_error>([&] { static_cast<void>(bricks.neighbors(0, bad)); });
        INFO(text);
        CHECK(says(text, "tsubu::brick_decomposition::neighbors: the cutoff " + tsubu::detail::shown(bad) +
                             "; give a finite"));
    }
    CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(bricks.neighbors(0, 1e7)); }),
               "more than 2^20 periods"));
}

TEST_CASE("a rank that does not exist is refused", "[domain][brick][input]") {
    const brick_decomposition<3> bricks(periodic_cube, 4);
    CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(bricks.subdomain(4)); }),
               "tsubu::brick_decomposition::subdomain: rank 4 of 4; ranks count from 0"));
    CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(bricks.neighbors(9, 0.1)); }), "rank 9 of 4"));
}

TEST_CASE("more ranks than cells, and grids of nothing, are refused", "[domain][brick][input][F3]") {
    const domain<1> few{{1e16}, {1e16 + 4}};
    CHECK(says(thrown<tsubu::input_error>([&] { brick_decomposition<1>(few, 8); }),
               "at most as many parts as it has numbers"));
    CHECK_NOTHROW(brick_decomposition<1>(few, 2));
    CHECK(says(thrown<tsubu::input_error>([&] { brick_decomposition<3>(closed_cube, 0); }), "0 ranks"));
    CHECK(says(thrown<tsubu::input_error>([&] { brick_decomposition<3>(closed_cube, grid3{2, 0, 1}); }), "0 parts"));
}

TEST_CASE("cuts of another axis are refused", "[domain][brick][input]") {
    const domain<1> box{{0}, {1}};
    const cuts<double> own(box.along(0), std::vector<double>{0.1, 0.3});
    CHECK(brick_decomposition<1>(box, std::array{own}).owner({0.2}) == 1);
    const cuts<double> other(tsubu::axis<double>(0, 2, false), 2);
    const auto text = thrown<tsubu::input_error>([&] { brick_decomposition<1>(box, std::array{other}); });
    INFO(text);
    CHECK(says(text, "the cuts for axis 0 are of an axis from 0 to 2; make them with domain::along(k)"));
    const cuts<double> around(tsubu::axis<double>(0, 1, true), 2);  // half-open: another axis, too
    CHECK_THROWS_AS(brick_decomposition<1>(box, std::array{around}), tsubu::input_error);
}

TEST_CASE("a lattice has the same owner for an image as for the point", "[domain][brick][lattice]") {
    using box_type = domain<2, lattice<std::int64_t>>;
    const box_type box{{0, 0}, {1, 1}, {.periodic = {true, true}}};
    const brick_decomposition<2, lattice<std::int64_t>> bricks(box, 6);
    for (const double x : {0.0, 0.1, 0.33, 0.75})
        CHECK(bricks.owner(box.from_real({x, 0.5}).position) == bricks.owner(box.from_real({x + 4, -0.5}).position));
}

TEST_CASE("more bricks than a communicator has ranks are refused", "[domain][bricks][input]") {
    const auto text = thrown<tsubu::input_error>([] {
        static_cast<void>(brick_decomposition<3>(closed_cube, grid3{100'000, 100'000, 1}));
    });
    INFO(text);
    CHECK(says(text, "tsubu::brick_decomposition: 1e+10 bricks; make at most 2^31 - 1"));
}
