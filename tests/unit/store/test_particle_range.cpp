// SPDX-License-Identifier: MIT
#include <tsubu/store/particle_range.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/last_words.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace {

constexpr tsubu::field<"marks", tsubu::list_of<std::int64_t>> marks{};
using set = tsubu::fields<tsubu::species, tsubu::id, tsubu::position<2>, marks>;

/// A particle of which each value says which one it is.
template <class Store>
void add(Store& g, std::int64_t t, std::int32_t kind) {
    const auto i = static_cast<std::size_t>(
        g.push_back(tsubu::id = t, tsubu::species = kind, tsubu::position<2> = {static_cast<double>(t), 0.5}));
    for (std::int64_t k = 0; k < t % 4; ++k) g[marks][i].push_back(t);
}
template <class Reference>
bool is_whole(const Reference& grain) {
    const auto t = grain[tsubu::id];
    const auto list = grain[marks];
    return grain[tsubu::position<2>][0] == static_cast<double>(t) &&
           list.size() == static_cast<std::size_t>(t % 4) &&
           std::all_of(list.begin(), list.end(), [&](std::int64_t mark) { return mark == t; });
}
template <class Store>
bool are_whole(const Store& g) {
    bool all = true;
    for (const auto grain : g.all()) all = all && is_whole(grain);
    return all;
}
template <class Layout>
auto shuffled(std::int64_t count) {
    tsubu::particle_store<set, Layout> g;
    for (std::int64_t k = 0; k < count; ++k) add(g, k * 7919 % count, static_cast<std::int32_t>(k % 10));
    return g;
}

}  // namespace

TEMPLATE_TEST_CASE("std::sort sorts particles, all of each", "[store]", tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    auto g = shuffled<TestType>(1000);
    const auto mine = g.owned();
    std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(std::is_sorted(g[tsubu::id].begin(), g[tsubu::id].end()));
    CHECK(are_whole(g));
    std::sort(mine.begin() + 10, mine.begin() + 20,
              [](const auto& a, const auto& b) { return a[tsubu::id] > b[tsubu::id]; });
    CHECK(g[tsubu::id][9] == 9);
    CHECK(g[tsubu::id][10] == 19);
    CHECK(g[tsubu::id][20] == 20);
    CHECK(are_whole(g));
}

TEMPLATE_TEST_CASE("std::stable_sort keeps the order of equals", "[store]", tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    auto g = shuffled<TestType>(1000);
    const auto mine = g.owned();
    const auto by_id = [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; };
    std::sort(mine.begin(), mine.end(), by_id);
    std::stable_sort(mine.begin(), mine.end(),
                     [](const auto& a, const auto& b) { return a[tsubu::species] < b[tsubu::species]; });
    bool in_order = true;
    for (std::size_t i = 1; i < g.size(); ++i)
        in_order = in_order && std::pair(g[tsubu::species][i - 1], g[tsubu::id][i - 1]) <
                                   std::pair(g[tsubu::species][i], g[tsubu::id][i]);
    CHECK(in_order);
    CHECK(are_whole(g));
}

TEST_CASE("other algorithms move particles too", "[store]") {
    auto g = shuffled<tsubu::soa>(100);
    const auto mine = g.owned();
    const auto first = g[tsubu::id][0];
    std::reverse(mine.begin(), mine.end());
    CHECK(g[tsubu::id][99] == first);
    std::rotate(mine.begin(), mine.begin() + 99, mine.end());
    CHECK(g[tsubu::id][0] == first);
    const auto middle = std::partition(mine.begin(), mine.end(), [](const auto& a) { return a[tsubu::id] < 50; });
    CHECK(middle - mine.begin() == 50);
    std::nth_element(mine.begin(), mine.begin() + 30, mine.end(),
                     [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(g[tsubu::id][30] == 30);
    std::make_heap(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(g[tsubu::id][0] == 99);
    CHECK(are_whole(g));
}

TEMPLATE_TEST_CASE("swapping references swaps particles, named or not", "[store]", tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    auto g = shuffled<TestType>(10);
    const auto t0 = g[tsubu::id][0];
    const auto t3 = g[tsubu::id][3];
    using std::swap;
    swap(g[0], g[3]);
    CHECK(g[tsubu::id][0] == t3);
    CHECK(g[tsubu::id][3] == t0);
    auto a = g[0];
    auto b = g[3];
    swap(a, b);
    CHECK(g[tsubu::id][0] == t0);
    CHECK(g[tsubu::id][3] == t3);
    const auto c = g[0];
    const auto d = g[3];
    swap(c, d);
    CHECK(g[tsubu::id][0] == t3);
    swap(c, c);
    CHECK(g[tsubu::id][0] == t3);
    const auto mine = g.owned();
    std::iter_swap(mine.begin(), mine.begin() + 3);
    CHECK(g[tsubu::id][0] == t0);
    CHECK(are_whole(g));
}

TEST_CASE("a reference reads and writes the fields of one particle", "[store]") {
    auto g = shuffled<tsubu::aos>(5);
    const auto grain = g[2];
    CHECK(grain.index() == 2);
    grain[tsubu::position<2>][1] = 8;
    CHECK(g[tsubu::position<2>][2][1] == 8);
    const auto& read = g;
    CHECK(read[2][tsubu::position<2>][1] == 8);
    STATIC_REQUIRE(std::is_same_v<decltype(read[2][tsubu::id]), const std::int64_t&>);
    const typename decltype(g)::record kept = g[2];
    CHECK(kept[tsubu::id] == g[tsubu::id][2]);
    CHECK(kept[tsubu::position<2>][1] == 8);
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::radius>> plain;
    plain.push_back(tsubu::id = 1, tsubu::radius = 2.0);
    plain.push_back(tsubu::id = 3, tsubu::radius = 4.0);
    plain[0] = plain[1];
    CHECK(plain[tsubu::radius][0] == 4);
    CHECK(plain[tsubu::id][0] == 3);
}

TEST_CASE("ranges over owned, ghosts and all", "[store]") {
    tsubu::particle_store<set> g;
    add(g, 1, 0);
    add(g, 2, 0);
    g.push_back_ghost(tsubu::id = 8);
    CHECK(g.owned().size() == 2);
    CHECK(g.ghosts().size() == 1);
    CHECK(g.all().size() == 3);
    CHECK(g.ghosts()[0][tsubu::id] == 8);
    CHECK(g.ghosts()[tsubu::id][0] == 8);
    CHECK(g.ghosts()[0].index() == 2);
    CHECK(g.owned()[tsubu::id].size() == 2);
    CHECK_FALSE(g.ghosts().empty());
    g.clear_ghosts();
    CHECK(g.ghosts().empty());
    CHECK(g.ghosts().begin() == g.ghosts().end());
    const auto mine = std::as_const(g).owned();
    CHECK(mine.end() - mine.begin() == 2);
    CHECK((*(mine.begin() + 1))[tsubu::id] == 2);
    CHECK(mine.begin()[1][tsubu::id] == 2);
}

#if defined(__unix__) && !defined(NDEBUG)
TEST_CASE("a reference to nothing, or swapped with another store's, is told in debug builds", "[store]") {
    auto g = shuffled<tsubu::soa>(3);
    auto h = shuffled<tsubu::soa>(3);
    CHECK(says(last_words([&] { static_cast<void>(g[3]); }), "no particle with this index"));
    CHECK(says(last_words([&] { static_cast<void>(g[-1]); }), "no particle with this index"));
    CHECK(says(last_words([&] { swap(g[0], h[0]); }), "particles of two stores do not swap"));
}
#endif
