// SPDX-License-Identifier: MIT
#include <tsubu/core/random.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

static_assert(std::uniform_random_bit_generator<tsubu::random_stream>);

TEST_CASE("the stream is splitmix64 as published", "[core]") {
    // The first outputs for seed 1234567 of Vigna's implementation.
    tsubu::random_stream random(1234567);
    CHECK(random() == 6457827717110365317U);
    CHECK(random() == 3203168211198807973U);
    CHECK(random() == 9817491932198370423U);
    CHECK(random() == 4593380528125082431U);
    CHECK(random() == 16408922859458223821U);
}

TEST_CASE("equal seeds give equal streams, in constant expressions too", "[core]") {
    constexpr auto third = [] {
        tsubu::random_stream random(42);
        random();
        random();
        return random();
    }();
    tsubu::random_stream random(42);
    random();
    random();
    CHECK(random() == third);
}

TEST_CASE("the standard library shuffles with the stream, which has all words", "[core]") {
    CHECK(tsubu::random_stream::min() == 0);
    CHECK(tsubu::random_stream::max() == ~std::uint64_t{0});
    tsubu::random_stream random(3);
    std::vector<int> cards(52);
    std::iota(cards.begin(), cards.end(), 0);
    const auto sorted = cards;
    std::shuffle(cards.begin(), cards.end(), random);
    CHECK(cards != sorted);
    CHECK(std::is_permutation(cards.begin(), cards.end(), sorted.begin()));
}

TEST_CASE("bounded numbers stay in their bounds", "[core]") {
    tsubu::random_stream random(7);
    bool seen[5] = {};
    for (int k = 0; k < 1000; ++k) {
        const auto below = random.below(5);
        REQUIRE(below < 5);
        seen[below] = true;
        const double unit = random.unit();
        REQUIRE((unit >= 0 && unit < 1));
    }
    for (const bool each : seen) CHECK(each);
    CHECK(random.below(1) == 0);
}
