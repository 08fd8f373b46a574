// SPDX-License-Identifier: MIT
/// @file
/// What stores ask of memory: how often, how much, and what holds when it is refused at any place.
#if defined(__clang__)
// The stable algorithms of libstdc++ 12 call its std::get_temporary_buffer, which it calls deprecated.
#pragma clang diagnostic ignored "-Wdeprecated-declarations"
#endif

#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/topology.hpp>

#include "support/catch.hpp"
#include "support/counted_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using counted_memory::granted;
using counted_memory::no_limit;
using counted_memory::times_asked;

constexpr tsubu::field<"contacts", tsubu::list_of<std::int64_t>> contacts{};
constexpr tsubu::field<"marks", tsubu::list_of<float>> marks{};
constexpr tsubu::field<"charge", tsubu::bonus_of<double>> charge{};
constexpr tsubu::field<"flag", unsigned char> flag{};
using set = tsubu::fields<tsubu::id, tsubu::position<3>, flag, contacts, marks, charge>;
using flat = tsubu::fields<tsubu::id, tsubu::position<2>, tsubu::velocity<2>, tsubu::radius>;
using words_t = std::vector<std::uint64_t>;
using index_list = std::vector<tsubu::index_t>;

index_list numbers(std::size_t count) {
    index_list result(count);
    for (std::size_t k = 0; k < count; ++k) result[k] = static_cast<tsubu::index_t>(k);
    return result;
}
/// All that a store holds.
template <class Store>
words_t content(const Store& g) {
    words_t words(tsubu::packed_words(g, typename Store::fields_type{}, numbers(g.size())));
    tsubu::pack(g, typename Store::fields_type{}, numbers(g.size()), words);
    words.push_back(g.owned_count());
    return words;
}
template <class Layout>
auto filled(std::size_t count, std::uint64_t seed = 3) {
    tsubu::particle_store<set, Layout> g;
    tsubu::random_stream random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        g.push_back(tsubu::id = static_cast<std::int64_t>(i), flag = static_cast<unsigned char>(i));
        for (auto k = random.below(12); k > 0; --k) g[contacts][i].push_back(static_cast<std::int64_t>(random()));
        for (auto k = random.below(3); k > 0; --k) g[marks][i].push_back(0.5F);
        if (random.below(3) == 0) g[charge][i].emplace(random.unit());
    }
    return g;
}
/// Does the call to a copy of the object while memory is refused after 0, 1, 2 ... requests: what it throws leaves no
/// trace, and once there is enough it does what it does else.
/// @return how many requests were not enough
template <class Object, class Content, class Call>
std::size_t refused(const Object& before, Content&& content_of, Call&& call) {
    const auto unchanged = content_of(before);
    auto other = before;
    call(other);
    const auto expected = content_of(other);
    for (std::size_t enough = 0;; ++enough) {
        auto one = before;
        granted = enough;
        bool throws = false;
        try {
            call(one);
        } catch (const std::bad_alloc&) {
            throws = true;
        }
        granted = no_limit;
        CAPTURE(enough, throws);
        CHECK(content_of(one) == (throws ? unchanged : expected));
        if (!throws) return enough;
        call(one);
        CHECK(content_of(one) == expected);
        REQUIRE(enough < 100);
    }
}
const auto all_of = [](const auto& g) { return content(g); };

}  // namespace

