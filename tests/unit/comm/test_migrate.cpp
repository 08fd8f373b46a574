// SPDX-License-Identifier: MIT
#include <tsubu/comm/migrate.hpp>

#include <tsubu/comm/self_transport.hpp>

#include "comm_laws/migrate_laws.hpp"
#include "comm_laws/on_ranks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using comm_laws::at_first;
using comm_laws::box_of;
using comm_laws::check_on_ranks;
using comm_laws::each_decomposition;
using comm_laws::migrate_keeps_all;
using comm_laws::some_ranks;
using comm_laws::tilted_box_of;
using comm_laws::wedge_of;

template <class Layout = tsubu::soa, class Box>
void check_motion(const Box& box, at_first first = at_first::everyone) {
    for (const auto ranks : some_ranks)
        each_decomposition(box, ranks, [&](const auto& parts) {
            check_on_ranks(ranks, [&](auto& on, verdict& seen) {
                migrate_keeps_all<Layout>(parts, on, ranks, 50, 21, seen, first);
            });
        });
}
/// @param axis  whose faces are not periodic
template <class Layout = tsubu::soa, class Box>
void check_losses(const Box& box, std::size_t axis) {
    for (const auto ranks : some_ranks)
        each_decomposition(box, ranks, [&](const auto& parts) {
            check_on_ranks(ranks, [&](auto& on, verdict& seen) {
                comm_laws::migrate_settles_the_lost<Layout>(parts, on, ranks, axis, seen);
            });
        });
}

}  // namespace

TEST_CASE("leavers are sorted by rank, in their order, for any number of ranks", "[comm][migrate]") {
    tsubu::message_memory memory;
    for (const std::size_t ranks : {1U, 2U, 255U, 256U, 257U, 65536U, 65537U, 20'000'000U}) {
        CAPTURE(ranks);
        auto all = memory.take<tsubu::detail::leaver>(1000);
        std::vector<tsubu::detail::leaver> expected;
        std::uint64_t state = 1;
        for (std::size_t k = 0; k < all.size(); ++k) {
            state = state * 6364136223846793005U + 1442695040888963407U;
            // Few ranks, far apart, so that each has several leavers.
            const auto to = static_cast<tsubu::rank_t>((state >> 33) % 100 * ((ranks + 99) / 100) % ranks);
            expected.push_back(all[k] = {to, static_cast<tsubu::index_t>(k)});
        }
        std::stable_sort(expected.begin(), expected.end(), [](auto& a, auto& b) { return a.to < b.to; });
        tsubu::detail::sort_by_rank(all, ranks, memory);
        REQUIRE(all.size() == expected.size());
        bool is_sorted = true;
        for (std::size_t k = 0; k < all.size(); ++k)
            is_sorted = is_sorted && all[k].to == expected[k].to && all[k].index == expected[k].index;
        CHECK(is_sorted);
    }
}

