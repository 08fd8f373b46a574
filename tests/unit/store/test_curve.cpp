// SPDX-License-Identifier: MIT
#include <tsubu/store/curve.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

namespace {

template <std::size_t D>
using cell = std::array<std::uint32_t, D>;

/// All cells of a grid, in the order of their keys; empty if two keys are the same or one is too large.
template <std::size_t D, class Curve>
std::vector<cell<D>> walk(const Curve& curve, unsigned bits) {
    const std::uint64_t cells = std::uint64_t{1} << (D * bits);
    std::vector<cell<D>> at(cells);
    std::vector<bool> seen(cells);
    for (std::uint64_t number = 0; number < cells; ++number) {
        cell<D> one{};
        for (std::size_t k = 0; k < D; ++k)
            one[k] = static_cast<std::uint32_t>(number >> (k * bits) & ((std::uint64_t{1} << bits) - 1));
        const auto key = curve.template key<D>(one, bits);
        if (key >= cells || seen[key]) return {};
        seen[key] = true;
        at[key] = one;
    }
    return at;
}
/// Successive cells that have no face in common.
template <std::size_t D>
std::size_t jumps(const std::vector<cell<D>>& way) {
    std::size_t sum = 0;
    for (std::size_t n = 1; n < way.size(); ++n) {
        std::uint32_t steps = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const auto a = way[n][k];
            const auto b = way[n - 1][k];
            steps += a > b ? a - b : b - a;
        }
        sum += steps == 1 ? 0U : 1U;
    }
    return sum;
}

template <std::size_t D>
std::vector<tsubu::vec<D>> random_points(std::size_t count) {
    tsubu::random_stream random(11);
    std::vector<tsubu::vec<D>> points(count);
    for (auto& point : points)
        for (auto& x : point) x = random.unit();
    return points;
}
template <std::size_t D>
double mean_step(const std::vector<tsubu::vec<D>>& points, const std::vector<tsubu::index_t>& order) {
    double sum = 0;
    for (std::size_t n = 1; n < order.size(); ++n) {
        double squared = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const auto step =
                points[static_cast<std::size_t>(order[n])][k] - points[static_cast<std::size_t>(order[n - 1])][k];
            squared += step * step;
        }
        sum += std::sqrt(squared);
    }
    return sum / static_cast<double>(order.size() - 1);
}
/// By how much shorter the steps from one particle to the next become.
template <std::size_t D, class Curve>
double gain(std::size_t count) {
    const auto points = random_points<D>(count);
    tsubu::vec<D> one{};
    one.fill(1);
    std::vector<tsubu::index_t> unsorted(count);
    for (std::size_t i = 0; i < count; ++i) unsorted[i] = static_cast<tsubu::index_t>(i);
    return mean_step(points, unsorted) /
           mean_step(points, tsubu::order_along(Curve{}, tsubu::domain<D>({}, one), points));
}

}  // namespace

TEMPLATE_TEST_CASE("keys are places on the curve: each once", "[store]", tsubu::hilbert_curve, tsubu::morton_curve) {
    STATIC_REQUIRE(tsubu::space_curve<TestType>);
    CHECK(walk<1>(TestType{}, 6).size() == 64);
    for (const unsigned bits : {1U, 2U, 5U}) CHECK(walk<2>(TestType{}, bits).size() == std::size_t{1} << 2 * bits);
    for (const unsigned bits : {1U, 2U, 4U}) CHECK(walk<3>(TestType{}, bits).size() == std::size_t{1} << 3 * bits);
    // With all bits that order_along uses, at the ends.
    constexpr auto last = (std::uint32_t{1} << 21) - 1;
    CHECK(TestType{}.template key<3>({0, 0, 0}, 21) == 0);
    CHECK(TestType{}.template key<3>({last, last, last}, 21) < std::uint64_t{1} << 63);
    CHECK(TestType{}.template key<1>({0xFFFFFFFF}, 32) == 0xFFFFFFFF);
}

TEST_CASE("on the Hilbert curve each cell is beside the one before it", "[store]") {
    CHECK(jumps(walk<1>(tsubu::hilbert_curve{}, 6)) == 0);
    for (const unsigned bits : {1U, 2U, 3U, 6U}) CHECK(jumps(walk<2>(tsubu::hilbert_curve{}, bits)) == 0);
    for (const unsigned bits : {1U, 2U, 3U, 5U}) CHECK(jumps(walk<3>(tsubu::hilbert_curve{}, bits)) == 0);
    CHECK(jumps(walk<2>(tsubu::morton_curve{}, 3)) > 0);
}

TEST_CASE("the Morton curve takes the bits in turn", "[store]") {
    STATIC_REQUIRE(tsubu::morton_curve{}.key<2>({0b01, 0b11}, 2) == 0b0111);
    STATIC_REQUIRE(tsubu::morton_curve{}.key<3>({1, 0, 1}, 1) == 0b101);
}

