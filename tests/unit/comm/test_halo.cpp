// SPDX-License-Identifier: MIT
/// @file
/// Ghosts in boxes with right angles, and what make_halo refuses.
#include <tsubu/comm/halo.hpp>

#include "halo_on_ranks.hpp"

namespace {

using comm_laws::box_of;
using comm_laws::check_ghosts;
using comm_laws::check_on_ranks;
using comm_laws::some_ranks;

}  // namespace

TEST_CASE("ghosts are the images within the cutoff: along a line", "[comm][halo]") {
    check_ghosts(box_of<1>(1));
    check_ghosts(box_of<1>(0));
}
TEST_CASE("ghosts are the images within the cutoff: in a plane", "[comm][halo]") {
    check_ghosts(box_of<2>(3));
    check_ghosts(box_of<2>(2));
}
TEST_CASE("ghosts are the images within the cutoff: in space", "[comm][halo]") {
    check_ghosts(box_of<3>(7));
    check_ghosts(box_of<3>(1), {0.2, 1.1});
}
TEST_CASE("a halo that cannot be is refused on all ranks", "[comm][halo]") {
    const auto box = box_of<2>(3);
    for (const auto ranks : some_ranks) {
        const tsubu::brick_decomposition<2> bricks(box, ranks);
        const tsubu::brick_decomposition<2> more(box, ranks + 1);
        const auto check = [&](const auto& pattern) {
            check_on_ranks(ranks, [&](auto& on, verdict& seen) {
                comm_laws::ghosts_of all(bricks, on, pattern, 0.3, 5, 40, seen);
                all.examine_refusals(more);
            });
        };
        check(tsubu::direct_pattern{});
        check(tsubu::staged_pattern{});
    }
}
