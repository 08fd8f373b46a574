// SPDX-License-Identifier: MIT
/// @file
/// Does a pair_reach keep its two laws? A suite for any test framework, or none.
///
///     tsubu::testing::check_pair_reach(my_reach{...}, particles, [](auto i, auto j) { return ...; },
///                                      [](bool ok, std::string_view law) { ... });
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/neighbor/reach.hpp>

#include <cmath>        // std::abs, std::sqrt
#include <cstddef>      // std::size_t
#include <limits>       // std::numeric_limits
#include <string>       // std::string, std::to_string
#include <string_view>  // std::string_view

namespace tsubu::testing {

/// The laws of pair_reach as the suite reports them: a name for each text; never an object.
struct pair_reach_law {
    pair_reach_law() = delete;

    static constexpr const char* greatest = "law 1: the greatest reach is at least that of any pair of the first N";
    static constexpr const char* square = "law 2: the square is that of the distance, in doubles and in floats";
    static constexpr const char* symmetric = "law 2: particles i and j have the reach of j and i, bit for bit";
};

/// Does this reach keep laws 1 and 2 for all pairs of so many particles?
///
/// @param distance  distance(i, j) is the reach of that pair as it is meant [m]
/// @param check     called as check(bool kept, std::string_view law); a broken law with the pair behind its text
/// Complexity: O(count^2).
template <pair_reach Reach, class Distance, class Check>
void check_pair_reach(const Reach& reach, std::size_t count, Distance&& distance, Check&& check) {
    const auto report = [&](bool kept, const char* text, std::size_t i, std::size_t j) {
        if (kept) return check(true, std::string_view(text));
        check(false, std::string_view(std::string(text) + ", of particles " + std::to_string(i) + " and " +
                                      std::to_string(j)));
    };
    // A few roundings of the sum and of its square.
    const auto is_near = [](auto square, double expected) {
        const auto slack = 8 * static_cast<double>(std::numeric_limits<decltype(square)>::epsilon());
        return std::abs(static_cast<double>(square) - expected * expected) <= slack * expected * expected;
    };
    for (std::size_t j = 1; j < count; ++j) {
        const double greatest = reach.greatest(j + 1);
        for (std::size_t i = 0; i < j; ++i) {
            const auto a = static_cast<index_t>(i);
            const auto b = static_cast<index_t>(j);
            const double expected = distance(a, b);
            const double square = reach.template square<double>(a, b);
            const float in_floats = reach.template square<float>(a, b);
            report(is_near(square, expected) && is_near(in_floats, expected), pair_reach_law::square, i, j);
            report(square == reach.template square<double>(b, a) && in_floats == reach.template square<float>(b, a),
                   pair_reach_law::symmetric, i, j);
            report(std::sqrt(square) <= greatest * (1 + 4 * std::numeric_limits<double>::epsilon()),
                   pair_reach_law::greatest, i, j);
        }
    }
}

}  // namespace tsubu::testing
