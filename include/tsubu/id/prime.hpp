// SPDX-License-Identifier: MIT
/// @file
/// Which prime comes next? The bucket count of LIGGGHTS' hash scheme.
#pragma once

#include <tsubu/core/error.hpp>

#include <concepts>  // std::integral
#include <cstdint>   // std::uint64_t
#include <limits>    // std::numeric_limits
#include <string>    // std::to_string

namespace tsubu {

/// Is n prime? By trial division with 2 and the odd d, d * d <= n, in 64 bits.
/// Complexity: O(sqrt n); 0.1 ms at 2^31.
[[nodiscard]] constexpr bool is_prime(std::uint64_t n) noexcept {
    if (n < 4) return n >= 2;
    if (n % 2 == 0) return false;
    for (std::uint64_t d = 3; d <= n / d; d += 2)  // d <= n / d: d * d would wrap near 2^64
        if (n % d == 0) return false;
    return true;
}

/// The smallest prime greater than n: 0 -> 2, 2 -> 3, 1000 -> 1009. A negative n yields 2.
///
/// The formula as the description prints it (A8) tries n + 2, n + 4, ...: for an even n, and the capacity is always
/// even, it never finds one.
///
/// @throws limit_error if no greater prime fits the type of n.
/// Complexity: O(gap * sqrt n): below 1 ms near 2^31.
/// Source: A7, A8.
template <std::integral Integer>
[[nodiscard]] constexpr Integer next_prime(Integer n) {
    if (n < 2) return 2;
    constexpr auto largest = static_cast<std::uint64_t>((std::numeric_limits<Integer>::max)());
    const auto from = static_cast<std::uint64_t>(n);
    for (std::uint64_t p = from + 1 + from % 2; p > from && p <= largest; p += 2)
        if (is_prime(p)) return static_cast<Integer>(p);
    detail::raise<limit_error>("next_prime", "no prime above " + std::to_string(n) + " fits the type",
                               "pass a wider integer");
}

}  // namespace tsubu
