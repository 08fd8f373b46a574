// SPDX-License-Identifier: MIT
#include <tsubu/store/aosoa.hpp>

#include "support/catch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

TEST_CASE("aosoa: N of each value, block by block", "[store]") {
    tsubu::aosoa<4>::memory<std::int32_t, double> rows;
    rows.reallocate(10, 0);
    CHECK(rows.capacity() == 12);
    const auto* const start = reinterpret_cast<const std::byte*>(&rows.at<1>(0));
    const auto offset = [&](const auto& value) { return reinterpret_cast<const std::byte*>(&value) - start; };
    CHECK(offset(rows.at<1>(3)) == 24);
    CHECK(offset(rows.at<0>(0)) == 32);
    CHECK(offset(rows.at<0>(3)) == 44);
    CHECK(offset(rows.at<1>(4)) == 48);
    CHECK(offset(rows.at<0>(11)) == 2 * 48 + 44);
    CHECK(rows.memory_bytes() == 3 * 48);
}

TEST_CASE("aosoa: blocks begin at a cache line where that costs no more than 1 %", "[store]") {
    tsubu::aosoa<16>::memory<double, std::int32_t> lines;
    lines.reallocate(32, 0);
    CHECK(reinterpret_cast<std::uintptr_t>(&lines.at<0>(0)) % 64 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(&lines.at<1>(16)) % 64 == 0);
    CHECK(lines.memory_bytes() == 32 * 12);
    tsubu::aosoa<1>::memory<double, double, double> records;
    records.reallocate(100, 0);
    CHECK(records.memory_bytes() == 100 * 24);
    tsubu::aosoa<5>::memory<double> odd;
    odd.reallocate(100, 0);
    CHECK(odd.memory_bytes() == 100 * 8);
}
