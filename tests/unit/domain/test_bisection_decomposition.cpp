// SPDX-License-Identifier: MIT
#include <tsubu/domain/bisection_decomposition.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <tsubu/core/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

using tsubu::bisection_decomposition;
using tsubu::domain;
using tsubu::lattice;
using tsubu::vec;

namespace {

/// A heap: dense at the origin.
std::vector<vec<3>> heap(std::size_t count) {
    tsubu::random_stream random(31);
    std::vector<vec<3>> sample(count);
    for (auto& x : sample)
        for (auto& coordinate : x) {
            const double u = random.unit();
            coordinate = u * u * u;
        }
    return sample;
}
template <class Decomposition, class Sample>
std::vector<double> loads(const Decomposition& parts, const Sample& sample, const std::vector<double>& weights = {}) {
    std::vector<double> load(parts.ranks());
    for (std::size_t i = 0; i < sample.size(); ++i) load[parts.owner(sample[i])] += weights.empty() ? 1 : weights[i];
    return load;
}

const domain<3> cube{{0, 0, 0}, {1, 1, 1}};

}  // namespace

TEST_CASE("an uneven scene is balanced, for any number of ranks", "[domain][bisection]") {
    const auto sample = heap(6400);
    for (std::size_t ranks = 1; ranks <= 64; ++ranks) {
        const bisection_decomposition<3> parts(cube, ranks, sample);
        CHECK(parts.ranks() == ranks);
        const auto load = loads(parts, sample);
        const double mean = 6400.0 / static_cast<double>(ranks);
        CAPTURE(ranks);
        CHECK(*std::max_element(load.begin(), load.end()) <= mean + 8);  // half a sample for each of the 6 cuts above
        CHECK(*std::min_element(load.begin(), load.end()) >= mean - 8);
    }
}

TEST_CASE("a layer at the bottom of a tall box is cut across, not along", "[domain][bisection]") {
    const domain<3> tall{{0, 0, 0}, {1, 1, 50}};
    tsubu::random_stream random(4);
    std::vector<vec<3>> layer(4096);
    for (auto& x : layer) x = {random.unit(), random.unit(), 0.125};
    for (const std::size_t ranks : {2U, 7U, 16U}) {
        const bisection_decomposition<3> parts(tall, ranks, layer);
        const auto load = loads(parts, layer);
        CAPTURE(ranks);
        CHECK(*std::min_element(load.begin(), load.end()) >= 4096.0 / static_cast<double>(ranks) - 8);
        for (std::size_t rank = 0; rank < ranks; ++rank) {
            CHECK(parts.subdomain(rank).lo()[2] == 0);
            CHECK(parts.subdomain(rank).hi()[2] == 50);
        }
    }
}

TEST_CASE("a few stray particles do not decide where the rest is cut", "[domain][bisection]") {
    std::vector<vec<3>> layer;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) layer.push_back({i / 64.0, j / 64.0, 25});
    layer.push_back({0.5, 0.5, 1});
    layer.push_back({0.5, 0.5, 49});
    const domain<3> tall{{0, 0, 0}, {1, 1, 50}};
    for (const std::size_t ranks : {2U, 4U, 8U}) {
        const auto load = loads(bisection_decomposition<3>(tall, ranks, layer), layer);
        CAPTURE(ranks);
        CHECK(*std::max_element(load.begin(), load.end()) <= 1.1 * 4098 / static_cast<double>(ranks));
    }
}

TEST_CASE("huge weights are balanced as small ones", "[domain][bisection]") {
    const auto sample = heap(2000);
    const std::vector<double> weights(sample.size(), 1e306);
    const auto load = loads(bisection_decomposition<3>(cube, 4, sample, weights), sample);
    for (const auto n : load) CHECK(std::abs(n - 500) <= 8);
}

TEST_CASE("weights count, not points", "[domain][bisection]") {
    const auto sample = heap(4000);
    std::vector<double> weights(sample.size());
    for (std::size_t i = 0; i < sample.size(); ++i) weights[i] = sample[i][0] < 0.1 ? 0.25 : 2;
    const bisection_decomposition<3> parts(cube, 8, sample, weights);
    const auto load = loads(parts, sample, weights);
    const auto [least, most] = std::minmax_element(load.begin(), load.end());
    CHECK(*most <= *least * 1.05);
    const bisection_decomposition<3> nothing(cube, 8, sample, std::vector<double>(sample.size(), 0.0));
    CHECK(nothing.owner({0.1, 0.1, 0.1}) == bisection_decomposition<3>(cube, 8, {}).owner({0.1, 0.1, 0.1}));
}

TEST_CASE("without a sample the volume is halved", "[domain][bisection]") {
    const bisection_decomposition<3> parts({{0, 0, 0}, {4, 2, 1}}, 8, {});
    for (std::size_t rank = 0; rank < 8; ++rank)
        for (std::size_t k = 0; k < 3; ++k) CHECK(parts.subdomain(rank).hi()[k] - parts.subdomain(rank).lo()[k] == 1);
    const bisection_decomposition<1> three({{0}, {3}}, 3, {});
    CHECK(three.subdomain(0).hi()[0] == 1);
    CHECK(three.subdomain(1).hi()[0] == 2);
}

