// SPDX-License-Identifier: MIT
/// @file
/// The rival that every C++ program has: std::unordered_map.
#pragma once

#include "map_storage.hpp"

#include <cstdint>        // std::int64_t
#include <functional>     // std::equal_to, std::hash
#include <unordered_map>  // std::unordered_map

namespace bench {

template <tsubu::particle_id Id>
using std_unordered_map =
    map_storage<std::unordered_map<Id, tsubu::index_t, std::hash<Id>, std::equal_to<Id>, counted_entries<Id>>>;
static_assert(tsubu::id_storage<std_unordered_map<std::int64_t>>);

}  // namespace bench
