// SPDX-License-Identifier: MIT
#include <tsubu/store/topology.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/particle_store.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using tsubu::absent;
using tsubu::newton_off;
using tsubu::newton_on;
using tsubu::term;
using set =
    tsubu::fields<tsubu::id, tsubu::position<1>, tsubu::bonds, tsubu::angles, tsubu::dihedrals, tsubu::impropers>;
using map = tsubu::id_map<tsubu::flat_storage<std::int64_t>>;

/// A rank: its particles, and where they are.
struct one_rank {
    tsubu::particle_store<set> g;
    map where;
    tsubu::same_id_links same;

    void add(std::int64_t t, double x = 0) { g.push_back(tsubu::id = t, tsubu::position<1> = {x}); }
    void add_ghost(std::int64_t t, double x = 0) { g.push_back_ghost(tsubu::id = t, tsubu::position<1> = {x}); }
    void index() { where.rebuild(g[tsubu::id].span(), same); }
};

/// `count` particles, dealt to ranks; each rank has ghosts of some that it does not own.
std::vector<one_rank> dealt(std::int64_t count, std::size_t ranks, tsubu::random_stream& random) {
    std::vector<one_rank> all(ranks);
    std::vector<std::size_t> owner(static_cast<std::size_t>(count));
    for (auto& rank : owner) rank = random.below(ranks);
    for (std::int64_t t = 0; t < count; ++t) all[owner[static_cast<std::size_t>(t)]].add(t + 1);
    for (std::size_t r = 0; r < ranks; ++r) {
        for (std::int64_t t = 0; t < count; ++t)
            if (random.below(3) == 0) all[r].add_ghost(t + 1);  // its own too: a periodic image
        all[r].index();
    }
    return all;
}

/// Terms of different particles, some of them twice, some of a negative type.
template <std::size_t Order>
std::vector<term<Order>> random_terms(std::size_t count, std::int64_t particles, tsubu::random_stream& random) {
    std::vector<term<Order>> terms;
    while (terms.size() < count) {
        term<Order> one;
        one.type = static_cast<std::int32_t>(random.below(7)) - 3;
        for (auto& t : one.ids) t = 1 + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(particles)));
        auto sorted = one.ids;
        std::sort(sorted.begin(), sorted.end());
        if (one.type == 0 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) continue;
        terms.push_back(one);
        if (random.below(5) == 0) terms.push_back(one);
    }
    return terms;
}

/// A term as it is the same whoever writes it: the type without its sign; a bond has no direction.
template <std::size_t Order>
std::pair<std::int64_t, std::array<std::int64_t, Order>> canonical(std::int64_t type,
                                                                   std::array<std::int64_t, Order> ids) {
    if (Order == 2) std::sort(ids.begin(), ids.end());
    return {type < 0 ? -type : type, ids};
}

template <auto Field, class Newton>
void check_split(std::size_t ranks, std::uint64_t seed) {
    using rules = tsubu::topology<Field, Newton>;
    constexpr auto order = rules::order;
    tsubu::random_stream random(seed);
    const std::int64_t particles = 60;
    auto all = dealt(particles, ranks, random);
    const auto terms = random_terms<order>(300, particles, random);
    std::size_t kept = 0;
    std::vector<std::pair<std::int64_t, std::array<std::int64_t, order>>> expected;
    for (const auto& one : terms) {
        for (auto& rank : all) kept += rules::insert(rank.g, rank.where, one);  // each rank is told of each term
        expected.push_back(canonical(one.type, one.ids));
    }
    decltype(expected) written;
    std::uint64_t counted = 0;
    bool begins_with_an_owned_one = true;
    for (const auto& rank : all) {
        const auto before = written.size();
        rules::rows(rank.g, [&](std::int64_t type, const auto& ids) {
            written.push_back(canonical(type, ids));
            const auto i = rank.where.find(ids[order == 2 ? 0 : 1]);
            begins_with_an_owned_one =
                begins_with_an_owned_one && i != absent && static_cast<std::size_t>(i) < rank.g.owned_count();
        });
        CHECK(rules::count(rank.g) == written.size() - before);
        counted += rules::count(rank.g);
    }
    std::sort(expected.begin(), expected.end());
    std::sort(written.begin(), written.end());
    CAPTURE(ranks, seed);
    CHECK(written == expected);
    CHECK(counted == terms.size());
    CHECK(begins_with_an_owned_one);
    CHECK(kept == terms.size() * (Newton::keeps_once ? 1 : order));

    // Some particles leave the simulation: their terms leave with them, on all ranks, and no other does.
    std::vector<std::int64_t> gone;
    for (std::int64_t t = 1; t <= particles; ++t)
        if (random.below(8) == 0) gone.push_back(t);
    const auto is_gone = [&](std::int64_t t) { return std::binary_search(gone.begin(), gone.end(), t); };
    std::size_t removed = 0;
    for (auto& rank : all) {
        removed += rules::remove_terms_of(rank.g, gone);
        rank.g.clear_ghosts();
        for (std::size_t i = rank.g.owned_count(); i-- > 0;)
            if (is_gone(rank.g[tsubu::id][i])) rank.g.swap_remove(i);
    }
    const auto end = std::remove_if(expected.begin(), expected.end(), [&](const auto& one) {
        return std::any_of(one.second.begin(), one.second.end(), is_gone);
    });
    const auto leaving = static_cast<std::size_t>(expected.end() - end);
    expected.erase(end, expected.end());
    written.clear();
    counted = 0;
    for (const auto& rank : all) {
        rules::rows(rank.g, [&](std::int64_t type, const auto& ids) { written.push_back(canonical(type, ids)); });
        counted += rules::count(rank.g);
    }
    std::sort(written.begin(), written.end());
    CHECK(written == expected);
    CHECK(counted == expected.size());
    CHECK(removed == leaving * (Newton::keeps_once ? 1 : order));
}

