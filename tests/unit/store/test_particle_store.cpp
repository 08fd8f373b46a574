// SPDX-License-Identifier: MIT
#include <tsubu/store/particle_store.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/curve.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/last_words.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace {

constexpr tsubu::field<"contacts", tsubu::list_of<std::int64_t>> contacts{};
constexpr tsubu::field<"charge", tsubu::bonus_of<double>> charge{};
constexpr tsubu::field<"flag", unsigned char> flag{};
constexpr auto x = tsubu::position<3>;
using set = tsubu::fields<tsubu::id, x, flag, tsubu::radius, contacts, charge>;
using flat_set =
    tsubu::fields<tsubu::id, tsubu::position<2>, tsubu::velocity<2>, tsubu::force<2>, tsubu::radius, tsubu::mass>;

/// A layout whose memory is refused when it is told to.
template <class Layout>
struct refusing {
    static inline bool refuses = false;
    template <class... Values>
    struct memory : Layout::template memory<Values...> {
        using base = typename Layout::template memory<Values...>;
        void reallocate(std::size_t capacity, std::size_t kept) {
            if (refuses) throw std::bad_alloc();
            base::reallocate(capacity, kept);
        }
        template <class Index>
        void gather(const Index* order, std::size_t count) {
            if (refuses) throw std::bad_alloc();
            base::gather(order, count);
        }
    };
};

/// Counts how often it is asked.
struct counting_growth {
    std::uint64_t* asked = nullptr;
    [[nodiscard]] std::uint64_t next(std::uint64_t capacity, std::uint64_t needed) const {
        ++*asked;
        return tsubu::geometric_growth{}.next(capacity, needed);
    }
};

template <class Store>
std::vector<std::int64_t> ids_of(const Store& g) {
    return {g[tsubu::id].begin(), g[tsubu::id].end()};
}

/// What a program does with particles, whatever the layout: all that it is left with, as words.
template <class Layout>
std::vector<std::uint64_t> scenario() {
    tsubu::particle_store<set, Layout> g;
    tsubu::random_stream random(5);
    const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1});
    for (std::int64_t t = 0; t < 500; ++t) {
        const auto i = static_cast<std::size_t>(g.push_back(tsubu::id = t, tsubu::radius = random.unit(),
                                                            x = {random.unit(), random.unit(), random.unit()}));
        if (t % 3 == 0) g[charge][i].emplace(random.unit());
    }
    for (int step = 0; step < 20; ++step) {
        for (auto& p : g[x])
            for (auto& coordinate : p) coordinate += 0.01 * (random.unit() - 0.5);
        for (auto grain : g.owned()) {
            grain[tsubu::radius] *= 1.001;
            if (random.below(4) == 0) grain[contacts].push_back(static_cast<std::int64_t>(random.below(500)));
        }
        for (int k = 0; k < 10; ++k) g.swap_remove(random.below(g.size()));
        g.permute(tsubu::order_along(tsubu::hilbert_curve{}, box, g.owned()[x]));
        for (int k = 0; k < 5; ++k) g.push_back_ghost(x = {0.5, 0.5, 0.5}, flag = static_cast<unsigned char>(k));
        double sum = 0;
        for (const auto grain : std::as_const(g).all()) sum += grain[tsubu::radius] * grain[x][0];
        g[tsubu::radius][0] = sum;
        g.clear_ghosts();
        const auto mine = g.owned();
        std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[x][2] < b[x][2]; });
    }
    std::vector<tsubu::index_t> all(g.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<tsubu::index_t>(i);
    std::vector<std::uint64_t> words(tsubu::packed_words(g, set{}, all));
    tsubu::pack(g, set{}, all, words);
    return words;
}

}  // namespace

TEMPLATE_TEST_CASE("the same program gives the same bits in each layout", "[store]", tsubu::aos, tsubu::aosoa<1>,
                   tsubu::aosoa<5>, tsubu::aosoa<16>) {
    const auto expected = scenario<tsubu::soa>();
    CHECK(expected.size() > 300 * 8);
    CHECK(scenario<TestType>() == expected);
}

