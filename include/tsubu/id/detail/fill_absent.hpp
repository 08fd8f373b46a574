// SPDX-License-Identifier: MIT
/// @file
/// Indices that are all absent, at the speed of memset.
#pragma once

#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstring>  // std::memset

namespace tsubu::detail {

inline void fill_absent(index_t* entries, std::size_t count) noexcept {
    static_assert(absent == -1, "filled bytewise");
    std::memset(entries, 0xff, count * sizeof(index_t));
}

}  // namespace tsubu::detail