TEST_CASE("along a curve, neighbours in memory are neighbours in space", "[store]") {
    // Of 4096 points, a step of the Hilbert curve is about 1/64 in two dimensions and 1/16 in three.
    CHECK(gain<2, tsubu::hilbert_curve>(4096) > 25);
    CHECK(gain<3, tsubu::hilbert_curve>(4096) > 8);
    CHECK(gain<2, tsubu::morton_curve>(4096) > 15);
    CHECK(gain<3, tsubu::morton_curve>(4096) > 6);
}

TEST_CASE("the order of points in one dimension is that of their coordinates", "[store]") {
    const auto points = random_points<1>(1000);
    const auto order = tsubu::order_along(tsubu::hilbert_curve{}, tsubu::domain<1>({0}, {1}), points);
    CHECK(std::is_sorted(order.begin(), order.end(), [&](auto i, auto j) {
        return points[static_cast<std::size_t>(i)] < points[static_cast<std::size_t>(j)];
    }));
}

TEMPLATE_TEST_CASE("points outside, at the same place, and no numbers have an order too", "[store]", double, float) {
    using real = TestType;
    constexpr auto inf = std::numeric_limits<real>::infinity();
    constexpr auto nan = std::numeric_limits<real>::quiet_NaN();
    const tsubu::domain<1, real> line({0}, {1});
    const std::vector<tsubu::vec<1, real>> points{{2},   {real(0.5)}, {inf}, {real(0.5)}, {-inf},
                                                  {nan}, {-1},        {1},   {real(0.75)}};
    const std::vector<tsubu::index_t> expected{4, 5, 6, 1, 3, 8, 0, 2, 7};
    CHECK(tsubu::order_along(tsubu::hilbert_curve{}, line, points) == expected);
    CHECK(tsubu::order_along(tsubu::morton_curve{}, line, points) == expected);
    CHECK(tsubu::order_along(tsubu::morton_curve{}, line, std::vector<tsubu::vec<1, real>>{}).empty());
}

namespace {

/// Points on the faces, beyond them, without end and without a number, in all combinations of some coordinates.
template <std::size_t D, class Scalar>
std::vector<tsubu::vec<D, Scalar>> awkward_points() {
    constexpr auto inf = std::numeric_limits<Scalar>::infinity();
    const std::array<Scalar, 10> values{std::numeric_limits<Scalar>::quiet_NaN(), -inf, inf,
                                        (std::numeric_limits<Scalar>::max)(), std::numeric_limits<Scalar>::lowest(),
                                        std::numeric_limits<Scalar>::denorm_min(), Scalar(-0.0), Scalar(1), Scalar(0.3),
                                        Scalar(0.7)};
    std::size_t count = 1;
    for (std::size_t k = 0; k < D; ++k) count *= values.size();
    std::vector<tsubu::vec<D, Scalar>> points(count);
    for (std::size_t n = 0; n < count; ++n)
        for (std::size_t k = 0, digits = n; k < D; ++k, digits /= values.size())
            points[n][k] = values[digits % values.size()];
    return points;
}
/// What the documentation says of them: at the nearest face; no number is the first cell.
template <std::size_t D, class Scalar>
tsubu::vec<D, Scalar> at_nearest_face(tsubu::vec<D, Scalar> point) {
    for (auto& x : point) x = x > 0 ? (std::min)(x, Scalar(1)) : Scalar(0);
    return point;
}
template <std::size_t D, class Scalar, class Curve>
void check_awkward() {
    auto points = awkward_points<D, Scalar>();
    tsubu::vec<D, Scalar> one{};
    one.fill(1);
    const tsubu::domain<D, Scalar> box({}, one);
    const auto order = tsubu::order_along(Curve{}, box, points);
    auto sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) REQUIRE(sorted[i] == static_cast<tsubu::index_t>(i));
    for (auto& point : points) point = at_nearest_face<D, Scalar>(point);
    CHECK(order == tsubu::order_along(Curve{}, box, points));
}

}  // namespace

TEMPLATE_TEST_CASE("points without a place count as at the nearest face, in each dimension", "[store]", double, float) {
    check_awkward<1, TestType, tsubu::hilbert_curve>();
    check_awkward<2, TestType, tsubu::hilbert_curve>();
    check_awkward<3, TestType, tsubu::hilbert_curve>();
    check_awkward<1, TestType, tsubu::morton_curve>();
    check_awkward<2, TestType, tsubu::morton_curve>();
    check_awkward<3, TestType, tsubu::morton_curve>();
    // In a sheared box infinite coordinates may have no fraction; each point has one place all the same.
    const tsubu::triclinic_box<3> sheared({-5, 100, 7}, {4, 2, 0.5}, {1, 0.5, 0.25}, {true, true, true});
    auto order = tsubu::order_along(tsubu::hilbert_curve{}, sheared, awkward_points<3, double>());
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i) REQUIRE(order[i] == static_cast<tsubu::index_t>(i));
}

