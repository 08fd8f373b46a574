// SPDX-License-Identifier: MIT
#include <tsubu/id/flat_storage.hpp>

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/threads.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

namespace {

using tsubu::absent;
using tsubu::flat_lines;
using tsubu::flat_storage;
using tsubu::index_t;
using ids_t = std::vector<std::int64_t>;

constexpr std::size_t threaded_count = tsubu::detail::threading_threshold + 8'000;

template <class Storage, class Id = typename Storage::id_type, class... On>
std::vector<index_t> build(Storage& storage, const std::vector<Id>& ids, const On&... on) {
    std::vector<index_t> links(ids.size(), 77);
    storage.rebuild(ids, tsubu::range_of(std::span<const Id>(ids)), links, on...);
    return links;
}

/// What the map must answer, and its links.
template <class Id>
struct oracle {
    explicit oracle(const std::vector<Id>& ids) : links(ids.size(), absent) {
        for (std::size_t i = ids.size(); i-- > 0;) {
            const auto [at, is_new] = first.try_emplace(ids[i], static_cast<index_t>(i));
            if (!is_new) links[i] = std::exchange(at->second, static_cast<index_t>(i));
        }
    }
    [[nodiscard]] index_t find(Id id) const {
        const auto at = first.find(id);
        return at == first.end() ? absent : at->second;
    }
    std::unordered_map<Id, index_t> first;
    std::vector<index_t> links;
};

/// Whether storage answers as the oracle for all ids, their neighbours and the ends of the type, singly and in batch.
template <class Storage, class Id = typename Storage::id_type>
bool agrees(const Storage& storage, const std::vector<Id>& ids, const oracle<Id>& expected) {
    using U = tsubu::detail::unsigned_id<Id>;
    using limits = std::numeric_limits<Id>;
    std::vector<Id> asked{0, static_cast<Id>(-1), (limits::min)(), (limits::max)()};
    for (const auto id : ids) {
        asked.push_back(id);
        asked.push_back(static_cast<Id>(static_cast<U>(id) + 1U));
        asked.push_back(static_cast<Id>(static_cast<U>(id) ^ (U{1} << (asked.size() % (8 * sizeof(Id))))));
    }
    std::vector<index_t> answers(asked.size(), 77);
    storage.find(std::span<const Id>(asked), answers);
    bool right = storage.size() == expected.first.size();
    for (std::size_t k = 0; k < asked.size(); ++k)
        right = right && answers[k] == expected.find(asked[k]) && storage.find(asked[k]) == answers[k];
    return right;
}

/// The x that the k-th multiplier maps to h in a range of `bits` bits: small h all fall into line 0.
std::int64_t x_that_hashes_to(std::uint64_t h, unsigned bits, std::uint32_t k) {
    const auto odd = tsubu::detail::odd_multiplier(k);
    std::uint64_t inverse = odd;
    for (int step = 0; step < 5; ++step) inverse *= 2 - odd * inverse;
    const auto folded = (h * inverse) & ((std::uint64_t{1} << bits) - 1);
    return static_cast<std::int64_t>(folded ^ (folded >> ((bits + 1) / 2)));
}

/// Enough ids for one line, its spill lines and the stash, and then some, under each of the first multipliers.
ids_t ids_made_to_collide(unsigned bits, std::uint32_t multipliers, std::uint64_t each = 200) {
    ids_t ids{0, (std::int64_t{1} << bits) - 1};  // the range is exactly `bits` bits
    for (std::uint32_t k = 0; k < multipliers; ++k)
        for (std::uint64_t h = 1; h < each; ++h) ids.push_back(x_that_hashes_to(h, bits, k));
    return ids;
}

template <class Id>
std::vector<Id> random_ids(std::size_t count, unsigned bits, std::uint64_t seed, Id offset = 0) {
    const auto mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    std::vector<Id> ids(count);
    for (std::size_t i = 0; i < count; ++i)
        ids[i] = static_cast<Id>(static_cast<std::uint64_t>(offset) + (tsubu::splitmix64(seed * count + i) & mask));
    if (count > 1) {
        ids[0] = offset;
        ids[1] = static_cast<Id>(static_cast<std::uint64_t>(offset) + mask);
    }
    return ids;
}

/// Parts in falling order, every other one on a thread of its own.
struct backwards {
    std::size_t count;
    [[nodiscard]] std::size_t concurrency() const noexcept { return count; }
    template <class Part>
    void run(Part&& part) const {
        for (std::size_t k = count; k-- > 0;) {
            if (k % 2 == 0)
                part(k);
            else
                std::thread([&] { part(k); }).join();
        }
    }
};

}  // namespace

