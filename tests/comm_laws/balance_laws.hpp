// SPDX-License-Identifier: MIT
/// @file
/// What balanced decompositions promise, on any transport.
#pragma once

#include <tsubu/comm/balance.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace comm_laws {

/// A heap: most particles lie low, near one corner; those with even ids cost nine times as much.
using heaped = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>>>;
constexpr std::size_t heaped_count = 6000;

[[nodiscard]] inline double cost_of(std::int64_t t) { return t % 2 == 0 ? 9.0 : 1.0; }
/// Dealt to the ranks by their number; all ranks together have the same ones, however many they are.
[[nodiscard]] inline heaped heap_of(tsubu::rank_t rank, std::size_t ranks) {
    heaped g;
    tsubu::random_stream random(9);
    for (std::size_t k = 0; k < heaped_count; ++k) {
        const double u = random.unit();
        const tsubu::vec<3> x{u * random.unit(), 2 * random.unit(), 3 * u * u * random.unit()};
        if (k % ranks == rank) g.push_back(tsubu::id = static_cast<std::int64_t>(k), tsubu::position<3> = x);
    }
    return g;
}
[[nodiscard]] inline std::vector<double> costs_of(const heaped& g) {
    std::vector<double> costs;
    for (const auto t : g.owned()[tsubu::id]) costs.push_back(cost_of(t));
    return costs;
}
/// The greatest cost of a rank over the mean one.
template <class Transport>
[[nodiscard]] double imbalance(Transport& on, const heaped& g) {
    double mine = 0;
    for (const auto cost : costs_of(g)) mine += cost;
    double sum[] = {mine};
    double most[] = {mine};
    on.reduce(std::span<double>(sum), tsubu::reduction::sum);
    on.reduce(std::span<double>(most), tsubu::reduction::greatest);
    return most[0] * static_cast<double>(on.ranks()) / sum[0];
}

