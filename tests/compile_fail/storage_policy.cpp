// SPDX-License-Identifier: MIT
#include <tsubu/id/id_map.hpp>
#include <tsubu/testing/archetypes.hpp>

#include <cstdint>
#include <span>

namespace {

/// The archetype, spoilt in one place.
struct policy : tsubu::testing::minimal_id_storage<std::int64_t> {
#if !defined(CASE)
#elif CASE == 1
    bool erase(std::int64_t) noexcept = delete;
#elif CASE == 2
    tsubu::index_t find(std::int64_t) const { return tsubu::absent; }
#elif CASE == 3
    void rebuild(std::span<const std::int64_t>, tsubu::id_range<std::int64_t>) {}
#elif CASE == 4
    policy() = default;
    policy(const policy&) = delete;
    policy& operator=(const policy&) = delete;
#endif
};

}  // namespace

bool built() {
    tsubu::id_map<policy> where;
    return where.size() == 0;
}
