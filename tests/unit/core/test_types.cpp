// SPDX-License-Identifier: MIT
#include <tsubu/core/types.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <limits>
#include <string>

static_assert(tsubu::particle_id<std::int32_t> && tsubu::particle_id<std::uint32_t>);
static_assert(tsubu::particle_id<std::int64_t> && tsubu::particle_id<std::uint64_t>);
static_assert(tsubu::particle_id<long> && tsubu::particle_id<unsigned long long>);
static_assert(!tsubu::particle_id<short> && !tsubu::particle_id<bool> && !tsubu::particle_id<char32_t>);
static_assert(!tsubu::particle_id<double> && !tsubu::particle_id<std::string>);

TEST_CASE("an index past the largest count, plus one, still fits its type", "[core]") {
    const auto last = static_cast<tsubu::index_t>(tsubu::max_index_count - 1);
    CHECK(last + 1 == (std::numeric_limits<tsubu::index_t>::max)());
    CHECK(tsubu::absent < 0);
}

TEST_CASE("no unsigned id is negative", "[core][T7]") {
    CHECK(tsubu::detail::is_negative(std::int32_t{-1}));
    CHECK(tsubu::detail::is_negative((std::numeric_limits<std::int64_t>::min)()));
    CHECK_FALSE(tsubu::detail::is_negative(std::int64_t{0}));
    CHECK_FALSE(tsubu::detail::is_negative((std::numeric_limits<std::uint64_t>::max)()));
    CHECK_FALSE(tsubu::detail::is_negative(std::uint32_t{1} << 31));
}
