// SPDX-License-Identifier: MIT
#include <tsubu/store/aos.hpp>

#include "support/catch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

TEST_CASE("aos: the values of a row lie together, those of the largest alignment first", "[store]") {
    tsubu::aos::memory<std::uint16_t, double, std::array<float, 3>, unsigned char> rows;
    rows.reallocate(10, 0);
    const auto* const start = reinterpret_cast<const std::byte*>(&rows.at<1>(0));
    const auto offset = [&](const auto& value) { return reinterpret_cast<const std::byte*>(&value) - start; };
    CHECK(offset(rows.at<2>(0)) == 8);
    CHECK(offset(rows.at<0>(0)) == 20);
    CHECK(offset(rows.at<3>(0)) == 22);
    CHECK(offset(rows.at<1>(1)) == 24);  // 8 + 12 + 2 + 1 = 23: one byte at the end
    CHECK(offset(rows.at<3>(9)) == 9 * 24 + 22);
    CHECK(rows.memory_bytes() == 240);
    CHECK(rows.capacity() == 10);
}

TEST_CASE("aos honours values that ask for more than a word", "[store]") {
    struct alignas(32) wide {
        double x[4];
    };
    tsubu::aos::memory<char, wide> rows;
    rows.reallocate(5, 0);
    CHECK(reinterpret_cast<std::uintptr_t>(&rows.at<1>(3)) % 32 == 0);
    CHECK(rows.memory_bytes() == 5 * 64);
}