template <class Transport, class Check>
void work_is_balanced(Transport& on, Check&& check) {
    const tsubu::domain<3> box{{0, 0, 0}, {1, 2, 3}, {.periodic = {true, false, true}}};
    const auto ranks = on.ranks();
    auto g = heap_of(on.rank(), ranks);
    const tsubu::brick_decomposition<3> even(box, std::array<std::size_t, 3>{1, 1, ranks});
    tsubu::migrate(g, even, on);
    const auto before = imbalance(on, g);

    const auto slabs = tsubu::balanced_bricks(on, box, {1, 1, ranks}, g.owned()[tsubu::position<3>], costs_of(g));
    auto h = heap_of(on.rank(), ranks);
    const auto same = tsubu::balanced_bricks(on, box, {1, 1, ranks}, h.owned()[tsubu::position<3>], costs_of(h));
    for (std::size_t k = 0; k < ranks; ++k)
        check(slabs.along(2).begin(k) == same.along(2).begin(k), "bricks: cuts do not depend on who has the particles");
    tsubu::migrate(g, slabs, on);
    check(imbalance(on, g) < 1.02, "bricks: slabs of equal cost");
    check(ranks == 1 || imbalance(on, g) < before, "bricks: better than even ones");

    const auto parts = tsubu::balanced_parts(on, box, g.owned()[tsubu::position<3>], costs_of(g));
    tsubu::migrate(g, parts, on);
    check(imbalance(on, g) < 1.02, "parts: of equal cost");
    const auto sampled = tsubu::balanced_parts(on, box, g.owned()[tsubu::position<3>], costs_of(g), 0, 1000);
    tsubu::migrate(g, sampled, on);
    check(imbalance(on, g) < 1.25, "parts: about equal from a sample");

    // A width that is asked for is kept, or refused on all ranks.
    const double least = (std::min)(0.9, 2.5 / static_cast<double>(ranks));
    const auto wide =
        tsubu::balanced_bricks(on, box, {1, 1, ranks}, g.owned()[tsubu::position<3>], costs_of(g), least);
    for (std::size_t rank = 0; rank < ranks; ++rank) {
        const auto part = wide.subdomain(rank);
        check(part.hi()[2] - part.lo()[2] >= least * (1 - 1e-12), "bricks: as wide as asked");
    }
    const auto refuses = [&](auto&& call) { return thrown<tsubu::input_error>(call); };
    check(says(refuses([&] {
                   static_cast<void>(tsubu::balanced_bricks(on, box, {1, 1, ranks}, g.owned()[tsubu::position<3>], {},
                                                            3.1 / static_cast<double>(ranks)));
               }),
               ranks < 4 ? "along axis" : "along axis 2, which is 3 long"),
          "bricks: too wide is refused with the numbers");
    check(says(refuses([&] {
                   static_cast<void>(tsubu::balanced_parts(on, box, g.owned()[tsubu::position<3>], {}, 1.5));
               }),
               "less than 1.5"),
          "parts: too wide is refused with the numbers");
    auto costs = costs_of(g);
    if (on.rank() + 1 == ranks && !costs.empty()) costs.front() = std::numeric_limits<double>::quiet_NaN();
    check(thrown<tsubu::error>([&] {
              static_cast<void>(tsubu::balanced_bricks(on, box, {1, 1, ranks}, g.owned()[tsubu::position<3>], costs));
          }) != "nothing was thrown",
          "bricks: a weight that is no number is refused on all");
    auto too_few = costs_of(g);
    if (on.rank() == 0) too_few.push_back(1);
    const auto miscounted = thrown<tsubu::error>(
        [&] { static_cast<void>(tsubu::balanced_parts(on, box, g.owned()[tsubu::position<3>], too_few)); });
    check(says(miscounted, on.rank() == 0 ? "give one for each owned particle" : "rank 0 refused the input"),
          "weights: one for each particle");
    const auto some = on.rank() == 0 ? std::vector<double>() : costs_of(g);
    for (const bool asks_for_bricks : {true, false}) {
        const auto mixed = refuses([&] {
            if (asks_for_bricks)
                static_cast<void>(
                    tsubu::balanced_bricks(on, box, {1, 1, ranks}, g.owned()[tsubu::position<3>], some));
            else
                static_cast<void>(tsubu::balanced_parts(on, box, g.owned()[tsubu::position<3>], some));
        });
        check(says(mixed, "1 with particles give none") == (ranks > 1), "weights: on all ranks, or on none");
    }
    check(refuses([&] {
              static_cast<void>(tsubu::balanced_bricks(on, box, {1, 2, ranks}, g.owned()[tsubu::position<3>]));
          }) != "nothing was thrown",
          "bricks: another number of ranks is refused");

    // In a tilted box the cuts are those of its cell.
    const tsubu::triclinic_box<3> tilted({0, 0, 0}, {1, 2, 3}, {0.3, 0, 0.2}, {true, true, true});
    for (auto& x : g.owned()[tsubu::position<3>]) x = tilted.wrap(x).position;
    const tsubu::cell_decomposition in_cell(
        tilted, tsubu::balanced_parts(on, tilted, g.owned()[tsubu::position<3>], costs_of(g)));
    tsubu::migrate(g, in_cell, on);
    check(imbalance(on, g) < 1.02, "parts: of equal cost in a tilted box");

    // All in one point: parts keep a width.
    for (auto& x : g.owned()[tsubu::position<3>]) x = {0.5, 0.5, 0.5};
    static_cast<void>(tsubu::balanced_bricks(on, box, {1, 1, ranks}, g.owned()[tsubu::position<3>]));
    heaped none;
    static_cast<void>(tsubu::balanced_parts(on, box, none.owned()[tsubu::position<3>]));
    const auto is_even = [&](const heaped& of, const std::vector<double>& weights) {
        const auto bricks = tsubu::balanced_bricks(on, box, {1, 1, ranks}, of.owned()[tsubu::position<3>], weights);
        bool all_are = true;
        for (std::size_t k = 0; k < ranks; ++k)
            all_are = all_are && std::abs(bricks.along(2).begin(k) - 3 * static_cast<double>(k) /
                                                                         static_cast<double>(ranks)) < 1e-12;
        return all_are;
    };
    check(is_even(none, {}), "bricks: without particles of one width");
    check(is_even(h, std::vector<double>(h.owned_count())), "bricks: without weight of one width");

    // As light as can be, and as heavy: only the ratios count.
    const auto unweighted = tsubu::balanced_bricks(on, box, {1, 1, ranks}, h.owned()[tsubu::position<3>]);
    for (const double weight : {1e-320, std::numeric_limits<double>::denorm_min(), 1e308}) {
        const auto weighted = tsubu::balanced_bricks(on, box, {1, 1, ranks}, h.owned()[tsubu::position<3>],
                                                     std::vector<double>(h.owned_count(), weight));
        for (std::size_t k = 0; k < ranks; ++k)
            check(weighted.along(2).begin(k) == unweighted.along(2).begin(k), "bricks: weights of any magnitude");
    }
}

}  // namespace comm_laws
