// SPDX-License-Identifier: MIT
#include <tsubu/id/chained_storage.hpp>

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
using tsubu::chained_storage;
using tsubu::index_t;
using tsubu::mixed;
using tsubu::mod_prime;

using notes_scheme = chained_storage<mod_prime>;

template <class Storage, class Id = typename Storage::id_type>
std::vector<index_t> build(Storage& storage, const std::vector<Id>& ids) {
    std::vector<index_t> links(ids.size(), 77);
    storage.rebuild(ids, tsubu::range_of(std::span<const Id>(ids)), links);
    return links;
}

std::vector<std::int64_t> multiples(std::int64_t stride, std::int64_t count) {
    std::vector<std::int64_t> ids;
    for (std::int64_t k = 1; k <= count; ++k) ids.push_back(k * stride);
    return ids;
}

}  // namespace

TEST_CASE("the capacity is max(1000, 2 N), the bucket count the next prime", "[id][chained_storage][A6][A7]") {
    notes_scheme storage;
    CHECK(storage.capacity() == 0);
    CHECK(storage.memory_bytes() == 0);
    build(storage, multiples(1, 10));
    CHECK(storage.capacity() == 1000);
    CHECK(storage.bucket_count() == 1009);
    CHECK(storage.memory_bytes() == 1000 * 16 + 1009 * 4);

    notes_scheme larger;
    build(larger, multiples(1, 16384));
    CHECK(larger.capacity() == 32768);
    CHECK(larger.bucket_count() == 32771);
    CHECK(larger.memory_bytes() / 16384 == 40);
}

TEST_CASE("N = M still fits, N = M + 1 is sized anew, and it never shrinks", "[id][chained_storage][A12][T9]") {
    notes_scheme storage;
    build(storage, multiples(1, 1));
    build(storage, multiples(7, 1000));
    CHECK(storage.capacity() == 1000);
    CHECK(storage.size() == 1000);
    build(storage, multiples(7, 1001));
    CHECK(storage.capacity() == 2002);
    CHECK(storage.bucket_count() == 2003);
    CHECK(storage.find(7007) == 1000);
    build(storage, multiples(7, 3));
    CHECK(storage.capacity() == 2002);
    CHECK(storage.find(28) == absent);
}

TEST_CASE("every path that inserts grows", "[id][chained_storage][A12][T12]") {
    notes_scheme storage;
    for (index_t k = 0; k < 1000; ++k) storage.assign(k, k);
    CHECK(storage.capacity() == 1000);
    storage.assign(999, 5);  // present: no node is needed
    CHECK(storage.capacity() == 1000);
    storage.assign(1000, 1000);
    CHECK(storage.capacity() == 2002);
    for (index_t k = 0; k < 1'000'000; ++k) storage.assign(k, 2 * k);
    CHECK(storage.size() == 1'000'000);
    bool right = true;
    for (index_t k = 0; k < 1'000'000; ++k) right = right && storage.find(k) == 2 * k;
    CHECK(right);
}

TEST_CASE("reserve sizes for the average of all ranks", "[id][chained_storage][A6]") {
    notes_scheme storage;
    storage.reserve(600);
    CHECK(storage.capacity() == 1200);
    build(storage, multiples(3, 10));
    CHECK(storage.capacity() == 1200);
    storage.reserve(1201);
    CHECK(storage.capacity() == 2402);
    CHECK(storage.find(30) == 9);
    CHECK(storage.size() == 10);
}

TEST_CASE("a hit rewrites the index, a miss takes a free node, erase gives it back",
          "[id][chained_storage][A10][A11]") {
    notes_scheme storage;
    storage.reserve(1);
    build(storage, multiples(1, 1000));  // no node is free now
    REQUIRE(storage.capacity() == 1000);
    for (std::int64_t k = 1; k <= 1000; ++k) {
        CHECK(storage.erase(k));
        CHECK_FALSE(storage.erase(k));
        storage.assign(5000 + k, static_cast<index_t>(k));
    }
    CHECK(storage.capacity() == 1000);
    CHECK(storage.size() == 1000);
    CHECK(storage.find(1) == absent);
    CHECK(storage.find(6000) == 1000);
}

TEST_CASE("erase unlinks the first, a middle and the last node of a chain", "[id][chained_storage][A10]") {
    const std::int64_t b = 1009;  // all in one bucket
    for (const std::int64_t gone : {b, 2 * b, 3 * b}) {
        notes_scheme storage;
        build<notes_scheme>(storage, {b, 2 * b, 3 * b});
        REQUIRE(storage.longest_chain() == 3);
        CHECK(storage.erase(gone));
        CHECK(storage.longest_chain() == 2);
        for (std::int64_t k = 1; k <= 3; ++k)
            CHECK(storage.find(k * b) == (k * b == gone ? absent : static_cast<index_t>(k - 1)));
    }
}

TEST_CASE("the old index that an insertion finds is the link", "[id][chained_storage][A4][A13][T4][T8]") {
    notes_scheme storage;
    CHECK(build<notes_scheme>(storage, {9, 5, 9, 5, 5}) == std::vector<index_t>{2, 3, absent, 4, absent});
    CHECK(storage.find(9) == 0);
    CHECK(storage.size() == 2);
    CHECK(build<notes_scheme>(storage, {7, 5, 5, 8}) == std::vector<index_t>{absent, 2, absent, absent});
    CHECK(storage.find(9) == absent);
    CHECK(build<notes_scheme>(storage, {5, 5, 5, 5}) == std::vector<index_t>{1, 2, 3, absent});
}

