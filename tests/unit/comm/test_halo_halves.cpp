// SPDX-License-Identifier: MIT
/// @file
/// Halves of forward and reverse that are mixed up, and halos that outlive their particles.
#include <tsubu/comm/halo.hpp>

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

constexpr auto x = tsubu::position<2>;
constexpr auto v = tsubu::velocity<2>;
constexpr auto f = tsubu::force<2>;
using store_type = tsubu::particle_store<tsubu::fields<tsubu::id, x, v, f>>;

/// body(g, halo, bricks, on) on each of two ranks with ghosts of each other and of themselves; checks what it counts.
template <class Body>
void check_on_two(Body&& body) {
    const tsubu::domain<2> box({0, 0}, {1, 1}, {.periodic = {true, true}});
    std::atomic<int> wrong = 0;
    tsubu::run_ranks(2, [&](tsubu::local_transport& on) {
        const tsubu::brick_decomposition<2> bricks(box, on.ranks());
        store_type g;
        tsubu::random_stream random(3 + on.rank());
        for (int k = 0; k < 30; ++k)
            g.push_back(tsubu::id = k + 100 * static_cast<std::int64_t>(on.rank()), x = {random.unit(), random.unit()});
        tsubu::migrate(g, bricks, on);
        auto halo = tsubu::make_halo(g, bricks, 0.3, on);
        for (std::size_t i = 0; i < g.size(); ++i) g[v][i] = {static_cast<double>(g[tsubu::id][i]), 1};
        if (!body(g, halo, bricks, on)) ++wrong;
    });
    CHECK(wrong == 0);
}
template <class Call>
bool refuses(const std::string& words, Call&& call) {
    return says(thrown<tsubu::input_error>(call), words);
}

}  // namespace

TEST_CASE("a forward and a reverse of one size are under way together", "[comm][halo]") {
    check_on_two([](store_type& g, auto& halo, const auto&, auto&) {
        auto apart = g;
        for (store_type* one : {&g, &apart})
            for (std::size_t i = 0; i < one->size(); ++i)
                (*one)[f][i] = i < one->owned_count() ? tsubu::vec<2>{} : (*one)[v][i];
        halo.forward(apart, v);
        halo.reverse(apart, f);
        halo.start_forward(g, v);
        halo.start_reverse(g, f);
        halo.finish_forward(g, v);
        halo.finish_reverse(g, f);
        bool same = halo.ghost_count() > 0;
        for (std::size_t i = 0; i < g.size(); ++i)
            same = same && g[v][i] == apart[v][i] && g[f][i] == apart[f][i] &&
                   g[v][i][0] == static_cast<double>(g[tsubu::id][i]);
        return same;
    });
}
TEST_CASE("halves that do not belong together are refused, and hurt nothing", "[comm][halo]") {
    check_on_two([](store_type& g, auto& halo, const auto&, auto&) {
        bool right = refuses("nothing was started", [&] { halo.finish_forward(g, v); });
        halo.start_forward(g, v);
        right = right && refuses("another one is under way", [&] { halo.start_forward(g, x); });
        right = right && refuses("other fields were started", [&] { halo.finish_forward(g, f); });
        right = right && refuses("other fields were started", [&] { halo.finish_forward(g, v, f); });
        right = right && refuses("nothing was started", [&] { halo.finish_reverse(g, f); });
        halo.finish_forward(g, v);
        right = right && refuses("nothing was started", [&] { halo.finish_forward(g, v); });
        halo.forward(g, v);
        halo.reverse(g, f);
        for (std::size_t i = 0; i < g.size(); ++i)
            right = right && g[v][i][0] == static_cast<double>(g[tsubu::id][i]);
        return right;
    });
}
TEST_CASE("a halo knows that its particles have gone, even where the numbers are the same", "[comm][halo]") {
    check_on_two([](store_type& g, auto& halo, const auto& bricks, auto& on) {
        auto permuted = g;
        std::vector<tsubu::index_t> order;
        const auto ghosts = g.ghost_count();
        permuted.clear_ghosts();
        for (auto i = permuted.owned_count(); i-- > 0;) order.push_back(static_cast<tsubu::index_t>(i));
        permuted.permute(order);
        permuted.add_ghosts(ghosts);
        bool right = refuses("permuted since", [&] { halo.forward(permuted, v); });
        right = right && refuses("this halo was made for", [&] {
            auto more = g;
            more.push_back_ghost();
            halo.reverse(more, f);
        });
        // No ghosts before or after, and nobody leaves: the same numbers.
        auto none = tsubu::make_halo(g, bricks, 0, on);
        right = right && g.ghost_count() == 0;
        tsubu::migrate(g, bricks, on);
        return right && refuses("come, gone or been permuted", [&] { none.forward(g, v); });
    });
}