TEST_CASE("the range of the ids decides the lines", "[id][flat_storage][A4]") {
    flat_storage<> storage;
    build(storage, random_ids<std::int64_t>(1000, 20, 1));
    CHECK(storage.lines() == flat_lines::narrow);
    build(storage, random_ids<std::int64_t>(1000, 33, 1));
    CHECK(storage.lines() == flat_lines::wide);
    build(storage, random_ids<std::int64_t>(1000, 63, 1));
    CHECK(storage.lines() == flat_lines::keyed);
    build(storage, random_ids<std::int64_t>(1000, 20, 1, std::int64_t{1} << 61));  // the range, not the highest id
    CHECK(storage.lines() == flat_lines::narrow);
}

TEMPLATE_TEST_CASE("ranges of every number of bits are told apart exactly", "[id][flat_storage][A1][A4][T7]",
                   std::int32_t, std::uint32_t, std::int64_t, std::uint64_t) {
    each_instruction_set{}.run([] {
        constexpr auto most = static_cast<unsigned>(std::numeric_limits<TestType>::digits);
        for (unsigned bits = 1; bits <= most; ++bits) {
            // The lowest id at 0, and the highest at the end of the type.
            const auto at_the_end =
                static_cast<TestType>((std::numeric_limits<TestType>::max)() -
                                      (bits == most ? (std::numeric_limits<TestType>::max)()
                                                    : static_cast<TestType>((TestType{1} << bits) - 1)));
            for (const auto offset : {TestType{0}, at_the_end}) {
                flat_storage<TestType> storage;
                const auto ids = random_ids<TestType>(300, bits, bits, offset);
                const oracle<TestType> expected(ids);
                INFO(bits << " bits from " << offset << ", " << name_of(storage.lines()));
                CHECK(build(storage, ids) == expected.links);
                CHECK(agrees(storage, ids, expected));
                // All entries are hashed back and forth when an assign lays the table out anew.
                const auto id = static_cast<TestType>(offset / 2);
                if (expected.find(id) != absent) continue;
                storage.assign(id, 1'000'000'000);
                bool right = storage.find(id) == 1'000'000'000;
                for (const auto& [present, index] : expected.first) right = right && storage.find(present) == index;
                CHECK(right);
            }
        }
    });
}

TEST_CASE("a batch of any length writes its own answers only", "[id][flat_storage][A1]") {
    each_instruction_set{}.run([] {
        for (const unsigned bits : {18U, 40U, 62U}) {
            flat_storage<> storage;
            const auto ids = random_ids<std::int64_t>(500, bits, 3);
            build(storage, ids);
            bool right = true;
            for (std::size_t length = 0; length <= 200; ++length) {
                const auto from = length % 7;
                std::vector<index_t> answers(length + 2, 77);
                storage.find(std::span(ids).subspan(from, length), std::span(answers).subspan(1, length));
                right = right && answers.front() == 77 && answers.back() == 77;
                for (std::size_t k = 0; k < length; ++k) right = right && answers[k + 1] == storage.find(ids[from + k]);
            }
            CHECK(right);
        }
    });
}

TEST_CASE("an empty span of links is not written, wherever it points", "[id][flat_storage][A13]") {
    const ids_t ids{5, 7'000'000, 5};
    std::vector<index_t> links(3, 42);
    flat_storage<> storage;
    storage.rebuild(ids, tsubu::range_of(std::span(ids)), std::span(links).first(0));
    CHECK(storage.find(5) == 0);
    CHECK(links == std::vector<index_t>(3, 42));
}

TEST_CASE("any executor builds the table that one thread builds", "[id][flat_storage][A13][T8]") {
    for (const unsigned bits : {19U, 40U, 62U}) {
        auto ids = random_ids<std::int64_t>(threaded_count, bits, 5);
        for (std::size_t i = 0; i < ids.size(); i += 3) ids[i] = ids[i / 2];
        const oracle<std::int64_t> expected(ids);
        const auto check = [&](const auto& on) {
            flat_storage<> storage;
            CHECK(build(storage, ids, on) == expected.links);
            CHECK(agrees(storage, ids, expected));
        };
        check(tsubu::threads(2));
        check(backwards{7});
        if (bits == 40U) check(backwards{2'000});  // more parts than blocks of 64 lines: some have none
    }
}

TEST_CASE("ids made to collide under some multipliers take another", "[id][flat_storage][T4]") {
    for (const unsigned bits : {19U, 40U}) {  // narrow, wide
        const auto ids = ids_made_to_collide(bits, 3);
        flat_storage<> storage;
        const oracle<std::int64_t> expected(ids);
        CHECK(build(storage, ids) == expected.links);
        CHECK(storage.discarded_multipliers() >= 3);
        CHECK(agrees(storage, ids, expected));
        // The multiplier is remembered.
        const auto discarded = storage.discarded_multipliers();
        build(storage, ids);
        CHECK(storage.discarded_multipliers() == discarded);
    }
}

TEST_CASE("a stride that one multiplier crowds into few lines takes another, on any number of threads",
          "[id][flat_storage][T4]") {
    ids_t ids(threaded_count);
    for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<std::int64_t>(k << 13);
    flat_storage<> one;
    flat_storage<> several;
    build(one, ids);
    build(several, ids, tsubu::threads(2));
    CHECK(one.discarded_multipliers() > 0);
    CHECK(several.discarded_multipliers() == one.discarded_multipliers());
    bool right = true;
    for (std::size_t k = 0; k < ids.size(); ++k)
        right = right && one.find(ids[k]) == static_cast<index_t>(k) && several.find(ids[k]) == one.find(ids[k]);
    CHECK(right);
}

TEST_CASE("ids that spill over several lines and into the stash are found, replaced and erased",
          "[id][flat_storage][A1][A13]") {
    for (const unsigned bits : {24U, 40U}) {
        auto ids =
            ids_made_to_collide(bits, 1,
                                bits == 24 ? 85 : 50);  // more than the free slots, less than these and the stash
        const auto different = ids.size();
        for (std::size_t i = 0; i < different; ++i) ids.push_back(ids[different - 1 - i]);
        for (std::size_t i = 0; i < 2000; ++i)  // room around them
            ids.push_back(static_cast<std::int64_t>(tsubu::splitmix64(i) & ((std::uint64_t{1} << bits) - 1)));
        flat_storage<> storage;
        oracle<std::int64_t> expected(ids);
        CHECK(build(storage, ids) == expected.links);
        CHECK(storage.discarded_multipliers() == 0);
        CHECK(agrees(storage, ids, expected));
        const auto copy = storage;
        const auto memory = storage.memory_bytes();
        for (std::size_t i = 0; i < different; i += 2) {
            CHECK(storage.erase(ids[i]));
            CHECK_FALSE(storage.erase(ids[i]));
        }
        for (std::size_t i = 0; i < different; ++i)
            CHECK(storage.find(ids[i]) == (i % 2 == 0 ? absent : expected.find(ids[i])));
        for (std::size_t i = 0; i < different; i += 2) storage.assign(ids[i], expected.find(ids[i]));
        CHECK(storage.memory_bytes() == memory);  // their slots were waiting for them
        CHECK(agrees(storage, ids, expected));
        CHECK(agrees(copy, ids, expected));
    }
}

TEST_CASE("assigning ids made to collide ends, with another multiplier", "[id][flat_storage][T4]") {
    flat_storage<> storage;
    const auto ids = ids_made_to_collide(40, 2);
    for (std::size_t i = 0; i < ids.size(); ++i) storage.assign(ids[i], static_cast<index_t>(i));
    CHECK(storage.discarded_multipliers() >= 1);
    CHECK(storage.memory_bytes() < 64 * ids.size());
    CHECK(agrees(storage, ids, oracle<std::int64_t>(ids)));
}

TEST_CASE("ids made to collide under every multiplier are refused by name", "[id][flat_storage][T10]") {
    flat_storage<> storage;
    const auto ids = ids_made_to_collide(50, tsubu::detail::most_attempts, 250);
    const auto message = thrown<tsubu::limit_error>([&] { build(storage, ids); });
    CHECK(says(message, "flat_storage"));
    CHECK(says(message, "did not fit under 64 hash multipliers"));
    CHECK(says(message, "use chained_storage"));
    CHECK(storage.size() == 0);
    build(storage, ids_t{4, 5});
    CHECK(storage.find(5) == 1);
}

TEST_CASE("ids that count up or down past the range are assigned in amortised constant time",
          "[id][flat_storage][T12]") {
    // The layouts are counted through their allocations, several each.
    using gated = tsubu::testing::throwing_allocator<std::byte>;
    const auto high = std::int64_t{1} << 62;
    for (const std::int64_t lowest : {std::int64_t{0}, std::int64_t{1}, high}) {
        for (const std::int64_t step : {1, -1}) {
            tsubu::testing::allocation_gate gate;
            flat_storage<std::int64_t, gated> storage{gated(gate)};
            build(storage, ids_t{lowest, high + high / 2});
            gate.open();
            auto id = high + high / 2;
            for (index_t k = 0; k < 5000; ++k) storage.assign(id += step, k);
            CHECK(gate.asked() < 100);
            CHECK(storage.find(id) == 4999);
            CHECK(storage.find(lowest) == (lowest == 0 || lowest == 1 || lowest == high ? 0 : absent));
        }
    }
}

TEST_CASE("erased ids leave no growth behind", "[id][flat_storage][A10][T12]") {
    for (const std::int64_t stride : {37LL, 1'000'003LL, 1LL << 40}) {
        flat_storage<> storage;
        std::size_t peak = 0;
        for (index_t k = 0; k < 200'000; ++k) {
            storage.assign((k % 50'000) * stride, k);
            if (k >= 500) storage.erase(((k - 500) % 50'000) * stride);
            peak = (std::max)(peak, storage.memory_bytes());
        }
        CHECK(storage.size() == 500);
        CHECK(peak < 500 * 120);
    }
}

TEST_CASE("where memory ends, threads or not, the old table is intact", "[id][flat_storage][T10]") {
    using gated = tsubu::testing::throwing_allocator<std::byte>;
    const auto former = random_ids<std::int64_t>(1000, 33, 1);
    for (const std::size_t team : {1U, 3U}) {
        for (const unsigned bits : {22U, 45U, 62U}) {
            const auto next = random_ids<std::int64_t>(team == 1 ? 20'000 : threaded_count, bits, 9);
            const oracle<std::int64_t> old(former);
            std::size_t number = 0;
            for (bool threw = true; threw; ++number) {
                tsubu::testing::allocation_gate gate;
                flat_storage<std::int64_t, gated> storage{gated(gate)};
                build(storage, former);
                std::vector<index_t> links(next.size(), 77);
                gate.refuse_from(number);
                try {
                    storage.rebuild(next, tsubu::range_of(std::span(next)), links, tsubu::threads(team));
                    threw = false;
                } catch (const std::bad_alloc&) {
                    CHECK(agrees(storage, former, old));
                    CHECK(std::count(links.begin(), links.end(), 77) == static_cast<std::ptrdiff_t>(links.size()));
                }
            }
            CHECK(number > 2);
        }
    }
}

TEST_CASE("a flat table past the memory limit is refused, and the old one stays", "[id][flat_storage][T10]") {
    flat_storage<> storage{tsubu::memory_limit{4096}};
    build(storage, ids_t{1, 2, 3});
    CHECK(says(thrown<tsubu::limit_error>([&] { build(storage, random_ids<std::int64_t>(1000, 20, 1)); }),
               "flat_storage"));
    CHECK_THROWS_AS(storage.reserve(10'000), tsubu::limit_error);
    CHECK(storage.find(2) == 1);
    CHECK(storage.size() == 3);
    flat_storage<> none{tsubu::memory_limit{0}};
    CHECK_THROWS_AS(build(none, ids_t{1}), tsubu::limit_error);
    CHECK_THROWS_AS(none.assign(1, 1), tsubu::limit_error);
    CHECK(none.find(1) == absent);
    build(none, ids_t{});
}

TEST_CASE("a copy of a flat_storage is independent, and what was moved from is empty", "[id][flat_storage]") {
    for (const unsigned bits : {20U, 40U, 62U}) {
        const auto ids = random_ids<std::int64_t>(300, bits, 2);
        flat_storage<> storage;
        build(storage, ids);
        auto copy = storage;
        auto& same = copy;
        copy = same;
        copy.assign(ids[5], 1000);
        CHECK(copy.erase(ids[6]));
        CHECK(agrees(storage, ids, oracle<std::int64_t>(ids)));
        const auto moved = std::move(copy);
        CHECK(moved.find(ids[5]) == 1000);
        CHECK(moved.find(ids[6]) == absent);
        CHECK(copy.size() == 0);
        CHECK(copy.find(ids[5]) == absent);
        CHECK_FALSE(copy.erase(ids[5]));
        copy.assign(7, 7);
        CHECK(copy.find(7) == 7);
    }
}

TEST_CASE("what was reserved stays through small rebuilds", "[id][flat_storage]") {
    flat_storage<> storage;
    storage.reserve(10'000);
    const auto reserved = storage.memory_bytes();
    build(storage, ids_t{4, 7, 4});
    CHECK(storage.memory_bytes() == reserved);
    build(storage, random_ids<std::int64_t>(10'000, 14, 6));
    CHECK(storage.memory_bytes() == reserved);
    storage.clear();
    CHECK(storage.memory_bytes() == reserved);

    flat_storage<> unreserved;
    build(unreserved, random_ids<std::int64_t>(10'000, 14, 6));
    build(unreserved, ids_t{4, 7, 4});
    CHECK(unreserved.memory_bytes() < reserved / 8);
}

TEST_CASE("the ids of a flat table are walked, each once with its index, wherever it lies", "[id][flat_storage]") {
    // Few, many in small lines, and a range that leaves no room for the index in a line.
    for (const auto& ids : {ids_t{5}, ids_t{-3, 900, 7, 900}, [] {
                                ids_t wide(3000);
                                for (std::size_t k = 0; k < wide.size(); ++k)
                                    wide[k] = static_cast<std::int64_t>(k * k) * 1'000'000'007 - 5;
                                return wide;
                            }()}) {
        flat_storage<> storage;
        build(storage, ids);
        const oracle<std::int64_t> expected(ids);
        std::unordered_map<std::int64_t, index_t> walked;
        std::size_t steps = 0;
        storage.for_each([&](std::int64_t id, index_t index) {
            walked[id] = index;
            ++steps;
        });
        CHECK(steps == storage.size());
        CHECK(walked == expected.first);
    }
}