TEST_CASE("the order is that of the places in the box, moved, stretched or sheared", "[store]") {
    const auto fractions = random_points<3>(500);
    const auto order = tsubu::order_along(tsubu::hilbert_curve{}, tsubu::domain<3>({0, 0, 0}, {1, 1, 1}), fractions);
    const tsubu::domain<3> far({-5, 100, 7}, {-1, 102, 7.5});
    const tsubu::triclinic_box<3> sheared({-5, 100, 7}, {4, 2, 0.5}, {1, 0.5, 0.25}, {true, true, true});
    std::vector<tsubu::vec<3>> moved(fractions.size());
    std::vector<tsubu::vec<3>> slanted(fractions.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const auto [a, b, c] = fractions[i];
        moved[i] = {-5 + 4 * a, 100 + 2 * b, 7 + 0.5 * c};
        slanted[i] = {moved[i][0] + b + 0.5 * c, moved[i][1] + 0.25 * c, moved[i][2]};
    }
    // Rounding may exchange points whose cells of 2^-21 are neighbours; of these 500 it does not.
    CHECK(tsubu::order_along(tsubu::hilbert_curve{}, far, moved) == order);
    CHECK(tsubu::order_along(tsubu::hilbert_curve{}, sheared, slanted) == order);
}

TEST_CASE("a store is brought into the order of the curve", "[store]") {
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>>, tsubu::aosoa<16>> g;
    const auto points = random_points<3>(1000);
    for (const auto& point : points)
        g.push_back(tsubu::id = static_cast<std::int64_t>(g.size()), tsubu::position<3> = point);
    const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1});
    const auto order = tsubu::order_along(tsubu::hilbert_curve{}, box, g.owned()[tsubu::position<3>]);
    CHECK(order == tsubu::order_along(tsubu::hilbert_curve{}, box, points));
    g.permute(order);
    for (std::size_t i = 0; i < 1000; ++i) CHECK(g[tsubu::id][i] == order[i]);
    const auto again = tsubu::order_along(tsubu::hilbert_curve{}, box, g.owned()[tsubu::position<3>]);
    CHECK(std::is_sorted(again.begin(), again.end()));
}

namespace {

constexpr tsubu::field<"contacts", tsubu::list_of<std::int64_t>> contacts{};
constexpr tsubu::field<"charge", tsubu::bonus_of<double>> charge{};

template <std::size_t D, class Layout, class Curve>
void check_all_of_each_moves() {
    constexpr auto x = tsubu::position<D>;
    tsubu::particle_store<tsubu::fields<tsubu::id, x, contacts, charge>, Layout> g;
    auto points = random_points<D>(500);
    points[7].fill(std::numeric_limits<double>::quiet_NaN());
    points[8].fill(-std::numeric_limits<double>::infinity());
    points[9].fill(3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        g.push_back(tsubu::id = static_cast<std::int64_t>(i), x = points[i]);
        for (std::size_t n = 0; n < i % 4; ++n) g[contacts][i].push_back(static_cast<std::int64_t>(i));
        if (i % 5 == 0) g[charge][i].emplace(static_cast<double>(i));
    }
    tsubu::vec<D> one{};
    one.fill(1);
    const tsubu::domain<D> box({}, one);
    g.permute(tsubu::order_along(Curve{}, box, g.owned()[x]));
    std::vector<bool> seen(points.size());
    bool is_whole = true;
    for (const auto grain : g.owned()) {
        const auto t = static_cast<std::size_t>(grain[tsubu::id]);
        is_whole = is_whole && !seen[t] && (t == 7 || grain[x] == points[t]) && grain[contacts].size() == t % 4 &&
                   grain[charge].has_value() == (t % 5 == 0) &&
                   (t % 5 != 0 || *grain[charge] == static_cast<double>(t));
        for (const auto partner : grain[contacts]) is_whole = is_whole && partner == grain[tsubu::id];
        seen[t] = true;
    }
    CHECK(is_whole);
    const auto again = tsubu::order_along(Curve{}, box, g.owned()[x]);
    CHECK(std::is_sorted(again.begin(), again.end()));
}

}  // namespace

TEMPLATE_TEST_CASE("along the curve lists and values go with their particles", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<16>) {
    check_all_of_each_moves<1, TestType, tsubu::hilbert_curve>();
    check_all_of_each_moves<2, TestType, tsubu::hilbert_curve>();
    check_all_of_each_moves<3, TestType, tsubu::hilbert_curve>();
    check_all_of_each_moves<3, TestType, tsubu::morton_curve>();
}
