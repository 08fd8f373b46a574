// SPDX-License-Identifier: MIT
/// @file
/// Are the ranks those that there are?
#pragma once

#include <tsubu/comm/mailbox.hpp>
#include <tsubu/core/error.hpp>

#include <cstddef>  // std::size_t
#include <string>   // std::to_string

namespace tsubu::detail {

/// @throws input_error if there is no such rank.
inline void check_parcel(const char* where, const parcel& one, std::size_t ranks) {
    if (one.rank >= ranks)
        raise<input_error>(where, "a parcel for rank " + std::to_string(one.rank) + " of " + std::to_string(ranks),
                           "ranks go from 0 to ranks() - 1");
}

/// @throws input_error if a decomposition is for another number of ranks.
inline void check_ranks(const char* where, std::size_t of_parts, std::size_t of_transport) {
    if (of_parts != of_transport)
        raise<input_error>(where,
                           "a decomposition for " + std::to_string(of_parts) + " ranks on " +
                               std::to_string(of_transport),
                           "make it for on.ranks()");
}

}  // namespace tsubu::detail
