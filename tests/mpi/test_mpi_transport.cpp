// SPDX-License-Identifier: MIT
#include <tsubu/comm/mpi_transport.hpp>

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/testing/transport_conformance.hpp>

#include "in_world.hpp"
#include "support/counted_memory.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <vector>

namespace {

using comm_laws::check_in;
using comm_laws::check_in_world;
using tsubu::testing::check_transport;

/// The ranks of this half of the world, in the order that is not theirs there.
struct half_of_the_world {
    MPI_Comm comm = MPI_COMM_NULL;
    half_of_the_world() {
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_split(MPI_COMM_WORLD, rank % 2, -rank, &comm);
    }
    ~half_of_the_world() { MPI_Comm_free(&comm); }
};

/// Before main, and so before MPI_Init.
const auto before_mpi = thrown<tsubu::input_error>([] { tsubu::mpi_transport on(MPI_COMM_WORLD); });

}  // namespace

TEST_CASE("a transport is made while MPI runs, over ranks of one group", "[comm][mpi][input]") {
    INFO(before_mpi);
    CHECK(says(before_mpi, "MPI is not running; make a tsubu::mpi_environment first"));
    int rank = 0;
    int size = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (size < 2) return;
    MPI_Comm mine = MPI_COMM_NULL;
    MPI_Comm between = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank % 2, rank, &mine);
    MPI_Intercomm_create(mine, 0, MPI_COMM_WORLD, 1 - rank % 2, 0, &between);
    const auto text = thrown<tsubu::input_error>([&] { tsubu::mpi_transport on(between); });
    CHECK(says(text, "the communicator is an intercommunicator; merge it with MPI_Intercomm_merge"));
    MPI_Comm_free(&between);
    MPI_Comm_free(&mine);
}
TEST_CASE("counts past those of MPI are refused on all ranks", "[comm][mpi][input]") {
    tsubu::mpi_transport on(MPI_COMM_WORLD);
    // Never looked at.
    std::uint64_t word = 0;
    double number = 0;
    const std::size_t many = std::size_t{1} << 31;
    CHECK(says(thrown<tsubu::limit_error>([&] { on.reduce(std::span(&number, many), tsubu::reduction::sum); }),
               "mpi_transport::reduce: 2147483648 numbers to reduce; give fewer than 2^31"));
    const auto mine = on.rank() + 1 == on.ranks() ? many : 1;
    CHECK(says(thrown<tsubu::limit_error>([&] { static_cast<void>(on.gather(std::span(&word, mine))); }),
               "words from all ranks; gather fewer than 2^31"));
    CHECK(on.sum_before(1) == on.rank());
}
TEST_CASE("MPI keeps all laws of a transport", "[comm][mpi][conformance]") {
    check_in_world([](auto& on, verdict& seen) { check_transport(on, 5, 60, seen); });
}
TEST_CASE("messages that are sent in pieces arrive whole", "[comm][mpi][conformance]") {
    for (const std::size_t most_words : {1U, 2U, 7U})
        check_in(MPI_COMM_WORLD, most_words,
                 [&](auto& on, verdict& seen) { check_transport(on, most_words, 12, seen); });
}
TEST_CASE("a part of the world is a transport of its own", "[comm][mpi][conformance]") {
    const half_of_the_world half;
    int size = 0;
    MPI_Comm_size(half.comm, &size);
    check_in(half.comm, 7, [&](auto& on, verdict& seen) {
        CHECK(on.ranks() == static_cast<std::size_t>(size));
        check_transport(on, 9, 20, seen);
    });
}
TEST_CASE("messages of several transports do not meet", "[comm][mpi][conformance]") {
    const half_of_the_world half;
    check_in_world([&](auto& on, verdict& seen) {
        tsubu::mpi_transport other(MPI_COMM_WORLD, 7);
        tsubu::mpi_transport part(half.comm);
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            check_transport(on, seed, 4, seen);
            check_transport(other, seed, 4, seen);
            check_transport(part, seed, 4, seen);
        }
        // A channel of one is on its way while the other exchanges.
        if (on.ranks() == 1) return;
        const auto next = static_cast<tsubu::rank_t>((on.rank() + 1) % on.ranks());
        const auto last = static_cast<tsubu::rank_t>((on.rank() + on.ranks() - 1) % on.ranks());
        tsubu::mpi_transport::channel way(on, on.next_tag(), {{next, 3}}, {{last, 3}});
        way.out()[2] = on.rank();
        way.start();
        check_transport(other, 8, 4, seen);
        way.finish();
        CHECK(way.in()[2] == last);
    });
}
TEST_CASE("exchanges that follow each other are not mixed up", "[comm][mpi]") {
    check_in_world([](auto& on, verdict& seen) {
        // No rank waits for the others between them.
        const auto ranks = static_cast<tsubu::rank_t>(on.ranks());
        for (std::uint64_t k = 0; k < 500; ++k) {
            const std::vector<std::uint64_t> words(k % 5, k);
            const tsubu::parcel parcels[] = {{static_cast<tsubu::rank_t>((on.rank() + k) % ranks), words}};
            const auto came = on.exchange(parcels, {});
            seen(came.size() == 1 && came[0].words.size() == k % 5 && (k % 5 == 0 || came[0].words[0] == k),
                 "exchange: the parcels of this exchange, and no others");
        }
    });
}
TEST_CASE("a parcel to nowhere is refused when the others have theirs", "[comm][mpi]") {
    check_in_world([](auto& on, verdict& seen) {
        const auto next = static_cast<tsubu::rank_t>((on.rank() + 1) % on.ranks());
        const std::vector<std::uint64_t> words{on.rank()};
        std::vector<tsubu::parcel> parcels{{next, words}};
        if (on.rank() == 0) parcels.push_back({static_cast<tsubu::rank_t>(on.ranks()), words});
        for (const bool is_wrong : {true, false}) {
            std::uint64_t sums[] = {3};
            std::size_t count = 0;
            bool was_refused = false;
            try {
                count = on.exchange(parcels, sums).size();
            } catch (const tsubu::input_error&) {
                was_refused = true;
            }
            seen(was_refused == (is_wrong && on.rank() == 0), "exchange: the rank that asks for it is refused");
            seen(sums[0] == 3 * on.ranks(), "exchange: the sums are those of all ranks");
            const std::size_t expected = is_wrong && (on.ranks() == 1 || on.rank() == 1) ? 0 : 1;  // from rank 0 nothing
            seen(was_refused || count == expected, "exchange: what the others sent arrives");
            parcels.resize(1);
        }
    });
}
TEST_CASE("a rank without memory takes part, and throws at the end", "[comm][mpi]") {
    check_in_world([](auto& on, verdict& seen) {
        const std::vector<std::uint64_t> words(100, on.rank());
        std::vector<tsubu::parcel> parcels;
        for (tsubu::rank_t r = 0; r < on.ranks(); ++r) parcels.push_back({r, words});
        const auto poor = static_cast<tsubu::rank_t>(on.ranks() - 1);
        for (const bool gathers : {false, true}) {
            std::uint64_t has_failed = 1;
            for (std::size_t requests = 0; has_failed != 0 && requests < 100; ++requests) {
                on.memory().clear();
                tsubu::mailbox came;
                if (on.rank() == poor) counted_memory::granted = requests;
                bool has_thrown = false;
                try {
                    came = gathers ? on.gather(words) : on.exchange(parcels, {});
                } catch (const std::bad_alloc&) {
                    has_thrown = true;
                } catch (const tsubu::limit_error&) {
                    has_thrown = on.rank() != poor;
                }
                counted_memory::granted = counted_memory::no_limit;
                std::uint64_t failed[] = {has_thrown ? 1U : 0U};
                on.reduce(std::span<std::uint64_t>(failed), tsubu::reduction::sum);
                has_failed = failed[0];
                seen(has_failed == 0 || requests != 0 || on.ranks() == has_failed || !gathers,
                     "gather: all ranks throw or none does");
                seen(has_failed != 0 || came.words() == 100 * on.ranks(), "what is asked for arrives at last");
                seen(requests != 0 || has_failed != 0, "the first request is refused");
                if (!gathers) came = on.exchange(parcels, {});  // whatever came before
                seen(gathers || came.words() == 100 * on.ranks(), "exchange: the next one is whole");
            }
            seen(has_failed == 0, "there is enough memory at last");
        }
    });
}
TEST_CASE("ranks that cut messages differently are told", "[comm][mpi]") {
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (ranks == 1) return;
    CHECK_THROWS_AS(tsubu::mpi_transport(MPI_COMM_WORLD, rank == 0 ? 2 : 4), tsubu::input_error);
    CHECK_THROWS_AS(tsubu::mpi_transport(MPI_COMM_WORLD, rank == 0 ? 0 : 4), tsubu::input_error);
}
TEST_CASE("what an MPI transport is given is checked before any message", "[comm][mpi]") {
    CHECK_THROWS_AS(tsubu::mpi_transport(MPI_COMM_NULL), tsubu::input_error);
    CHECK_THROWS_AS(tsubu::mpi_transport(MPI_COMM_WORLD, 0), tsubu::input_error);
    CHECK_THROWS_AS(tsubu::mpi_transport(MPI_COMM_WORLD, std::size_t{1} << 31), tsubu::input_error);
    tsubu::mpi_transport on(MPI_COMM_WORLD);
    const tsubu::parcel nowhere[] = {{static_cast<tsubu::rank_t>(on.ranks()), {}}};
    CHECK_THROWS_AS(static_cast<void>(on.exchange(nowhere, {})), tsubu::input_error);
}
TEST_CASE("ranks of an agreement learn of the others over MPI", "[comm][mpi][agreement]") {
    check_in_world([](auto& on, verdict& seen) {
        for (tsubu::rank_t culprit = 0; culprit < on.ranks(); ++culprit) {
            tsubu::agreement<1> all(on.rank());
            all.attempt([&] {
                if (on.rank() == culprit) throw tsubu::limit_error("no room");
            });
            all[0] = 2;
            static_cast<void>(on.exchange({}, all.words()));
            std::string text;
            try {
                all.settle("test");
            } catch (const tsubu::limit_error& thrown) {
                text = thrown.what();
            }
            seen(all[0] == 2 * on.ranks(), "agreement: its sums are those of all ranks");
            seen(on.rank() == culprit ? text == "no room"
                                      : text.find("rank " + std::to_string(culprit) + " exceeded") != text.npos,
                 "agreement: the rank that failed throws what it threw, the others name it");
        }
    });
}
TEST_CASE("a channel that was started and never finished ends without harm", "[comm][mpi]") {
    check_in_world([](auto& on, verdict& seen) {
        seen(true, "channel: it ends");
        if (on.ranks() == 1) return;
        const auto next = static_cast<tsubu::rank_t>((on.rank() + 1) % on.ranks());
        const auto last = static_cast<tsubu::rank_t>((on.rank() + on.ranks() - 1) % on.ranks());
        {
            tsubu::mpi_transport::channel way(on, on.next_tag(), {{next, 5}}, {{last, 5}});
            auto moved = std::move(way);
            moved.start();
        }
        std::uint64_t sums[] = {1};
        on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
    });
}
TEST_CASE("an MPI that runs is left to who has started it", "[comm][mpi][mpi_environment]") {
    int argc = 0;
    char** argv = nullptr;
    { const tsubu::mpi_environment mpi(argc, argv); }
    int ended = 0;
    MPI_Finalized(&ended);
    CHECK(ended == 0);
}
