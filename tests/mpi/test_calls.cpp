// SPDX-License-Identifier: MIT
/// @file
/// Which MPI calls are made, how often, and how many bytes go to whom. A program of its own: its MPI calls are counted.
#include "counted_calls.hpp"

#include <tsubu/comm/halo.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/mpi_transport.hpp>

#include "comm_laws/known_particles.hpp"
#include "in_world.hpp"

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace {

using counted::seen;

using set = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::force<3>>;
using store = tsubu::particle_store<set>;
constexpr std::size_t fields_bytes = 8 + 24 + 24;

/// Many particles, each on its rank.
struct scene {
    tsubu::brick_decomposition<3> parts{comm_laws::box_of<3>(7), comm_laws::world_size()};
    tsubu::mpi_transport on{MPI_COMM_WORLD};
    store grains;
    explicit scene(std::size_t count = 400) {
        const auto points = comm_laws::points_in(parts.whole(), count, 3);
        for (std::size_t t = 0; t < count; ++t)
            if (parts.owner(points[t]) == on.rank())
                grains.push_back(tsubu::id = static_cast<std::int64_t>(t), tsubu::position<3> = points[t]);
    }
};

std::set<int> receivers() {
    std::set<int> ranks;
    for (const auto& one : seen.sent) ranks.insert(one.to);
    return ranks;
}
std::size_t bytes() {
    std::size_t sum = 0;
    for (const auto& one : seen.sent) sum += one.bytes;
    return sum;
}

}  // namespace