TEST_CASE("points outside the box, or not finite, count for nothing", "[domain][bisection]") {
    auto sample = heap(1000);
    const bisection_decomposition<3> clean(cube, 7, sample);
    for (const double bad :
         {-1.0, 2.0, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        for (std::size_t k = 0; k < 3; ++k) {
            vec<3> x{0.5, 0.5, 0.5};
            x[k] = bad;
            sample.push_back(x);
        }
    const bisection_decomposition<3> dirty(cube, 7, sample);
    for (std::size_t rank = 0; rank < 7; ++rank) {
        CHECK(clean.subdomain(rank).lo() == dirty.subdomain(rank).lo());
        CHECK(clean.subdomain(rank).hi() == dirty.subdomain(rank).hi());
    }
}

TEST_CASE("the order of the sample does not matter", "[domain][bisection][I12]") {
    auto sample = heap(1000);
    for (auto& x : sample) x[0] = std::round(x[0] * 16) / 16;  // many equal coordinates
    const bisection_decomposition<3> one(cube, 13, sample);
    std::reverse(sample.begin(), sample.end());
    const bisection_decomposition<3> other(cube, 13, sample);
    for (std::size_t rank = 0; rank < 13; ++rank) CHECK(one.subdomain(rank).lo() == other.subdomain(rank).lo());
}

TEST_CASE("all particles in one point, or beside a face, leave room for every rank", "[domain][bisection]") {
    for (const double x : {0.0, 0x1p-1074, 1e-300, 0.5, 1 - 0x1p-53, 1.0})
        for (const std::size_t ranks : {2U, 3U, 8U, 64U}) {
            CAPTURE(x, ranks);
            const std::vector<vec<1>> line(50, vec<1>{x});
            const bisection_decomposition<1> parts({{0}, {1}}, ranks, line);
            CHECK(parts.ranks() == ranks);
            for (std::size_t rank = 0; rank < ranks; ++rank) CHECK(parts.owner(parts.subdomain(rank).lo()) == rank);
            CHECK(bisection_decomposition<3>(cube, ranks, std::vector<vec<3>>(50, vec<3>{x, x, x})).ranks() == ranks);
        }
}

TEST_CASE("as many ranks as there are points, and no more", "[domain][bisection][input]") {
    constexpr double step = std::numeric_limits<double>::denorm_min();
    const domain<1> four{{0}, {4 * step}, {.periodic = {true}}};
    for (std::size_t ranks = 1; ranks <= 4; ++ranks)
        CHECK(bisection_decomposition<1>(four, ranks, {}).ranks() == ranks);
    const bisection_decomposition<1> full(four, 4, {});
    for (std::size_t rank = 0; rank < 4; ++rank) CHECK(full.owner({static_cast<double>(rank) * step}) == rank);
    const auto text = thrown<tsubu::input_error>([&] { bisection_decomposition<1>(four, 5, {}); });
    INFO(text);
    CHECK(says(text, "tsubu::bisection_decomposition: a part has so few points"));
    CHECK(says(text, "ask for fewer ranks"));
    const domain<1, lattice<std::int8_t>> small{{0}, {1}, {.periodic = {true}}};
    CHECK(bisection_decomposition<1, lattice<std::int8_t>>(small, 256, {}).ranks() == 256);
    CHECK_THROWS_AS((bisection_decomposition<1, lattice<std::int8_t>>(small, 257, {})), tsubu::input_error);
}

TEST_CASE("a sample of another box is refused", "[domain][bisection][input]") {
    const std::vector<vec<3>> elsewhere = {{5, 5, 5}, {7, 7, 7}};
    const auto text = thrown<tsubu::input_error>([&] { bisection_decomposition<3>(cube, 4, elsewhere); });
    INFO(text);
    CHECK(says(text,
               "tsubu::bisection_decomposition: none of 2 positions is inside the box; give positions of this box"));
}

TEST_CASE("a sample in columns is as good as one in rows", "[domain][bisection][batch]") {
    const auto sample = heap(500);
    std::array<std::vector<double>, 3> column;
    for (const auto& x : sample)
        for (std::size_t k = 0; k < 3; ++k) column[k].push_back(x[k]);
    const bisection_decomposition<3> rows(cube, 7, sample);
    const bisection_decomposition<3> columns(cube, 7, {{column[0], column[1], column[2]}});
    for (const auto& x : sample) CHECK(rows.owner(x) == columns.owner(x));
}

TEST_CASE("a rank may be an int, as MPI has it", "[domain][bisection][input]") {
    const bisection_decomposition<3> parts(cube, 4, {});
    const int mine = 3;
    CHECK(parts.subdomain(mine).lo() == parts.subdomain(std::size_t{3}).lo());
    CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(parts.neighbors(-1, 0.1)); }), "rank -1 of 4"));
}

TEST_CASE("bad samples are refused", "[domain][bisection][input]") {
    const auto sample = heap(3);
    const auto message = [&](std::size_t ranks, const std::vector<double>& weights) {
        return thrown<tsubu::input_error>([&] { bisection_decomposition<3>(cube, ranks, sample, weights); });
    };
    CHECK(says(message(0, {}), "tsubu::bisection_decomposition: 0 ranks; ask for at least 1"));
    CHECK(says(message(2, {1, 1}), "2 weights for 3 positions; give one for each, or none"));
    CHECK(says(message(2, {1, -2, 1}), "weight 1 is -2; give finite weights of at least 0"));
    CHECK(says(message(2, {1, 1, std::nan("")}), "weight 2 is nan"));
    CHECK(says(message(2, {std::numeric_limits<double>::infinity(), 1, 1}), "weight 0 is inf"));
    const bisection_decomposition<3> parts(cube, 2, sample);
    CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(parts.subdomain(2)); }),
               "rank 2 of 2; ranks count from 0"));
    for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK(says(thrown<tsubu::input_error>([&] { static_cast<void>(parts.neighbors(0, bad)); }),
                   "tsubu::bisection_decomposition::neighbors: the cutoff"));
}
