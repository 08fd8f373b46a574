// SPDX-License-Identifier: MIT
/// @file
/// What a user's program does first; built by both consumers.
#include <tsubu/tsubu.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

int main() {
    const std::vector<std::int64_t> ids{901'417, 7, 42, 7};
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    where.rebuild(ids, same);
    const bool good = where.find(42) == 2 && where.find(7) == 1 && same.next(1) == 3 && where.find(5) == tsubu::absent;
    std::puts(good ? "found" : "wrong");
    return good ? 0 : 1;
}
