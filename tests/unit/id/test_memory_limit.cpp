// SPDX-License-Identifier: MIT
#include <tsubu/id/memory_limit.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstdint>

using tsubu::memory_limit;

TEST_CASE("the default limit is 64 times the chained style, with a floor", "[id][A5]") {
    constexpr memory_limit limit;
    CHECK(limit.bytes(0) == memory_limit::floor_bytes);
    CHECK(limit.bytes(1) == memory_limit::floor_bytes);
    CHECK(limit.bytes(1'000'000) == 64 * 40 * std::uint64_t{1'000'000});
    CHECK(limit.bytes(std::size_t{1} << 31) == 64 * 40 * (std::uint64_t{1} << 31));
}

TEST_CASE("a fixed limit does not grow with the particles", "[id][A5]") {
    constexpr memory_limit limit(1000);
    CHECK(limit.bytes(0) == 1000);
    CHECK(limit.bytes(1'000'000) == 1000);
    CHECK(limit.admits(1000, 5));
    CHECK_FALSE(limit.admits(1001, 5));
    CHECK_FALSE(memory_limit(0).admits(1, 5));
}

TEST_CASE("a refusal names policy, id, bytes, limit and remedy", "[id][A5][T11]") {
    const auto text = thrown<tsubu::limit_error>(
        [] { memory_limit().check("dense_storage", 8'000'000'004, 1, 2'000'000'000, "use flat_storage"); });
    INFO(text);
    for (const auto* words : {"dense_storage", "id 2000000000", "8000000004 bytes", "16777216", "use flat_storage"})
        CHECK(says(text, words));
    memory_limit().check("dense_storage", memory_limit::floor_bytes, 1, 7, "use flat_storage");
}
