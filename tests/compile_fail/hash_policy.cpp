// SPDX-License-Identifier: MIT
#include <tsubu/id/chained_storage.hpp>

#include <cstdint>

namespace {

struct policy {
    static std::uint64_t bucket(std::uint64_t id, std::uint64_t count)
#if !defined(CASE)
        noexcept
#endif
    {
        return id % count;
    }
};

}  // namespace

bool built() {
    const tsubu::chained_storage<policy> table;
    return table.size() == 0;
}
