// SPDX-License-Identifier: MIT
#include <tsubu/comm/self_transport.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <vector>

TEST_CASE("a process sends to itself, and to nobody else", "[comm][self_transport]") {
    tsubu::self_transport on;
    CHECK(on.rank() == 0);
    CHECK(on.ranks() == 1);
    const std::vector<std::uint64_t> words{4, 5};
    const tsubu::parcel parcels[] = {{0, words}, {0, {}}};
    const auto came = on.exchange(parcels, {});
    REQUIRE(came.size() == 2);
    CHECK(came[0].words[1] == 5);
    CHECK(came[1].words.empty());
    const tsubu::parcel nowhere[] = {{1, words}};
    CHECK_THROWS_AS(static_cast<void>(on.exchange(nowhere, {})), tsubu::input_error);
}
