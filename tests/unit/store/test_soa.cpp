// SPDX-License-Identifier: MIT
#include <tsubu/store/soa.hpp>

#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

TEST_CASE("soa: one array per value, each from a cache line on", "[store]") {
    tsubu::soa::memory<double, std::uint16_t, std::array<float, 3>> rows;
    rows.reallocate(1000, 0);
    CHECK(&rows.at<0>(7) == &rows.at<0>(0) + 7);
    CHECK(&rows.at<1>(999) == &rows.at<1>(0) + 999);
    CHECK(reinterpret_cast<std::uintptr_t>(&rows.at<0>(0)) % 64 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(&rows.at<1>(0)) % 64 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(&rows.at<2>(0)) % 64 == 0);
    CHECK(rows.memory_bytes() == 8000 + 2048 + 12032);  // 8000, 2000, 12000 in lines of 64 bytes
    CHECK(rows.place<0>().start == &rows.at<0>(0));
}

namespace {

struct alignas(128) wide {
    double value;
};
inline constexpr tsubu::field<"wide", wide> wide_field{};

}  // namespace

TEST_CASE("arrays are as aligned as their values", "[store][soa]") {
    for (int k = 0; k < 8; ++k) {
        tsubu::particle_store<tsubu::fields<tsubu::id, wide_field>> g;
        g.push_back(tsubu::id = k);
        CHECK(reinterpret_cast<std::uintptr_t>(&g[wide_field][0]) % alignof(wide) == 0);
    }
}
