// SPDX-License-Identifier: MIT
/// @file
/// What a store asks of the indices it is given; none of it depends on its fields.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <span>     // std::span
#include <string>   // std::to_string
#include <vector>   // std::vector

namespace tsubu::detail {

inline void refuse_ghosts(const char* where, std::size_t ghosts) {
    if (ghosts != 0)
        raise<input_error>(where, std::to_string(ghosts) + " ghosts stand after the owned particles",
                           "call clear_ghosts() before owned particles come, go or change places");
}

[[noreturn]] inline void refuse_count(std::size_t count, std::size_t size) {
    raise<limit_error>("particle_store", std::to_string(count) + " particles where " + std::to_string(size) + " are",
                       "spread them over more ranks: one holds fewer than 2^31");
}

/// Owned particles, in ascending order, each once.
inline void check_ascending(const char* where, std::span<const index_t> chosen, std::size_t owned) {
    for (std::size_t k = 0; k < chosen.size(); ++k)
        if (chosen[k] < 0 || static_cast<std::size_t>(chosen[k]) >= owned || (k != 0 && chosen[k - 1] >= chosen[k]))
            raise<input_error>(where,
                               "index " + std::to_string(chosen[k]) + " at place " + std::to_string(k) + ", of " +
                                   std::to_string(owned) + " owned particles",
                               "give indices from 0 to owned_count() - 1 in ascending order, each once");
}

inline void check_order_length(const char* where, std::size_t length, std::size_t owned) {
    if (length != owned)
        raise<input_error>(where,
                           "an order of " + std::to_string(length) + " for " + std::to_string(owned) +
                               " owned particles",
                           "give each index once");
}

[[nodiscard]] inline bool is_permutation(std::span<const index_t> order) {
    std::vector<bool> seen(order.size());
    for (const auto i : order) {
        if (i < 0 || static_cast<std::size_t>(i) >= order.size() || seen[static_cast<std::size_t>(i)]) return false;
        seen[static_cast<std::size_t>(i)] = true;
    }
    return true;
}

}  // namespace tsubu::detail
