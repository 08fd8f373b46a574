// SPDX-License-Identifier: MIT
#include <tsubu/id/dense_storage.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/core/threads.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using tsubu::absent;
using tsubu::dense_storage;
using tsubu::index_t;
using tsubu::memory_limit;

template <class Storage, class Id = typename Storage::id_type>
std::vector<index_t> build(Storage& storage, const std::vector<Id>& ids) {
    std::vector<index_t> links(ids.size(), 77);
    storage.rebuild(ids, tsubu::range_of(std::span<const Id>(ids)), links);
    return links;
}

struct broken_executor {
    [[nodiscard]] static std::size_t concurrency() noexcept { return 2; }
    template <class Part>
    static void run(Part&&) {
        throw std::runtime_error("no threads today");
    }
};

constexpr auto largest = (std::numeric_limits<std::int64_t>::max)();

}  // namespace

TEST_CASE("a dense table with lowest id 0 has T_max + 1 entries, ghosts included", "[id][dense_storage][A2][A3][T3]") {
    dense_storage<> storage;
    const auto links = build<dense_storage<>>(storage, {0, 3, 5, 9999});  // 9999: a ghost above all owned ids
    CHECK(storage.memory_bytes() == 10000 * sizeof(index_t) + 10);        // and a byte per 1024
    CHECK(storage.find(0) == 0);
    CHECK(storage.find(9999) == 3);
    CHECK(storage.find(4) == absent);
    CHECK(storage.find(10000) == absent);
    CHECK(links == std::vector<index_t>{absent, absent, absent, absent});
}

TEST_CASE("a dense table pays for the range of the ids, not for the highest", "[id][dense_storage][A2]") {
    dense_storage<> storage;
    build<dense_storage<>>(storage, {largest - 999, largest, largest - 5});
    CHECK(storage.memory_bytes() == 1000 * sizeof(index_t) + 1);
    CHECK(storage.find(largest) == 1);
    CHECK(storage.find(largest - 999) == 0);
    CHECK(storage.find(largest - 1000) == absent);
}

TEST_CASE("the lowest index of an id wins, and the links lead through its copies", "[id][dense_storage][A1][A4][A13]") {
    dense_storage<> storage;
    CHECK(build<dense_storage<>>(storage, {9, 5, 9, 5, 5}) == std::vector<index_t>{2, 3, absent, 4, absent});
    CHECK(storage.find(9) == 0);
    CHECK(storage.find(5) == 1);
    CHECK(storage.size() == 2);
}

TEST_CASE("a rebuild leaves nothing of the old content behind", "[id][dense_storage][A4][T8][T9]") {
    dense_storage<> storage;
    build<dense_storage<>>(storage, {1, 2, 5});
    CHECK(build<dense_storage<>>(storage, {7, 5, 5, 8}) == std::vector<index_t>{absent, 2, absent, absent});
    CHECK(storage.find(5) == 1);
    CHECK(storage.find(1) == absent);
    CHECK(storage.find(2) == absent);

    // Blocks far apart are cleared one by one: nothing may be left in any of them, nor between.
    std::vector<std::int64_t> ids;
    for (std::int64_t k = 0; k < 50; ++k) ids.push_back(k * 1000);
    build(storage, ids);
    build<dense_storage<>>(storage, {0, 49000});
    for (std::int64_t id = 1; id < 49000; ++id)
        if (storage.find(id) != absent) FAIL("id " << id << " is left");
    CHECK(storage.size() == 2);
}

TEMPLATE_TEST_CASE("any value of the type may be looked up in a dense_storage", "[id][dense_storage][A1][T7]",
                   std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    using limits = std::numeric_limits<TestType>;
    dense_storage<TestType> storage;
    const TestType questions[] = {0, 1, static_cast<TestType>(-1), (limits::min)(), (limits::max)()};
    for (const auto id : questions) CHECK(storage.find(id) == absent);
    build(storage, std::vector<TestType>{1000, 2000});
    for (const auto id : questions) CHECK(storage.find(id) == absent);
    build(storage, std::vector<TestType>{(limits::max)()});
    CHECK(storage.find((limits::max)()) == 0);
    for (const TestType id : {TestType{0}, (limits::min)()}) CHECK(storage.find(id) == absent);
    storage.assign((limits::max)() - 1, 7);  // the window cannot grow upwards
    CHECK(storage.find((limits::max)()) == 0);
    CHECK(storage.find((limits::max)() - 1) == 7);
    CHECK(storage.find((limits::max)() - 2) == absent);
}

