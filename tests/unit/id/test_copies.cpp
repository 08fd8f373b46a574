// SPDX-License-Identifier: MIT
#include <tsubu/id/copies.hpp>

#include "support/catch.hpp"

#include <tsubu/id/id_map.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using tsubu::absent;
using tsubu::index_t;

struct chain {
    explicit chain(const std::vector<std::int64_t>& ids) { where.rebuild(ids, same); }
    tsubu::id_map<> where;
    tsubu::same_id_links same;
};

index_t closest(const chain& copies, std::int64_t id, const std::vector<double>& distances) {
    return tsubu::closest_image(copies.same, copies.where.find(id),
                                [&](index_t k) { return distances[static_cast<std::size_t>(k)]; });
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the nearest copy may be a ghost behind an owned one", "[id][A1][T1]") {
    // One periodic axis of length 1; ghosts beyond both faces.
    const chain copies({1, 2, 1, 2});
    const std::vector<double> x{0.1, 0.9, 1.1, -0.1};
    CHECK(copies.where.find(1) == 0);
    CHECK(copies.where.find(2) == 1);
    CHECK(std::vector<index_t>(copies.same.links().begin(), copies.same.links().end()) ==
          std::vector<index_t>{2, 3, absent, absent});
    const auto nearest = tsubu::closest_image(copies.same, copies.where.find(1), [&](index_t k) {
        return std::abs(x[1] - x[static_cast<std::size_t>(k)]);
    });
    CHECK(nearest == 2);
}

TEST_CASE("ties go to the lowest index", "[id][A1]") {
    const chain copies({7, 5, 5, 7, 5, 5});
    CHECK(closest(copies, 5, {0, 2, 1, 0, 1, 1}) == 2);
    CHECK(closest(copies, 5, {0, 1, 1, 0, 1, 1}) == 1);
    CHECK(closest(copies, 5, {0, 0.0, -0.0, 0, 1, 1}) == 1);
    CHECK(closest(copies, 5, {0, infinity, infinity, 0, infinity, infinity}) == 1);
}

TEST_CASE("a distance that is no number is never nearer", "[id][A1]") {
    const chain copies({5, 5, 5});
    CHECK(closest(copies, 5, {unknown, 2, 1}) == 2);
    CHECK(closest(copies, 5, {unknown, unknown, 9}) == 2);
    CHECK(closest(copies, 5, {3, unknown, 1}) == 2);
    CHECK(closest(copies, 5, {3, unknown, unknown}) == 0);
    CHECK(closest(copies, 5, {unknown, infinity, unknown}) == 1);
    CHECK(closest(copies, 5, {unknown, unknown, unknown}) == 0);
}

TEST_CASE("the nearest copy of what is not here is absent, and no distance is asked for", "[id][A1]") {
    const chain copies({5, 6});
    const auto nearest = tsubu::closest_image(copies.same, copies.where.find(8), [](index_t) -> double {
        FAIL("asked for a distance");
        return 0;
    });
    CHECK(nearest == absent);
}

TEST_CASE("distances may be integers", "[id][A1]") {
    const chain copies({5, 5});
    CHECK(tsubu::closest_image(copies.same, copies.where.find(5), [](index_t k) { return 4 - k; }) == 1);
}

TEST_CASE("owned duplicates are reported with both indices", "[id][A13][T5]") {
    using tsubu::duplicate;
    const auto found = [](const std::vector<std::int64_t>& ids, std::size_t owned_count) {
        return tsubu::owned_duplicates(chain(ids).same, owned_count);
    };
    CHECK(found({4, 9, 4}, 3) == std::vector<duplicate>{{0, 2}});
    CHECK(found({4, 9, 4}, 2).empty());
    CHECK(found({1, 1, 3}, 3) == std::vector<duplicate>{{0, 1}});
    CHECK(found({5, 5, 5, 5}, 4) == std::vector<duplicate>{{0, 1}, {1, 2}, {2, 3}});
    CHECK(found({5, 5, 5, 5}, 2) == std::vector<duplicate>{{0, 1}});
    CHECK(found({5, 6, 5, 6, 7}, 4) == std::vector<duplicate>{{0, 2}, {1, 3}});
    CHECK(found({5, 5}, 0).empty());
    CHECK(found({}, 0).empty());
    CHECK(found({5, 5}, 99) == std::vector<duplicate>{{0, 1}});
}
