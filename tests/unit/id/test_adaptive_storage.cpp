// SPDX-License-Identifier: MIT
#include <tsubu/id/adaptive_storage.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

using tsubu::absent;
using tsubu::adaptive_choice;
using tsubu::adaptive_storage;
using tsubu::index_t;
using ids_t = std::vector<std::int64_t>;

template <class Storage>
std::vector<index_t> build(Storage& storage, const ids_t& ids) {
    std::vector<index_t> links(ids.size(), 77);
    storage.rebuild(ids, tsubu::range_of(std::span(ids)), links);
    return links;
}

ids_t consecutive(std::size_t count, std::int64_t from = 0) {
    ids_t ids(count);
    for (std::size_t i = 0; i < count; ++i) ids[i] = from + static_cast<std::int64_t>(i);
    return ids;
}

/// Different ids, one at random in each run of `gap` values.
ids_t scattered(std::size_t count, std::int64_t gap) {
    ids_t ids(count);
    for (std::size_t i = 0; i < count; ++i)
        ids[i] = static_cast<std::int64_t>(i) * gap +
                 static_cast<std::int64_t>(tsubu::splitmix64(i) % static_cast<std::uint64_t>(gap));
    return ids;
}

/// Runs of 1024 ids, 2^20 apart.
ids_t blocks(std::size_t count) {
    ids_t ids(count);
    for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<std::int64_t>((i >> 10 << 20) + (i & 1023));
    return ids;
}

