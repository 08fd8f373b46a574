// SPDX-License-Identifier: MIT
/// @file
/// Do the rivals of the benchmark keep the laws of id_storage? Only then are their figures comparable.
#include "rivals/std_unordered_map.hpp"
#if defined(TSUBU_RIVAL_BOOST)
#include "rivals/boost_flat_map.hpp"
#endif
#if defined(TSUBU_RIVAL_ABSL)
#include "rivals/absl_flat_hash_map.hpp"
#endif

#include <tsubu/testing/id_storage_conformance.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

namespace {

using rivals = std::tuple<
#if defined(TSUBU_RIVAL_BOOST)
    bench::boost_flat_map<std::int64_t>, bench::boost_flat_map<std::uint32_t>,
#endif
#if defined(TSUBU_RIVAL_ABSL)
    bench::absl_flat_hash_map<std::int64_t>, bench::absl_flat_hash_map<std::uint32_t>,
    bench::absl_prefetched<std::int64_t>,
#endif
    bench::std_unordered_map<std::int64_t>, bench::std_unordered_map<std::uint32_t>>;

}  // namespace

TEMPLATE_LIST_TEST_CASE("a rival keeps the laws of id_storage", "[id][conformance]", rivals) {
    const auto seed = GENERATE(1U, 2U, 3U);
    std::size_t checked = 0;
    tsubu::testing::check_id_storage<TestType>(seed, 300, [&](bool kept, std::string_view law) {
        ++checked;
        if (kept) return;
        INFO("seed " << seed << ", " << std::string(law));
        CHECK(kept);
    });
    CHECK(checked > 1000);
}

TEMPLATE_LIST_TEST_CASE("a rival gives back the bytes that it counted", "[id][conformance]", rivals) {
    using id_type = typename TestType::id_type;
    TestType map;
    const auto empty = map.memory_bytes();
    for (id_type id = 0; id < 1000; ++id) map.assign(id * 7, 1);
    CHECK(map.memory_bytes() >= 1000 * (sizeof(id_type) + sizeof(tsubu::index_t)));
    const TestType copy = map;
    CHECK(copy.memory_bytes() >= 1000 * (sizeof(id_type) + sizeof(tsubu::index_t)));
    TestType stolen = std::move(map);
    CHECK(stolen.find(7) == 1);
    stolen = TestType();
    CHECK(stolen.memory_bytes() == empty);
    CHECK(copy.find(7) == 1);
}