TEMPLATE_TEST_CASE("a new particle has what it is given, and zeros", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    tsubu::particle_store<set, TestType> g;
    CHECK(g.empty());
    CHECK(g.capacity() == 0);
    for (int round = 0; round < 3; ++round) {  // in memory that others have used
        CHECK(g.push_back(tsubu::radius = 0.5, tsubu::id = 7) == 0);
        CHECK(g.push_back() == 1);
        CHECK(g[tsubu::id][0] == 7);
        CHECK(g[tsubu::radius][0] == 0.5);
        CHECK(g[tsubu::position<3>][0] == tsubu::vec<3>{});
        CHECK(g[tsubu::id][1] == 0);
        CHECK(g[tsubu::radius][1] == 0);
        CHECK(g[flag][1] == 0);
        CHECK(g[contacts][1].empty());
        CHECK_FALSE(g[charge][1].has_value());
        for (std::size_t i = 0; i < 2; ++i) {
            g[i][tsubu::position<3>] = {1, 2, 3};
            g[i][flag] = 9;
            g[i][contacts].push_back(4);
            g[i][charge].emplace(5);
        }
        if (round == 0) {
            g.swap_remove(0);
            g.swap_remove(0);
        } else {
            g.clear();
        }
        CHECK(g.empty());
    }
    CHECK(g.add_owned(3) == 0);
    CHECK(g.add_owned(2) == 3);
    CHECK(g.size() == 5);
    CHECK(g[flag][4] == 0);
}

TEST_CASE("ghosts come after the owned ones, which wait until they are gone", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back(tsubu::id = 1);
    CHECK(g.push_back_ghost(tsubu::id = 2, tsubu::radius = 3.0) == 1);
    CHECK(g.add_ghosts(2) == 2);
    CHECK(g.owned_count() == 1);
    CHECK(g.ghost_count() == 3);
    CHECK(g.size() == 4);
    const auto refused = [&](const char* where, auto&& call) {
        const auto text = thrown<tsubu::input_error>(call);
        INFO(text);
        CHECK(says(text, std::string("tsubu::particle_store::") + where + ": 3 ghosts stand after the owned particles; "
                                                                          "call clear_ghosts() before owned particles "
                                                                          "come, go or change places"));
        CHECK(g.size() == 4);
        CHECK(g.owned_count() == 1);
    };
    refused("add_owned", [&] { g.push_back(); });
    refused("add_owned", [&] { g.add_owned(5); });
    refused("swap_remove", [&] { g.swap_remove(0); });
    refused("permute", [&] { g.permute(std::vector<tsubu::index_t>{0}); });
    g.clear_ghosts();
    CHECK(g.size() == 1);
    CHECK(g.push_back(tsubu::id = 3) == 1);
    CHECK(g.owned_count() == 2);
}

TEST_CASE("the last particle moves into the hole", "[store]") {
    tsubu::particle_store<set> g;
    for (int t = 0; t < 5; ++t) g.push_back(tsubu::id = t);
    g.swap_remove(1);
    CHECK(ids_of(g) == std::vector<std::int64_t>{0, 4, 2, 3});
    g.swap_remove(3);
    CHECK(ids_of(g) == std::vector<std::int64_t>{0, 4, 2});
    const auto text = thrown<tsubu::input_error>([&] { g.swap_remove(3); });
    CHECK(says(text, "tsubu::particle_store::swap_remove: index 3 of 3 owned particles; indices go from 0 to "
                     "owned_count() - 1"));
    for (int k = 0; k < 3; ++k) g.swap_remove(0);
    CHECK(g.empty());
    CHECK_THROWS_AS(g.swap_remove(0), tsubu::input_error);
}

