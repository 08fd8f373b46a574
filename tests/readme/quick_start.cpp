// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
    const std::vector<std::int64_t> ids = {40, 7, 901417, 7};  // three owned particles, then a ghost of 7
    tsubu::id_map<> where;                                     // picks its table by the ids it is given
    tsubu::same_id_links same;                                 // from each copy of an id to the next
    where.rebuild(ids, same);
    for (const auto k : same.images(where.find(7))) std::printf("a copy of 7 at index %d\n", k);
    std::puts(where.storage().explain().c_str());
    return where.find(901417) == 2 && where.find(-1) == tsubu::absent ? 0 : 1;
}
