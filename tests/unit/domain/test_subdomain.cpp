// SPDX-License-Identifier: MIT
#include <tsubu/domain/subdomain.hpp>

#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using tsubu::brick_decomposition;
using tsubu::domain;
using tsubu::index_t;
using tsubu::lattice;
using tsubu::vec;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

tsubu::subdomain<3> unit_cube() { return brick_decomposition<3>({{0, 0, 0}, {1, 1, 1}}, 1).subdomain(0); }

template <std::size_t D, class Scalar>
domain<D, Scalar> some_box() {
    typename domain<D, Scalar>::real_position_type lo{};
    typename domain<D, Scalar>::real_position_type hi{};
    typename domain<D, Scalar>::options with{};
    hi.fill(1);
    with.periodic.fill(tsubu::is_lattice<Scalar>);
    return {lo, hi, with};
}

/// Inside, outside, on faces, beside them, and not finite.
template <std::size_t D, class Scalar>
std::vector<vec<D, Scalar>> mixed_points(const tsubu::subdomain<D, Scalar>& mine, std::size_t count,
                                         std::uint64_t seed) {
    tsubu::random_stream random(seed);
    std::vector<vec<D, Scalar>> points(count);
    for (auto& x : points)
        for (std::size_t k = 0; k < D; ++k) {
            if constexpr (tsubu::is_lattice<Scalar>) {
                x[k] = {static_cast<decltype(x[k].value)>(random())};
                static_cast<void>(mine);
            } else {
                using limits = std::numeric_limits<Scalar>;
                const Scalar faces[] = {mine.lo()[k], mine.hi()[k], Scalar{0}, Scalar{1}};
                const Scalar bad[] = {limits::quiet_NaN(), limits::infinity(),   -limits::infinity(), (limits::max)(),
                                      limits::lowest(),    limits::denorm_min(), -Scalar{0}};
                const auto kind = random.below(16);
                const auto face = faces[random.below(4)];
                x[k] = kind == 0   ? face
                       : kind == 1 ? std::nextafter(face, limits::lowest())
                       : kind == 2 ? std::nextafter(face, (limits::max)())
                       : kind == 3 ? bad[random.below(7)]
                                   : static_cast<Scalar>(random.unit() * 1.5 - 0.25);
            }
        }
    return points;
}

template <std::size_t D, class Scalar>
void batched_is_single() {
    const brick_decomposition<D, Scalar> bricks(some_box<D, Scalar>(), 3);
    for (std::size_t rank = 0; rank < 3; ++rank) {
        const auto mine = bricks.subdomain(rank);
        for (const std::size_t count : {0U, 1U, 7U, 63U, 64U, 65U, 128U, 1000U, 1024U, 1025U, 2100U}) {
            const auto rows = mixed_points(mine, count, count + rank);
            std::array<std::vector<Scalar>, D> storage;
            typename tsubu::points<D, const Scalar>::columns columns{};
            for (std::size_t k = 0; k < D; ++k) {
                for (const auto& x : rows) storage[k].push_back(x[k]);
                columns[k] = storage[k];
            }
            std::vector<unsigned char> owned(count);
            std::vector<unsigned char> extended(count);
            std::vector<index_t> leavers;
            for (std::size_t i = 0; i < count; ++i) {
                owned[i] = mine.owns(rows[i]);
                extended[i] = mine.owns_extended(rows[i]);
                if (owned[i] == 0) leavers.push_back(static_cast<index_t>(i));
            }
            each_instruction_set{}.run([&] {
                CAPTURE(D, rank, count, tsubu::name_of(tsubu::best_instruction_set()));
                std::vector<unsigned char> mask(count, 7);
                mine.owns(columns, mask);
                CHECK(mask == owned);
                mask.assign(count, 7);
                mine.owns(rows, mask);
                CHECK(mask == owned);
                mask.assign(count, 7);
                mine.owns_extended(columns, mask);
                CHECK(mask == extended);
                mask.assign(count, 7);
                mine.owns_extended(rows, mask);
                CHECK(mask == extended);
                std::vector<index_t> left(count, -5);
                left.resize(mine.leavers(columns, left));
                CHECK(left == leavers);
                left.assign(count, -5);
                left.resize(mine.leavers(rows, left));
                CHECK(left == leavers);
            });
        }
    }
}

}  // namespace

TEMPLATE_TEST_CASE("many points at once are as each alone, for every instruction set", "[domain][B3][B4][batch]",
                   double, float, lattice<std::int32_t>, lattice<std::int64_t>) {
    batched_is_single<1, TestType>();
    batched_is_single<2, TestType>();
    batched_is_single<3, TestType>();
}

TEST_CASE("what is not a number leaves, and is not lost", "[domain][B3][batch][F4]") {
    const auto mine = unit_cube();
    const std::vector<vec<3>> x = {{0.5, 0.5, 0.5},
                                   {not_a_number, 0.5, 0.5},
                                   {0.5, infinity, 0.5},
                                   {0.5, 0.5, -infinity}};
    std::vector<index_t> left(x.size());
    REQUIRE(mine.leavers(x, left) == 3);
    CHECK((left[0] == 1 && left[1] == 2 && left[2] == 3));
    for (std::size_t i = 1; i < x.size(); ++i) CHECK_FALSE((mine.owns(x[i]) || mine.owns_extended(x[i])));
}