TEST_CASE("several leave at once, and the last ones that stay take their places in order", "[store]") {
    tsubu::particle_store<set> g;
    for (std::int64_t t = 0; t < 8; ++t) {
        const auto i = static_cast<std::size_t>(g.push_back(tsubu::id = t));
        g[contacts][i].push_back(10 * t);
        if (t % 2 == 0) g[charge][i].emplace(0.5 * static_cast<double>(t));
    }
    const std::vector<tsubu::index_t> wrong[] = {{3, 1}, {2, 2}, {-1, 3}, {5, 8}};
    for (const auto& gone : wrong) CHECK_THROWS_AS(g.remove(gone), tsubu::input_error);
    CHECK(says(thrown<tsubu::input_error>([&] { g.remove(wrong[0]); }), "index 1 at place 1, of 8 owned particles"));
    CHECK(ids_of(g) == std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7});

    g.remove({});
    CHECK(g.size() == 8);
    g.remove(std::vector<tsubu::index_t>{0, 2, 6});
    CHECK(ids_of(g) == std::vector<std::int64_t>{5, 1, 7, 3, 4});
    for (std::size_t i = 0; i < g.size(); ++i) {
        const auto t = g[tsubu::id][i];
        CHECK(g[contacts][i].span().size() == 1);
        CHECK(g[contacts][i].span()[0] == 10 * t);
        CHECK(g[charge][i].has_value() == (t % 2 == 0));
        if (t % 2 == 0) CHECK(*g[charge][i] == 0.5 * static_cast<double>(t));
    }
    g.push_back_ghost();
    CHECK_THROWS_AS(g.remove(std::vector<tsubu::index_t>{0}), tsubu::input_error);
    g.clear_ghosts();
    g.remove(std::vector<tsubu::index_t>{0, 1, 2, 3, 4});
    CHECK(g.empty());
}
TEMPLATE_TEST_CASE("rows whose fields are left unset have zeros in the others, and empty lists", "[store]", tsubu::soa,
                   tsubu::aos, tsubu::aosoa<4>) {
    tsubu::particle_store<set, TestType> g;
    for (int k = 0; k < 5; ++k) {
        const auto i = static_cast<std::size_t>(g.push_back(tsubu::id = 7, tsubu::radius = 2.0, x = {1, 1, 1}));
        g[contacts][i].push_back(3);
        g[charge][i].emplace(4.0);
    }
    g.clear();
    const auto first = g.add_owned(3, tsubu::fields<tsubu::id, contacts, charge>{});
    const auto ghost = g.add_ghosts(2, tsubu::fields<x>{});
    CHECK(first == 0);
    CHECK(ghost == 3);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(g[tsubu::radius][i] == 0);
        CHECK(g[contacts][i].span().empty());
        CHECK(!g[charge][i].has_value());
    }
    for (std::size_t i = 0; i < 3; ++i) CHECK(g[x][i] == tsubu::vec<3>{});
    for (std::size_t i = 3; i < 5; ++i) CHECK(g[tsubu::id][i] == 0);
}
TEMPLATE_TEST_CASE("permute, and its inverse, which brings all back", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    tsubu::particle_store<set, TestType> g;
    const std::size_t count = 1000;
    for (std::size_t k = 0; k < count; ++k) {
        g.push_back(tsubu::id = static_cast<std::int64_t>(k), flag = static_cast<unsigned char>(k));
        if (k % 2 == 0) g[charge][k].emplace(static_cast<double>(k));
    }
    std::vector<tsubu::index_t> order(count);
    std::vector<tsubu::index_t> inverse(count);
    for (std::size_t k = 0; k < count; ++k) {
        order[k] = static_cast<tsubu::index_t>(k * 7 % count);
        inverse[k * 7 % count] = static_cast<tsubu::index_t>(k);
    }
    g.permute(order);
    CHECK(g[tsubu::id][3] == 21);
    CHECK(g[flag][999] == 993 % 256);
    CHECK(g[charge][2].has_value());
    CHECK(*g[charge][2] == 14);
    g.permute(inverse);
    auto expected = ids_of(g);
    std::sort(expected.begin(), expected.end());
    CHECK(ids_of(g) == expected);
    order.pop_back();
    const auto text = thrown<tsubu::input_error>([&] { g.permute(order); });
    CHECK(says(text, "tsubu::particle_store::permute: an order of 999 for 1000 owned particles; give each index once"));
}