template <class Newton>
using bonding = tsubu::topology<tsubu::bonds, Newton>;
template <class Newton>
using bending = tsubu::topology<tsubu::angles, Newton>;

}  // namespace

TEMPLATE_TEST_CASE("over all ranks each term is written exactly once, with Newton's rule or without", "[store][C5][C7]",
                   newton_on, newton_off) {
    for (std::size_t ranks = 1; ranks <= 8; ++ranks)
        for (const std::uint64_t seed : {1U, 2U, 3U}) {
            check_split<tsubu::bonds, TestType>(ranks, seed);
            check_split<tsubu::angles, TestType>(ranks, seed);
            check_split<tsubu::dihedrals, TestType>(ranks, seed);
            check_split<tsubu::impropers, TestType>(ranks, seed);
        }
}

TEST_CASE("a term is kept by its main particle, or by all", "[store][C5][C7]") {
    constexpr term<2> bond{1, {9, 7}};
    STATIC_REQUIRE(bonding<newton_on>::keeps(bond, 9));
    STATIC_REQUIRE_FALSE(bonding<newton_on>::keeps(bond, 7));
    STATIC_REQUIRE(bonding<newton_off>::keeps(bond, 7));
    STATIC_REQUIRE_FALSE(bonding<newton_off>::keeps(bond, 8));
    STATIC_REQUIRE(bonding<newton_on>::writes(bond, 9));
    STATIC_REQUIRE(bonding<newton_off>::writes(bond, 7));  // 7 < 9
    STATIC_REQUIRE_FALSE(bonding<newton_off>::writes(bond, 9));
    constexpr term<3> angle{1, {1, 2, 3}};
    STATIC_REQUIRE(bending<newton_on>::keeps(angle, 2));
    STATIC_REQUIRE_FALSE(bending<newton_on>::keeps(angle, 1));
    STATIC_REQUIRE(bending<newton_off>::keeps(angle, 1));
    STATIC_REQUIRE(bending<newton_off>::writes(angle, 2));
    STATIC_REQUIRE_FALSE(bending<newton_off>::writes(angle, 1));
    STATIC_REQUIRE_FALSE(bending<newton_off>::writes(term<3>{}, 0));
}

TEST_CASE("rows go by particle and by place, and a bond begins with the particle that writes it", "[store][C5]") {
    one_rank r;
    for (const std::int64_t t : {5, 3, 8}) r.add(t);
    r.index();
    using rules = bonding<newton_off>;
    CHECK(rules::insert(r.g, r.where, {2, {8, 3}}) == 2);
    CHECK(rules::insert(r.g, r.where, {-4, {5, 3}}) == 2);
    CHECK(rules::insert(r.g, r.where, {2, {5, 8}}) == 2);
    CHECK(rules::insert(r.g, r.where, {2, {8, 5}}) == 2);  // a double bond
    CHECK(rules::insert(r.g, r.where, {1, {8, 77}}) == 1);
    CHECK(rules::insert(r.g, r.where, {1, {76, 77}}) == 0);
    std::vector<std::array<std::int64_t, 3>> written;
    rules::rows(r.g, [&](std::int64_t type, const auto& ids) { written.push_back({type, ids[0], ids[1]}); });
    CHECK(written == std::vector<std::array<std::int64_t, 3>>{{2, 5, 8}, {2, 5, 8}, {2, 3, 8}, {4, 3, 5}, {1, 8, 77}});
    CHECK(rules::count(r.g) == 5);
}

