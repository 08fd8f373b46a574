// SPDX-License-Identifier: MIT
#include <tsubu/id/paged_storage.hpp>

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
using tsubu::index_t;
using tsubu::paged_storage;

template <class Storage, class Id = typename Storage::id_type>
std::vector<index_t> build(Storage& storage, const std::vector<Id>& ids) {
    std::vector<index_t> links(ids.size(), 77);
    storage.rebuild(ids, tsubu::range_of(std::span<const Id>(ids)), links);
    return links;
}

/// `count` runs of 1000 ids, each at a multiple of 2^20.
std::vector<std::int64_t> blocks(std::int64_t count) {
    std::vector<std::int64_t> ids;
    for (std::int64_t block = 0; block < count; ++block)
        for (std::int64_t k = 0; k < 1000; ++k) ids.push_back((block << 20) + k);
    return ids;
}

constexpr auto largest = (std::numeric_limits<std::int64_t>::max)();

}  // namespace

TEST_CASE("pages are held only where ids are", "[id][paged_storage]") {
    paged_storage<> storage;
    const auto ids = blocks(100);
    build(storage, ids);
    CHECK(storage.used_pages() == 100);
    CHECK(storage.memory_bytes() < 101 * (4096 + 8) + 100 * 1024 * 4 + 1);  // pages, and 4 bytes per page of the range
    CHECK(storage.size() == 100'000);
    bool right = true;
    for (std::size_t k = 0; k < ids.size(); ++k) right = right && storage.find(ids[k]) == static_cast<index_t>(k);
    CHECK(right);
    CHECK(storage.find(1000) == absent);     // in a page that exists
    CHECK(storage.find(500'000) == absent);  // in one that does not
}

TEST_CASE("the lowest index of an id wins in a paged table too", "[id][paged_storage][A1][A4][A13][T8]") {
    paged_storage<> storage;
    CHECK(build<paged_storage<>>(storage, {9, 5000, 9, 5000, 5000}) ==
          std::vector<index_t>{2, 3, absent, 4, absent});
    CHECK(storage.size() == 2);
    CHECK(build<paged_storage<>>(storage, {7, 5, 5, 8}) == std::vector<index_t>{absent, 2, absent, absent});
    CHECK(storage.find(5) == 1);
    CHECK(storage.find(9) == absent);
    CHECK(storage.find(5000) == absent);
}

TEST_CASE("a rebuild reuses pages and directory and leaves nothing behind", "[id][paged_storage][A4][T9]") {
    tsubu::testing::allocation_gate gate;
    using allocator = tsubu::testing::throwing_allocator<std::byte>;
    paged_storage<std::int64_t, allocator> storage{allocator(gate)};
    build(storage, blocks(20));
    gate.refuse_from(0);
    for (const std::int64_t shift : {5'000'192, 0, 12'288}) {
        auto ids = blocks(19);
        for (auto& id : ids) id += shift;
        build(storage, ids);
        CHECK(storage.size() == ids.size());
        CHECK(storage.find(shift + (std::int64_t{18} << 20)) == 18'000);
        CHECK(storage.find(shift + (std::int64_t{19} << 20)) == absent);
        if (shift != 0) CHECK(storage.find(0) == absent);
    }
    CHECK(gate.asked() == 0);
    gate.open();
    build<decltype(storage)>(storage, {1, 2});
    CHECK(storage.memory_bytes() < 2 * 4096 + 3000);  // given back
    CHECK(gate.bytes() == storage.memory_bytes());
}

TEMPLATE_TEST_CASE("any value of the type may be looked up in a paged_storage", "[id][paged_storage][A1][T7]",
                   std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    using limits = std::numeric_limits<TestType>;
    paged_storage<TestType> storage;
    const TestType questions[] = {0, 1, static_cast<TestType>(-1), (limits::min)(), (limits::max)()};
    for (const auto id : questions) {
        CHECK(storage.find(id) == absent);
        CHECK_FALSE(storage.erase(id));
    }
    build(storage, std::vector<TestType>{10'000, 20'000});
    for (const auto id : questions) {
        CHECK(storage.find(id) == absent);
        CHECK_FALSE(storage.erase(id));
    }
    build(storage, std::vector<TestType>{(limits::max)()});
    CHECK(storage.find((limits::max)()) == 0);
    for (const TestType id : {TestType{0}, (limits::min)()}) CHECK(storage.find(id) == absent);
    storage.assign((limits::max)() - 5000, 7);
    CHECK(storage.find((limits::max)() - 5000) == 7);
    CHECK(storage.find((limits::max)()) == 0);
}

TEST_CASE("a paged table past the memory limit is refused, and the old one stays", "[id][paged_storage][T11]") {
    paged_storage<> storage;
    build<paged_storage<>>(storage, {4, 2});
    const auto intact = [&] { return storage.find(4) == 0 && storage.find(2) == 1 && storage.size() == 2; };

    build<paged_storage<>>(storage, {4, 2'000'000'000});  // 2 pages and 8 MB of directory: admitted
    build<paged_storage<>>(storage, {4, 2});
    const auto message = thrown<tsubu::limit_error>([&] { build<paged_storage<>>(storage, {0, largest}); });
    CHECK(says(message, "paged_storage::rebuild"));
    CHECK(says(message, "id 9223372036854775807 among 2 ids"));
    CHECK(says(message, "use flat_storage"));
    CHECK(intact());
    CHECK_THROWS_AS(storage.assign(largest, 1), tsubu::limit_error);
    CHECK(intact());

    // Within the range, but each id in a page of its own: refused after the pages were counted in the directory.
    paged_storage<> small{tsubu::memory_limit{100'000}};
    std::vector<std::int64_t> far;
    for (std::int64_t k = 0; k < 100; ++k) far.push_back(k * 1024);
    build<paged_storage<>>(small, {0, 5, 99 * 1024});
    CHECK_THROWS_AS(build(small, far), tsubu::limit_error);
    CHECK(small.find(5) == 1);
    CHECK(small.find(99 * 1024) == 2);
    CHECK(small.find(1024) == absent);
    CHECK(small.size() == 3);
    bool threw = false;
    for (std::int64_t k = 1; k < 99 && !threw; ++k) {
        try {
            small.assign(k * 1024, 50);
        } catch (const tsubu::limit_error&) {
            threw = true;
            CHECK(small.find(k * 1024) == absent);
        }
        CHECK(small.memory_bytes() <= 100'000);
    }
    CHECK(threw);
    CHECK(small.find(5) == 1);
}

TEST_CASE("assign adds pages and widens the directory on either side", "[id][paged_storage][T12]") {
    paged_storage<> storage;
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
    CHECK(storage.erase(500'000));
    CHECK_FALSE(storage.erase(500'000));
    CHECK(storage.find(500'000) == absent);
    CHECK(storage.find(500'001) == 2);
}

TEST_CASE("where memory ends, the old pages are intact", "[id][paged_storage][T10]") {
    tsubu::testing::allocation_gate gate;
    using allocator = tsubu::testing::throwing_allocator<std::byte>;
    paged_storage<std::int64_t, allocator> storage{allocator(gate)};
    build<decltype(storage)>(storage, {5, 6, 5, 40'000});
    const auto refused = [&](const std::vector<std::int64_t>& ids) {
        std::size_t times = 0;
        for (std::size_t number = 0; number < 3; ++number) {
            gate.refuse_at(number);
            std::vector<index_t> links(ids.size(), 77);
            try {
                const auto range = tsubu::range_of(std::span<const std::int64_t>(ids));
                storage.rebuild(ids, range, links);
                return times;
            } catch (const std::bad_alloc&) {
                ++times;
            }
            gate.open();
            CHECK(links == std::vector<index_t>(ids.size(), 77));
            CHECK(storage.find(5) == 0);
            CHECK(storage.find(6) == 1);
            CHECK(storage.find(40'000) == 3);
            CHECK(storage.find(20'000) == absent);
            CHECK(storage.size() == 3);
        }
        return times;
    };
    CHECK(refused({20'000, 20'001, 2'000'000}) == 1);  // two pages again: only the directory needs memory
    gate.open();
    build<decltype(storage)>(storage, {5, 6, 5, 40'000, 2'000'000});
    build<decltype(storage)>(storage, {5, 6, 5, 40'000});
    CHECK(refused({0, 10'000, 20'000, 30'000, 40'000, 50'000}) == 2);  // the directory is there, pages are not
}

TEMPLATE_TEST_CASE("all kernels of a paged_storage answer alike, and as one look-up at a time",
                   "[id][paged_storage][A1]", std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    tsubu::random_stream random(2);
    const auto before = tsubu::best_instruction_set();
    for (const std::size_t count : {0U, 1U, 100U, 3000U}) {
        paged_storage<TestType, std::allocator<std::byte>, tsubu::paged_options{.page_bits = 5}> storage;
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

TEST_CASE("a copy of a paged_storage is independent, and what was moved from is empty", "[id][paged_storage]") {
    paged_storage<> storage;
    build<paged_storage<>>(storage, {1, 2});
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

TEST_CASE("a directory that grew far downwards still knows where each page stands", "[id][paged_storage]") {
    tsubu::paged_storage<> storage;
    const std::int64_t high = std::int64_t{1} << 40;
    const std::int64_t low = high - (std::int64_t{1} << 28);  // 2^18 pages below
    storage.assign(high, 1);
    storage.assign(low, 2);
    bool right = true;
    std::size_t count = 0;
    storage.for_each([&](std::int64_t id, tsubu::index_t index) {
        right = right && id == (index == 1 ? high : low);
        ++count;
    });
    CHECK(right);
    CHECK(count == 2);
    storage.clear();
    CHECK(storage.find(high) == tsubu::absent);
    storage.assign(high + 1, 3);
    CHECK(storage.find(high) == tsubu::absent);
    CHECK(storage.find(high + 1) == 3);
}
