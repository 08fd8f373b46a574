// SPDX-License-Identifier: MIT
#include <tsubu/id/hash.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

using tsubu::mixed;
using tsubu::mod_prime;

namespace {

/// Ids in the fullest of `buckets` buckets.
template <class Hash, class Ids>
std::size_t fullest(Ids&& id, std::uint64_t count, std::uint64_t buckets) {
    std::vector<std::size_t> held(buckets);
    for (std::uint64_t k = 1; k <= count; ++k) ++held[Hash::bucket(id(k), buckets)];
    return *std::max_element(held.begin(), held.end());
}

}  // namespace

TEST_CASE("mod_prime is the remainder of the unsigned value", "[id][A9]") {
    CHECK(mod_prime::bucket(0, 1009) == 0);
    CHECK(mod_prime::bucket(1009, 1009) == 0);
    CHECK(mod_prime::bucket(1010, 1009) == 1);
    CHECK(mod_prime::bucket(~std::uint64_t{0}, 32'771) == 18446744073709551615U % 32'771U);
}

TEST_CASE("every hash stays below the bucket count", "[id][A9]") {
    const auto buckets =
        GENERATE(std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{1009}, std::uint64_t{2'147'483'659});
    for (std::uint64_t k = 0; k < 2000; ++k) {
        const auto id = k % 2 == 0 ? k : ~std::uint64_t{0} - k * 0x123456789abcdefU;
        REQUIRE(mod_prime::bucket(id, buckets) < buckets);
        REQUIRE(mixed::bucket(id, buckets) < buckets);
    }
}

TEST_CASE("strided ids fill one bucket of mod_prime, and no bucket of mixed", "[id][A9][H1]") {
    constexpr std::uint64_t buckets = 32'771;
    struct pattern {
        const char* name;
        std::uint64_t (*id)(std::uint64_t);
    };
    const auto pattern_of =
        GENERATE(pattern{"k * 32771", [](std::uint64_t k) { return k * 32'771; }},
                 pattern{"k * 1009", [](std::uint64_t k) { return k * 1009; }},
                 pattern{"k * 2^16", [](std::uint64_t k) { return k << 16; }},
                 pattern{"k * 2^32", [](std::uint64_t k) { return k << 32; }},
                 pattern{"bit-reversed k",
                         [](std::uint64_t k) {
                             std::uint64_t reversed = 0;
                             for (int bit = 0; bit < 62; ++bit) reversed |= (k >> bit & 1) << (61 - bit);
                             return reversed;
                         }},
                 pattern{"rank * 10^9 + k", [](std::uint64_t k) { return k % 16 * 1'000'000'000 + k / 16; }},
                 pattern{"Fibonacci", [](std::uint64_t k) { return k * 11'400'714'819'323'198'485U >> 2; }});
    INFO(pattern_of.name);
    // 40 000 random ids in 32 771 buckets: the fullest holds 8 or 9; 16 has a probability below 1e-8.
    CHECK(fullest<mixed>(pattern_of.id, 40'000, buckets) <= 16);
    CHECK(fullest<mod_prime>([](std::uint64_t k) { return k * 32'771; }, 40'000, buckets) == 40'000);
}
