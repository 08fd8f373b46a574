// SPDX-License-Identifier: MIT
#include <tsubu/comm/balance.hpp>

#include "comm_laws/balance_laws.hpp"
#include "comm_laws/on_ranks.hpp"
#include "comm_laws/refused_memory.hpp"

#include <tsubu/comm/self_transport.hpp>

namespace {

/// Positions that count how often they are asked for.
struct asked_positions {
    std::vector<tsubu::vec<2>> x;
    mutable std::size_t asked = 0;

    [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
    [[nodiscard]] const tsubu::vec<2>& operator[](std::size_t i) const noexcept {
        ++asked;
        return x[i];
    }
};

}  // namespace

TEST_CASE("ranks get equal shares of the work", "[comm][balance]") {
    for (const auto ranks : comm_laws::some_ranks)
        comm_laws::check_on_ranks(ranks, [](auto& on, verdict& seen) { comm_laws::work_is_balanced(on, seen); });
}
TEST_CASE("each position is asked for once", "[comm][balance]") {
    const tsubu::domain<2> box({0, 0}, {1, 1}, {.periodic = {true, false}});
    std::vector<std::size_t> asked(4);
    comm_laws::check_on_ranks(4, [&](auto& on, verdict& seen) {
        asked_positions some;
        tsubu::random_stream random(3 + on.rank());
        for (int k = 0; k < 200; ++k) some.x.push_back({random.unit(), random.unit()});
        some.x.push_back({1.5, 1});  // at a closed face, and beyond one
        const auto bricks = tsubu::balanced_bricks(on, box, {2, 2}, some);
        seen(bricks.ranks() == 4, "bricks");
        asked[on.rank()] = some.asked;
    });
    CHECK(asked == std::vector<std::size_t>(4, 201));
}
TEST_CASE("many cuts are found among few particles", "[comm][balance]") {
    // Of numbers 0, 1, ... each part gets as many; some cuts share a bin for several rounds, some are alone in theirs.
    tsubu::self_transport on;
    constexpr std::size_t parts = 50;
    std::vector<double> x;
    for (int k = 0; k < 400; ++k) x.push_back(k % 4 == 0 ? 0.5 + 1e-6 * k : 1e-3 * k);
    const tsubu::detail::counted_weights weights(on, "test", {}, x.size(), [] {});
    tsubu::detail::balanced_cuts<double> cuts(0, 1, parts);
    cuts.find(on, std::span<const double>(x), weights);
    const auto found = cuts.found();
    std::sort(x.begin(), x.end());
    REQUIRE(found.size() == parts - 1);
    for (std::size_t c = 0; c < found.size(); ++c) {
        const auto below = std::lower_bound(x.begin(), x.end(), found[c]) - x.begin();
        INFO("cut " << c << " at " << found[c] << " has " << below << " below");
        CHECK(below == static_cast<std::ptrdiff_t>(8 * (c + 1)));
    }
}
TEST_CASE("where one rank has no memory to balance, all ranks learn of it", "[comm][balance][T7]") {
    const auto refusals = [](auto&& call) {
        return comm_laws::refusals_until_done([&](tsubu::local_transport& on, auto&& limited) {
            const tsubu::domain<3> box{{0, 0, 0}, {1, 2, 3}, {.periodic = {true, false, true}}};
            auto g = comm_laws::heap_of(on.rank(), 50 * on.ranks());
            on.memory().clear();
            limited([&] { call(on, box, g.owned()[tsubu::position<3>]); });
        });
    };
    CHECK(refusals([](auto& on, const auto& box, const auto& x) {
              static_cast<void>(tsubu::balanced_bricks(on, box, {1, 1, 3}, x));
          }) > 10);
    CHECK(refusals([](auto& on, const auto& box, const auto& x) {
              static_cast<void>(tsubu::balanced_parts(on, box, x));
          }) > 10);
}
