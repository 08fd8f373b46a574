// SPDX-License-Identifier: MIT
#include <tsubu/id/id_map.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/core/threads.hpp>
#include <tsubu/id/chained_storage.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/memory_limit.hpp>
#include <tsubu/testing/archetypes.hpp>
#include <tsubu/testing/id_patterns.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <new>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using namespace tsubu;
using ids_t = std::vector<std::int64_t>;
using testing::minimal_id_storage;

using fronts = std::tuple<id_map<>, id_map<minimal_id_storage<>>, id_map<chained_storage<mixed>>,
                          id_map<flat_storage<>>, id_map<dense_storage<>>>;

static_assert(std::is_same_v<id_map<>::id_type, std::int64_t>);
static_assert(std::is_nothrow_move_constructible_v<id_map<>>);
static_assert(noexcept(std::declval<const id_map<>&>().find(5)));
static_assert(noexcept(std::declval<const id_map<>&>().prefetch(5)));
static_assert(noexcept(std::declval<id_map<>&>().erase(5)) && noexcept(std::declval<id_map<>&>().clear()));

std::vector<index_t> all_links(const same_id_links& same) { return {same.links().begin(), same.links().end()}; }

/// Whether the map answers for `ids`, for `others` and for its size as one that was built from `ids` alone.
template <class Map>
bool is_map_of(const Map& where, const ids_t& ids, const ids_t& others = {}) {
    id_map<minimal_id_storage<>> right;
    right.rebuild(ids);
    bool same = where.size() == right.size();
    for (const auto id : ids) same = same && where.find(id) == right.find(id);
    for (const auto id : others) same = same && where.find(id) == right.find(id);
    return same && where.find(-1) == absent;
}
std::vector<index_t> links_of(const ids_t& ids) {
    id_map<minimal_id_storage<>> right;
    same_id_links same;
    right.rebuild(ids, same);
    return all_links(same);
}

/// An executor of the caller's own: parts in reverse, on the calling thread.
struct backwards {
    [[nodiscard]] static constexpr std::size_t concurrency() noexcept { return 3; }
    template <class Part>
    static void run(Part&& part) {
        for (std::size_t k = 3; k-- > 0;) part(k);
    }
};
static_assert(executor<backwards>);

