// SPDX-License-Identifier: MIT
/// @file
/// The rival absl::flat_hash_map: open addressing, groups of 16 with a byte of hash each; plain and with prefetches.
#pragma once

#include "map_storage.hpp"

#include <absl/container/flat_hash_map.h>

#include <algorithm>  // std::min
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <span>       // std::span

namespace bench {

template <tsubu::particle_id Id>
using absl_map = absl::flat_hash_map<Id, tsubu::index_t, absl::container_internal::hash_default_hash<Id>,
                                     absl::container_internal::hash_default_eq<Id>, counted_entries<Id>>;

template <tsubu::particle_id Id>
using absl_flat_hash_map = map_storage<absl_map<Id>>;
static_assert(tsubu::id_storage<absl_flat_hash_map<std::int64_t>>);

/// The same map, with a batched look-up by its public prefetch(key): the best that its interface offers.
template <tsubu::particle_id Id>
class absl_prefetched : public absl_flat_hash_map<Id> {
public:
    using absl_flat_hash_map<Id>::find;
    void find(std::span<const Id> ids, std::span<tsubu::index_t> out) const noexcept {
        constexpr std::size_t ahead = 16;  // about the line-fill buffers of a core; 8 and 32 are no better
        const std::size_t count = ids.size();
        for (std::size_t k = 0; k < (std::min)(ahead, count); ++k) this->map().prefetch(ids[k]);
        for (std::size_t k = 0; k < count; ++k) {
            if (k + ahead < count) this->map().prefetch(ids[k + ahead]);
            out[k] = find(ids[k]);
        }
    }
};
static_assert(tsubu::batched_lookup<absl_prefetched<std::int64_t>>);

}  // namespace bench
