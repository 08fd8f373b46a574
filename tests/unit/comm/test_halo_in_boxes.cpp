// SPDX-License-Identifier: MIT
/// @file
/// Ghosts in sheared boxes and sectors.
#include <tsubu/comm/halo.hpp>

#include "halo_on_ranks.hpp"

#include <cstddef>

namespace {

using comm_laws::check_ghosts;
using comm_laws::tilted_box_of;
using comm_laws::wedge_of;

}  // namespace

TEST_CASE("ghosts are the images within the cutoff: in sheared boxes", "[comm][halo]") {
    check_ghosts(tilted_box_of<2>(0.4, 3));
    check_ghosts(tilted_box_of<3>(0.4, 7), {0, 0.2, 1.1});
    check_ghosts(tilted_box_of<3>(1.7, 5), {0.07, 0.5});
}
TEST_CASE("ghosts are the images within the cutoff: in sectors", "[comm][halo]") {
    for (const std::size_t sectors : {2U, 3U, 6U}) check_ghosts(wedge_of(sectors), {0, 0.2, 0.7, 2.2});
}