// Layouts and boxes are met in pairs, not in all combinations: what is compiled is dear.
TEST_CASE("no particle is lost or doubled in boxes with right angles", "[comm][migrate]") {
    check_motion<tsubu::aosoa<8>>(box_of<1>(1));
    check_motion(box_of<2>(1));
    check_motion(box_of<3>(7));
}
TEST_CASE("no particle is lost or doubled in boxes that are sheared, or sectors", "[comm][migrate]") {
    check_motion<tsubu::aos>(tilted_box_of<2>(0.4, 3));
    check_motion(tilted_box_of<3>(1.7, 5));
    check_motion(wedge_of(2));
    check_motion(wedge_of(6));
}
TEST_CASE("particles of all scalars migrate", "[comm][migrate]") {
    check_motion(box_of<2, float>(3));
    check_motion(box_of<3, tsubu::lattice<std::int32_t>>(7));
    check_motion(box_of<2, tsubu::lattice<std::int64_t>>(3));
}
TEST_CASE("one rank that has all particles sends them to the others", "[comm][migrate]") {
    check_motion(box_of<2>(3), at_first::the_last_rank);
    check_motion(box_of<3>(7), at_first::owners);
}
TEST_CASE("few particles leave most ranks empty", "[comm][migrate]") {
    const auto box = box_of<3>(7);
    each_decomposition(box, 8, [&](const auto& parts) {
        for (const std::size_t count : {1U, 2U, 5U})
            check_on_ranks(8, [&](auto& on, verdict& seen) { migrate_keeps_all(parts, on, count, count, 30, seen); });
    });
}
TEST_CASE("a program of one process migrates without threads", "[comm][migrate]") {
    tsubu::self_transport on;
    verdict seen;
    migrate_keeps_all(comm_laws::bisection_of(box_of<3>(5), 1), on, 3, 50, 40, seen);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 0);
}
TEST_CASE("particles that have left the box are refused, collected or clamped", "[comm][migrate]") {
    check_losses<tsubu::aosoa<8>>(box_of<1>(0), 0);
    check_losses(box_of<2, float>(2), 0);
    check_losses(box_of<3>(3), 2);
    check_losses<tsubu::aos>(tilted_box_of<2>(0.4, 1), 1);
    check_losses(tilted_box_of<3>(0.7, 2), 2);
    check_losses(wedge_of(5), 1);
}
TEST_CASE("a decomposition for other ranks is refused on all", "[comm][migrate]") {
    const auto box = box_of<2>(3);
    for (const auto ranks : some_ranks) {
        const comm_laws::any_parts<tsubu::domain<2>> bricks(comm_laws::bricks_of(box, ranks));
        const comm_laws::any_parts<tsubu::domain<2>> more(comm_laws::bricks_of(box, ranks + 1));
        check_on_ranks(ranks, [&](auto& on, verdict& seen) {
            comm_laws::migrations all(bricks, on, 3, 20, at_first::owners, seen);
            all.refuse_other_ranks(more);
        });
    }
}
TEST_CASE("lost particles are not collected where they are lost from", "[comm][migrate]") {
    tsubu::self_transport on;
    const tsubu::brick_decomposition<2> bricks(tsubu::domain<2>({0, 0}, {1, 1}), 1);
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<2>>> g;
    g.push_back(tsubu::position<2> = {2, 0});
    CHECK_THROWS_AS(tsubu::migrate(g, bricks, on, tsubu::collect_lost(g)), tsubu::input_error);
    CHECK(g.owned_count() == 1);
}
TEST_CASE("a clamp that comes to nothing because another rank fails is undone", "[comm][migrate]") {
    std::vector<char> right(2, 0);
    tsubu::run_ranks(2, [&](tsubu::local_transport& on) {
        const tsubu::brick_decomposition<2> bricks(tsubu::domain<2>({0, 0}, {1, 1}, {.periodic = {true, false}}), 2);
        tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<2>>> g;
        const auto nan = std::numeric_limits<double>::quiet_NaN();
        g.push_back(tsubu::position<2> = on.rank() == 0 ? tsubu::vec<2>{1.25, 7} : tsubu::vec<2>{nan, 0});
        bool has_thrown = false;
        try {
            tsubu::migrate(g, bricks, on, tsubu::clamp_lost{});
        } catch (const tsubu::input_error&) {
            has_thrown = true;
        }
        if (on.rank() == 1) g[tsubu::position<2>][0] = {0.75, 0.5};
        const auto y = g[tsubu::position<2>][0][1];
        const auto lost = tsubu::migrate(g, bricks, on, tsubu::clamp_lost{}).lost;
        right[on.rank()] = has_thrown && y == (on.rank() == 0 ? 7 : 0.5) && lost == (on.rank() == 0 ? 1U : 0U);
    });
    CHECK(right == std::vector<char>(2, 1));
}
TEST_CASE("what is too far out for a wrap is collected as it is", "[comm][migrate]") {
    tsubu::self_transport on;
    const auto tilted = tilted_box_of<3>(1.7, 3);
    const auto bricks = comm_laws::bricks_of(tilted, 1);
    using store_type = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>>>;
    store_type g;
    store_type outside;
    const tsubu::vec<3> far{0.1, 0.1, 1e300};
    g.push_back(tsubu::position<3> = far);
    CHECK(tsubu::migrate(g, bricks, on, tsubu::collect_lost(outside)).lost == 1);
    CHECK(g.owned_count() == 0);
    REQUIRE(outside.owned_count() == 1);
    CHECK(outside[tsubu::position<3>][0] == far);
}
TEST_CASE("2000 steps of random motion lose nothing", "[comm][migrate]") {
    const auto box = box_of<3>(7);
    const tsubu::brick_decomposition<3> bricks(box, 4);
    check_on_ranks(4, [&](auto& on, verdict& seen) {
        comm_laws::migrations all(bricks, on, 11, 24, at_first::everyone, seen);
        for (std::size_t k = 0; k < 2000; ++k) all.step(k, 10);
    });
}
TEST_CASE("1e5 steps of random motion lose nothing", "[comm][migrate][.slow]") {
    const auto box = box_of<3>(7);
    each_decomposition(box, 4, [&](const auto& parts) {
        check_on_ranks(4, [&](auto& on, verdict& seen) {
            comm_laws::migrations all(parts, on, 12, 24, at_first::everyone, seen);
            for (std::size_t k = 0; k < 100'000; ++k) all.step(k, 100);
            all.look();
        });
    });
}
TEST_CASE("only the fields that are named go along", "[comm][migrate]") {
    using store_type =
        tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<1>, tsubu::force<1>, tsubu::mass>>;
    const tsubu::domain<1> box({0}, {1}, {.periodic = {true}});
    const tsubu::brick_decomposition<1> parts(box, 2);
    check_on_ranks(2, [&](auto& on, verdict& seen) {
        store_type store;
        // One that goes to the other rank, and one that stays.
        const double mine = on.rank() == 0 ? 0.25 : 0.75;
        store.push_back(tsubu::id = on.rank(), tsubu::position<1> = {1 - mine}, tsubu::force<1> = {7}, tsubu::mass = 3);
        store.push_back(tsubu::id = 2 + on.rank(), tsubu::position<1> = {mine}, tsubu::force<1> = {7}, tsubu::mass = 3);
        tsubu::migrate(store, parts, on, tsubu::refuse_lost{}, tsubu::fields<tsubu::id, tsubu::position<1>, tsubu::mass>{});
        seen(store.size() == 2, "one comes for the one that goes");
        for (std::size_t i = 0; i < store.size(); ++i) {
            const bool has_come = store[tsubu::id][i] < 2;
            seen(store[tsubu::force<1>][i][0] == (has_come ? 0 : 7), "a field that is not carried is zero");
            seen(store[tsubu::mass][i] == 3, "a field that is carried arrives");
        }
    });
}
