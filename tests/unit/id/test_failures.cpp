// SPDX-License-Identifier: MIT
/// @file
/// The inputs on which id maps are known to fail, each under its number, for every policy.
/// T: map and chain; H: hash and prime (the rest of H is in test_prime and test_hash); I: invariants.
/// T6 needs several ranks and stands with the tests of comm.
#include <tsubu/id/id_map.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/id/adaptive_storage.hpp>
#include <tsubu/id/bitmap_storage.hpp>
#include <tsubu/id/chained_storage.hpp>
#include <tsubu/id/copies.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/hash.hpp>
#include <tsubu/id/paged_storage.hpp>
#include <tsubu/id/prime.hpp>
#include <tsubu/id/sizing.hpp>
#include <tsubu/testing/id_model.hpp>
#include <tsubu/testing/id_patterns.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <new>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace tsubu;
using ids_t = std::vector<std::int64_t>;

using policies = std::tuple<dense_storage<>, chained_storage<mod_prime>, chained_storage<mixed>, flat_storage<>,
                            bitmap_storage<>, paged_storage<>, adaptive_storage<>>;
using narrow = std::tuple<dense_storage<std::int32_t>, chained_storage<mod_prime, std::int32_t>,
                          chained_storage<mixed, std::int32_t>, flat_storage<std::int32_t>,
                          bitmap_storage<std::int32_t>, paged_storage<std::int32_t>, adaptive_storage<std::int32_t>>;
using by_range = std::tuple<dense_storage<>, bitmap_storage<>>;

template <class Storage, class Id = typename Storage::id_type>
struct built {
    built() = default;
    explicit built(const std::vector<Id>& ids) { rebuild(ids); }
    void rebuild(const std::vector<Id>& ids) { where.rebuild(ids, same); }
    [[nodiscard]] std::vector<index_t> links() const { return {same.links().begin(), same.links().end()}; }
    id_map<Storage> where;
    same_id_links same;
};

/// Whether `rebuild` took the ids; if not, by limit_error.
template <class Map, class Ids>
bool takes(Map& map, const Ids& ids) {
    try {
        map.rebuild(ids);
    } catch (const limit_error&) {
        return false;
    }
    return true;
}

}  // namespace

// --- 1. Map and chain -----------------------------------------------------------------------------------------------

TEMPLATE_LIST_TEST_CASE("T1: an owned particle hides its nearer ghost from find, not from closest_image",
                        "[id][T1][A1]", policies) {
    const built<TestType> map({1, 2, 1, 2});
    const double x[] = {0.1, 0.9, 1.1, -0.1};
    CHECK(map.where.find(1) == 0);
    CHECK(map.where.find(2) == 1);
    CHECK(map.links() == std::vector<index_t>{2, 3, -1, -1});
    const auto near = [&](index_t i, std::int64_t id) {
        return closest_image(map.same, map.where.find(id), [&](index_t k) { return std::abs(x[i] - x[k]); });
    };
    CHECK(near(1, 1) == 2);
    CHECK(near(0, 2) == 3);
    CHECK(near(0, 1) == 0);
}

TEMPLATE_LIST_TEST_CASE("T2: no particles, and one", "[id][T2]", policies) {
    built<TestType> map;
    CHECK(map.where.find(0) == absent);
    for (int twice = 0; twice < 2; ++twice) {
        map.rebuild({});
        CHECK(map.where.empty());
        for (const std::int64_t id : {0L, 1L, -1L, 42L}) CHECK(map.where.find(id) == absent);
        std::vector<index_t> answer(1, 9);
        map.where.find(ids_t{42}, answer);
        CHECK(answer[0] == absent);
        CHECK_FALSE(map.where.erase(42));
        map.where.clear();
        map.rebuild({42});
        CHECK(map.where.find(42) == 0);
        CHECK(map.where.size() == 1);
        CHECK(map.links() == std::vector<index_t>{-1});
    }
}

