// SPDX-License-Identifier: MIT
/// @file
/// How large is LIGGGHTS' hash table? The sizing rule as free functions, exact in 64 bits.
#pragma once

#include <tsubu/core/error.hpp>

#include <cstdint>  // std::uint64_t
#include <string>   // std::to_string

namespace tsubu {

/// The least capacity of the chained style. Source: A6.
inline constexpr std::uint64_t chained_least_capacity = 1000;

/// What the chained style holds per id with 64-bit ids: 2 pool nodes of 16 bytes and 2 bucket heads of 4. [bytes]
inline constexpr std::uint64_t chained_bytes_per_id = std::uint64_t{2} * (16 + 4);

/// Nodes in the pool of the chained style: max(1000, 2 max(N, ceil(N_total / P))).
///
/// @param local_count  N, ids on this rank, owned and ghost
/// @param total_count  N_total, particles of the whole simulation (0: not known)
/// @param rank_count   P, at least 1
/// @throws input_error if rank_count is 0; limit_error if the capacity does not fit 64 bits.
/// Source: A6.
[[nodiscard]] constexpr std::uint64_t chained_capacity(std::uint64_t local_count, std::uint64_t total_count = 0,
                                                       std::uint64_t rank_count = 1) {
    if (rank_count == 0)
        detail::raise<input_error>("chained_capacity", "rank_count is 0", "pass the number of ranks, at least 1");
    const std::uint64_t average = total_count / rank_count + (total_count % rank_count != 0 ? 1 : 0);
    const std::uint64_t count = local_count > average ? local_count : average;
    if (count > ~std::uint64_t{0} / 2)
        detail::raise<limit_error>("chained_capacity", "twice " + std::to_string(count) + " does not fit 64 bits",
                                   "spread the particles over more ranks");
    return 2 * count > chained_least_capacity ? 2 * count : chained_least_capacity;
}

}  // namespace tsubu
