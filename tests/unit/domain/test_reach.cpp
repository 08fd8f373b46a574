// SPDX-License-Identifier: MIT
#include <tsubu/domain/detail/reach.hpp>

#include "support/catch.hpp"

#include <tsubu/core/random.hpp>

#include <algorithm>
#include <cmath>

using tsubu::axis;
using tsubu::detail::reaching_images;
using tsubu::detail::stretch;

TEMPLATE_TEST_CASE("two stretches reach one another or neither does, at the last bit of the cutoff",
                   "[domain][neighbors][F4]", double, float) {
    tsubu::random_stream random(41);
    for (int i = 0; i < 3000; ++i) {
        const auto lo = static_cast<TestType>(random.unit() - 0.5);
        const axis<TestType> along(lo, lo + static_cast<TestType>(random.unit() + 0.1), true);
        const auto some_stretch = [&] {
            const auto a = lo + static_cast<TestType>(random.unit()) * along.length();
            const auto b = lo + static_cast<TestType>(random.unit()) * along.length();
            return stretch<TestType>{std::min(a, b), std::max(a, b)};
        };
        const auto mine = some_stretch();
        const auto other = some_stretch();
        for (const auto& image : reaching_images("test", along, mine, other, along.length() * 2))
            for (const auto cutoff :
                 {image.gap, std::nextafter(image.gap, TestType{0}), std::nextafter(image.gap, TestType{9})}) {
                const auto there = reaching_images("test", along, mine, other, cutoff);
                const auto back = reaching_images("test", along, other, mine, cutoff);
                REQUIRE(there.size() == back.size());
                for (std::size_t k = 0; k < there.size(); ++k) {
                    REQUIRE(there[k].shift == -back[back.size() - 1 - k].shift);
                    REQUIRE(there[k].gap == back[back.size() - 1 - k].gap);
                }
            }
    }
}
