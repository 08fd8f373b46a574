// SPDX-License-Identifier: MIT
#include <tsubu/id/id_range.hpp>

#include "support/catch.hpp"

#include <tsubu/core/random.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

using tsubu::id_range;
using tsubu::range_of;

using all_ids = std::tuple<std::int32_t, std::uint32_t, std::int64_t, std::uint64_t>;

TEMPLATE_LIST_TEST_CASE("the range of no ids is empty", "[id][A3][T2]", all_ids) {
    const auto range = range_of(std::span<const TestType>());
    CHECK(range.empty());
    CHECK_FALSE(range.contains(0));
    CHECK_FALSE(range.contains((std::numeric_limits<TestType>::max)()));
    CHECK(range == id_range<TestType>{});
}

TEMPLATE_LIST_TEST_CASE("the range is that of a plain minimum and maximum, for every length", "[id][A3]", all_ids) {
    tsubu::random_stream random(5);
    for (std::size_t count = 1; count < 40; ++count) {
        std::vector<TestType> ids(count);
        for (auto& id : ids) id = static_cast<TestType>(random());
        const auto range = range_of(std::span<const TestType>(ids));
        CHECK(range.lowest == *std::min_element(ids.begin(), ids.end()));
        CHECK(range.highest == *std::max_element(ids.begin(), ids.end()));
        for (const auto id : ids) CHECK(range.contains(id));
    }
}

TEMPLATE_LIST_TEST_CASE("the extent of the widest range does not overflow", "[id][A3][T11]", all_ids) {
    constexpr auto lowest = (std::numeric_limits<TestType>::min)();
    constexpr auto highest = (std::numeric_limits<TestType>::max)();
    using bits = std::make_unsigned_t<TestType>;
    CHECK((id_range<TestType>{lowest, highest}.extent()) == (std::numeric_limits<bits>::max)());
    CHECK((id_range<TestType>{0, highest}.extent()) == static_cast<std::uint64_t>(highest));
    CHECK((id_range<TestType>{highest, highest}.extent()) == 0);
}

TEST_CASE("range_of is a constant expression", "[id]") {
    static constexpr std::int64_t ids[] = {9, 5, 9, -2, 5};
    constexpr auto range = range_of(std::span<const std::int64_t>(ids));
    static_assert(range.lowest == -2 && range.highest == 9 && range.extent() == 11);
    CHECK(range.with(20).highest == 20);
}
