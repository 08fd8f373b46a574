// SPDX-License-Identifier: MIT
#include <tsubu/comm/local_transport.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// What run_ranks throws if the last of `ranks` throws and the others do `meanwhile`, which waits for it.
template <class Meanwhile>
std::string thrown_beside(std::size_t ranks, Meanwhile&& meanwhile) {
    std::vector<char> has_lost(ranks, 0);
    std::string text;
    try {
        tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) {
            if (on.rank() + 1 == on.ranks()) throw std::runtime_error("this rank has failed");
            try {
                meanwhile(on);
            } catch (const tsubu::lost_rank_error&) {
                has_lost[on.rank()] = 1;
                throw;
            }
        });
    } catch (const std::runtime_error& thrown) {
        text = thrown.what();
    }
    for (std::size_t rank = 0; rank + 1 < ranks; ++rank)
        if (has_lost[rank] == 0) text += "; rank " + std::to_string(rank) + " was not told";
    return text;
}

}  // namespace

TEST_CASE("ranks that wait for one that has thrown are told, and its exception is the answer",
          "[comm][local_transport]") {
    for (const std::size_t ranks : {2U, 4U}) {
        CHECK(thrown_beside(ranks, [](auto& on) { static_cast<void>(on.exchange({}, {})); }) == "this rank has failed");
        CHECK(thrown_beside(ranks, [](auto& on) { static_cast<void>(on.gather({})); }) == "this rank has failed");
        CHECK(thrown_beside(ranks, [](auto& on) {
                  const auto last = static_cast<tsubu::rank_t>(on.ranks() - 1);
                  tsubu::local_transport::channel way(on, on.next_tag(), {{last, 1}}, {{last, 1}});
                  way.start();
                  way.finish();
              }) == "this rank has failed");
    }
}
TEST_CASE("run_ranks waits for all ranks, and gives each its number", "[comm][local_transport]") {
    std::vector<std::size_t> seen(5, 99);
    tsubu::run_ranks(5, [&](tsubu::local_transport& on) {
        if (on.ranks() == 5) seen[on.rank()] = on.rank();
    });
    CHECK(seen == std::vector<std::size_t>{0, 1, 2, 3, 4});
}
TEST_CASE("ranks that do not call the same are told so", "[comm][local_transport]") {
    CHECK_THROWS_AS(tsubu::run_ranks(3,
                                     [](tsubu::local_transport& on) {
                                         std::vector<std::uint64_t> sums(on.rank() == 1 ? 2 : 1);
                                         on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
                                     }),
                    tsubu::input_error);
    CHECK_THROWS_AS(tsubu::run_ranks(2,
                                     [](tsubu::local_transport& on) {
                                         const auto other = static_cast<tsubu::rank_t>(1 - on.rank());
                                         tsubu::local_transport::channel way(on, on.next_tag(), {{other, 2}},
                                                                             {{other, 3}});
                                         way.start();
                                         way.finish();
                                     }),
                    tsubu::input_error);
    CHECK_THROWS_AS(tsubu::run_ranks(2,
                                     [](tsubu::local_transport& on) {
                                         const tsubu::parcel nowhere[] = {{2, {}}};
                                         static_cast<void>(on.exchange(nowhere, {}));
                                     }),
                    tsubu::input_error);
}
