// SPDX-License-Identifier: MIT
/// @file
/// The rival boost::unordered_flat_map (Boost >= 1.81): open addressing, groups of 15 with a byte of hash each.
#pragma once

#include "map_storage.hpp"

#include <boost/unordered/unordered_flat_map.hpp>

#include <cstdint>     // std::int64_t
#include <functional>  // std::equal_to

namespace bench {

template <tsubu::particle_id Id>
using boost_flat_map =
    map_storage<boost::unordered_flat_map<Id, tsubu::index_t, boost::hash<Id>, std::equal_to<Id>, counted_entries<Id>>>;
static_assert(tsubu::id_storage<boost_flat_map<std::int64_t>>);

}  // namespace bench
