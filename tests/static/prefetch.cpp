// SPDX-License-Identifier: MIT
// One function for each storage, whose code must hold a prefetch: read as assembly by prefetch.cmake.
#include <tsubu/tsubu.hpp>

#include <cstdint>

#define PREFETCHES(name, ...)                                                                                      \
    extern "C" tsubu::index_t name(const tsubu::id_map<__VA_ARGS__>& map, std::int64_t next, std::int64_t now) { \
        map.prefetch(next);                                                                                        \
        return map.find(now);                                                                                      \
    }
PREFETCHES(in_adaptive, tsubu::adaptive_storage<>)
PREFETCHES(in_dense, tsubu::dense_storage<>)
PREFETCHES(in_flat, tsubu::flat_storage<>)
PREFETCHES(in_bitmap, tsubu::bitmap_storage<>)
PREFETCHES(in_paged, tsubu::paged_storage<>)
PREFETCHES(in_chained, tsubu::chained_storage<tsubu::mixed>)
