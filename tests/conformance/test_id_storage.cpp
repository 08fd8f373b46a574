// SPDX-License-Identifier: MIT
/// @file
/// The shipped storage policies against the nine laws of id_storage: the list, nothing else.
#include <tsubu/id/adaptive_storage.hpp>
#include <tsubu/id/bitmap_storage.hpp>
#include <tsubu/id/chained_storage.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/hash.hpp>
#include <tsubu/id/memory_limit.hpp>
#include <tsubu/id/paged_storage.hpp>
#include <tsubu/testing/id_storage_conformance.hpp>

#include "support/catch.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

namespace {

using namespace tsubu;
using gated = testing::throwing_allocator<std::byte>;

using narrow_or_unsigned =
    std::tuple<dense_storage<std::int32_t>, dense_storage<std::uint32_t>, dense_storage<std::uint64_t>,
               chained_storage<mod_prime, std::int32_t>, chained_storage<mod_prime, std::uint32_t>,
               chained_storage<mod_prime, std::uint64_t>, chained_storage<mixed, std::int32_t>,
               chained_storage<mixed, std::uint32_t>, chained_storage<mixed, std::uint64_t>, flat_storage<std::int32_t>,
               flat_storage<std::uint32_t>, flat_storage<std::uint64_t>, bitmap_storage<std::int32_t>,
               bitmap_storage<std::uint32_t>, bitmap_storage<std::uint64_t>, paged_storage<std::int32_t>,
               paged_storage<std::uint32_t>, paged_storage<std::uint64_t>, adaptive_storage<std::int32_t>,
               adaptive_storage<std::uint32_t>, adaptive_storage<std::uint64_t>>;
using wide = std::tuple<dense_storage<>, chained_storage<mod_prime>, chained_storage<mixed>, flat_storage<>,
                        bitmap_storage<>, paged_storage<>, adaptive_storage<>>;
using all_gated = std::tuple<dense_storage<std::int64_t, gated>, chained_storage<mod_prime, std::int64_t, gated>,
                             chained_storage<mixed, std::uint32_t, gated>, flat_storage<std::int64_t, gated>,
                             flat_storage<std::uint32_t, gated>, bitmap_storage<std::int64_t, gated>,
                             paged_storage<std::int64_t, gated>, adaptive_storage<std::int64_t, gated>,
                             adaptive_storage<std::uint32_t, gated>>;

constexpr std::uint64_t seed = 20'240'901;

void require_law(bool kept, std::string_view law) {
    if (!kept) FAIL_CHECK(law);
}

/// A table by range takes memory by range: with a limit, most of the rebuilds stay in the cache, and as many
/// as it refuses are checked for law 8.
template <class Storage>
Storage limited() {
    if constexpr (std::is_constructible_v<Storage, memory_limit>)
        return Storage(memory_limit(std::uint64_t{1} << 18));
    else
        return Storage();
}

}  // namespace

// Where nothing is optimised, rebuilds take 30 times as long.
#if defined(NDEBUG)
constexpr bool is_fast = true;
#else
constexpr bool is_fast = false;
#endif
constexpr std::size_t many_rebuilds = is_fast ? 10'000 : 800;
constexpr std::size_t some_rebuilds = is_fast ? 1'500 : 150;

TEMPLATE_LIST_TEST_CASE("thousands of random rebuilds agree with a sorted array",
                        "[id][conformance][T9][I1][I2][I5][A1][A13]", wide) {
    INFO("seed " << seed);
    testing::check_id_storage(seed, many_rebuilds, require_law, limited<TestType>());
    SUCCEED();
}

TEMPLATE_LIST_TEST_CASE("the laws hold for ids of 32 bits and unsigned ones", "[id][conformance][T9][I5]",
                        narrow_or_unsigned) {
    INFO("seed " << seed);
    testing::check_id_storage(seed + 1, some_rebuilds, require_law, limited<TestType>());
    SUCCEED();
}

TEMPLATE_LIST_TEST_CASE("the laws hold with the default memory limit", "[id][conformance]", wide) {
    testing::check_id_storage(seed + 2, 100, require_law, TestType());
    SUCCEED();
}

TEMPLATE_LIST_TEST_CASE("the laws hold for many ids, built by one, two and three threads", "[id][conformance][I5]",
                        wide) {
    // Of fewer, flat_storage builds nothing by threads, nor does adaptive_storage, which has one inside.
    constexpr bool has_threads = std::same_as<TestType, flat_storage<>>;
    testing::check_id_storage_large<TestType>(seed + 3, is_fast || has_threads ? 300'000 : 30'000, require_law);
    SUCCEED();
}

TEMPLATE_LIST_TEST_CASE("what throws for want of memory changes nothing", "[id][conformance][T10]", all_gated) {
    testing::check_id_storage_allocation<TestType>(seed + 4, is_fast ? 25 : 6, require_law);
    SUCCEED();
}
