// SPDX-License-Identifier: MIT
#include <tsubu/comm/mailbox.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

static_assert(std::forward_iterator<tsubu::mailbox::iterator>);

TEST_CASE("a mailbox has parcels as they came, and sorted those of one sender stay in order", "[comm][mailbox]") {
    tsubu::mailbox box;
    CHECK(box.empty());
    CHECK(box.words() == 0);
    const std::vector<std::uint64_t> words{1, 2, 3};
    box.add(tsubu::parcel{2, words});
    box.add(tsubu::parcel{0, {}});
    const auto room = box.add(2, 1);
    room[0] = 7;
    auto whole = tsubu::message_memory().take<std::uint64_t>(2);
    whole[0] = 8;
    whole[1] = 9;
    box.add(1, std::move(whole));
    CHECK(box.size() == 4);
    CHECK(box.words() == 6);

    box.sort();
    std::vector<tsubu::rank_t> ranks;
    std::vector<std::uint64_t> all;
    for (const auto& [from, some] : box) {
        ranks.push_back(from);
        all.insert(all.end(), some.begin(), some.end());
    }
    CHECK(ranks == std::vector<tsubu::rank_t>{0, 1, 2, 2});
    CHECK(all == std::vector<std::uint64_t>{8, 9, 1, 2, 3, 7});
    CHECK(box[0].words.empty());
    CHECK(box[3].words[0] == 7);
    auto at = box.begin();
    CHECK((*at++).rank == 0);
    CHECK((*at).rank == 1);
}