/// A span of as many ids as are asked for, none of which may be read.
std::span<const std::int64_t> unreadable(std::size_t count) {
    static const std::int64_t one = 0;
    return {&one, count};
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("find yields the lowest index, or absent", "[id][A1][A4]", fronts) {
    TestType where;
    CHECK(where.empty());
    where.rebuild(ids_t{9, 5, 9, 0, 5});
    CHECK(where.find(9) == 0);
    CHECK(where.find(5) == 1);
    CHECK(where.find(0) == 3);
    CHECK(where.find(1) == absent);
    CHECK(where.find(-9) == absent);
    CHECK(where.contains(5));
    CHECK_FALSE(where.contains(6));
    CHECK(where.size() == 3);
    CHECK_FALSE(where.empty());
    CHECK(where.memory_bytes() > 0);
    where.clear();
    CHECK(where.empty());
    CHECK(where.find(9) == absent);
}

TEMPLATE_LIST_TEST_CASE("many ids at once yield what each yields alone", "[id][A1]", fronts) {
    TestType where;
    where.rebuild(ids_t{9, 5, 9, 0, 5});
    const ids_t asked{5, -1, 9, 9, 7, 0, (std::numeric_limits<std::int64_t>::max)()};
    std::vector<index_t> indices(asked.size(), 99);
    where.find(asked, indices);
    CHECK(indices == std::vector<index_t>{1, -1, 0, 0, -1, 3, -1});
    where.find({}, {});
    where.prefetch(5);
    where.prefetch(-5);
    CHECK(where.find(5) == 1);
}

TEST_CASE("spans of different length are refused, and nothing is written", "[id]") {
    id_map<> where;
    where.rebuild(ids_t{9, 5});
    const ids_t asked{5, 9, 9};
    std::vector<index_t> indices(2, 99);
    const auto text = thrown<input_error>([&] { where.find(asked, indices); });
    INFO(text);
    for (const auto* words : {"id_map::find", "3 ids", "2 indices", "equal length"}) CHECK(says(text, words));
    CHECK(indices == std::vector<index_t>{99, 99});
}

TEST_CASE("at names the id that is not there", "[id][A1]") {
    id_map<> where;
    where.rebuild(ids_t{9, 5});
    CHECK(where.at(5) == 1);
    const auto text = thrown<input_error>([&] { static_cast<void>(where.at(901'417)); });
    INFO(text);
    for (const auto* words : {"id_map::at", "id 901417", "2 ids", "find()"}) CHECK(says(text, words));
}

TEMPLATE_LIST_TEST_CASE("a negative id is refused by index and value, and nothing changes", "[id][T7]", fronts) {
    TestType where;
    same_id_links same;
    const ids_t ids{9, 5, 9};
    where.rebuild(ids, same);
    const auto before = all_links(same);
    const ids_t bad{1, 2, 3, 1, -7, 3, -8};
    for (const bool with_links : {true, false}) {
        const auto text = thrown<input_error>([&] {
            if (with_links)
                where.rebuild(bad, same);
            else
                where.rebuild(bad);
        });
        INFO(text);
        for (const auto* words : {"id_map::rebuild", "ids[4] = -7", "from 0 or 1"}) CHECK(says(text, words));
        CHECK(is_map_of(where, ids, bad));
        CHECK(all_links(same) == before);
    }
}

TEST_CASE("more ids than an index can count are refused unread", "[id][T14]") {
    id_map<> where;
    same_id_links same;
    where.rebuild(ids_t{9, 5, 9}, same);
    const auto many = unreadable(max_index_count + 1);
    const auto text = thrown<limit_error>([&] { where.rebuild(many); });
    INFO(text);
    for (const auto* words : {"id_map::rebuild", "2147483648 ids", "31 bits", "2147483647", "more ranks"})
        CHECK(says(text, words));
    CHECK_THROWS_AS(where.rebuild(many, same), limit_error);
    CHECK(says(thrown<limit_error>([&] { where.reserve(max_index_count + 1); }), "id_map::reserve"));
    CHECK(is_map_of(where, {9, 5, 9}));
    CHECK(same.size() == 3);
}

TEMPLATE_LIST_TEST_CASE("assign inserts or overwrites, erase forgets", "[id]", fronts) {
    TestType where;
    where.assign(7, 3);
    where.assign(7, 1);
    where.assign(0, 0);
    CHECK(where.find(7) == 1);
    CHECK(where.size() == 2);
    CHECK(where.erase(7));
    CHECK_FALSE(where.erase(7));
    CHECK_FALSE(where.erase(-7));
    CHECK(where.find(7) == absent);
    CHECK(where.find(0) == 0);
    where.reserve(1000);
    CHECK(where.find(0) == 0);
}

TEST_CASE("assign refuses negative ids and indices that are none", "[id][T7]") {
    id_map<> where;
    where.assign(5, 2);
    const auto negative_id = thrown<input_error>([&] { where.assign(-3, 2); });
    INFO(negative_id);
    CHECK(says(negative_id, "id -3 is negative"));
    const auto negative_index = thrown<input_error>([&] { where.assign(5, absent); });
    INFO(negative_index);
    for (const auto* words : {"index -1 of id 5", "erase(id)"}) CHECK(says(negative_index, words));
    // index + 1 must fit as well: the last index is max_index_count - 1.
    CHECK_THROWS_AS(where.assign(5, (std::numeric_limits<index_t>::max)()), error);
    CHECK(where.find(5) == 2);
    CHECK(where.size() == 1);
    where.assign(5, static_cast<index_t>(max_index_count - 1));
    CHECK(where.find(5) == static_cast<index_t>(max_index_count - 1));
}

TEMPLATE_LIST_TEST_CASE("the result of rebuild does not depend on who does the work", "[id][A4][I12]", fronts) {
    random_stream random(3);
    // Of fewer, flat_storage builds nothing by threads.
#if defined(NDEBUG)
    constexpr std::size_t many = 300'000;
#else  // rebuilds take 30 times as long
    constexpr std::size_t many = std::is_same_v<TestType, id_map<flat_storage<>>> ? 300'000 : 20'000;
#endif
    for (const auto count : std::initializer_list<std::size_t>{0, 1, 2, 3, 1000, many}) {
        const auto ids = testing::make_ids<std::int64_t>(testing::id_pattern::repeated, count, random);
        TestType serial;
        TestType parallel;
        TestType own;
        same_id_links of_serial;
        same_id_links of_parallel;
        same_id_links of_own;
        serial.rebuild(ids, of_serial);
        parallel.rebuild(ids, of_parallel, threads(3));
        own.rebuild(ids, of_own, backwards{});
        CHECK(is_map_of(serial, ids));
        CHECK(is_map_of(parallel, ids));
        CHECK(is_map_of(own, ids));
        CHECK(all_links(of_serial) == links_of(ids));
        CHECK(all_links(of_parallel) == all_links(of_serial));
        CHECK(all_links(of_own) == all_links(of_serial));
        parallel.rebuild(ids, threads(2));
        CHECK(is_map_of(parallel, ids));
    }
}

TEST_CASE("a configured storage is adopted, and may be read", "[id]") {
    const id_map where(chained_storage<mixed>(memory_limit(std::uint64_t{1} << 20)));
    static_assert(std::is_same_v<decltype(where)::storage_type, chained_storage<mixed>>);
    CHECK(where.storage().size() == 0);
    id_map limited(dense_storage<>(memory_limit(1000)));
    CHECK_THROWS_AS(limited.rebuild(ids_t{0, 1'000'000}), limit_error);
}

TEMPLATE_LIST_TEST_CASE("maps are values", "[id]", fronts) {
    TestType where;
    where.rebuild(ids_t{9, 5});
    auto copy = where;
    copy.erase(9);
    CHECK(where.find(9) == 0);
    auto moved = std::move(where);
    CHECK(moved.find(9) == 0);
    where = copy;
    CHECK(where.find(9) == absent);
    CHECK(where.find(5) == 1);
}

// --- update ---------------------------------------------------------------------------------------------------------

TEMPLATE_LIST_TEST_CASE("update yields what rebuild would", "[id][A1][A13]", fronts) {
    const auto seed = GENERATE(std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3}, std::uint64_t{4});
    INFO("seed " << seed);
    random_stream random(seed);
    const std::size_t count = seed % 2 == 0 ? 1500 : 200;
    // Copies of one id everywhere, so that chains are cut at their head, inside, and at their end.
    const std::uint64_t different = 1 + random.below(seed < 3 ? count / 4 : 2 * count);
    const auto some_id = [&] { return static_cast<std::int64_t>(random.below(different)); };
    ids_t ids(count);
    for (auto& id : ids) id = some_id();
    TestType where;
    same_id_links same;
    where.rebuild(ids, same);
    for (int step = 0; step < 150; ++step) {
        auto after = ids;
        switch (random.below(4)) {
            case 0: after.resize(after.size() - random.below(8)); break;
            case 1:
                for (auto k = random.below(8); k > 0; --k) after.push_back(some_id());
                break;
            default: break;
        }
        for (auto k = random.below(after.size() / 20); k > 0; --k) {
            const auto i = random.below(after.size());
            after[i] = random.below(8) == 0 ? static_cast<std::int64_t>(random.below(1 << 20)) : some_id();
            if (random.below(3) == 0) std::swap(after[i], after[random.below(after.size())]);
        }
        where.update(ids, after, same);
        REQUIRE(all_links(same) == links_of(after));
        REQUIRE(is_map_of(where, after, ids));
        ids = after;
    }
}

TEMPLATE_LIST_TEST_CASE("update of nothing, of everything, and to and from nothing", "[id][T2]", fronts) {
    TestType where;
    same_id_links same;
    where.update({}, {}, same);
    CHECK(where.empty());
    ids_t ids(100, 5);
    for (const auto& after : {ids, ids, ids_t(100, 6), ids_t{}, ids_t{7}, ids_t{8}, ids_t(3000, 9), ids_t(2999, 9)}) {
        const auto before = where.empty() ? ids_t{} : ids;
        where.update(before, after, same);
        CHECK(all_links(same) == links_of(after));
        CHECK(is_map_of(where, after, before));
        ids = after;
    }
}

TEST_CASE("update refuses links that are not those of before", "[id][T8]") {
    id_map<> where;
    same_id_links same;
    const ids_t ids{9, 5, 9};
    where.rebuild(ids, same);
    const auto text = thrown<input_error>([&] { where.update(ids_t{9, 5}, ids_t{9, 6}, same); });
    INFO(text);
    for (const auto* words : {"id_map::update", "3 links", "2 ids before", "last built from"}) CHECK(says(text, words));
    CHECK(is_map_of(where, ids));
    CHECK(all_links(same) == links_of(ids));
}

TEST_CASE("update refuses a negative id by index and value, and nothing changes", "[id][T7]") {
    random_stream random(11);
    const auto ids = testing::make_ids<std::int64_t>(testing::id_pattern::repeated, 500, random);
    id_map<> where;
    same_id_links same;
    where.rebuild(ids, same);
    for (const bool many_changes : {false, true}) {
        auto after = ids;
        after[3] = 77'000;
        after[400] = -12;
        if (many_changes)
            for (std::size_t k = 0; k < 200; ++k) after[k] = 88'000;
        const auto text = thrown<input_error>([&] { where.update(ids, after, same); });
        INFO(text);
        CHECK(says(text, "ids[400] = -12"));
        CHECK(is_map_of(where, ids, after));
        CHECK(all_links(same) == links_of(ids));
    }
}

TEST_CASE("update that a policy refuses half way leaves map and links as they were", "[id][T10][T11]") {
    id_map where(dense_storage<>(memory_limit(100'000)));
    same_id_links same;
    ids_t ids(500);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i / 2);
    where.rebuild(ids, same);
    auto after = ids;
    after[0] = 300;
    after[7] = 301;
    after[450] = 2'000'000'000;
    after.push_back(1);
    CHECK_THROWS_AS(where.update(ids, after, same), limit_error);
    CHECK(is_map_of(where, ids, after));
    CHECK(all_links(same) == links_of(ids));
}

namespace {
using gated = testing::throwing_allocator<std::byte>;
using gated_storages = std::tuple<chained_storage<mixed, std::int64_t, gated>, flat_storage<std::int64_t, gated>,
                                  dense_storage<std::int64_t, gated>, adaptive_storage<std::int64_t, gated>>;
}  // namespace

TEMPLATE_LIST_TEST_CASE("update without memory leaves map and links as they were", "[id][T10]", gated_storages) {
    // 1000 different ids fill the least pool of the chained style, so that the new ids need memory.
    ids_t ids(1000);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(3 * i);
    auto after = ids;
    after[10] = 6;  // an image
    for (std::int64_t k = 0; k < 20; ++k) after.push_back(50'000'000 * (k + 1));
    for (std::size_t k = 0; k < 30; ++k) {
        testing::allocation_gate gate;
        id_map<TestType> where{TestType(gated(gate))};
        same_id_links same;
        where.rebuild(ids_t{1});
        where.rebuild(ids, same);
        gate.refuse_from(k);
        bool failed = false;
        try {
            where.update(ids, after, same);
        } catch (const std::bad_alloc&) {
            failed = true;
        } catch (const limit_error&) {
            failed = true;  // a table by range need not take them
        }
        const bool refused = gate.refused() != 0;
        gate.open();
        INFO("allocation " << k << (failed ? " failed" : ""));
        CHECK(is_map_of(where, failed ? ids : after, failed ? after : ids));
        const bool same_links = all_links(same) == links_of(failed ? ids : after);
        CHECK(same_links);
        if (!refused) break;
    }
}

TEST_CASE("an update with the wrong ids before leaves no chain that is a cycle", "[id][id_map][A13]") {
    std::vector<std::int64_t> ids(40);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = 100 + static_cast<std::int64_t>(i);
    ids[0] = ids[5] = 7;
    id_map<flat_storage<>> map;
    same_id_links same;
    map.rebuild(ids, same);
    auto wrong = ids;
    wrong[5] = 999;  // so index 5 stays in the chain of 7, and is to be linked into it again
    map.update(wrong, ids, same);
    const auto links = same.links();
    bool upwards = true;
    for (std::size_t i = 0; i < links.size(); ++i)
        upwards = upwards && (links[i] == absent || links[i] > static_cast<index_t>(i));
    CHECK(upwards);

    wrong = ids;
    wrong[0] = 12'345;  // an id that is not in the map
    map.update(wrong, wrong, same);
    CHECK(map.find(12'345) == absent);
    CHECK(map.size() == 39);
}
