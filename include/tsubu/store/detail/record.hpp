// SPDX-License-Identifier: MIT
/// @file
/// Where the values of N particles lie in a block of memory.
#pragma once

#include <algorithm>  // std::max
#include <array>      // std::array
#include <cstddef>    // std::size_t

namespace tsubu::detail {

/// N values of each type, one type after the other, those of the largest alignment first.
template <std::size_t N, class... Values>
struct record {
    static constexpr std::size_t count = sizeof...(Values);
    static constexpr std::array<std::size_t, count> sizes{sizeof(Values)...};
    static constexpr std::array<std::size_t, count> alignments{alignof(Values)...};
    static constexpr std::size_t alignment = (std::max)({std::size_t{1}, alignof(Values)...});
    static constexpr std::array<std::size_t, count> offset = [] {
        std::array<std::size_t, count> result{};
        std::size_t at = 0;
        for (auto wanted = alignment; wanted > 0; wanted /= 2)
            for (std::size_t k = 0; k < count; ++k)
                if (alignments[k] == wanted) {
                    result[k] = at;
                    at += N * sizes[k];
                }
        return result;
    }();
    static constexpr std::size_t size = [] {
        std::size_t sum = 0;
        for (const auto bytes : sizes) sum += N * bytes;
        return (sum + alignment - 1) / alignment * alignment;
    }();
};

}  // namespace tsubu::detail
