// SPDX-License-Identifier: MIT
#include <tsubu/domain/ghost.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/id/id_map.hpp>

#include <cstdint>
#include <span>
#include <vector>

using tsubu::image_shift;
using tsubu::index_t;

TEST_CASE("a periodic ghost has a shift, whatever its position", "[domain][B9]") {
    CHECK_FALSE(tsubu::is_periodic_ghost<3>({0, 0, 0}));
    CHECK(tsubu::is_periodic_ghost<3>({0, 0, -1}));
    CHECK(tsubu::is_periodic_ghost<1>({7}));
    const std::vector<image_shift<2>> shifts = {{0, 0}, {1, 0}, {0, -3}, {1, -1}};
    std::vector<unsigned char> mask(4, 7);
    tsubu::is_periodic_ghost<2>(shifts, mask);
    CHECK(mask == std::vector<unsigned char>{0, 1, 1, 1});
    mask.resize(3);
    CHECK(says(thrown<tsubu::input_error>([&] { tsubu::is_periodic_ghost<2>(shifts, mask); }),
               "tsubu::is_periodic_ghost: 3 answers for 4 points"));
}

TEST_CASE("the particle that the map finds stands for its id", "[domain][B10]") {
    const std::vector<std::int64_t> ids = {5, 9, 7, 9, 5, 11, 11, 9};  // 0 .. 2 owned
    tsubu::id_map<> where;
    where.rebuild(ids);
    const std::vector<unsigned char> expected = {1, 1, 1, 0, 0, 1, 0, 0};
    for (std::size_t i = 0; i < ids.size(); ++i)
        CHECK(tsubu::is_owned_or_first_ghost(where, ids, static_cast<index_t>(i)) == (expected[i] != 0));
    std::vector<unsigned char> mask(ids.size(), 7);
    tsubu::is_owned_or_first_ghost(where, ids, mask);
    CHECK(mask == expected);
    mask.resize(2);
    CHECK(says(thrown<tsubu::input_error>([&] { tsubu::is_owned_or_first_ghost(where, ids, mask); }),
               "tsubu::is_owned_or_first_ghost: 2 answers for 8 points"));
}

TEST_CASE("of many images of many ids one each stands for it", "[domain][B10]") {
    tsubu::random_stream random(3);
    std::vector<std::int64_t> ids(5000);
    for (auto& id : ids) id = static_cast<std::int64_t>(random.below(2000));
    tsubu::id_map<> where;
    where.rebuild(ids);
    std::vector<unsigned char> mask(ids.size());
    tsubu::is_owned_or_first_ghost(where, ids, mask);
    std::vector<int> standing(2000, 0);
    std::vector<int> present(2000, 0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        standing[static_cast<std::size_t>(ids[i])] += mask[i];
        present[static_cast<std::size_t>(ids[i])] = 1;
        CHECK((mask[i] != 0) == tsubu::is_owned_or_first_ghost(where, ids, static_cast<index_t>(i)));
    }
    CHECK(standing == present);
}