TEST_CASE("T2: an empty map takes no memory", "[id][T2]") {
    testing::allocation_gate gate;
    using gated = testing::throwing_allocator<std::byte>;
    gate.refuse_from(0);
    id_map<adaptive_storage<std::int64_t, gated>> where{adaptive_storage<std::int64_t, gated>(gated(gate))};
    where.rebuild(ids_t{});
    CHECK(where.find(3) == absent);
    where.clear();
    CHECK(gate.refused() == 0);
}

TEMPLATE_LIST_TEST_CASE("T3: ghosts only, with ids above all that were owned here", "[id][T3][A3]", policies) {
    built<TestType> map({1, 2, 3});
    const ids_t ghosts{900'000, 899'999, 900'000, 899'997};
    map.rebuild(ghosts);
    CHECK(map.where.find(900'000) == 0);
    CHECK(map.where.find(899'997) == 3);
    CHECK(map.where.find(2) == absent);
    CHECK(map.links() == std::vector<index_t>{2, -1, -1, -1});
    CHECK(owned_duplicates(map.same, 0).empty());
    // Owned ones first, ghosts far above them.
    map.rebuild({1, 2, 3, 900'000, 2});
    CHECK(map.where.find(900'000) == 3);
    CHECK(map.where.find(900'001) == absent);
    CHECK(map.where.find(2) == 1);
}

TEMPLATE_LIST_TEST_CASE("T4: all copies of one id are one chain", "[id][T4][A13]", policies) {
    const auto count = GENERATE(std::size_t{2}, std::size_t{17}, std::size_t{50'000});
    const built<TestType> map(ids_t(count, 5));
    CHECK(map.where.find(5) == 0);
    CHECK(map.where.size() == 1);
    const auto links = map.links();
    REQUIRE(links.size() == count);
    bool rising = links.back() == absent;
    for (std::size_t i = 0; i + 1 < count; ++i) rising = rising && links[i] == static_cast<index_t>(i + 1);
    CHECK(rising);
}

TEMPLATE_LIST_TEST_CASE("T5: particles owned twice are reported", "[id][T5][A13]", policies) {
    const auto first = owned_duplicates(built<TestType>({4, 9, 4}).same, 3);
    REQUIRE(first.size() == 1);
    CHECK(first[0] == duplicate{0, 2});
    const auto second = owned_duplicates(built<TestType>({1, 1, 3}).same, 3);
    REQUIRE(second.size() == 1);
    CHECK(second[0] == duplicate{0, 1});
}

TEMPLATE_LIST_TEST_CASE("T7: extreme values as questions are absent, as ids they are kept or refused", "[id][T7][A1]",
                        policies) {
    constexpr auto low = (std::numeric_limits<std::int64_t>::min)();
    constexpr auto high = (std::numeric_limits<std::int64_t>::max)();
    constexpr std::int64_t low32 = (std::numeric_limits<std::int32_t>::min)();
    constexpr std::int64_t high32 = (std::numeric_limits<std::int32_t>::max)();
    const ids_t extremes{0, -1, low32, high32, high, low, high - 1, low + 1, high32 + 1, -2};
    const ids_t ids{7, 5, 6, 5};
    built<TestType> map(ids);
    const auto unharmed = [&] {
        return map.where.find(7) == 0 && map.where.find(5) == 1 && map.where.find(6) == 2 && map.where.size() == 3;
    };
    std::vector<index_t> answers(extremes.size(), 0);
    map.where.find(extremes, answers);
    CHECK(answers == std::vector<index_t>(extremes.size(), absent));
    for (const auto id : extremes) {
        INFO("id " << id);
        CHECK(map.where.find(id) == absent);
        CHECK_FALSE(map.where.erase(id));
        CHECK(unharmed());
        if (id < 0) {
            CHECK(says(thrown<input_error>([&] { map.rebuild({7, id}); }), "ids[1] = " + std::to_string(id)));
            CHECK_THROWS_AS(map.where.assign(id, 0), input_error);
            CHECK(unharmed());
            CHECK(map.links() == std::vector<index_t>{-1, 3, -1, -1});
        } else if (takes(map, ids_t{1, id, 1})) {
            CHECK(map.where.find(id) == 1);
            CHECK(map.where.find(1) == 0);
            CHECK(map.where.find(low) == absent);
            CHECK(map.where.find(-1) == absent);
            map.rebuild({id});
            CHECK(map.where.find(id) == 0);
            map.rebuild(ids);
        } else {
            CHECK(unharmed());
        }
    }
    // Alone, the highest id spans a range of one: no policy may refuse it for its size.
    built<dense_storage<>> one({high});
    CHECK(one.where.find(high) == 0);
    CHECK(one.where.find(-1) == absent);
}

TEMPLATE_LIST_TEST_CASE("T7: the extremes of 32-bit ids", "[id][T7][T11]", narrow) {
    constexpr auto low = (std::numeric_limits<std::int32_t>::min)();
    constexpr auto high = (std::numeric_limits<std::int32_t>::max)();
    built<TestType> map(std::vector<std::int32_t>{high, high - 1, high - 2, high});
    CHECK(map.where.find(high) == 0);
    CHECK(map.where.find(high - 2) == 2);
    CHECK(map.links() == std::vector<index_t>{3, -1, -1, -1});
    for (const auto id : {low, low + 1, -1, 0, high - 3}) CHECK(map.where.find(id) == absent);
    if (takes(map, std::vector<std::int32_t>{0, high})) {
        CHECK(map.where.find(high) == 1);
        CHECK(map.where.find(0) == 0);
    } else {
        CHECK(map.where.find(high - 1) == 1);
    }
    CHECK(map.where.find(low) == absent);
    CHECK(map.where.find(-1) == absent);
    CHECK_THROWS_AS(map.rebuild({5, low}), input_error);
}

TEMPLATE_LIST_TEST_CASE("T8: nothing of an earlier build is left", "[id][T8][A4]", policies) {
    built<TestType> map({1, 3, 5});
    CHECK(map.where.find(5) == 2);
    map.rebuild({7, 5, 5, 8});
    CHECK(map.links() == std::vector<index_t>{-1, 2, -1, -1});
    CHECK(map.where.find(5) == 1);
    CHECK(map.where.find(1) == absent);
    CHECK(map.where.find(3) == absent);
    CHECK(map.where.size() == 3);
}

TEMPLATE_LIST_TEST_CASE("T9: every policy gives the same map and links, across the capacity of LIGGGHTS' scheme",
                        "[id][T9][I5][A12]", policies) {
    random_stream random(9);
    built<TestType> map;
    for (const std::size_t count : {1000U, 1001U, 2002U, 2003U, 999U, 5U, 4006U, 4007U, 0U, 1000U}) {
        for (const auto pattern : {testing::id_pattern::sparse, testing::id_pattern::repeated}) {
            const auto ids = testing::make_ids<std::int64_t>(pattern, count, random);
            const built<chained_storage<mod_prime>> scheme(ids);
            map.rebuild(ids);
            CHECK(map.links() == scheme.links());
            CHECK(map.where.size() == scheme.where.size());
            bool same = true;
            for (std::int64_t id = -2; id < static_cast<std::int64_t>(8 * count + 2); ++id)
                same = same && map.where.find(id) == scheme.where.find(id);
            CHECK(same);
        }
    }
}

TEST_CASE("T10: growth that finds no memory leaves the map as it was", "[id][T10][A12]") {
    using gated = testing::throwing_allocator<std::byte>;
    testing::allocation_gate gate;
    id_map<chained_storage<mixed, std::int64_t, gated>> where{chained_storage<mixed, std::int64_t, gated>(gated(gate))};
    ids_t ids(1000);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(7 * i);
    where.rebuild(ids);
    const auto unharmed = [&] {
        bool same = where.size() == ids.size() && where.find(7 * 1000) == absent;
        for (std::size_t i = 0; i < ids.size(); ++i) same = same && where.find(ids[i]) == static_cast<index_t>(i);
        return same;
    };
    for (std::size_t k = 0; k < 2; ++k) {
        gate.refuse_at(k);
        CHECK_THROWS_AS(where.reserve(5000), std::bad_alloc);
        CHECK(unharmed());
        gate.refuse_at(k);
        CHECK_THROWS_AS(where.rebuild(ids_t(3000, 4)), std::bad_alloc);
        CHECK(unharmed());
    }
    // N = M fits, one more does not.
    ids_t full(chained_least_capacity);
    for (std::size_t i = 0; i < full.size(); ++i) full[i] = static_cast<std::int64_t>(i);
    id_map<chained_storage<mixed, std::int64_t, gated>> small{chained_storage<mixed, std::int64_t, gated>(gated(gate))};
    gate.open();
    small.rebuild(ids_t{1});
    gate.refuse_from(0);
    small.rebuild(full);
    CHECK_THROWS_AS(small.assign(5000, 0), std::bad_alloc);
    CHECK(small.size() == full.size());
    CHECK(small.find(999) == 999);
    small.assign(999, 3);
    CHECK(small.find(999) == 3);
}

TEMPLATE_LIST_TEST_CASE("T11: a table by range refuses one far id instead of taking 8 GB", "[id][T11][A2][A3][A5]",
                        by_range) {
    built<TestType> map({3, 1, 2});
    const auto text = thrown<limit_error>([&] { map.rebuild({1, 2'000'000'000, 2}); });
    INFO(text);
    for (const auto* words : {"2000000000", "bytes", "limit", "flat_storage"}) CHECK(says(text, words));
    CHECK_THROWS_AS(map.where.assign(2'000'000'000, 0), limit_error);
    CHECK(map.where.find(1) == 1);
    CHECK(map.where.size() == 3);
    CHECK(map.links() == std::vector<index_t>{-1, -1, -1});
    // A limit of the caller's own is kept to the byte.
    id_map<TestType> generous{TestType(memory_limit(std::uint64_t{1} << 22))};
    generous.rebuild(ids_t{0, 500'000});
    CHECK(generous.find(500'000) == 1);
    CHECK(generous.memory_bytes() <= std::size_t{1} << 22);
}

TEST_CASE("T11: the default takes one far id within its memory bound", "[id][T11]") {
    ids_t ids(1000);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i);
    ids[500] = 2'000'000'000;
    const built<adaptive_storage<>> map(ids);
    CHECK(map.where.find(2'000'000'000) == 500);
    CHECK(map.where.find(999) == 999);
    CHECK(map.where.find(500) == absent);
    CHECK(map.where.memory_bytes() < 64 * chained_bytes_per_id * ids.size());
}

TEST_CASE("T11: the range of 32-bit ids up to the highest does not wrap", "[id][T11][A3]") {
    constexpr auto high = (std::numeric_limits<std::int32_t>::max)();
    built<dense_storage<std::int32_t>> dense({high - 1, high, high - 1});
    CHECK(dense.where.find(high) == 1);
    CHECK(dense.where.find((std::numeric_limits<std::int32_t>::min)()) == absent);
    CHECK_THROWS_AS(dense.rebuild({0, high}), limit_error);
    CHECK(dense.where.find(high) == 1);
    built<dense_storage<std::uint64_t>> widest({0});
    CHECK_THROWS_AS(widest.rebuild({0, ~std::uint64_t{0}}), limit_error);
    CHECK(widest.where.find(0) == 0);
    CHECK(widest.where.find(~std::uint64_t{0}) == absent);
}

TEMPLATE_LIST_TEST_CASE("T12: a million new ids go one by one into a table sized for a thousand", "[id][T12][A12]",
                        policies) {
    constexpr std::int64_t count = 1'000'000;
    id_map<TestType> where;
    where.reserve(1000);
    where.rebuild(ids_t{2, 4});
    for (std::int64_t k = 0; k < count; ++k) where.assign(2 * k + 1, static_cast<index_t>(k));
    CHECK(where.size() == static_cast<std::size_t>(count) + 2);
    bool right = where.find(2) == 0 && where.find(4) == 1 && where.find(6) == absent;
    for (std::int64_t k = 0; k < count; ++k) right = right && where.find(2 * k + 1) == static_cast<index_t>(k);
    CHECK(right);
}

TEMPLATE_LIST_TEST_CASE("T13: shuffling ghosts moves nothing but ghosts", "[id][T13][I12][A1]", policies) {
    random_stream random(13);
    constexpr std::size_t owned_count = 200;
    ids_t ids;
    std::vector<double> x;
    for (std::size_t i = 0; i < owned_count; ++i) {
        ids.push_back(static_cast<std::int64_t>(i) * 5);
        x.push_back(random.unit());
    }
    for (std::size_t k = 0; k < 150; ++k) {  // images of owned ones, and particles that live elsewhere
        const auto id =
            static_cast<std::int64_t>(random.below(2) == 0 ? 5 * random.below(owned_count) : 2000 + random.below(60));
        ids.push_back(id);
        x.push_back(2 * random.unit() - 0.5);
    }
    const built<TestType> before(ids);
    auto shuffled_ids = ids;
    auto shuffled_x = x;
    for (std::size_t k = ids.size() - 1; k > owned_count; --k) {
        const auto j = owned_count + random.below(k - owned_count + 1);
        std::swap(shuffled_ids[k], shuffled_ids[j]);
        std::swap(shuffled_x[k], shuffled_x[j]);
    }
    const built<TestType> after(shuffled_ids);
    const auto least = [](const built<TestType>& map, const std::vector<double>& at, std::int64_t id, double from) {
        const auto distance = [&](index_t k) { return std::abs(at[static_cast<std::size_t>(k)] - from); };
        return distance(closest_image(map.same, map.where.find(id), distance));
    };
    bool owned_stay = true;
    bool same_distance = true;
    for (const auto id : ids) {
        const auto found = before.where.find(id);
        if (static_cast<std::size_t>(found) < owned_count)
            owned_stay = owned_stay && after.where.find(id) == found;
        else
            owned_stay = owned_stay && static_cast<std::size_t>(after.where.find(id)) >= owned_count;
        same_distance = same_distance && least(before, x, id, 0.37) == least(after, shuffled_x, id, 0.37);
    }
    CHECK(owned_stay);
    CHECK(same_distance);
    CHECK(before.where.size() == after.where.size());
}

TEST_CASE("T14: sizes of the largest runs do not wrap", "[id][T14][A6]") {
    CHECK(chained_capacity(std::uint64_t{1} << 30, 100'000'000'000, 10) == 20'000'000'000);
    CHECK(memory_limit().bytes(max_index_count) == 64 * 40 * std::uint64_t{2'147'483'647});
}

// --- 2. Hash and prime ----------------------------------------------------------------------------------------------

TEST_CASE("H1: ids that are multiples of the bucket count are one chain of mod_prime, none of mixed",
          "[id][H1][A9][A10][A11]") {
    constexpr std::int64_t count = 4000;
    id_map<chained_storage<mod_prime>> notes;
    id_map<chained_storage<mixed>> mixing;
    notes.reserve(count);
    mixing.reserve(count);
    ids_t ids;
    const auto buckets = static_cast<std::int64_t>(notes.storage().bucket_count());
    CHECK(buckets == next_prime(2 * count));
    for (std::int64_t k = 1; k <= count; ++k) ids.push_back(k * buckets);
    notes.rebuild(ids);
    mixing.rebuild(ids);
    CHECK(notes.storage().longest_chain() == static_cast<std::size_t>(count));
    CHECK(mixing.storage().longest_chain() <= 10);
    CHECK(notes.find(ids[77]) == 77);
    CHECK(mixing.find(ids[77]) == 77);
}

TEST_CASE("H1: 40 000 multiples of 32771, and all 65 530 of 32 bits", "[id][H1]") {
    std::vector<std::int32_t> ids;
    for (std::int64_t id = 32'771; id <= (std::numeric_limits<std::int32_t>::max)(); id += 32'771)
        ids.push_back(static_cast<std::int32_t>(id));
    CHECK(ids.size() == 65'530);
    const built<chained_storage<mixed, std::int32_t>> chained(ids);
    CHECK(chained.where.storage().longest_chain() <= 12);
    const built<adaptive_storage<std::int32_t>> map(ids);
    CHECK(map.where.find(ids[60'000]) == 60'000);
    CHECK(map.where.find(32'770) == absent);
    const built<adaptive_storage<>> wide(ids_t(ids.begin(), ids.begin() + 40'000));
    CHECK(wide.where.find(39'999LL * 32'771) == 39'998);
}

TEST_CASE("H1: patterned ids cost the default no more memory, and mixed no longer chains, than random ones",
          "[id][H1][A9]") {
    using testing::id_pattern;
    const auto pattern = GENERATE(id_pattern::stride_1009, id_pattern::stride_32771, id_pattern::stride_65536,
                                  id_pattern::stride_2_32, id_pattern::stride_golden, id_pattern::bit_reversed,
                                  id_pattern::rank_high, id_pattern::rank_low, id_pattern::billions);
    INFO(testing::name_of(pattern));
    random_stream random(21);
    constexpr std::size_t count = 40'000;
    const auto ids = testing::make_ids<std::int64_t>(pattern, count, random);
    const auto uniform = testing::make_ids<std::int64_t>(id_pattern::full_width, count, random);
    const built<chained_storage<mixed>> chained(ids);
    CHECK(chained.where.storage().longest_chain() <= 12);
    const built<flat_storage<>> flat(ids);
    const built<flat_storage<>> flat_uniform(uniform);
    CHECK(flat.where.memory_bytes() <= flat_uniform.where.memory_bytes() * 5 / 4);
    const built<adaptive_storage<>> map(ids);
    testing::id_model<std::int64_t> model;
    CHECK(map.links() == model.rebuild(ids));
    CHECK(flat.links() == map.links());
    bool right = map.where.size() == model.size();
    for (const auto id : ids)
        right = right && map.where.find(id) == model.find(id) && flat.where.find(id) == model.find(id);
    CHECK(right);
}

TEST_CASE("H1: multiples of the current bucket count after each growth", "[id][H1][A7][A12]") {
    id_map<chained_storage<mixed>> where;
    where.reserve(1);
    for (int growth = 0; growth < 6; ++growth) {
        const auto buckets = static_cast<std::int64_t>(where.storage().bucket_count());
        const auto capacity = where.storage().capacity();
        CHECK(buckets == next_prime(static_cast<std::int64_t>(capacity)));
        ids_t ids;
        for (std::size_t k = 0; k < capacity; ++k) ids.push_back(static_cast<std::int64_t>(k + 1) * buckets);
        where.rebuild(ids);
        CHECK(where.storage().capacity() == capacity);  // N = M still fits
        CHECK(where.storage().longest_chain() <= 12);
        where.assign(5, 5);  // N = M + 1 does not
        CHECK(where.storage().capacity() >= 2 * capacity);
        CHECK(where.storage().longest_chain() <= 12);
        CHECK(where.find(ids.back()) == static_cast<index_t>(capacity - 1));
        CHECK(where.find(5) == 5);
    }
}

TEST_CASE("LIGGGHTS' scheme: a hit rewrites the index, a miss takes a free node, erase gives it back",
          "[id][A10][A11][A12]") {
    id_map<chained_storage<mod_prime>> where;
    ids_t ids(chained_least_capacity);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i);
    where.rebuild(ids_t{1});  // sizes the table, in which 1000 then fit
    where.rebuild(ids);
    const auto bytes = where.memory_bytes();
    CHECK(where.storage().capacity() == chained_least_capacity);
    CHECK(where.storage().bucket_count() == 1009);
    CHECK(bytes == chained_least_capacity * 16 + 1009 * 4);
    where.assign(5, 700);  // a hit needs no node, though none is free
    CHECK(where.storage().capacity() == chained_least_capacity);
    CHECK(where.find(5) == 700);
    CHECK(where.erase(6));
    where.assign(6000, 1);  // the node of 6
    CHECK(where.memory_bytes() == bytes);
    where.assign(6001, 2);
    CHECK(where.storage().capacity() > chained_least_capacity);
    CHECK(where.find(6000) == 1);
    CHECK(where.find(6001) == 2);
    CHECK(where.find(6) == absent);
}

// --- 6. Invariants --------------------------------------------------------------------------------------------------

TEMPLATE_LIST_TEST_CASE("I1 to I4: lowest index, next copy, every copy reached, unique owned ones are their own",
                        "[id][I1][I2][I3][I4][A1][A13]", policies) {
    random_stream random(6);
    built<TestType> map;
    for (int round = 0; round < 60; ++round) {
        const auto pattern = round % 3 == 0   ? testing::id_pattern::repeated
                             : round % 3 == 1 ? testing::id_pattern::sparse
                                              : testing::id_pattern::lattice;
        const auto count = 1 + random.below(120);
        const auto ids = testing::make_ids<std::int64_t>(pattern, count, random);
        const auto owned_count = random.below(count + 1);
        map.rebuild(ids);
        std::map<std::int64_t, int> owned_copies;
        for (std::size_t i = 0; i < owned_count; ++i) ++owned_copies[ids[i]];
        bool i1 = true;
        bool i2 = true;
        bool i4 = true;
        std::vector<bool> reached(count, false);
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = static_cast<index_t>(i);
            i1 = i1 && map.where.find(ids[i]) <= at && map.where.find(ids[i]) >= 0;
            const auto next = map.same.next(at);
            i2 = i2 && (next == absent || (next > at && ids[static_cast<std::size_t>(next)] == ids[i]));
            const auto end = next == absent ? count : static_cast<std::size_t>(next);
            for (std::size_t j = i + 1; j < end; ++j) i2 = i2 && ids[j] != ids[i];
            if (i < owned_count && owned_copies[ids[i]] == 1) i4 = i4 && map.where.find(ids[i]) == at;
            if (map.where.find(ids[i]) != at) continue;
            for (const auto k : map.same.images(at)) reached[static_cast<std::size_t>(k)] = true;
        }
        CHECK(i1);
        CHECK(i2);
        CHECK(i4);
        CHECK(reached == std::vector<bool>(count, true));
    }
}

TEMPLATE_LIST_TEST_CASE("I5: every policy agrees with std::map under assign and erase", "[id][I5]", policies) {
    random_stream random(5);
    id_map<TestType> where;
    std::map<std::int64_t, index_t> oracle;
    for (int step = 0; step < 20'000; ++step) {
        const auto id = static_cast<std::int64_t>(random.below(3000));
        if (random.below(3) != 0) {
            const auto index = static_cast<index_t>(random.below(100'000));
            where.assign(id, index);
            oracle[id] = index;
        } else if (where.erase(id) != (oracle.erase(id) != 0)) {
            FAIL("step " << step << ": erase(" << id << ")");
        }
    }
    CHECK(where.size() == oracle.size());
    bool same = true;
    for (std::int64_t id = -5; id < 3005; ++id) {
        const auto at = oracle.find(id);
        same = same && where.find(id) == (at == oracle.end() ? absent : at->second);
    }
    CHECK(same);
}
