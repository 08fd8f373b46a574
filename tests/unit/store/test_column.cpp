// SPDX-License-Identifier: MIT
#include <tsubu/store/column.hpp>

#include <tsubu/domain/points.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/last_words.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <ranges>
#include <span>
#include <vector>

namespace {

constexpr tsubu::field<"flag", std::byte> flag{};
using set = tsubu::fields<tsubu::id, tsubu::position<3>, flag, tsubu::radius>;
template <class Layout>
using store = tsubu::particle_store<set, Layout>;

template <class Layout>
store<Layout> filled(std::int64_t count) {
    store<Layout> g;
    for (std::int64_t k = 0; k < count; ++k)
        g.push_back(tsubu::id = k, tsubu::radius = static_cast<double>(k) / 2, flag = static_cast<std::byte>(k));
    return g;
}

}  // namespace

TEMPLATE_TEST_CASE("columns and ranges take any integer as an index", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    auto g = filled<TestType>(10);
    const auto ids = g[tsubu::id];
    const tsubu::index_t i = 7;
    CHECK(ids[i] == 7);
    CHECK(ids[std::uint16_t{7}] == 7);
    CHECK(ids[std::int64_t{7}] == 7);
    CHECK(ids[std::uint64_t{7}] == 7);
    CHECK(g.owned()[i][tsubu::id] == 7);
#if defined(__unix__) && !defined(NDEBUG)
    CHECK(says(last_words([&] { static_cast<void>(ids[tsubu::absent]); }), "no particle with this index"));
    CHECK(says(last_words([&] { static_cast<void>(ids[std::int64_t{-1}]); }), "no particle with this index"));
    CHECK(says(last_words([&] { static_cast<void>(g.owned()[tsubu::absent]); }), "no particle with this index"));
#endif
}

TEMPLATE_TEST_CASE("a column can be indexed, walked and sorted in each layout", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<1>, tsubu::aosoa<5>, tsubu::aosoa<16>) {
    auto g = filled<TestType>(100);
    auto radii = g[tsubu::radius];
    STATIC_REQUIRE(std::random_access_iterator<decltype(radii.begin())>);
    STATIC_REQUIRE(std::ranges::random_access_range<decltype(radii)>);
    STATIC_REQUIRE(std::ranges::borrowed_range<decltype(radii)>);
    REQUIRE(radii.size() == 100);
    CHECK_FALSE(radii.empty());
    CHECK(std::accumulate(radii.begin(), radii.end(), 0.0) == 99 * 100 / 4.0);
    for (auto& r : radii) r = 50 - r;
    CHECK(g[tsubu::radius][0] == 50);
    std::sort(radii.begin(), radii.end());
    CHECK(std::is_sorted(radii.begin(), radii.end()));
    CHECK(radii[0] == 0.5);
    std::int64_t expected = 0;
    for (const auto t : std::as_const(g)[tsubu::id]) CHECK(t == expected++);  // the other columns stay
    for (std::size_t k = 0; k < 100; ++k)
        CHECK(*std::next(g[flag].begin(), static_cast<std::ptrdiff_t>(k)) == std::byte(k));
}

TEMPLATE_TEST_CASE("the cursor of a column counts as an iterator must", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    auto g = filled<TestType>(20);
    const auto ids = g[tsubu::id];
    auto at = ids.begin();
    CHECK(*at++ == 0);
    CHECK(*++at == 2);
    CHECK(*at-- == 2);
    CHECK(*--at == 0);
    at += 7;
    CHECK(*at == 7);
    at -= 3;
    CHECK(at[5] == 9);
    CHECK(*(at + 2) == 6);
    CHECK(*(2 + at) == 6);
    CHECK(*(at - 2) == 2);
    CHECK(ids.end() - at == 16);
    CHECK(at < ids.end());
    CHECK(at != ids.begin());
    CHECK(g[tsubu::position<3>].begin()->size() == 3);
}

TEMPLATE_TEST_CASE("a part of a column begins where it is told", "[store]", tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    auto g = filled<TestType>(20);
    const auto some = g[tsubu::id].part(7, 9).part(2, 4);
    REQUIRE(some.size() == 4);
    CHECK(some[0] == 9);
    CHECK(*(some.end() - 1) == 12);
    CHECK(g[tsubu::id].part(20, 0).empty());
}

TEST_CASE("columns of soa are spans, and points", "[store]") {
    auto g = filled<tsubu::soa>(3);
    const auto& read = g;
    const std::span<double> written = g[tsubu::radius];
    const std::span<const double> also = g[tsubu::radius];
    const std::span<const double> const_span = read[tsubu::radius];
    written[1] = 9;
    CHECK(also[1] == 9);
    CHECK(const_span[1] == 9);
    CHECK(g[tsubu::radius].span().data() == g[tsubu::radius].data());
    const tsubu::points<3> where(g.owned()[tsubu::position<3>]);
    g[tsubu::position<3>][2] = {1, 2, 3};
    CHECK(where.size() == 3);
    CHECK(where[2] == tsubu::vec<3>{1, 2, 3});
    tsubu::points<3, double>(g[tsubu::position<3>]).set(0, {4, 5, 6});
    CHECK(read[tsubu::position<3>][0] == tsubu::vec<3>{4, 5, 6});
    STATIC_REQUIRE_FALSE(std::convertible_to<decltype(store<tsubu::aos>{}[tsubu::radius]), std::span<double>>);
}

TEST_CASE("vector loads find columns of soa at a cache line", "[store]") {
    auto g = filled<tsubu::soa>(1);
    CHECK(reinterpret_cast<std::uintptr_t>(g[tsubu::radius].data()) % 64 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(g[flag].data()) % 64 == 0);
}

#if defined(__unix__) && !defined(NDEBUG)
TEMPLATE_TEST_CASE("a column that is older than the memory says so in debug builds", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<16>) {
    auto g = filled<TestType>(3);
    const auto old = g[tsubu::radius];
    const auto old_part = g.owned()[tsubu::radius].part(1, 1);
    CHECK(old[0] == 0);
    g.reserve(g.capacity() + 1);
    const std::string words =
        "precondition violated: this view of a store is older than its memory; take a new one after "
        "particles were added";
    CHECK(says(last_words([&] { static_cast<void>(old[0]); }), words));
    CHECK(says(last_words([&] { static_cast<void>(old.begin()); }), words));
    CHECK(says(last_words([&] { static_cast<void>(old_part[0]); }), words));
    const auto fresh = g[tsubu::radius];
    CHECK(fresh[2] == 1);
    g.permute(std::vector<tsubu::index_t>{2, 1, 0});
    CHECK(says(last_words([&] { static_cast<void>(fresh[0]); }), words));
    CHECK(g[tsubu::radius][0] == 1);
}

TEST_CASE("a column that becomes full by one append ends, and not before", "[store]") {
    auto g = filled<tsubu::soa>(1);
    while (g.size() < g.capacity()) {
        const auto before = g[tsubu::id];
        g.push_back();
        static_cast<void>(before[0]);
    }
    const auto before = g[tsubu::id];
    g.push_back();
    CHECK(says(last_words([&] { static_cast<void>(before[0]); }), "older than its memory"));
}

TEST_CASE("an index beyond a column is told in debug builds", "[store]") {
    auto g = filled<tsubu::aosoa<16>>(3);
    CHECK(says(last_words([&] { static_cast<void>(g[tsubu::radius][3]); }), "no particle with this index"));
    CHECK(says(last_words([&] { static_cast<void>(g[tsubu::radius].part(2, 2)); }),
               "a part that reaches beyond the column"));
}
#endif
