// SPDX-License-Identifier: MIT
#include <tsubu/comm/duplicate_ids.hpp>

#include <tsubu/comm/mpi_transport.hpp>
#include <tsubu/core/random.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

// Between collectives CHECK, never REQUIRE: a rank that leaves early lets the others wait for ever.

namespace {

struct world {
    int rank = 0;
    int size = 1;
    world() {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &size);
    }
};

template <class Id>
auto ask(const std::vector<Id>& owned, MPI_Comm over = MPI_COMM_WORLD) {
    tsubu::mpi_transport on(over);
    return tsubu::duplicate_ids(on, owned);
}

/// What every rank owns is a function of (seed, rank), so each rank knows the whole truth.
std::vector<std::int64_t> ids_of(std::uint64_t seed, int rank, std::uint64_t range) {
    tsubu::random_stream stream(tsubu::splitmix64(seed) + static_cast<std::uint64_t>(rank));
    std::vector<std::int64_t> ids(stream.below(60));
    for (auto& id : ids) id = static_cast<std::int64_t>(stream.below(range));
    return ids;
}

std::string message_of(const std::exception& thrown) { return thrown.what(); }

}  // namespace

TEST_CASE("an id that two ranks own is reported to both with both ranks", "[comm][duplicates][T6][A13]") {
    const world here;
    std::vector<std::int64_t> owned;
    if (here.rank == 0) owned = {1, 2};
    if (here.rank == 1) owned = {2, 3};
    const auto twice = ask(owned);
    const bool there_is = here.size > 1;
    CHECK(twice.total == (there_is ? 1U : 0U));
    CHECK(twice.empty() == !there_is);
    if (there_is && here.rank < 2) {
        CHECK(twice.here == std::vector{tsubu::duplicate_id<std::int64_t>{2, 0, 1}});
    } else {
        CHECK(twice.here.empty());
    }
}

TEST_CASE("an id that one rank owns three times is reported to that rank alone", "[comm][duplicates][T5][A13]") {
    const world here;
    const int last = here.size - 1;
    std::vector<std::int32_t> owned{10 + here.rank};
    if (here.rank == last) owned = {4, 9, 4, 4};
    const auto twice = ask(owned);
    CHECK(twice.total == 1);
    if (here.rank == last) {
        const auto rank = static_cast<tsubu::rank_t>(last);
        CHECK(twice.here == std::vector{tsubu::duplicate_id<std::int32_t>{4, rank, rank}});
    } else {
        CHECK(twice.here.empty());
    }
}

TEST_CASE("no particle at all is no duplicate", "[comm][duplicates][T2]") {
    const auto twice = ask(std::vector<std::int64_t>{});
    CHECK(twice.empty());
    CHECK(twice.here.empty());
}

TEST_CASE("the same id everywhere is one duplicate, named with the lowest and the highest rank",
          "[comm][duplicates][T4][A13]") {
    const world here;
    const auto twice = ask(std::vector<std::uint64_t>(1000, (std::numeric_limits<std::uint64_t>::max)()));
    CHECK(twice.total == 1);
    CHECK(twice.here == std::vector{tsubu::duplicate_id<std::uint64_t>{(std::numeric_limits<std::uint64_t>::max)(), 0,
                                                                       static_cast<tsubu::rank_t>(here.size - 1)}});
}

TEST_CASE("reports agree with a map of all owners", "[comm][duplicates][T5][T6][A13]") {
    const world here;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const std::uint64_t range = seed % 2 == 0 ? 40 : 4000;
        std::map<std::int64_t, std::multiset<tsubu::rank_t>> owners;
        for (int r = 0; r < here.size; ++r)
            for (const auto id : ids_of(seed, r, range)) owners[id].insert(static_cast<tsubu::rank_t>(r));
        std::vector<tsubu::duplicate_id<std::int64_t>> expected;
        std::uint64_t total = 0;
        for (const auto& [id, ranks] : owners) {
            if (ranks.size() < 2) continue;
            ++total;
            if (ranks.count(static_cast<tsubu::rank_t>(here.rank)) != 0)
                expected.push_back({id, *ranks.begin(), *ranks.rbegin()});
        }
        const auto twice = ask(ids_of(seed, here.rank, range));
        INFO("seed " << seed << ", rank " << here.rank);
        CHECK(twice.total == total);
        CHECK(twice.here == expected);
    }
}

TEST_CASE("a negative id on one rank is refused on all", "[comm][duplicates][T7]") {
    const world here;
    const int culprit = here.size / 2;
    std::vector<std::int64_t> owned{5, 6 + here.rank};
    if (here.rank == culprit) owned = {5, 7, -3};
    std::string message;
    try {
        static_cast<void>(ask(owned));
    } catch (const tsubu::error& thrown) {
        message = message_of(thrown);
    }
    INFO(message);
    if (here.rank == culprit) {
        CHECK(message.find("index 2 is -3") != std::string::npos);
    } else {
        CHECK(message.find("rank " + std::to_string(culprit)) != std::string::npos);
    }
}

TEST_CASE("ids that do not fit one message are sent in several", "[comm][duplicates]") {
    const world here;
    std::vector<std::int64_t> owned;
    for (int k = 0; k < 50; ++k) owned.push_back(k + 40 * here.rank);
    tsubu::mpi_transport on(MPI_COMM_WORLD, 3);
    const auto twice = tsubu::duplicate_ids(on, std::span<const std::int64_t>(owned));
    CHECK(twice.total == 10U * static_cast<unsigned>(here.size - 1));
}

TEST_CASE("ranks of a part of the world ask among themselves", "[comm][duplicates]") {
    const world here;
    MPI_Comm half = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, here.rank % 2, here.rank, &half);
    int members = 0;
    MPI_Comm_size(half, &members);
    const auto twice = ask(std::vector<std::int64_t>{here.rank % 2, 100 + here.rank}, half);
    CHECK(twice.total == (members > 1 ? 1U : 0U));
    MPI_Comm_free(&half);
}

TEST_CASE("the error handler of the caller's communicator stays as it is", "[comm][mpi_error]") {
    MPI_Comm own = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &own);
    MPI_Comm_set_errhandler(own, MPI_ERRORS_ARE_FATAL);
    static_cast<void>(ask(std::vector<std::int64_t>{1}, own));
    MPI_Errhandler after = MPI_ERRHANDLER_NULL;
    MPI_Comm_get_errhandler(own, &after);
    CHECK(after == MPI_ERRORS_ARE_FATAL);
    MPI_Comm_free(&own);
}

TEST_CASE("a null communicator is refused before any message", "[comm][mpi_error]") {
    CHECK_THROWS_AS(ask(std::vector<std::int64_t>{1}, MPI_COMM_NULL), tsubu::input_error);
}

TEST_CASE("an error of MPI names the call, the class and MPI's own words", "[comm][mpi_error]") {
    const tsubu::detail::own_communicator on(MPI_COMM_WORLD, "test");
    int value = 0;
    bool thrown = false;
    try {
        tsubu::detail::check_mpi(MPI_Bcast(&value, 1, MPI_INT, on.size() + 7, on.get()), "MPI_Bcast");
    } catch (const tsubu::mpi_error& seen) {
        thrown = true;
        CHECK(seen.call() == "MPI_Bcast");
        CHECK(seen.error_class() == MPI_ERR_ROOT);
        CHECK_FALSE(seen.text().empty());
        CHECK(message_of(seen).find(seen.text()) != std::string::npos);
    }
    CHECK(thrown);
}
