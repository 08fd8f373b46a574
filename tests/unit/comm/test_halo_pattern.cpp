// SPDX-License-Identifier: MIT
#include <tsubu/comm/halo_pattern.hpp>

#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/domain/wedge.hpp>

#include "support/catch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using bricks = tsubu::brick_decomposition<2>;
using in_triclinic = tsubu::cell_decomposition<tsubu::triclinic_box<2>, bricks>;
using in_wedge = tsubu::cell_decomposition<tsubu::wedge<>, tsubu::brick_decomposition<3>>;
using on_lattice = tsubu::brick_decomposition<2, tsubu::lattice<std::int32_t>>;

static_assert(tsubu::halo_pattern<tsubu::staged_pattern, bricks>);
static_assert(tsubu::halo_pattern<tsubu::staged_pattern, in_triclinic>);
// Where images turn, or have no numbers outside the box, nothing can be passed on.
static_assert(!tsubu::halo_pattern<tsubu::staged_pattern, in_wedge>);
static_assert(!tsubu::halo_pattern<tsubu::staged_pattern, on_lattice>);
static_assert(tsubu::halo_pattern<tsubu::direct_pattern, in_wedge>);
static_assert(tsubu::halo_pattern<tsubu::direct_pattern, on_lattice>);

bricks grid(std::array<std::size_t, 2> along, std::array<bool, 2> periodic = {true, true}) {
    return {tsubu::domain<2>({0, 0}, {1, 1}, {.periodic = periodic}), along};
}

}  // namespace

TEST_CASE("the direct pattern has one step, for the neighbours of the decomposition", "[comm][halo_pattern]") {
    const auto parts = grid({4, 4});
    const auto steps = tsubu::direct_pattern{}.plan(parts, 5, 0.1);
    REQUIRE(steps.size() == 1);
    CHECK(steps[0].askers.size() == 8);
    CHECK(steps[0].askers.size() == parts.neighbors(5, 0.1).size());
    for (const auto& one : steps[0].askers) CHECK(one.shift == tsubu::image_shift<2>{});
}
TEST_CASE("the direct pattern moves images to where they are asked for", "[comm][halo_pattern]") {
    // What is in the first brick is an image above the last one.
    const auto steps = tsubu::direct_pattern{}.plan(grid({4, 1}, {true, false}), 0, 0.1);
    REQUIRE(steps[0].askers.size() == 2);
    CHECK(steps[0].askers[0].rank == 1);
    CHECK(steps[0].askers[0].shift == tsubu::image_shift<2>{0, 0});
    CHECK(steps[0].askers[1].rank == 3);
    CHECK(steps[0].askers[1].shift == tsubu::image_shift<2>{1, 0});
}
TEST_CASE("the staged pattern has two steps per axis, and as many hops as the cutoff is bricks long",
          "[comm][halo_pattern]") {
    const auto hops = [](const bricks& parts, double cutoff) {
        return tsubu::staged_pattern{}.plan(parts, 0, cutoff).size();
    };
    CHECK(hops(grid({4, 4}), 0.1) == 4);
    CHECK(hops(grid({4, 4}), 0.24) == 4);
    CHECK(hops(grid({4, 4}), 0.26) == 8);
    CHECK(hops(grid({4, 4}), 0.6) == 12);
    CHECK(hops(grid({1, 1}), 2.5) == 12);
    CHECK(hops(grid({1, 1}, {false, false}), 2.5) == 0);
    CHECK(hops(grid({4, 1}, {false, true}), 0.1) == 4);
    CHECK(hops(grid({4, 1}, {false, true}), 9.9) == 6 + 2 * 10);
}
TEST_CASE("all ranks plan as many steps, of which each has one rank to send to at most", "[comm][halo_pattern]") {
    const tsubu::domain<2> box({0, 0}, {1, 1}, {.periodic = {true, false}});
    const bricks uneven(box, std::array{tsubu::cuts<double>(box.along(0), {0.05, 0.1}),
                                        tsubu::cuts<double>(box.along(1), {0.7})});
    const auto first = tsubu::staged_pattern{}.plan(uneven, 0, 0.3);
    for (std::size_t rank = 0; rank < uneven.ranks(); ++rank) {
        const auto steps = tsubu::staged_pattern{}.plan(uneven, static_cast<tsubu::rank_t>(rank), 0.3);
        REQUIRE(steps.size() == first.size());
        for (std::size_t k = 0; k < steps.size(); ++k) {
            CHECK(steps[k].askers.size() <= 1);
            CHECK(steps[k].from < steps[k].to);
            CHECK(steps[k].to <= k + 1);  // groups that are there by then
            CHECK((steps[k].from == first[k].from && steps[k].to == first[k].to));
        }
    }
}
