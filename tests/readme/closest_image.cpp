// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

int main() {
    // A periodic box of length 1: particles 1 and 2 are owned, their images across the border are ghosts.
    const std::vector<std::int64_t> ids = {1, 2, 1, 2};
    const std::vector<double> x = {0.1, 0.9, 1.1, -0.1};
    tsubu::id_map<> where;
    tsubu::same_id_links same;
    where.rebuild(ids, same);
    const auto from_particle_2 = [&](tsubu::index_t k) { return std::abs(x[static_cast<std::size_t>(k)] - x[1]); };
    const auto nearest = tsubu::closest_image(same, where.find(1), from_particle_2);
    return where.find(1) == 0 && nearest == 2 && tsubu::owned_duplicates(same, 2).empty() ? 0 : 1;
}
