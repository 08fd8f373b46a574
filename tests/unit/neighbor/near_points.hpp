// SPDX-License-Identifier: MIT
/// @file
/// Points that lists of neighbours find hard, and their pairs by comparing each with each.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/neighbor/pair_list.hpp>
#include <tsubu/neighbor/reach.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace near_points {

template <std::size_t D, class Real>
using points = std::vector<tsubu::vec<D, Real>>;
using pair = std::pair<tsubu::index_t, tsubu::index_t>;

template <std::size_t D, class Real>
struct cloud {
    std::string name;
    points<D, Real> x;
    double reach;
};

template <std::size_t D, class Real>
points<D, Real> scattered(std::size_t count, double edge, std::uint64_t seed) {
    tsubu::random_stream random(seed);
    points<D, Real> x(count);
    for (auto& at : x)
        for (auto& coordinate : at) coordinate = static_cast<Real>(edge * random.unit());
    return x;
}
/// Whole numbers, in an order that has nothing to do with where they are.
template <std::size_t D, class Real>
points<D, Real> grid(std::size_t per_edge) {
    std::size_t all = 1;
    for (std::size_t k = 0; k < D; ++k) all *= per_edge;
    points<D, Real> x(all);
    for (std::size_t i = 0; i < all; ++i) {
        auto rest = i * 7 % all;  // a multiple of 7 has no such edge
        for (auto& coordinate : x[i]) {
            coordinate = static_cast<Real>(rest % per_edge);
            rest /= per_edge;
        }
    }
    return x;
}
template <std::size_t D, class Real>
points<D, Real> moved(points<D, Real> x, double scale, double shift) {
    for (auto& at : x)
        for (auto& coordinate : at) coordinate = static_cast<Real>(scale * static_cast<double>(coordinate) + shift);
    return x;
}

/// Sizes are such that each cloud has pairs and others.
template <std::size_t D, class Real>
std::vector<cloud<D, Real>> clouds() {
    constexpr double edge = D == 1 ? 60 : D == 2 ? 9 : 5;  // of 200 points, with a few within 1 of each
    const auto spread = scattered<D, Real>(200, edge, 3);
    const auto lattice = grid<D, Real>(D == 1 ? 100 : D == 2 ? 12 : 6);
    std::vector<cloud<D, Real>> all;
    all.push_back({"none", {}, 1});
    all.push_back({"one", {spread[0]}, 1});
    all.push_back({"random", spread, 1});
    auto uneven = spread;  // as many cells along no two axes
    for (auto& at : uneven)
        for (std::size_t k = 0; k < D; ++k) at[k] *= static_cast<Real>(std::pow(2.0, static_cast<double>(k) - 1));
    all.push_back({"random, as long along no two axes", uneven, 1});
    all.push_back({"random, all in one cell", spread, 1000});
    // More than there is room for at first, and stretches of more than a chunk.
    all.push_back({"many in few cells", scattered<D, Real>(1200, 2, 7), 0.9});
    all.push_back({"random, hardly any near", spread, 0.05});
    all.push_back({"random, far away", moved<D, Real>(spread, 1, sizeof(Real) == 8 ? 1e9 : 1e4), 1});
    all.push_back({"random, small", moved<D, Real>(spread, 1e-9, 0), 1e-9});
    all.push_back({"random, large and negative", moved<D, Real>(spread, -1e9, 0), 1e9});
    all.push_back({"whole numbers, reach 1", lattice, 1});
    all.push_back({"whole numbers, reach 2", lattice, 2});
    all.push_back({"whole numbers, reach just above 1", lattice, 1 + 4 * double{std::numeric_limits<Real>::epsilon()}});
    all.push_back({"in one place", points<D, Real>(50, spread[0]), 1e-3});
    auto line = scattered<1, Real>(300, 100, 4);
    points<D, Real> flat(line.size(), tsubu::vec<D, Real>{});
    for (std::size_t i = 0; i < flat.size(); ++i) flat[i][D - 1] = line[i][0];
    all.push_back({"on a line", flat, 0.7});
    auto strays = spread;
    for (std::size_t k = 0; k < D; ++k) strays[17][k] = static_cast<Real>(1e6);
    strays[33][0] = static_cast<Real>(-1e30);
    all.push_back({"with strays", strays, 1});
    points<D, Real> crowds;
    const auto crowd = scattered<D, Real>(50, 1, 5);
    for (int c = 0; c < 5; ++c)
        for (const auto& at : moved<D, Real>(crowd, std::pow(0.1, c), 3 * c)) crowds.push_back(at);
    all.push_back({"crowded", crowds, 0.3});
    return all;
}

/// As lists are to compare: in the numbers of the positions, nearer than the reach.
template <std::size_t D, class Real, class Reach>
bool is_near(const points<D, Real>& x, std::size_t i, std::size_t j, const Reach& reach) {
    Real square = 0;
    for (std::size_t k = 0; k < D; ++k) square += (x[i][k] - x[j][k]) * (x[i][k] - x[j][k]);
    return square < reach.template square<Real>(static_cast<tsubu::index_t>(i), static_cast<tsubu::index_t>(j));
}
/// All pairs of which the first is owned, in order.
template <std::size_t D, class Real, class Reach>
std::vector<pair> by_comparing_all(const points<D, Real>& x, std::size_t owned, const Reach& reach) {
    std::vector<pair> pairs;
    for (std::size_t i = 0; i < owned; ++i)
        for (auto j = i + 1; j < x.size(); ++j)
            if (is_near(x, i, j, reach))
                pairs.emplace_back(static_cast<tsubu::index_t>(i), static_cast<tsubu::index_t>(j));
    return pairs;
}
inline std::vector<pair> sorted(const tsubu::pair_list& list) {
    std::vector<pair> pairs;
    for (const auto [i, j] : list.pairs()) pairs.emplace_back(i, j);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}
/// Where the list first differs from what it is to be; nothing if it does not. (All pairs would fill the screen.)
inline std::string difference(const tsubu::pair_list& list, const std::vector<pair>& wanted) {
    const auto found = sorted(list);
    const auto at = std::mismatch(found.begin(), found.end(), wanted.begin(), wanted.end());
    const auto shown = [](auto one, auto end) {
        return one == end ? "no more" : std::to_string(one->first) + "-" + std::to_string(one->second);
    };
    if (at.first == found.end() && at.second == wanted.end()) return "";
    return shown(at.first, found.end()) + " instead of " + shown(at.second, wanted.end());
}
/// Some radii: most alike, a few larger, one 0.
template <class Radius>
std::vector<Radius> radii(std::size_t count) {
    tsubu::random_stream random(6);
    std::vector<Radius> all(count);
    for (std::size_t i = 0; i < count; ++i)
        all[i] = static_cast<Radius>((i % 11 == 0 ? 0.9 : 0.3) * (0.8 + 0.2 * random.unit()));
    if (count > 3) all[3] = 0;
    return all;
}
/// For owned counts: all, most, one, none.
inline std::vector<std::size_t> parts_of(std::size_t count) {
    std::vector<std::size_t> parts{count};
    if (count > 1) parts.insert(parts.end(), {count * 2 / 3, 1, 0});
    return parts;
}

}  // namespace near_points
