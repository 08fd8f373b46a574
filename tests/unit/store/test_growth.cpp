// SPDX-License-Identifier: MIT
#include <tsubu/store/growth.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstdint>
#include <limits>

namespace {

constexpr auto max64 = (std::numeric_limits<std::uint64_t>::max)();

/// What n appends cost, one by one.
template <class Growth>
auto cost_of(std::uint64_t appends) {
    struct {
        std::uint64_t reallocations = 0;
        std::uint64_t copied = 0;
    } cost;
    for (std::uint64_t capacity = 0; capacity < appends;) {
        cost.copied += capacity;  // it is full
        capacity = Growth{}.next(capacity, capacity + 1);
        ++cost.reallocations;
    }
    return cost;
}

}  // namespace

TEST_CASE("next_block is strictly above, round_up is not", "[store][C1][C2]") {
    using tsubu::next_block;
    using tsubu::round_up;
    STATIC_REQUIRE(next_block(0) == 16384);
    STATIC_REQUIRE(next_block(1) == 16384);
    STATIC_REQUIRE(next_block(16383) == 16384);
    STATIC_REQUIRE(next_block(16384) == 32768);
    STATIC_REQUIRE(next_block(16385) == 32768);
    STATIC_REQUIRE(next_block(2147467264) == 2147483648);  // where 32 bits end
    STATIC_REQUIRE(round_up(0) == 0);
    STATIC_REQUIRE(round_up(1) == 16384);
    STATIC_REQUIRE(round_up(16384) == 16384);
    STATIC_REQUIRE(round_up(16385) == 32768);
    STATIC_REQUIRE(next_block(0, tsubu::bonus_block) == 8192);
    STATIC_REQUIRE(next_block(8192, tsubu::bonus_block) == 16384);
    STATIC_REQUIRE(next_block(2147475456, tsubu::bonus_block) == 2147483648);
    STATIC_REQUIRE(round_up(8193, tsubu::bonus_block) == 16384);
}

TEST_CASE("where 64 bits end, no block is invented", "[store][C1]") {
    constexpr auto last_block = max64 / 16384 * 16384;
    CHECK(tsubu::next_block(last_block - 1) == last_block);
    CHECK(tsubu::round_up(last_block) == last_block);
    for (const auto n : {last_block, max64}) {
        const auto text = thrown<tsubu::limit_error>([&] { static_cast<void>(tsubu::next_block(n)); });
        CHECK(says(text, "tsubu::next_block: no whole block above " + std::to_string(n) + " fits 64 bits"));
    }
    CHECK_THROWS_AS(tsubu::round_up(max64), tsubu::limit_error);
    CHECK_THROWS_AS(tsubu::geometric_growth{}.next(max64, max64), tsubu::limit_error);
    CHECK_THROWS_AS(tsubu::block_growth{}.next(max64, max64), tsubu::limit_error);
}

TEMPLATE_TEST_CASE("a growth policy gives what is needed, more than there is, in whole blocks", "[store][C1]",
                   tsubu::geometric_growth, tsubu::block_growth) {
    for (const std::uint64_t capacity : {0U, 1U, 16383U, 16384U, 16385U, 65536U, 1'000'000U, 2'147'483'648U})
        for (const std::uint64_t needed :
             {std::uint64_t{0}, capacity, capacity + 1, capacity + 100'000, 10 * capacity}) {
            const auto next = TestType{}.next(capacity, needed);
            CAPTURE(capacity, needed, next);
            CHECK(next > capacity);
            CHECK(next >= needed);
            CHECK(next % tsubu::store_block == 0);
        }
}

TEST_CASE("geometric growth reallocates O(log n) times and copies less than three times n", "[store][C1]") {
    for (const std::uint64_t appends : {100'000U, 10'000'000U, 100'000'000U}) {
        const auto cost = cost_of<tsubu::geometric_growth>(appends);
        CAPTURE(appends, cost.reallocations, cost.copied);
        CHECK(cost.copied < 3 * appends);
    }
    CHECK(cost_of<tsubu::geometric_growth>(10'000'000).reallocations <= 20);
    CHECK(cost_of<tsubu::geometric_growth>(100'000'000).reallocations <= 25);
    // A constant number for each factor of ten: O(log n).
    std::uint64_t before = cost_of<tsubu::geometric_growth>(1'000'000).reallocations;
    for (std::uint64_t appends = 10'000'000; appends <= 10'000'000'000'000; appends *= 10) {
        const auto reallocations = cost_of<tsubu::geometric_growth>(appends).reallocations;
        CHECK(reallocations - before <= 6);  // log(10) / log(1.5) = 5.7
        before = reallocations;
    }
}

TEST_CASE("block growth copies 3e11 elements for 1e8 appends", "[store][C1]") {
    const auto cost = cost_of<tsubu::block_growth>(100'000'000);
    CHECK(cost.reallocations == (100'000'000 + 16383) / 16384);
    // Before block k + 1 comes, k blocks are copied: 16384 * (0 + 1 + ... + 6103) = 3.05e11.
    CHECK(cost.copied == std::uint64_t{16384} * 6103 * 6104 / 2);
    CHECK(cost.copied == 305'174'216'704);
    CHECK(cost_of<tsubu::block_growth>(10'000'000).reallocations == 611);
}