TEMPLATE_TEST_CASE("type 0 is skipped wherever it stands, and refused where it is inserted", "[store][C5][C7]",
                   newton_on, newton_off) {
    one_rank r;
    for (const std::int64_t t : {1, 2, 3}) r.add(t);
    r.index();
    CHECK(says(thrown<tsubu::input_error>([&] { bonding<TestType>::insert(r.g, r.where, {0, {1, 2}}); }),
               "tsubu::topology::insert: a term of type 0 in bonds {1, 2}; type 0 is no term; leave it out"));
    r.g[tsubu::bonds][0].push_back({0, {1, 2}});
    r.g[tsubu::bonds][0].push_back({-2147483647 - 1, {1, 2}});
    r.g[tsubu::angles][1].push_back({0, {1, 2, 3}});
    CHECK(bonding<TestType>::count(r.g) == 1);
    CHECK(bending<TestType>::count(r.g) == 0);
    bonding<TestType>::rows(r.g, [](std::int64_t type, const auto&) { CHECK(type == 2147483648); });
    CHECK(bonding<TestType>::resolve(r.g, r.where, r.same, [](auto, auto) { return 0.0; }).keepers.size() == 1);
}

TEMPLATE_TEST_CASE("a particle twice in a term is refused, unless that is meant", "[store][C5][C7]", newton_on,
                   newton_off) {
    one_rank r;
    for (const std::int64_t t : {1, 2, 3}) r.add(t);
    r.index();
    CHECK(says(
        thrown<tsubu::input_error>([&] {
            bonding<TestType>::insert(r.g, r.where, {1, {2, 2}});
        }),
        "tsubu::topology::insert: particle 2 twice in bonds {2, 2}; a term joins different particles; allow repeats "
        "if that is meant"));
    CHECK_THROWS_AS(bending<TestType>::insert(r.g, r.where, {1, {1, 3, 3}}), tsubu::input_error);
    CHECK_THROWS_AS(bending<TestType>::insert(r.g, r.where, {1, {3, 1, 3}}), tsubu::input_error);
    CHECK(bonding<TestType>::count(r.g) + bending<TestType>::count(r.g) == 0);
    CHECK(bonding<TestType>::insert(r.g, r.where, {1, {2, 2}}, true) == 1);
    CHECK(bending<TestType>::insert(r.g, r.where, {1, {1, 3, 3}}, true) == (TestType::keeps_once ? 1 : 2));
    CHECK(bonding<TestType>::count(r.g) == 1);
    CHECK(bending<TestType>::count(r.g) == 1);
}

TEST_CASE("a term whose main particle is owned nowhere is kept by those that are, and not written", "[store][C7]") {
    one_rank r;
    r.add(1);
    r.add_ghost(2);
    r.index();
    CHECK(bending<newton_on>::insert(r.g, r.where, {1, {1, 2, 3}}) == 0);
    CHECK(bending<newton_off>::insert(r.g, r.where, {1, {1, 2, 3}}) == 1);
    CHECK(bending<newton_off>::count(r.g) == 0);
    CHECK(r.g[tsubu::angles][1].empty());  // no ghost keeps one
}

TEST_CASE("each partner is its copy closest to the keeper, also where a ghost is nearer than the owned one",
          "[store]") {
    one_rank r;  // a periodic line from 0 to 10
    r.add(1, 0.1);
    r.add(2, 9.9);
    r.add(3, 0.5);
    r.add_ghost(2, -0.1);
    r.add_ghost(1, 10.1);
    r.add_ghost(3, 10.5);
    r.index();
    using rules = bonding<newton_off>;
    rules::insert(r.g, r.where, {1, {1, 2}});
    rules::insert(r.g, r.where, {1, {3, 1}});
    rules::insert(r.g, r.where, {1, {2, 77}});
    const auto x = r.g[tsubu::position<1>];
    const auto found = rules::resolve(r.g, r.where, r.same, [&](tsubu::index_t i, tsubu::index_t j) {
        const auto step = x[static_cast<std::size_t>(i)][0] - x[static_cast<std::size_t>(j)][0];
        return step * step;
    });
    using places = std::vector<std::array<tsubu::index_t, 2>>;
    CHECK(found.keepers == std::vector<tsubu::index_t>{0, 0, 1, 1, 2});
    CHECK(found.places == places{{0, 3}, {2, 0}, {4, 1}, {1, absent}, {2, 0}});
    CHECK(found.incomplete == 1);
    const auto none = bending<newton_on>::resolve(r.g, r.where, r.same, [](auto, auto) { return 0; });
    CHECK(none.keepers.empty());
    CHECK(none.incomplete == 0);
}