struct example {
    adaptive_choice choice;
    ids_t ids;
};
std::vector<example> one_for_each_table() {
    return {{adaptive_choice::dense, consecutive(5000, 100)},
            {adaptive_choice::flat, scattered(5000, 1'000'003)},
            {adaptive_choice::paged, blocks(50'000)}};
}

template <class Storage>
bool holds(const Storage& storage, const ids_t& ids) {
    std::vector<index_t> answers(ids.size(), 77);
    storage.find(ids, answers);
    bool right = storage.size() == ids.size();
    for (std::size_t i = 0; i < ids.size(); ++i)
        right = right && answers[i] == static_cast<index_t>(i) && storage.find(ids[i]) == answers[i];
    return right && storage.find(-1) == absent && storage.find(std::int64_t{1} << 62) == absent;
}

}  // namespace

TEST_CASE("each pattern of ids gets its table, whichever came before", "[id][adaptive_storage][A4][A5]") {
    const auto examples = one_for_each_table();
    for (const auto& former : examples) {
        for (const auto& next : examples) {
            adaptive_storage<> storage;
            build(storage, former.ids);
            CHECK(storage.choice() == former.choice);
            const auto links = build(storage, next.ids);
            CHECK(storage.choice() == next.choice);
            CHECK(holds(storage, next.ids));
            CHECK(links == std::vector<index_t>(next.ids.size(), absent));
        }
    }
}

TEST_CASE("the choice names its table and its reason", "[id][adaptive_storage]") {
    adaptive_storage<> storage;
    CHECK(says(storage.explain(), "no ids yet"));
    const char* const names[] = {"flat_storage", "dense_storage", "paged_storage"};
    for (const auto& [choice, ids] : one_for_each_table()) {
        build(storage, ids);
        CHECK(says(storage.explain(), names[static_cast<std::size_t>(choice)]));
        CHECK(says(storage.explain(), std::to_string(ids.size()) + " ids between"));
    }
    storage.clear();
    CHECK(says(storage.explain(), "no ids yet"));
}

TEST_CASE("an assign far outside the range moves the ids of any table to flat lines", "[id][adaptive_storage][T12]") {
    for (const auto& [choice, ids] : one_for_each_table()) {
        adaptive_storage<> storage;
        build(storage, ids);
        storage.assign(std::int64_t{1} << 61, 7);
        CHECK(storage.choice() == adaptive_choice::flat);
        CHECK(storage.find(std::int64_t{1} << 61) == 7);
        CHECK(storage.erase(std::int64_t{1} << 61));
        CHECK(holds(storage, ids));
        build(storage, ids);  // back at a rebuild
        CHECK(storage.choice() == choice);
    }
}

TEST_CASE("an assign inside the range, or beside it, stays in the table", "[id][adaptive_storage]") {
    for (const auto& [choice, ids] : one_for_each_table()) {
        adaptive_storage<> storage;
        build(storage, ids);
        storage.assign(ids[3], 12);
        storage.assign(ids.back() + 1, 13);
        CHECK(storage.choice() == choice);
        CHECK(storage.find(ids[3]) == 12);
        CHECK(storage.find(ids.back() + 1) == 13);
        CHECK(storage.size() == ids.size() + 1);
    }
}

TEST_CASE("a memory limit that refuses the pick leads to flat lines, and a smaller one to an exception",
          "[id][adaptive_storage][T10]") {
    const auto ids = scattered(5000, 20);  // dense: 400 kB, flat: 40 kB
    adaptive_storage<> free_choice;
    build(free_choice, ids);
    REQUIRE(free_choice.choice() == adaptive_choice::dense);
    adaptive_storage<> limited{tsubu::memory_limit{100'000}};
    build(limited, ids);
    CHECK(limited.choice() == adaptive_choice::flat);
    CHECK(limited.memory_bytes() <= 100'000);
    CHECK(holds(limited, ids));
    CHECK_THROWS_AS(build(limited, scattered(50'000, 20)), tsubu::limit_error);
    CHECK(holds(limited, ids));

    adaptive_storage<> none{tsubu::memory_limit{0}};
    build(none, {});
    for (const auto& [choice, refused] : one_for_each_table())
        CHECK_THROWS_AS(build(none, refused), tsubu::limit_error);
    CHECK_THROWS_AS(none.assign(1, 1), tsubu::limit_error);
    CHECK(none.size() == 0);
}

TEST_CASE("where memory ends while the table changes, the old one is intact", "[id][adaptive_storage][T10]") {
    using gated = tsubu::testing::throwing_allocator<std::byte>;
    const auto examples = one_for_each_table();
    for (const auto& former : examples) {
        for (const auto& next : examples) {
            if (former.choice == next.choice) continue;
            std::size_t number = 0;
            for (bool threw = true; threw; ++number) {
                tsubu::testing::allocation_gate gate;
                adaptive_storage<std::int64_t, gated> storage{gated(gate)};
                build(storage, former.ids);
                gate.refuse_from(number);
                try {
                    build(storage, next.ids);
                    threw = false;
                } catch (const std::bad_alloc&) {
                    CHECK(storage.choice() == former.choice);
                    CHECK(holds(storage, former.ids));
                }
            }
            CHECK(number > 1);
        }
        // The move to flat lines as well.
        if (former.choice == adaptive_choice::flat) continue;
        tsubu::testing::allocation_gate gate;
        adaptive_storage<std::int64_t, gated> storage{gated(gate)};
        build(storage, former.ids);
        gate.refuse_from(0);
        CHECK_THROWS_AS(storage.assign(std::int64_t{1} << 61, 7), std::bad_alloc);
        gate.open();
        CHECK(storage.choice() == former.choice);
        CHECK(holds(storage, former.ids));
    }
}

TEST_CASE("a copy of an adaptive_storage is independent, and what was moved from takes ids again",
          "[id][adaptive_storage]") {
    for (const auto& [choice, ids] : one_for_each_table()) {
        adaptive_storage<> storage;
        build(storage, ids);
        auto copy = storage;
        CHECK(copy.choice() == choice);
        copy.assign(ids[0], 99);
        CHECK(holds(storage, ids));
        const auto moved = std::move(copy);
        CHECK(moved.find(ids[0]) == 99);
        build(copy, ids);
        CHECK(holds(copy, ids));
    }
}