TEST_CASE("ids that are multiples of the bucket count share one chain under mod_prime", "[id][chained_storage][A9]") {
    const auto ids = multiples(32771, 16384);  // N = 16384, M = 32768, B = 32771
    notes_scheme degenerate;
    build(degenerate, multiples(32771, 2000));
    CHECK(degenerate.bucket_count() == 4001);
    degenerate.reserve(32768 / 2);
    CHECK(degenerate.bucket_count() == 32771);
    CHECK(degenerate.longest_chain() == 2000);

    chained_storage<mixed> even;
    build(even, ids);
    CHECK(even.bucket_count() == 32771);
    CHECK(even.longest_chain() < 12);
    build(even, multiples(1, 16384));
    CHECK(even.longest_chain() < 12);
}

TEMPLATE_TEST_CASE("any value of the type may be looked up in a chained_storage", "[id][chained_storage][A1][T7]",
                   std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    using limits = std::numeric_limits<TestType>;
    chained_storage<mod_prime, TestType> notes;
    chained_storage<mixed, TestType> other;
    const TestType questions[] = {0, 1, static_cast<TestType>(-1), (limits::min)(), (limits::max)()};
    for (const bool filled : {false, true}) {
        if (filled) {
            build(notes, std::vector<TestType>{1000, 2000});
            build(other, std::vector<TestType>{1000, 2000});
        }
        for (const auto id : questions) {
            CHECK(notes.find(id) == absent);
            CHECK(other.find(id) == absent);
            CHECK_FALSE(notes.erase(id));
        }
    }
    build(notes, std::vector<TestType>{(limits::max)(), 0});
    CHECK(notes.find((limits::max)()) == 0);
    CHECK(notes.find(0) == 1);
}

TEST_CASE("a chained table past the memory limit is refused, and the old one stays", "[id][chained_storage][T10]") {
    notes_scheme storage{tsubu::memory_limit{1000 * 16 + 1009 * 4}};
    storage.reserve(1);
    build(storage, multiples(1, 1000));  // N = M
    const auto message = thrown<tsubu::limit_error>([&] { storage.assign(5000, 1); });
    CHECK(says(message, "chained_storage::assign"));
    CHECK(says(message, "1001 ids need a table of 40044 bytes, the limit is 20036"));
    CHECK(says(message, "use flat_storage"));
    CHECK_THROWS_AS(build(storage, multiples(1, 1001)), tsubu::limit_error);
    CHECK_THROWS_AS(storage.reserve(1001), tsubu::limit_error);
    CHECK(storage.find(1000) == 999);
    CHECK(storage.find(5000) == absent);
    CHECK(storage.size() == 1000);
}

TEST_CASE("where memory ends, the old chains are intact", "[id][chained_storage][T10]") {
    tsubu::testing::allocation_gate gate;
    using allocator = tsubu::testing::throwing_allocator<std::byte>;
    chained_storage<mod_prime, std::int64_t, allocator> storage{allocator(gate)};
    storage.reserve(1);
    build(storage, multiples(1, 1000));  // N = M: the next one needs memory
    for (std::size_t number = 0; number < 2; ++number) {
        gate.refuse_at(number);
        CHECK_THROWS_AS(storage.assign(5000, 1), std::bad_alloc);
        gate.refuse_at(number);
        CHECK_THROWS_AS(build(storage, multiples(1, 1001)), std::bad_alloc);
        gate.refuse_at(number);
        CHECK_THROWS_AS(storage.reserve(1001), std::bad_alloc);
        gate.open();
        CHECK(storage.find(1) == 0);
        CHECK(storage.find(1000) == 999);
        CHECK(storage.find(5000) == absent);
        CHECK(storage.size() == 1000);
    }
    CHECK(gate.bytes() == storage.memory_bytes());
}

TEST_CASE("a batch of chained look-ups answers as one at a time", "[id][chained_storage][A1]") {
    chained_storage<mixed> storage;
    for (const std::int64_t count : {0, 1, 500}) {
        build(storage, multiples(3, count));
        for (const std::size_t length : {0U, 1U, 31U, 32U, 33U, 1000U}) {
            std::vector<std::int64_t> asked(length);
            for (std::size_t k = 0; k < length; ++k) asked[k] = static_cast<std::int64_t>(2 * k) - 9;
            std::vector<index_t> answers(length, 77);
            storage.find(asked, answers);
            for (std::size_t k = 0; k < length; ++k) CHECK(answers[k] == storage.find(asked[k]));
        }
    }
}

TEST_CASE("a copy of a chained_storage is independent, and what was moved from is empty", "[id][chained_storage]") {
    notes_scheme storage;
    build(storage, multiples(1, 2));
    auto copy = storage;
    copy.assign(1, 9);
    CHECK(storage.find(1) == 0);
    auto moved = std::move(copy);
    CHECK(moved.find(1) == 9);
    CHECK(copy.find(1) == absent);
    copy.assign(4, 4);
    CHECK(copy.find(4) == 4);
    CHECK(moved.find(4) == absent);
}
