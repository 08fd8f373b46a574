// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <vector>

int main() {
    const tsubu::domain<3> box{{0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, false}}};
    const tsubu::brick_decomposition<3> bricks(box, 12);  // on the process grid of least surface
    const auto [y, shift] = box.wrap({1.25, -0.5, 0.5});  // (.25, .5, .5), and (1, -1, 0) periods
    const auto mine = bricks.subdomain(bricks.owner(y));
    std::vector<tsubu::vec<3>> positions = {{0.26, 0.51, 0.51}, y, {1, 1, 1}, {0.9, 0.1, 0.1}};
    std::vector<tsubu::index_t> left(positions.size());
    const auto leavers = mine.leavers(positions, left);            // left[0 .. leavers) are not mine
    const auto around = bricks.neighbors(bricks.owner(y), 0.1);    // ranks near, each with the shift of its image
    const auto d = box.minimum_image({0.95, 0, 0}, {0.05, 0, 0});  // -0.1 along x: across the face
    return mine.owns(y) && leavers == 2 && left[0] == 2 && !around.empty() && d[0] < 0 ? 0 : 1;
}