TEST_CASE("spans of different length are refused", "[domain][batch][input]") {
    const auto mine = unit_cube();
    const std::vector<vec<3>> x(4);
    std::vector<unsigned char> mask(3);
    const auto text = thrown<tsubu::input_error>([&] { mine.owns(x, mask); });
    INFO(text);
    CHECK(says(text, "tsubu::subdomain::owns: 3 answers for 4 points; give spans of equal length"));
    CHECK(says(thrown<tsubu::input_error>([&] { mine.owns_extended(x, mask); }), "subdomain::owns_extended"));
    CHECK(
        says(thrown<tsubu::input_error>([&] { mine.clear_of_borders(x, 0.1, mask); }), "subdomain::clear_of_borders"));
    std::vector<index_t> left(5);
    CHECK(says(thrown<tsubu::input_error>([&] { mine.leavers(x, left); }), "subdomain::leavers: 5 answers for 4"));
    std::vector<double> distances(3);
    CHECK(says(thrown<tsubu::input_error>([&] { mine.face_distance(x, distances); }), "subdomain::face_distance"));
}

TEST_CASE("borders and distances of many points are those of each", "[domain][batch][B6]") {
    const auto mine = brick_decomposition<3>({{0, 0, 0}, {1, 1, 1}}, 3).subdomain(1);
    const auto rows = mixed_points<3, double>(mine, 1000, 3);
    std::vector<unsigned char> mask(rows.size());
    std::vector<double> distances(rows.size());
    each_instruction_set{}.run([&] {
        mine.clear_of_borders(rows, 0.1, mask);
        mine.face_distance(rows, distances);
        std::size_t different = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            different += (mask[i] != 0) != mine.clear_of_borders(rows[i], 0.1) ? 1U : 0U;
            const auto one = mine.face_distance(rows[i]);
            different += distances[i] != one && !(std::isnan(distances[i]) && std::isnan(one)) ? 1U : 0U;
        }
        CHECK(different == 0);
    });
}

TEST_CASE("clear of borders: far enough from both faces, inside", "[domain][B6][F3]") {
    const auto mine = unit_cube();
    CHECK(mine.clear_of_borders({0.5, 0.5, 0.5}, 0.25));
    CHECK_FALSE(mine.clear_of_borders({100, 100, 100}, 0.25));  // far from the faces, but outside
    CHECK_FALSE(mine.clear_of_borders({-100, 0.5, 0.5}, 0));
    CHECK(mine.clear_of_borders({0.25, 0.75, 0.5}, 0.25));  // exactly touching
    CHECK_FALSE(mine.clear_of_borders({std::nextafter(0.25, 0), 0.5, 0.5}, 0.25));
    CHECK_FALSE(mine.clear_of_borders({0.5, 0.5, std::nextafter(0.75, 1)}, 0.25));
    CHECK(mine.clear_of_borders({0.5, 0.5, 0.5}, 0.5));
    CHECK_FALSE(mine.clear_of_borders({0.5, 0.5, 0.5}, std::nextafter(0.5, 1)));  // wider than half: nothing is
    CHECK(mine.clear_of_borders({0.5, 0.5, 0.1}, vec<3>{0.5, 0.2, 0}));
    CHECK_FALSE(mine.clear_of_borders({0.5, not_a_number, 0.5}, 0));
    CHECK_FALSE(mine.clear_of_borders({0.5, 0.5, 0.5}, infinity));
    for (const double bad : {-1.0, -1e-300, not_a_number}) {
        const auto text = thrown<tsubu::input_error>([&] {
            static_cast<void>(mine.clear_of_borders({0.5, 0.5, 0.5}, vec<3>{0, bad, 0}));
        });
        INFO(text);
        CHECK(says(text, "tsubu::subdomain::clear_of_borders: the distance " + tsubu::detail::shown(bad) +
                             " on axis 1; give"));
    }
}

TEST_CASE("a margin above half the width leaves nothing, in a batch too", "[domain][B6][batch][F3]") {
    const auto mine = brick_decomposition<1>({{0}, {1}}, 2).subdomain(0);
    const std::vector<double> x(70, 0.45);
    std::vector<unsigned char> mask(x.size());
    each_instruction_set{}.run([&] {
        mask.assign(x.size(), 7);
        mine.clear_of_borders({{x}}, 0.4, mask);
        CHECK(std::count(mask.begin(), mask.end(), 0) == 70);
    });
}

TEST_CASE("face distance: to the nearest plane, from either side", "[domain][B6][F3]") {
    const auto mine = unit_cube();
    CHECK(mine.face_distance({100, 100, 100}) == 99);
    CHECK(mine.face_distance({0.5, 0.25, 0.5}) == 0.25);
    CHECK(mine.face_distance({0.5, 0.5, 1}) == 0);
    CHECK(mine.face_distance({-0.125, 0.5, 0.5}) == 0.125);
    CHECK(brick_decomposition<1>({{0}, {1}}, 4).subdomain(1).face_distance({0.3}) == Approx(0.05));
}

TEST_CASE("the shortest edge of a subdomain, of equal ones the first", "[domain][B7][B8]") {
    const brick_decomposition<3> bricks({{0, 0, 0}, {1, 1, 2}}, std::array<std::size_t, 3>{1, 2, 4});
    CHECK(bricks.subdomain(3).min_extent().axis == 1);
    CHECK(bricks.subdomain(3).min_extent().width == 0.5);
    CHECK(unit_cube().min_extent().axis == 0);
}