TEST_CASE("a transport duplicates its communicator, and frees the duplicate", "[comm][mpi][calls]") {
    seen.clear();
    { const tsubu::mpi_transport on(MPI_COMM_WORLD); }
    INFO(seen.text());
    CHECK(seen.of("Comm_dup") == 1);
    CHECK(seen.of("Comm_free") == 1);
    CHECK(seen.of("Allreduce") == 1);  // that all cut messages alike
    CHECK(seen.but({"Comm_dup", "Comm_free", "Allreduce"}) == 0);
}
TEST_CASE("forward and reverse are one message each way to each neighbour, and nothing else", "[comm][mpi][calls]") {
    scene here;
    const auto ranks = here.on.ranks();
    auto halo = tsubu::make_halo(here.grains, here.parts, 0.3, here.on);
    CHECK(halo.sent_messages() == ranks - 1);
    for (const bool is_first : {true, false}) {
        seen.clear();
        halo.forward(here.grains, tsubu::position<3>);
        INFO("forward: " << seen.text());
        CHECK(static_cast<std::size_t>(seen.of("Start")) == halo.sent_messages() + halo.received_messages());
        CHECK(seen.of("Waitall") == (ranks > 1 ? 1 : 0));
        // The first time ways are laid, without a message.
        CHECK((is_first || seen.but({"Start", "Waitall"}) == 0));
        CHECK(seen.but({"Start", "Waitall", "Send_init", "Recv_init"}) == 0);
        CHECK(seen.sent.size() == halo.sent_messages());
        CHECK(receivers().size() == halo.sent_messages());
        CHECK((ranks == 1 || bytes() % 24 == 0));
        CHECK(bytes() <= 24 * halo.sent_count());
        const auto forward_bytes = bytes();

        seen.clear();
        halo.reverse(here.grains, tsubu::force<3>);
        INFO("reverse: " << seen.text());
        CHECK(static_cast<std::size_t>(seen.of("Start")) == halo.sent_messages() + halo.received_messages());
        CHECK(seen.of("Waitall") == (ranks > 1 ? 1 : 0));
        CHECK((is_first || seen.but({"Start", "Waitall"}) == 0));
        CHECK(seen.but({"Start", "Waitall", "Send_init", "Recv_init"}) == 0);
        CHECK(seen.sent.size() == halo.received_messages());
        std::uint64_t sums[] = {forward_bytes, bytes()};
        here.on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
        CHECK(sums[0] == sums[1]);  // the same lanes the other way
    }
}
TEST_CASE("what goes to ghosts of other ranks is their fields, and no byte more", "[comm][mpi][calls]") {
    scene here;
    auto halo = tsubu::make_halo(here.grains, here.parts, 0.3, here.on);
    seen.clear();
    halo.forward(here.grains, tsubu::position<3>, tsubu::force<3>);
    // Ghosts of a rank's own images need no message.
    std::uint64_t from_others = 0;
    const auto mine = here.parts.subdomain(here.on.rank());
    for (std::size_t k = 0; k < halo.ghost_count(); ++k) {
        const auto x = here.parts.whole().wrap(here.grains[tsubu::position<3>][halo.owned_count() + k]).position;
        from_others += mine.owns(x) ? 0U : 1U;
    }
    std::uint64_t sums[] = {bytes(), 48 * from_others};
    here.on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
    CHECK(sums[0] == sums[1]);
}
TEST_CASE("a staged halo sends two messages per axis at most", "[comm][mpi][calls]") {
    scene here;
    auto halo = tsubu::make_halo(here.grains, here.parts, 0.3, here.on, tsubu::staged_pattern{});
    halo.forward(here.grains, tsubu::position<3>);
    seen.clear();
    halo.forward(here.grains, tsubu::position<3>);
    INFO(seen.text());
    CHECK(seen.sent.size() == halo.sent_messages());
    CHECK(seen.sent.size() <= 6);
    CHECK(static_cast<std::size_t>(seen.of("Start")) == halo.sent_messages() + halo.received_messages());
    CHECK(seen.of("Waitall") <= 6);
    CHECK(seen.but({"Start", "Waitall"}) == 0);
}
TEST_CASE("a migration without leavers is one reduction, and no message", "[comm][mpi][calls]") {
    scene here;
    seen.clear();
    const auto done = tsubu::migrate(here.grains, here.parts, here.on);
    INFO(seen.text());
    CHECK(done.sent == 0);
    CHECK(seen.sent.empty());
    CHECK(seen.of("Iallreduce") == 1);
    CHECK(seen.but({"Iallreduce", "Improbe", "Test", "Testall"}) == 0);  // these look, and send nothing
}
TEST_CASE("a migration sends one message to each rank that gets any, of the leavers' bytes", "[comm][mpi][calls]") {
    scene here;
    const auto box = here.parts.whole();
    std::set<tsubu::rank_t> to;
    std::size_t leavers = 0;
    for (std::size_t i = 0; i < here.grains.owned_count(); i += 10) {
        auto& x = here.grains[tsubu::position<3>][i];
        for (auto& coordinate : x) coordinate += 0.37 * static_cast<double>(i);  // to here and there
        const auto owner = here.parts.owner(box.wrap(x).position);
        if (owner == here.on.rank()) continue;
        to.insert(owner);
        ++leavers;
    }
    seen.clear();
    const auto done = tsubu::migrate(here.grains, here.parts, here.on);
    INFO(seen.text());
    CHECK(done.sent == leavers);
    CHECK(seen.sent.size() == to.size());
    CHECK(receivers().size() == to.size());
    CHECK(bytes() == 8 * to.size() + fields_bytes * leavers);
    CHECK(seen.of("Iallreduce") == 1);
    std::uint64_t any[] = {leavers};
    here.on.reduce(std::span<std::uint64_t>(any), tsubu::reduction::sum);
    CHECK(seen.of("Allreduce") == (any[0] != 0 ? 2 : 1));  // one of them is that of this test
    CHECK(seen.but({"Iallreduce", "Allreduce", "Issend", "Improbe", "Mrecv", "Test", "Testall"}) == 0);
}
TEST_CASE("a halo is made of one message to each rank that gets ghosts", "[comm][mpi][calls]") {
    scene here;
    seen.clear();
    auto halo = tsubu::make_halo(here.grains, here.parts, 0.3, here.on);
    INFO(seen.text());
    CHECK(seen.sent.size() == halo.sent_messages());
    CHECK(seen.of("Iallreduce") + seen.of("Allreduce") == 4);
    CHECK(seen.of("Barrier") == 0);
}
TEST_CASE("no message goes over the communicator of the program", "[comm][mpi][calls]") {
    scene here;
    seen.clear();
    auto halo = tsubu::make_halo(here.grains, here.parts, 0.3, here.on);
    halo.forward(here.grains, tsubu::position<3>);
    tsubu::migrate(here.grains, here.parts, here.on);
    static_cast<void>(here.on.gather({}));
    static_cast<void>(here.on.sum_before(1));
    CHECK_FALSE(seen.has_used_world);
}
