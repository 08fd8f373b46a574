// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <span>
#include <vector>

int main() {
    const tsubu::domain<3> box{{-1, 0, 0}, {1, 2, 5}, {.periodic = {true, true, false}}};  // lower, upper corner
    const tsubu::brick_decomposition bricks(box, 12);                                      // ranks
    const auto mine = bricks.subdomain(7);
    std::vector<double> x = {-0.9, 0.2, 7.5}, y = {1.5, -0.1, 1}, z = {4, 1, 0.3};
    std::vector<tsubu::image_shift<3>> images(x.size());  // counts the periods, as image flags do

    // Each step: wrap, find who left, find to whom.
    box.wrap({{x, y, z}}, images);
    std::vector<tsubu::index_t> left(x.size());
    left.resize(mine.leavers({{x, y, z}}, left));
    for (const auto k : left) {
        const auto i = static_cast<std::size_t>(k);
        const auto rank = bricks.owner({x[i], y[i], z[i]});  // 7 itself: it left through a face that is not periodic
        if (rank >= bricks.ranks()) return 1;
    }
    // Ghosts: what lies near a neighbour's subdomain, moved by shift, goes there; there it is moved by -shift.
    for (const auto& [rank, shift] : bricks.neighbors(7, 0.1))
        if (rank == 7 && shift == tsubu::image_shift<3>{}) return 1;
    const auto ghost = box.image({0.5, 1, 1}, {-1, 0, 0});        // {-1.5, 1, 1}
    const auto d = box.minimum_image({0.9, 0, 1}, {-0.9, 0, 1});  // from the second to the first: -0.2 along x
    return images[2][0] == 4 && ghost[0] == -1.5 && d[0] < 0 ? 0 : 1;
}
