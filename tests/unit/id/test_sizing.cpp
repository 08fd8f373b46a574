// SPDX-License-Identifier: MIT
#include <tsubu/id/prime.hpp>
#include <tsubu/id/sizing.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstdint>

using tsubu::chained_capacity;

TEST_CASE("the capacity is twice the count, at least 1000", "[id][A6]") {
    CHECK(chained_capacity(0) == 1000);
    CHECK(chained_capacity(499) == 1000);
    CHECK(chained_capacity(500) == 1000);
    CHECK(chained_capacity(501) == 1002);
    CHECK(chained_capacity(1001) == 2002);
    CHECK(chained_capacity(16'384) == 32'768);
}

TEST_CASE("the average over all ranks counts where it is larger, rounded up", "[id][A6]") {
    CHECK(chained_capacity(10, 100'000, 10) == 20'000);
    CHECK(chained_capacity(10, 100'001, 10) == 20'002);
    CHECK(chained_capacity(30'000, 100'000, 10) == 60'000);
    CHECK(chained_capacity(0, 1, 1'000'000) == 1000);
}

TEST_CASE("capacities of the largest runs are exact in 64 bits", "[id][A6][T14]") {
    CHECK(chained_capacity(std::uint64_t{1} << 30, 100'000'000'000, 10) == 20'000'000'000);
    CHECK(chained_capacity(std::uint64_t{1} << 30) == std::uint64_t{1} << 31);
    CHECK(chained_capacity((std::uint64_t{1} << 31) - 1) == 4'294'967'294);
    CHECK(tsubu::next_prime(chained_capacity(std::uint64_t{1} << 30)) == 2'147'483'659);
    // ceil(N_total / P) near 2^64: N_total + P - 1 would wrap.
    CHECK(chained_capacity(0, ~std::uint64_t{0}, 2'000) == 2 * 9'223'372'036'854'776);
    CHECK(chained_capacity(0, ~std::uint64_t{0}, 3) == 2 * (~std::uint64_t{0} / 3));
}

TEST_CASE("a capacity past 64 bits and a run without ranks are refused", "[id][A6][T14]") {
    const auto text = thrown<tsubu::limit_error>([] { static_cast<void>(chained_capacity(0, ~std::uint64_t{0}, 1)); });
    INFO(text);
    CHECK(says(text, "18446744073709551615"));
    CHECK_THROWS_AS(chained_capacity(std::uint64_t{1} << 63), tsubu::limit_error);
    CHECK(chained_capacity((std::uint64_t{1} << 63) - 1) == ~std::uint64_t{0} - 1);
    CHECK(says(thrown<tsubu::input_error>([] { static_cast<void>(chained_capacity(1, 1, 0)); }), "rank_count"));
}