TEMPLATE_TEST_CASE("packing asks for no memory, and takes the words that it says", "[store][C4]", tsubu::soa,
                   tsubu::aos, tsubu::aosoa<5>, tsubu::aosoa<16>) {
    const auto g = filled<TestType>(300);
    tsubu::random_stream random(8);
    words_t words(100'000);
    const auto check = [&](auto which, const index_list& chosen) {
        std::size_t said = 0;
        std::size_t taken = 0;
        CHECK(times_asked([&] { said = tsubu::packed_words(g, which, chosen); }) == 0);
        CHECK(times_asked([&] { taken = tsubu::pack(g, which, chosen, words); }) == 0);
        CHECK(said == taken);
        words_t exact(said, 1);
        CHECK(tsubu::pack(g, which, chosen, exact) == said);
        CHECK(std::equal(exact.begin(), exact.end(), words.begin()));
        auto h = g;
        h.add_owned(chosen.size());
        CHECK(tsubu::unpack(h, which, g.size(), chosen.size(), exact) == said);
    };
    for (int round = 0; round < 50; ++round) {
        index_list chosen(round == 0 ? 0 : random.below(300));
        for (auto& i : chosen) i = static_cast<tsubu::index_t>(random.below(300));
        check(set{}, chosen);
        check(tsubu::fields<contacts>{}, chosen);
        check(tsubu::fields<charge>{}, chosen);
        check(tsubu::fields<marks, flag, charge>{}, chosen);
        check(tsubu::fields<flag, tsubu::id>{}, chosen);
        check(tsubu::fields<>{}, chosen);
    }
}

TEMPLATE_TEST_CASE("a store that holds nothing, one that is moved, and what reads ask for no memory", "[store]",
                   tsubu::soa, tsubu::aos, tsubu::aosoa<16>) {
    using store = tsubu::particle_store<set, TestType>;
    STATIC_REQUIRE(std::is_nothrow_default_constructible_v<store>);
    STATIC_REQUIRE(std::is_nothrow_move_constructible_v<store>);
    STATIC_REQUIRE(std::is_nothrow_move_assignable_v<store>);
    CHECK(times_asked([] {
              store g;
              const store also = g;
              g.permute(index_list{});
              g.clear();
              for (const auto grain : also.all()) static_cast<void>(grain[tsubu::id]);
              store moved = std::move(g);
              g = std::move(moved);
          }) == 0);
    auto g = filled<TestType>(20);
    const auto expected = content(g);
    granted = 0;  // what asks within a noexcept function ends the program
    store moved = std::move(g);
    store again = std::move(moved);
    moved = std::move(again);
    std::swap(again, moved);
    granted = no_limit;
    CHECK(content(again) == expected);
    CHECK(moved.empty());
    CHECK(g.empty());  // NOLINT(bugprone-use-after-move)
    for (auto* const emptied : {&g, &moved}) {
        CHECK(emptied->push_back(tsubu::id = 4) == 0);
        CHECK((*emptied)[tsubu::id][0] == 4);
    }
}

TEMPLATE_TEST_CASE("algorithms that move particles ask for no memory of their own", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    auto g = filled<TestType>(300);
    const auto mine = g.owned();
    const auto less = [](const auto& a, const auto& b) { return a[flag] < b[flag]; };
    const auto is_odd = [](const auto& a) { return a[tsubu::id] % 2 == 1; };
    CHECK(times_asked([&] {
              std::sort(mine.begin(), mine.end(), less);
              std::rotate(mine.begin(), mine.begin() + 1, mine.end());
              std::rotate(mine.begin(), mine.begin() + 100, mine.end());
              std::reverse(mine.begin(), mine.end());
              std::partition(mine.begin(), mine.end(), is_odd);
              std::make_heap(mine.begin(), mine.end(), less);
              std::nth_element(mine.begin(), mine.begin() + 80, mine.end(), less);
              std::swap_ranges(mine.begin(), mine.begin() + 100, mine.begin() + 100);
          }) == 0);
    // The buffers that these take are the library's.
    CHECK(times_asked([&] { std::stable_sort(mine.begin(), mine.end(), less); }) <= 1);
    CHECK(times_asked([&] { std::stable_partition(mine.begin(), mine.end(), is_odd); }) <= 1);
}

TEMPLATE_TEST_CASE("wherever memory is refused, a store is what it was", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<16>) {
    auto full = filled<TestType>(300);
    while (full.size() < full.capacity()) full.push_back();
    using store = decltype(full);
    CHECK(refused(full, all_of, [](store& g) { g.push_back(tsubu::id = 1); }) > 0);
    CHECK(refused(full, all_of, [](store& g) { g.push_back_ghost(flag = 1); }) > 0);
    CHECK(refused(full, all_of, [](store& g) { g.reserve(40'000); }) > 0);
    auto some = filled<TestType>(300);
    CHECK(refused(some, all_of, [](store& g) {
              auto order = numbers(g.size());
              for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<tsubu::index_t>(k * 7 % 300);
              g.permute(order);
          }) > 0);
    CHECK(refused(some, all_of, [](store& g) { g[contacts][5].clear(); }) == 0);
    CHECK(refused(some, all_of, [](store& g) { g[contacts][5].assign(std::vector<std::int64_t>(5000, 1)); }) > 0);
    CHECK(refused(some, all_of, [](store& g) { g[contacts][5].reserve(5000); }) > 0);
    CHECK(refused(some, all_of, [](store& g) { g.compact(); }) > 0);
    store none;
    none.add_owned(2);
    CHECK(refused(none, all_of, [](store& g) { g[charge][1].emplace(4); }) == 2);
    CHECK(refused(none, all_of, [](store& g) { g[marks][1].push_back(4); }) == 1);
}

TEMPLATE_TEST_CASE("an assignment that lacks memory changes nothing", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    using store = tsubu::particle_store<set, TestType>;
    store g;
    g.add_owned(3);
    g[0][tsubu::id] = 5;
    g[1][tsubu::id] = 6;
    g[contacts][0].resize(10);
    for (auto& t : g[contacts][0]) t = 7;
    g[marks][0].push_back(2);
    g[marks][2].push_back(3);
    store valued = g;
    valued[charge][0].emplace(0.5);
    CHECK(refused(g, all_of, [](store& h) { h[1] = h[0]; }) >= 1);
    CHECK(refused(g, all_of, [&](store& h) { h[1] = valued[0]; }) >= 3);
    CHECK(refused(g, all_of, [&](store& h) { h[2] = std::as_const(valued)[0]; }) >= 3);
    CHECK(refused(g, all_of, [](store& h) {
              const typename store::record held = h[0];
              h[2] = held;
          }) >= 1);
    auto lacking = g;
    granted = 0;
    const auto mine = lacking.owned();
    auto given = mine[0];
    *(mine.begin() + 1) = std::move(given);  // asks for none
    granted = no_limit;
    CHECK(lacking[contacts][1].size() == 10);
    CHECK(lacking[contacts][0].empty());
}

TEMPLATE_TEST_CASE("a particle is removed, and an order taken, though there is no memory to compact lists", "[store]",
                   tsubu::soa, tsubu::aos, tsubu::aosoa<16>) {
    using store = tsubu::particle_store<set, TestType>;
    auto g = filled<TestType>(400);
    for (std::size_t i = 0; i < 390; ++i) g[contacts][i].resize(40);
    store h = g;
    const auto pools = [](const store& s) { return s.memory_bytes() - s.capacity() * store::bytes_per_particle; };
    granted = 0;
    while (g.size() > 20) g.swap_remove(0);  // soon most of the pool is garbage
    granted = no_limit;
    while (h.size() > 20) h.swap_remove(0);
    CHECK(content(g) == content(h));
    CHECK(pools(g) > 2 * pools(h));
    g.swap_remove(19);  // tries again
    h.swap_remove(19);
    CHECK(content(g) == content(h));
    CHECK(pools(g) < 2 * pools(h));
    // Ghosts with lists leave garbage, which a permutation finds.
    const auto order = [] {
        auto result = numbers(19);
        std::swap(result[3], result[8]);
        return result;
    }();
    for (std::size_t enough = 0;; ++enough) {
        store one = h;
        one.add_ghosts(500);
        for (std::size_t i = 0; i < 500; ++i) one.ghosts()[contacts][i].resize(50);
        one.clear_ghosts();
        const auto before = content(one);
        const auto held = pools(one);
        granted = enough;
        bool throws = false;
        try {
            one.permute(order);
        } catch (const std::bad_alloc&) {
            throws = true;
        }
        granted = no_limit;
        CAPTURE(enough);
        CHECK((content(one) == before) == throws);
        CHECK(one[tsubu::id][3] == h[tsubu::id][throws ? 3 : 8]);
        if (pools(one) < held) break;  // compacted
        REQUIRE(enough < 100);
    }
}

TEST_CASE("a term is kept by all of its particles, or, where memory is refused, by none", "[store][C5]") {
    using bonding = tsubu::topology<tsubu::bonds, tsubu::newton_off>;
    using joining = tsubu::topology<tsubu::dihedrals, tsubu::newton_off>;
    using store = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::bonds, tsubu::dihedrals>>;
    store g;
    for (const std::int64_t t : {1, 2, 3, 4}) g.push_back(tsubu::id = t);
    tsubu::id_map<tsubu::flat_storage<std::int64_t>> where;
    tsubu::same_id_links same;
    where.rebuild(std::span<const std::int64_t>(g[tsubu::id].span()), same);
    const auto terms_of = [](const store& h) {  // not their bits, of which some are padding
        std::vector<std::int64_t> all;
        for (const auto grain : h.all()) {
            for (const auto& one : grain[tsubu::bonds]) all.insert(all.end(), {one.type, one.ids[0], one.ids[1]});
            for (const auto& one : grain[tsubu::dihedrals]) all.insert(all.end(), {one.type, one.ids[0], one.ids[3]});
            all.push_back(0);
        }
        return all;
    };
    CHECK(refused(g, terms_of, [&](store& h) { bonding::insert(h, where, {1, {1, 2}}); }) >= 1);
    CHECK(refused(g, terms_of, [&](store& h) { joining::insert(h, where, {1, {4, 2, 3, 1}}); }) >= 1);
    // Also a term that lies in a list which grows when it is added.
    joining::insert(g, where, {1, {4, 2, 3, 1}});
    for (int k = 0; k < 200; ++k) {
        const auto last = g[tsubu::dihedrals][static_cast<std::size_t>(k) % 4].size() - 1;
        joining::insert(g, where, g[tsubu::dihedrals][static_cast<std::size_t>(k) % 4][last]);
    }
    CHECK(joining::count(g) == 201);
    for (std::size_t i = 0; i < 4; ++i)
        for (const auto& one : g[tsubu::dihedrals][i]) CHECK(one == tsubu::term<4>{1, {4, 2, 3, 1}});
}

namespace {

template <class Fields, class Layout, class Growth = tsubu::geometric_growth>
void check_bytes(std::size_t blocks) {
    using store = tsubu::particle_store<Fields, Layout, Growth>;
    store g;
    for (std::size_t n = 0; n < blocks; ++n) {
        g.push_back();
        g.add_owned(g.capacity() - g.size());
        const auto fields = static_cast<double>(g.size() * store::bytes_per_particle);
        CAPTURE(g.size(), g.memory_bytes());
        CHECK(g.size() % 16384 == 0);
        CHECK(static_cast<double>(g.memory_bytes()) >= fields);
        CHECK(static_cast<double>(g.memory_bytes()) <= 1.01 * fields);
    }
}

}  // namespace

TEST_CASE("at full capacity a particle takes the sum of its fields, and at most 1 % more", "[store]") {
    check_bytes<flat, tsubu::soa>(6);
    check_bytes<flat, tsubu::aos>(6);  // no field asks for padding
    check_bytes<flat, tsubu::aosoa<16>>(6);
    check_bytes<flat, tsubu::soa, tsubu::block_growth>(6);
    using odd = tsubu::fields<flag, tsubu::id, tsubu::position<3, float>, tsubu::species, contacts>;
    check_bytes<odd, tsubu::soa>(4);
    check_bytes<odd, tsubu::aosoa<16>>(4);
    using frictional =
        tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>, tsubu::angular_velocity<3>,
                      tsubu::torque<3>, tsubu::radius, tsubu::mass, contacts>;
    check_bytes<frictional, tsubu::soa>(3);
    check_bytes<frictional, tsubu::aos>(3);
    check_bytes<frictional, tsubu::aosoa<16>>(3);
}

TEST_CASE("1e7 appends ask for memory O(log n) times", "[store][C1]") {
    tsubu::particle_store<tsubu::fields<flag>> g;
    const std::size_t appends = 10'000'000;
    std::size_t reallocations = 0;
    const auto times = times_asked([&] {
        while (g.size() < appends)
            if (g.size() == g.capacity()) {
                g.push_back();
                ++reallocations;
            } else {
                g.add_owned((std::min)(g.capacity(), appends) - g.size());  // as many appends, which do not ask
            }
    });
    CHECK(times == reallocations + 1);  // and once for the number of the allocation
    CHECK(g.size() == appends);
    CHECK(reallocations <= 20);
    CHECK(reallocations >= 10);
}