TEST_CASE("1e7 appends need O(log n) reallocations, block growth one per block", "[store][C1]") {
    std::uint64_t asked = 0;
    tsubu::particle_store<tsubu::fields<tsubu::species>, tsubu::soa, counting_growth> g(counting_growth{&asked});
    for (int k = 0; k < 10'000'000; ++k) g.push_back(tsubu::species = k);
    CHECK(asked <= 20);
    CHECK(g[tsubu::species][9'999'999] == 9'999'999);
    CHECK(g.capacity() < 15'100'000);
    tsubu::particle_store<tsubu::fields<tsubu::species>, tsubu::aos, tsubu::block_growth> h;
    std::size_t reallocations = 0;
    for (int k = 0; k < 1'000'000; ++k) {
        const auto before = h.capacity();
        h.push_back(tsubu::species = k);
        reallocations += h.capacity() == before ? 0U : 1U;
    }
    CHECK(reallocations == (1'000'000 + 16383) / 16384);
    CHECK(h.capacity() == reallocations * 16384);
}

TEST_CASE("many at once are one reallocation", "[store]") {
    std::uint64_t asked = 0;
    tsubu::particle_store<tsubu::fields<tsubu::id>, tsubu::soa, counting_growth> g(counting_growth{&asked});
    g.add_owned(1'000'000);
    CHECK(asked == 1);
    g.reserve(1);
    CHECK(g.capacity() == 1'000'000 / 16384 * 16384 + 16384);
    g.reserve(2'000'000);
    CHECK(g.capacity() == 2'000'000 / 16384 * 16384 + 16384);
    g.add_ghosts(1'000'000);
    CHECK(asked == 1);
}

TEST_CASE("2^31 particles are refused, and numbers that wrap around", "[store]") {
    tsubu::particle_store<tsubu::fields<tsubu::species>> g;
    g.push_back(tsubu::species = 4);
    for (const std::size_t count :
         {std::size_t{1} << 31, std::size_t{1} << 62, (std::numeric_limits<std::size_t>::max)()}) {
        CAPTURE(count);
        CHECK(says(thrown<tsubu::limit_error>([&] { g.reserve(count); }),
                   "tsubu::particle_store: " + std::to_string(count)));
        CHECK_THROWS_AS(g.add_owned(count), tsubu::limit_error);
        CHECK_THROWS_AS(g.add_ghosts(count), tsubu::limit_error);
    }
    CHECK_THROWS_AS(g.add_owned(tsubu::max_index_count), tsubu::limit_error);  // one too many
    CHECK(g.size() == 1);
    CHECK(g[tsubu::species][0] == 4);
}

