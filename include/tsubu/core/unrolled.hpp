// SPDX-License-Identifier: MIT
/// @file
/// unrolled: a loop of a few rounds that the compiler is to take apart, whatever its options.
#pragma once

#include <tsubu/version.hpp>

#include <cstddef>      // std::size_t
#include <type_traits>  // std::integral_constant
#include <utility>      // std::index_sequence, std::make_index_sequence

namespace tsubu {

/// body(k) for k = 0 .. Count - 1, each a constant. Where g++ -O2 leaves a loop over the axes, the numbers in it live in
/// memory.
template <std::size_t Count, class Body>
[[gnu::always_inline]] constexpr void unrolled(Body&& body) {
    [&]<std::size_t... K>(std::index_sequence<K...>) __attribute__((always_inline)) {
        (body(std::integral_constant<std::size_t, K>{}), ...);
    }
    (std::make_index_sequence<Count>{});
}

}  // namespace tsubu
