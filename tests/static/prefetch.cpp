// SPDX-License-Identifier: MIT
// A function whose code must hold prefetches of STORAGE: read as assembly by prefetch.cmake.
#include <tsubu/tsubu.hpp>

#include <cstdint>

extern "C" tsubu::index_t look_up(const tsubu::id_map<STORAGE>& map, std::int64_t next, std::int64_t now) {
    map.prefetch(next);
    return map.find(now);
}
