// SPDX-License-Identifier: MIT
/// @file
/// Ghosts on 1 to 8 ranks. What is compiled is dear, so each D, box, pattern, scalar and layout is here once or twice,
/// not in all combinations; all decompositions and numbers of ranks are, for they are found when the program runs.
#include <tsubu/comm/halo.hpp>

#include <tsubu/comm/self_transport.hpp>

#include "comm_laws/halo_laws.hpp"
#include "comm_laws/on_ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace {

using comm_laws::box_of;
using comm_laws::check_on_ranks;
using comm_laws::ghosts_are_images;
using comm_laws::passed;
using comm_laws::some_ranks;
using comm_laws::tilted_box_of;
using comm_laws::wedge_of;

/// Cutoffs from none to several lengths of the box.
using cutoffs = std::initializer_list<double>;

template <class Layout, class Parts>
void check_on_parts(const Parts& parts, passed how, cutoffs some) {
    for (const auto cutoff : some)
        check_on_ranks(parts.ranks(), [&](auto& on, verdict& seen) {
            ghosts_are_images<Layout>(parts, on, how, cutoff, seen);
        });
}
/// In bricks, uneven bricks and bisections.
template <class Layout = tsubu::soa, class Box>
void check_ghosts(const Box& box, cutoffs some) {
    for (const auto ranks : some_ranks)
        comm_laws::each_decomposition(box, ranks, [&](const auto& parts) {
            check_on_parts<Layout>(parts, passed::directly, some);
        });
}
/// By all patterns.
template <class Layout = tsubu::soa, class Box>
void check_bricks(const Box& box, cutoffs some) {
    for (const auto ranks : some_ranks)
        comm_laws::each_kind_of_bricks(box, ranks, [&](const auto& parts) {
            check_on_parts<Layout>(parts, passed::directly, some);
            check_on_parts<Layout>(parts, passed::in_stages, some);
        });
}

}  // namespace

TEST_CASE("ghosts are the images within the cutoff: along a line", "[comm][halo]") {
    check_ghosts<tsubu::aosoa<8>>(box_of<1, float>(1), {0, 0.07, 0.4, 1.1, 2.5});
    check_ghosts<tsubu::aosoa<8>>(box_of<1, float>(0), {0, 0.07, 0.4, 1.1, 2.5});
    check_bricks(box_of<1>(1), {0, 0.07, 0.4, 1.1, 2.5});
    check_bricks(box_of<1>(0), {0, 0.07, 0.4, 1.1, 2.5});
}
TEST_CASE("ghosts are the images within the cutoff: in a plane", "[comm][halo]") {
    check_ghosts(box_of<2>(3), {0, 0.07, 0.4, 1.1, 2.5});
    check_ghosts(box_of<2>(2), {0, 0.07, 0.4, 1.1, 2.5});
}
TEST_CASE("ghosts are the images within the cutoff: in space", "[comm][halo]") {
    check_bricks(box_of<3>(7), {0, 0.07, 0.4, 1.1, 2.5});
    check_bricks(box_of<3>(1), {0.2, 1.1});
}
TEST_CASE("ghosts are the images within the cutoff: in sheared boxes", "[comm][halo]") {
    check_bricks<tsubu::aos>(tilted_box_of<2>(0.4, 3), {0, 0.07, 0.4, 1.1, 2.5});
    check_ghosts(tilted_box_of<3>(0.4, 7), {0, 0.2, 1.1});
    check_ghosts(tilted_box_of<3>(1.7, 5), {0.07, 0.5});
}
TEST_CASE("ghosts are the images within the cutoff: in sectors", "[comm][halo]") {
    for (const std::size_t sectors : {2U, 3U, 6U}) check_ghosts(wedge_of(sectors), {0, 0.2, 0.7, 2.2});
}
TEST_CASE("ghosts are the images within the cutoff: on a lattice", "[comm][halo]") {
    check_ghosts(box_of<2, tsubu::lattice<std::int32_t>>(3), {0, 0.3, 1.1});
}
TEST_CASE("a program of one process has ghosts of its own particles", "[comm][halo]") {
    tsubu::self_transport on;
    verdict seen;
    const auto parts = comm_laws::bisection_of(box_of<2>(3), 1);
    for (const auto cutoff : {0.0, 0.07, 0.4, 1.1, 2.5})
        ghosts_are_images(parts, on, passed::directly, cutoff, seen);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 0);
}
TEST_CASE("a halo that cannot be is refused on all ranks", "[comm][halo]") {
    const auto box = box_of<3>(3);
    for (const auto ranks : some_ranks) {
        const auto bricks = comm_laws::bricks_of(box, ranks);
        const auto more = comm_laws::bricks_of(box, ranks + 1);
        for (const auto how : {passed::directly, passed::in_stages})
            check_on_ranks(ranks, [&](auto& on, verdict& seen) {
                comm_laws::ghosts_of all(bricks, on, how, 0.3, 5, 40, seen);
                all.examine_refusals(more);
            });
    }
}