TEST_CASE("a table past the memory limit is refused, and the old one stays", "[id][dense_storage][A5][T11]") {
    dense_storage<> storage;
    build<dense_storage<>>(storage, {4, 2});
    const auto intact = [&] { return storage.find(4) == 0 && storage.find(2) == 1 && storage.size() == 2; };

    const auto message = thrown<tsubu::limit_error>([&] {
        build<dense_storage<>>(storage, {0, 2'000'000'000});
    });
    CHECK(says(message, "dense_storage::rebuild"));
    CHECK(says(message, "id 2000000000 among 2 ids"));
    CHECK(says(message, "8001953130 bytes"));
    CHECK(says(message, "use flat_storage"));
    CHECK(intact());

    CHECK_THROWS_AS(build<dense_storage<>>(storage, {0, largest}), tsubu::limit_error);
    CHECK_THROWS_AS(storage.assign(largest, 1), tsubu::limit_error);
    CHECK(intact());

    dense_storage<std::uint64_t> wide;
    CHECK_THROWS_AS(build(wide, std::vector<std::uint64_t>{0, ~std::uint64_t{0}}), tsubu::limit_error);
    dense_storage<std::int32_t> narrow;
    CHECK_THROWS_AS(build(narrow, std::vector<std::int32_t>{0, 2147483647}), tsubu::limit_error);
}

TEST_CASE("a memory limit of one's own is kept to the byte", "[id][dense_storage][A5]") {
    dense_storage<> storage{memory_limit{4001}};  // 1000 entries and one byte for their block
    build<dense_storage<>>(storage, {0, 999});
    CHECK(storage.memory_bytes() == 4001);
    CHECK_THROWS_AS(build<dense_storage<>>(storage, {0, 1000}), tsubu::limit_error);
    CHECK_THROWS_AS(storage.assign(1000, 3), tsubu::limit_error);
    CHECK_THROWS_AS(storage.reserve(1001), tsubu::limit_error);
    CHECK(storage.find(999) == 1);
}

TEST_CASE("assign grows the table on either side", "[id][dense_storage][T12]") {
    dense_storage<> storage;
    storage.reserve(1000);
    for (index_t k = 0; k < 100'000; ++k) {
        storage.assign(500'000 + k, 2 * k);
        storage.assign(499'999 - k, 2 * k + 1);
    }
    CHECK(storage.size() == 200'000);
    bool right = true;
    for (index_t k = 0; k < 100'000; ++k)
        right = right && storage.find(500'000 + k) == 2 * k && storage.find(499'999 - k) == 2 * k + 1;
    CHECK(right);
    CHECK(storage.find(600'000) == absent);
    CHECK(storage.find(399'999) == absent);
}

TEST_CASE("erase says whether the id was there", "[id][dense_storage]") {
    dense_storage<> storage;
    CHECK_FALSE(storage.erase(3));
    build<dense_storage<>>(storage, {3, 4});
    CHECK(storage.erase(3));
    CHECK_FALSE(storage.erase(3));
    CHECK_FALSE(storage.erase(-1));
    CHECK(storage.find(4) == 1);
    CHECK(storage.size() == 1);
    storage.clear();
    CHECK(storage.size() == 0);
    CHECK(storage.find(4) == absent);
}

TEST_CASE("a rebuild of the same range takes no memory, a much smaller one gives some back", "[id][dense_storage]") {
    tsubu::testing::allocation_gate gate;
    using allocator = tsubu::testing::throwing_allocator<std::byte>;
    dense_storage<std::int64_t, allocator> storage{allocator(gate)};
    build<decltype(storage)>(storage, {0, 99'999});
    const auto full = storage.memory_bytes();
    CHECK(gate.bytes() == full);
    gate.refuse_from(0);
    build<decltype(storage)>(storage, {1000, 100'999, 5000});
    build<decltype(storage)>(storage, {7, 50'000});
    CHECK(gate.asked() == 0);
    build<decltype(storage)>(storage, {7, 8});  // would give memory back, which needs some: it may not fail for that
    CHECK(gate.refused() != 0);
    CHECK(storage.find(8) == 1);
    CHECK(storage.memory_bytes() == full);
    gate.open();
    build<decltype(storage)>(storage, {7, 8});
    CHECK(storage.memory_bytes() < full / 4);
    CHECK(gate.bytes() == storage.memory_bytes());
}

TEST_CASE("where memory ends, the old content is intact", "[id][dense_storage][T10]") {
    tsubu::testing::allocation_gate gate;
    using allocator = tsubu::testing::throwing_allocator<std::byte>;
    dense_storage<std::int64_t, allocator> storage{allocator(gate)};
    build<decltype(storage)>(storage, {5, 6, 5});
    for (std::size_t number = 0; number < 2; ++number) {
        gate.refuse_at(number);
        const std::vector<std::int64_t> more{5, 60'000};
        std::vector<index_t> links(2, 77);
        CHECK_THROWS_AS(storage.rebuild(more, {5, 60'000}, links), std::bad_alloc);
        CHECK(links == std::vector<index_t>{77, 77});
        gate.refuse_at(number);
        CHECK_THROWS_AS(storage.assign(60'000, 1), std::bad_alloc);
        gate.refuse_at(number);
        CHECK_THROWS_AS(storage.reserve(60'000), std::bad_alloc);
        gate.open();
        CHECK(storage.find(5) == 0);
        CHECK(storage.find(6) == 1);
        CHECK(storage.find(60'000) == absent);
        CHECK(storage.size() == 2);
    }
}

TEST_CASE("several threads build what one builds", "[id][dense_storage][A13]") {
    tsubu::random_stream random(1);
    const auto spread = GENERATE(std::uint64_t{90'000}, std::uint64_t{8'000'000});  // every block, and some of them
    std::vector<std::int64_t> ids(100'000);
    for (auto& id : ids) id = static_cast<std::int64_t>(random.below(spread));
    const auto range = tsubu::range_of(std::span<const std::int64_t>(ids));
    dense_storage<> serial;
    const auto expected = build(serial, ids);
    for (const std::size_t team : {1U, 2U, 3U, 7U}) {
        dense_storage<> storage;
        build<dense_storage<>>(storage, {1, 89'000, 70'000});  // to be cleared
        std::vector<index_t> links(ids.size(), 77);
        storage.rebuild(ids, range, links, tsubu::threads(team));
        CHECK(links == expected);
        CHECK(storage.size() == serial.size());
        bool same = true;
        for (std::int64_t id = 0; id < static_cast<std::int64_t>(spread); ++id)
            same = same && storage.find(id) == serial.find(id);
        CHECK(same);
        build<dense_storage<>>(storage, {0});
        CHECK(storage.find(ids[1]) == (ids[1] == 0 ? 0 : absent));
    }
}

TEST_CASE("an executor that cannot run costs time, not the answer", "[id][dense_storage]") {
    std::vector<std::int64_t> ids(70'000);
    for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<std::int64_t>(k / 2);
    dense_storage<> storage;
    storage.rebuild(ids, {0, 34'999}, {}, broken_executor{});
    CHECK(storage.size() == 35'000);
    CHECK(storage.find(34'999) == 69'998);
}

TEMPLATE_TEST_CASE("all kernels of a dense_storage answer alike, and as one look-up at a time",
                   "[id][dense_storage][A1]", std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    tsubu::random_stream random(2);
    const auto before = tsubu::best_instruction_set();
    for (const std::size_t count : {0U, 1U, 100U, 3000U}) {
        dense_storage<TestType> storage;
        std::vector<TestType> ids(count);
        for (auto& id : ids) id = static_cast<TestType>(5000 + random.below(8000));
        build(storage, ids);
        for (const std::size_t length : {0U, 1U, 3U, 4U, 7U, 8U, 9U, 16U, 1001U}) {
            std::vector<TestType> asked(length);
            for (auto& id : asked)
                id = random.below(4) == 0 ? static_cast<TestType>(random())
                                          : static_cast<TestType>(4000 + random.below(10'000));
            for (const auto wanted : {tsubu::instruction_set::portable, tsubu::instruction_set::avx2,
                                      tsubu::instruction_set::avx512}) {
                tsubu::use_instruction_set(wanted);
                std::vector<index_t> answers(length + 1, 77);
                storage.find(asked, std::span(answers).first(length));
                bool same = answers.back() == 77;
                for (std::size_t k = 0; k < length; ++k) same = same && answers[k] == storage.find(asked[k]);
                INFO(count << " ids, " << length << " asked, " << tsubu::name_of(tsubu::best_instruction_set()));
                CHECK(same);
            }
        }
    }
    tsubu::use_instruction_set(before);
}

TEST_CASE("a copy of a dense_storage is independent, and what was moved from is empty", "[id][dense_storage]") {
    dense_storage<> storage;
    build<dense_storage<>>(storage, {1, 2});
    auto copy = storage;
    copy.assign(1, 9);
    CHECK(storage.find(1) == 0);
    auto moved = std::move(copy);
    CHECK(moved.find(1) == 9);
    CHECK(copy.find(1) == absent);
    CHECK(copy.size() == 0);
    copy = moved;
    CHECK(copy.find(2) == 1);
}