TEST_CASE("a term of several absent particles is one incomplete term", "[store]") {
    one_rank r;
    r.add(1);
    r.add(2);
    r.index();
    bending<newton_on>::insert(r.g, r.where, {1, {70, 2, 71}});
    bending<newton_on>::insert(r.g, r.where, {1, {1, 2, 71}});
    const auto found = bending<newton_on>::resolve(r.g, r.where, r.same, [](auto, auto) { return 0; });
    CHECK(found.incomplete == 2);
    CHECK(found.places[0] == std::array<tsubu::index_t, 3>{absent, 1, absent});
    CHECK(found.places[1] == std::array<tsubu::index_t, 3>{0, 1, absent});
}

TEMPLATE_TEST_CASE("terms of particles that leave are removed, and counted", "[store]", newton_on, newton_off) {
    tsubu::random_stream random(8);
    auto all = dealt(50, 1, random);
    auto& r = all[0];
    const auto terms = random_terms<3>(200, 50, random);
    std::size_t kept = 0;
    for (const auto& one : terms) kept += bending<TestType>::insert(r.g, r.where, one);
    const std::vector<std::int64_t> gone{3, 17, 18, 49};
    const auto names_one = [&](const auto& ids) {
        return std::any_of(ids.begin(), ids.end(),
                           [&](auto t) { return std::binary_search(gone.begin(), gone.end(), t); });
    };
    const auto leaving =
        std::count_if(terms.begin(), terms.end(), [&](const auto& one) { return names_one(one.ids); });
    const auto removed = bending<TestType>::remove_terms_of(r.g, gone);
    CHECK(removed == static_cast<std::size_t>(leaving) * (TestType::keeps_once ? 1 : 3));
    CHECK(bending<TestType>::count(r.g) == terms.size() - static_cast<std::size_t>(leaving));
    bending<TestType>::rows(r.g, [&](std::int64_t, const auto& ids) { CHECK_FALSE(names_one(ids)); });
    CHECK(bending<TestType>::remove_terms_of(r.g, gone) == 0);
    CHECK(bending<TestType>::remove_terms_of(r.g, std::vector<std::int64_t>{}) == 0);
    CHECK(kept > removed);
}

TEST_CASE("terms go with their particles: sorted, removed, added after another", "[store]") {
    one_rank r;
    for (const std::int64_t t : {4, 3, 2, 1}) r.add(t);
    r.index();
    for (std::int64_t t = 1; t < 4; ++t)
        bonding<newton_on>::insert(r.g, r.where, {static_cast<std::int32_t>(t), {t, t + 1}});
    const auto mine = r.g.owned();
    std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(r.g[tsubu::bonds][0][0] == term<2>{1, {1, 2}});
    CHECK(r.g[tsubu::bonds][2][0] == term<2>{3, {3, 4}});
    r.g.swap_remove(0);
    CHECK(r.g[tsubu::bonds][0].empty());
    CHECK(bonding<newton_on>::count(r.g) == 2);
}

TEST_CASE("ids that no particle can have are refused, or found nowhere", "[store][topology]") {
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::bonds>> g;
    g.push_back(tsubu::id = 7);
    g.push_back(tsubu::id = 9);
    tsubu::id_map<tsubu::dense_storage<std::int32_t>> where;
    where.rebuild(std::vector<std::int32_t>{7, 9});
    using rules = tsubu::topology<tsubu::bonds, tsubu::newton_on>;
    CHECK(says(thrown<tsubu::input_error>([&] { rules::insert(g, where, {1, {7, -9}}); }), "particle -9"));
    for (const std::int64_t type : {std::int64_t{1} << 31, -(std::int64_t{1} << 31)}) {
        const auto text = thrown<tsubu::input_error>([&] { rules::insert(g, where, {type, {7, 9}}); });
        CHECK(says(text, "type " + std::to_string(type) + " in bonds {7, 9}; types go up to 2^31 - 1"));
    }
    const std::int64_t beyond = (std::int64_t{1} << 32) + 7;
    CHECK(rules::insert(g, where, {1, {beyond, 9}}) == 0);
    g[tsubu::bonds][0].push_back({1, {beyond, 9}});
    const std::vector<std::int32_t> ids{7, 9};
    tsubu::same_id_links same;
    where.rebuild(ids, same);
    const auto found = rules::resolve(g, where, same, [](tsubu::index_t, tsubu::index_t) { return 0.0; });
    CHECK(found.incomplete == 1);
    CHECK(found.places[0][0] == tsubu::absent);
    CHECK(found.places[0][1] == 1);
}
