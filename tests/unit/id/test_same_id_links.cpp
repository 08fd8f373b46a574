// SPDX-License-Identifier: MIT
#include <tsubu/id/same_id_links.hpp>

#include "support/catch.hpp"

#include <tsubu/id/id_map.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

using tsubu::absent;
using tsubu::index_t;

static_assert(std::forward_iterator<tsubu::image_range::iterator>);
static_assert(std::sentinel_for<std::default_sentinel_t, tsubu::image_range::iterator>);

namespace {

std::vector<index_t> images(const tsubu::same_id_links& same, index_t first) {
    std::vector<index_t> all;
    for (const auto k : same.images(first)) all.push_back(k);
    return all;
}
std::vector<index_t> all_links(const tsubu::same_id_links& same) { return {same.links().begin(), same.links().end()}; }

}  // namespace

TEST_CASE("images are every copy, lowest index first", "[id][A13]") {
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    where.rebuild(std::vector<std::int64_t>{9, 5, 9, 5, 5}, same);
    CHECK(all_links(same) == std::vector<index_t>{2, 3, -1, 4, -1});
    CHECK(images(same, where.find(5)) == std::vector<index_t>{1, 3, 4});
    CHECK(images(same, where.find(9)) == std::vector<index_t>{0, 2});
    CHECK(images(same, 3) == std::vector<index_t>{3, 4});
    CHECK(images(same, where.find(1)).empty());
    CHECK(same.images(absent).empty());
    CHECK(same.next(1) == 3);
    CHECK(same.next(4) == absent);
}

TEST_CASE("k copies of one id make a chain of length k", "[id][A13][T4]") {
    const auto count = GENERATE(std::size_t{1}, std::size_t{2}, std::size_t{1000}, std::size_t{100'000});
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    where.rebuild(std::vector<std::int64_t>(count, 5), same);
    const auto all = images(same, where.find(5));
    REQUIRE(all.size() == count);
    for (std::size_t k = 0; k < count; ++k)
        if (all[k] != static_cast<index_t>(k)) FAIL("image " << k << " is " << all[k]);
    CHECK(where.size() == 1);
}

TEST_CASE("links follow the ids when they shrink and grow", "[id][A13]") {
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    CHECK(same.size() == 0);
    where.rebuild(std::vector<std::int64_t>{5, 5, 5}, same);
    CHECK(same.size() == 3);
    where.rebuild(std::vector<std::int64_t>{5}, same);
    CHECK(all_links(same) == std::vector<index_t>{-1});
    const auto held = same.memory_bytes();
    CHECK(held >= 3 * sizeof(index_t));  // the memory is kept
    where.rebuild(std::vector<std::int64_t>{5, 5, 5}, same);
    CHECK(same.memory_bytes() == held);
    CHECK(all_links(same) == std::vector<index_t>{1, 2, -1});
    where.rebuild(std::vector<std::int64_t>{}, same);
    CHECK(same.size() == 0);
}

TEST_CASE("image iterators step, copy and compare", "[id]") {
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    where.rebuild(std::vector<std::int64_t>{5, 5}, same);
    auto at = same.images(0).begin();
    const auto before = at++;
    CHECK(*before == 0);
    CHECK(*at == 1);
    CHECK(before != at);
    CHECK(++at == std::default_sentinel);
    CHECK(tsubu::image_range::iterator() == std::default_sentinel);
}
