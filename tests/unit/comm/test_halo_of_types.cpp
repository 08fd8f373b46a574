// SPDX-License-Identifier: MIT
/// @file
/// Ghosts of other scalars, in other layouts, and without threads.
#include <tsubu/comm/halo.hpp>

#include <tsubu/comm/self_transport.hpp>

#include "halo_on_ranks.hpp"

#include <cstdint>

namespace {

using comm_laws::box_of;
using comm_laws::check_ghosts;
using comm_laws::each_decomposition;
using comm_laws::ghosts_are_images;

}  // namespace

TEST_CASE("ghosts of positions in float and on lattices", "[comm][halo]") {
    check_ghosts(box_of<2, float>(3), {0, 0.3, 1.1});
    check_ghosts(box_of<2, tsubu::lattice<std::int32_t>>(3), {0, 0.3, 1.1});
}
TEST_CASE("ghosts in other layouts", "[comm][halo]") {
    check_ghosts<tsubu::aos>(box_of<2>(3), {0.3, 1.1});
    check_ghosts<tsubu::aosoa<8>>(box_of<2>(1), {0.3});
}
TEST_CASE("a program of one process has ghosts of its own particles", "[comm][halo]") {
    tsubu::self_transport on;
    verdict seen;
    for (const auto cutoff : comm_laws::no_cutoff_to_several_boxes)
        each_decomposition(box_of<2>(3), 1, [&](const auto& parts) { ghosts_are_images(parts, on, cutoff, seen); });
    INFO(seen.first);
    CHECK(seen.broken.empty());
}