TEMPLATE_TEST_CASE("where memory is refused, the store is what it was", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<16>) {
    using layout = refusing<TestType>;
    tsubu::particle_store<set, layout> g;
    while (g.size() == 0 || g.size() < g.capacity()) {
        const auto i = static_cast<std::size_t>(g.push_back(tsubu::id = static_cast<std::int64_t>(g.size())));
        if (i % 100 == 0) g[contacts][i].push_back(static_cast<std::int64_t>(i));
    }
    const auto before = ids_of(g);
    const auto held = g.capacity();
    const auto column = g[tsubu::id];
    layout::refuses = true;
    CHECK_THROWS_AS(g.push_back(tsubu::id = -1), std::bad_alloc);
    CHECK_THROWS_AS(g.push_back_ghost(tsubu::id = -1), std::bad_alloc);
    CHECK_THROWS_AS(g.add_owned(100), std::bad_alloc);
    CHECK_THROWS_AS(g.reserve(held + 1), std::bad_alloc);
    std::vector<tsubu::index_t> order(g.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<tsubu::index_t>(order.size() - 1 - i);
    CHECK_THROWS_AS(g.permute(order), std::bad_alloc);
    layout::refuses = false;
    CHECK(g.size() == held);
    CHECK(g.owned_count() == held);
    CHECK(g.ghost_count() == 0);
    CHECK(g.capacity() == held);
    CHECK(ids_of(g) == before);
    CHECK(g[contacts][100][0] == 100);
    CHECK(column[5] == 5);  // views still hold
    g.push_back(tsubu::id = -1);
    CHECK(g.size() == held + 1);
    CHECK(g[tsubu::id][held] == -1);
}

TEMPLATE_TEST_CASE("a copy is independent, a store that was moved from is empty", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    using store = tsubu::particle_store<set, TestType>;
    store g;
    for (int t = 0; t < 10; ++t) g[static_cast<std::size_t>(g.push_back(tsubu::id = t))][contacts].push_back(t);
    g.push_back_ghost(tsubu::id = 77);
    store copy = g;
    copy[tsubu::id][0] = 99;
    copy[contacts][0][0] = 99;
    copy[contacts][1].push_back(5);
    CHECK(g[tsubu::id][0] == 0);
    CHECK(g[contacts][0][0] == 0);
    CHECK(g[contacts][1].size() == 1);
    CHECK(copy.ghost_count() == 1);
    [[maybe_unused]] const auto ids = g[tsubu::id];
    store moved = std::move(g);
#ifndef NDEBUG
    CHECK(says(last_words([&] { static_cast<void>(ids[10]); }), "older than its memory"));
#endif
    CHECK(moved.owned_count() == 10);
    CHECK(g.empty());  // NOLINT(bugprone-use-after-move)
    CHECK(g.capacity() == 0);
    CHECK(g.memory_bytes() == 0);
    CHECK(g.push_back(tsubu::id = 5) == 0);
    g[contacts][0].push_back(6);
    CHECK(moved[contacts][9][0] == 9);
    g = copy;
    CHECK(g[contacts][1].size() == 2);
    g = std::move(moved);
    CHECK(g[contacts][1].size() == 1);
    CHECK(g.ghosts()[0][tsubu::id] == 77);
    store& same = g;
    g = same;
    CHECK(g.size() == 11);
}

TEMPLATE_TEST_CASE("a flat set takes the sum of its fields, and no more", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<1>, tsubu::aosoa<16>) {
    using store = tsubu::particle_store<flat_set, TestType>;
    STATIC_REQUIRE(store::bytes_per_particle == 8 + 3 * 16 + 2 * 8);
    store g;
    g.push_back();
    CHECK(g.capacity() == 16384);
    CHECK(g.memory_bytes() == 16384 * store::bytes_per_particle);
}

TEST_CASE("a store for reading gives values for reading", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back(tsubu::id = 3);
    g[contacts][0].push_back(8);
    const auto& read = g;
    STATIC_REQUIRE(std::is_same_v<decltype(read[tsubu::id][0]), const std::int64_t&>);
    STATIC_REQUIRE(std::is_same_v<decltype(read[contacts][0][0]), const std::int64_t&>);
    STATIC_REQUIRE(std::is_same_v<decltype(g[tsubu::id][0]), std::int64_t&>);
    CHECK(read[0][tsubu::id] == 3);
    CHECK(read[std::int8_t{0}][contacts][0] == 8);
    CHECK(read.owned()[tsubu::id][0] == 3);
    CHECK(read.all()[0][contacts].size() == 1);
    STATIC_REQUIRE(decltype(g)::has<decltype(contacts)>);
    STATIC_REQUIRE_FALSE(decltype(g)::has<decltype(tsubu::mass)>);
}

#if defined(__unix__) && !defined(NDEBUG)
TEST_CASE("what is no permutation is told in debug builds", "[store]") {
    tsubu::particle_store<set> g;
    g.add_owned(3);
    for (const auto& order : {std::vector<tsubu::index_t>{0, 1, 1}, {0, 1, 3}, {0, -1, 2}})
        CHECK(says(last_words([&] { g.permute(order); }), "this is not a permutation; give each index once"));
}
#endif
