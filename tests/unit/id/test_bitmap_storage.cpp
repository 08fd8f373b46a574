// SPDX-License-Identifier: MIT
#include <tsubu/id/bitmap_storage.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace {

using tsubu::absent;
using tsubu::bitmap_storage;
using tsubu::index_t;

template <class Storage, class Id = typename Storage::id_type>
std::vector<index_t> build(Storage& storage, const std::vector<Id>& ids) {
    std::vector<index_t> links(ids.size(), 77);
    storage.rebuild(ids, tsubu::range_of(std::span<const Id>(ids)), links);
    return links;
}

constexpr auto largest = (std::numeric_limits<std::int64_t>::max)();

}  // namespace

TEST_CASE("a bitmap table takes 4 bytes per id and 3/16 per id of the range", "[id][bitmap_storage]") {
    std::vector<std::int64_t> ids;
    for (std::int64_t k = 0; k < 100'000; ++k) ids.push_back(8 * k);
    bitmap_storage<> storage;
    build(storage, ids);
    CHECK(storage.memory_bytes() == 100'001 * 4 + 12'500 * 12);
    bool right = true;
    for (std::int64_t id = -10; id < 800'010; ++id)
        right = right && storage.find(id) ==
                             (id >= 0 && id < 800'000 && id % 8 == 0 ? static_cast<index_t>(id / 8) : absent);
    CHECK(right);
}

TEST_CASE("the lowest index of an id wins in a bitmap table too", "[id][bitmap_storage][A1][A4][A13][T8]") {
    bitmap_storage<> storage;
    CHECK(build<bitmap_storage<>>(storage, {9, 500, 9, 500, 500}) == std::vector<index_t>{2, 3, absent, 4, absent});
    CHECK(storage.find(9) == 0);
    CHECK(storage.find(500) == 1);
    CHECK(storage.size() == 2);
    CHECK(build<bitmap_storage<>>(storage, {7, 5, 5, 8}) == std::vector<index_t>{absent, 2, absent, absent});
    CHECK(storage.find(5) == 1);
    CHECK(storage.find(9) == absent);
    CHECK(storage.find(500) == absent);
    // No links asked for: none written, though the span points somewhere.
    index_t beside = 77;
    const std::vector<std::int64_t> ids{3, 3};
    storage.rebuild(ids, {3, 3}, std::span<index_t>(&beside, 0));
    CHECK(beside == 77);
    CHECK(storage.find(3) == 0);
}

TEMPLATE_TEST_CASE("any value of the type may be looked up in a bitmap_storage", "[id][bitmap_storage][A1][T7]",
                   std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    using limits = std::numeric_limits<TestType>;
    bitmap_storage<TestType> storage;
    const TestType questions[] = {0, 1, static_cast<TestType>(-1), (limits::min)(), (limits::max)()};
    for (const bool filled : {false, true}) {
        if (filled) build(storage, std::vector<TestType>{1000, 2000});
        for (const auto id : questions) {
            CHECK(storage.find(id) == absent);
            CHECK_FALSE(storage.erase(id));
        }
    }
    build(storage, std::vector<TestType>{(limits::max)()});
    CHECK(storage.find((limits::max)()) == 0);
    for (const TestType id : {TestType{0}, (limits::min)()}) CHECK(storage.find(id) == absent);
    storage.assign((limits::max)() - 1000, 7);
    CHECK(storage.find((limits::max)() - 1000) == 7);
    CHECK(storage.find((limits::max)()) == 0);
}

TEST_CASE("a bitmap past the memory limit is refused, and the old one stays", "[id][bitmap_storage][T11]") {
    bitmap_storage<> storage;
    build<bitmap_storage<>>(storage, {4, 2});
    const auto message = thrown<tsubu::limit_error>([&] { build<bitmap_storage<>>(storage, {0, 2'000'000'000}); });
    CHECK(says(message, "bitmap_storage::rebuild"));
    CHECK(says(message, "id 2000000000 among 2 ids needs a table of 375000024 bytes"));
    CHECK(says(message, "use flat_storage"));
    CHECK_THROWS_AS(build<bitmap_storage<>>(storage, {0, largest}), tsubu::limit_error);
    CHECK_THROWS_AS(storage.assign(largest, 1), tsubu::limit_error);
    CHECK(storage.find(4) == 0);
    CHECK(storage.find(2) == 1);
    CHECK(storage.size() == 2);

    bitmap_storage<std::uint64_t> wide;
    CHECK_THROWS_AS(build(wide, std::vector<std::uint64_t>{0, ~std::uint64_t{0}}), tsubu::limit_error);

    bitmap_storage<> small{tsubu::memory_limit{2000}};
    bool threw = false;
    index_t taken = 0;
    for (; taken < 1000 && !threw; ++taken) {
        try {
            small.assign(taken, taken);
        } catch (const tsubu::limit_error&) {
            threw = true;
            --taken;
        }
        CHECK(small.memory_bytes() <= 2000);
    }
    CHECK(threw);
    CHECK(taken > 200);
    CHECK(small.size() == static_cast<std::size_t>(taken));
    for (index_t k = 0; k < 1000; ++k) CHECK(small.find(k) == (k < taken ? k : absent));
}

TEST_CASE("ids assigned in any order take their places", "[id][bitmap_storage][T12]") {
    tsubu::random_stream random(5);
    std::vector<std::int64_t> ids(200'000);
    for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<std::int64_t>(3 * k);
    for (std::size_t k = ids.size(); k > 1; --k) std::swap(ids[k - 1], ids[random.below(k)]);
    bitmap_storage<> storage;
    storage.reserve(1000);
    for (std::size_t k = 0; k < ids.size(); ++k) storage.assign(ids[k], static_cast<index_t>(k));
    CHECK(storage.size() == ids.size());
    bool right = true;
    for (std::size_t k = 0; k < ids.size(); ++k)
        right = right && storage.find(ids[k]) == static_cast<index_t>(k) && storage.find(ids[k] + 1) == absent;
    CHECK(right);
    CHECK(storage.memory_bytes() < 16 * ids.size());
}

TEST_CASE("an erased id can come back, and many erased ones take no room for ever", "[id][bitmap_storage]") {
    bitmap_storage<> storage;
    build<bitmap_storage<>>(storage, {10, 11, 12});
    CHECK(storage.erase(11));
    CHECK_FALSE(storage.erase(11));
    CHECK(storage.find(11) == absent);
    CHECK(storage.find(12) == 2);
    CHECK(storage.size() == 2);
    storage.assign(11, 8);
    CHECK(storage.find(11) == 8);
    CHECK(storage.size() == 3);
    storage.assign(11, 9);
    CHECK(storage.find(11) == 9);
    CHECK(storage.size() == 3);
    for (index_t k = 0; k < 100'000; ++k) {  // three ids at a time
        storage.assign(13 + k, 3 + k);
        CHECK(storage.erase(10 + k));
    }
    CHECK(storage.size() == 3);
    CHECK(storage.find(100'012) == 100'002);
    CHECK(storage.memory_bytes() < 100'000);
}

TEST_CASE("where memory ends, the old bits are intact", "[id][bitmap_storage][T10]") {
    tsubu::testing::allocation_gate gate;
    using allocator = tsubu::testing::throwing_allocator<std::byte>;
    bitmap_storage<std::int64_t, allocator> storage{allocator(gate)};
    build<decltype(storage)>(storage, {5, 6, 5});
    const std::vector<std::int64_t> more{5, 6000, 7000, 8000};
    for (std::size_t number = 0; number < 3; ++number) {
        gate.refuse_at(number);
        std::vector<index_t> links(more.size(), 77);
        CHECK_THROWS_AS(storage.rebuild(more, {5, 8000}, links), std::bad_alloc);
        CHECK(links == std::vector<index_t>(more.size(), 77));
        gate.open();
        CHECK(storage.find(5) == 0);
        CHECK(storage.find(6) == 1);
        CHECK(storage.find(6000) == absent);
        CHECK(storage.size() == 2);
    }
    build<decltype(storage)>(storage, {5, 6, 7});         // the pool is full
    for (std::size_t number = 0; number < 3; ++number) {  // two for the bitmap, one for the pool
        auto copy = storage;
        gate.refuse_at(number);
        CHECK_THROWS_AS(copy.assign(9000, 1), std::bad_alloc);
        gate.open();
        CHECK(copy.find(5) == 0);
        CHECK(copy.find(6) == 1);
        CHECK(copy.find(9000) == absent);
        CHECK(copy.size() == 3);
    }
    build<decltype(storage)>(storage, more);
    gate.refuse_from(0);
    build<decltype(storage)>(storage, {6, 7000, 5, 5});
    CHECK(gate.asked() == 0);
    CHECK(storage.find(7000) == 1);
}

TEMPLATE_TEST_CASE("both kernels answer alike, and as one look-up at a time", "[id][bitmap_storage][A1]", std::int32_t,
                   std::uint32_t, std::int64_t, std::uint64_t) {
    tsubu::random_stream random(2);
    const auto before = tsubu::best_instruction_set();
    for (const std::size_t count : {0U, 1U, 100U, 3000U}) {
        std::vector<TestType> ids(count);
        for (auto& id : ids) id = static_cast<TestType>(5000 + random.below(8000));
        std::vector<index_t> first_links;
        for (const auto wanted : {tsubu::instruction_set::portable, tsubu::instruction_set::avx2,
                                  tsubu::instruction_set::avx512}) {
            tsubu::use_instruction_set(wanted);
            bitmap_storage<TestType> storage;
            const auto links = build(storage, ids);
            if (first_links.empty()) first_links = links;
            CHECK(links == first_links);
            std::vector<TestType> asked(1001);
            for (auto& id : asked)
                id = random.below(4) == 0 ? static_cast<TestType>(random())
                                          : static_cast<TestType>(4000 + random.below(10'000));
            std::vector<index_t> answers(asked.size(), 77);
            storage.find(asked, answers);
            bool same = true;
            for (std::size_t k = 0; k < asked.size(); ++k) same = same && answers[k] == storage.find(asked[k]);
            CHECK(same);
        }
    }
    tsubu::use_instruction_set(before);
}

TEST_CASE("bits are counted right without the instruction", "[id][bitmap_storage]") {
    tsubu::random_stream random(3);
    CHECK(tsubu::detail::popcount<false>(0) == 0);
    CHECK(tsubu::detail::popcount<false>(~std::uint64_t{0}) == 64);
    bool right = true;
    for (int k = 0; k < 1000; ++k) {
        const auto word = random() & random();
        std::uint32_t bits = 0;
        for (int b = 0; b < 64; ++b) bits += static_cast<std::uint32_t>((word >> b) & 1U);
        right = right && tsubu::detail::popcount<false>(word) == bits && tsubu::detail::popcount<true>(word) == bits;
    }
    CHECK(right);
}

TEST_CASE("a copy of a bitmap_storage is independent, and what was moved from is empty", "[id][bitmap_storage]") {
    bitmap_storage<> storage;
    build<bitmap_storage<>>(storage, {1, 2});
    auto copy = storage;
    copy.assign(1, 9);
    CHECK(storage.find(1) == 0);
    auto moved = std::move(copy);
    CHECK(moved.find(1) == 9);
    CHECK(copy.find(1) == absent);
    CHECK(copy.size() == 0);
    copy.assign(70'000, 3);
    CHECK(copy.find(70'000) == 3);
    CHECK(moved.find(70'000) == absent);
}

TEST_CASE("the ids of a bitmap are walked in order, each with its index", "[id][bitmap_storage]") {
    bitmap_storage<> storage;
    build<bitmap_storage<>>(storage, {500, 7, 63, 64, 7});
    storage.assign(1, 9);
    CHECK(storage.erase(63));
    std::vector<std::pair<std::int64_t, index_t>> walked;
    storage.for_each([&](std::int64_t id, index_t index) { walked.emplace_back(id, index); });
    CHECK(walked == std::vector<std::pair<std::int64_t, index_t>>{{1, 9}, {7, 1}, {64, 3}, {500, 0}});
}
