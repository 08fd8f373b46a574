// SPDX-License-Identifier: MIT
/// @file
/// What holds when one rank is refused memory, at any place: all ranks learn of it, none has done anything, and the
/// next call works.
#include <tsubu/comm/halo.hpp>
#include <tsubu/comm/local_transport.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "support/counted_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace {

using counted_memory::granted;
using counted_memory::no_limit;

constexpr tsubu::field<"contacts", tsubu::list_of<std::int64_t>> contacts{};
using store_type = tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<2>, tsubu::radius, contacts>>;
constexpr std::size_t ranks = 3;
constexpr tsubu::rank_t poor = 1;

/// Of each particle its id and the number of its contacts.
std::vector<std::int64_t> seen_in(const store_type& g) {
    std::vector<std::int64_t> all;
    for (std::size_t i = 0; i < g.owned_count(); ++i) {
        all.push_back(g[tsubu::id][i]);
        all.push_back(static_cast<std::int64_t>(g[contacts][i].span().size()));
    }
    return all;
}

enum class outcome { done, no_memory, told, other };

/// What becomes of a call on this rank, where only so many requests of the poor one are granted.
template <class Call>
outcome outcome_of(const tsubu::local_transport& on, std::size_t requests, Call&& call) {
    if (on.rank() == poor) granted = requests;
    auto result = outcome::done;
    try {
        call();
    } catch (const std::bad_alloc&) {
        result = outcome::no_memory;
    } catch (const tsubu::limit_error&) {
        result = outcome::told;
    } catch (...) {
        result = outcome::other;
    }
    granted = no_limit;
    return result;
}

/// Runs examine(g, parts, on, requests) on all ranks with 0, 1, 2 ... requests that are granted, until the call is
/// done; it returns the outcome, and clears `holds` if what is left is wrong. @return how many were too few.
template <class Examine>
std::size_t refusals_until_done(Examine&& examine) {
    const tsubu::domain<2> box({0, 0}, {1, 1}, {.periodic = {true, true}});
    for (std::size_t requests = 0; requests < 400; ++requests) {
        std::vector<outcome> outcomes(ranks);
        std::vector<char> holds(ranks, 1);
        tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) {
            std::vector<tsubu::vec<2>> points;
            tsubu::random_stream random(5);
            for (int k = 0; k < 90; ++k) points.push_back({random.unit(), random.unit()});
            const tsubu::bisection_decomposition<2> parts(box, ranks, points);
            store_type g;
            for (std::size_t k = on.rank(); k < points.size(); k += ranks) {
                const auto i = static_cast<std::size_t>(g.push_back(
                    tsubu::id = static_cast<std::int64_t>(k), tsubu::position<2> = points[k], tsubu::radius = 1.0));
                for (std::size_t n = 0; n < k % 4; ++n) g[contacts][i].push_back(static_cast<std::int64_t>(n));
            }
            bool is_right = true;
            outcomes[on.rank()] = examine(g, parts, on, requests, is_right);
            holds[on.rank()] = is_right ? 1 : 0;
        });
        INFO(requests << " requests granted");
        CHECK(holds == std::vector<char>(ranks, 1));
        if (outcomes == std::vector<outcome>(ranks, outcome::done)) return requests;
        CHECK(outcomes == std::vector<outcome>{outcome::told, outcome::no_memory, outcome::told});
    }
    return 0;
}

}  // namespace

TEST_CASE("migrate on a rank without memory moves nothing anywhere", "[comm][migrate]") {
    const auto refusals = refusals_until_done(
        [](store_type& g, const auto& parts, tsubu::local_transport& on, std::size_t requests, bool& is_right) {
            const auto before = seen_in(g);
            const auto result = outcome_of(on, requests, [&] { tsubu::migrate(g, parts, on); });
            if (result != outcome::done) {
                is_right = seen_in(g) == before;
                tsubu::migrate(g, parts, on);
            }
            std::uint64_t count[] = {g.owned_count()};
            on.reduce(std::span<std::uint64_t>(count), tsubu::reduction::sum);
            is_right = is_right && count[0] == 90;
            for (std::size_t i = 0; i < g.size(); ++i)
                is_right = is_right && parts.owner(g[tsubu::position<2>][i]) == on.rank() &&
                           g[contacts][i].span().size() == static_cast<std::size_t>(g[tsubu::id][i]) % 4;
            return result;
        });
    CHECK(refusals > 10);
}
TEST_CASE("make_halo on a rank without memory leaves no ghosts anywhere", "[comm][halo]") {
    const auto refusals = refusals_until_done(
        [](store_type& g, const auto& parts, tsubu::local_transport& on, std::size_t requests, bool& is_right) {
            tsubu::migrate(g, parts, on);
            static_cast<void>(tsubu::make_halo(g, parts, 0.2, on));
            const auto ghosts = g.ghost_count();
            g.clear_ghosts();
            const auto before = seen_in(g);
            on.memory().clear();
            const auto result =
                outcome_of(on, requests, [&] { static_cast<void>(tsubu::make_halo(g, parts, 0.2, on)); });
            if (result != outcome::done) {
                is_right = seen_in(g) == before && g.ghost_count() == 0;
                static_cast<void>(tsubu::make_halo(g, parts, 0.2, on));
            }
            is_right = is_right && seen_in(g) == before && g.ghost_count() == ghosts && ghosts > 0;
            return result;
        });
    CHECK(refusals > 10);
}
TEST_CASE("lost particles are collected whole, or, where memory is refused, none of them", "[comm][migrate][memory]") {
    store_type from;
    for (std::int64_t k = 0; k < 40; ++k) {
        from.push_back(tsubu::id = k);
        for (std::int64_t n = 0; n < k; ++n) from[contacts][static_cast<std::size_t>(k)].push_back(n);
    }
    const std::vector<tsubu::index_t> lost{3, 17, 39};
    std::size_t refusals = 0;
    for (bool is_done = false; !is_done; ++refusals) {
        store_type into;
        into.push_back(tsubu::id = 100);
        const auto before = seen_in(into);
        granted = refusals;
        try {
            tsubu::detail::append_rows(into, from, lost);
            is_done = true;
        } catch (const std::bad_alloc&) {
        }
        granted = no_limit;
        const auto after = seen_in(into);
        if (is_done)
            CHECK(after == std::vector<std::int64_t>{100, 0, 3, 3, 17, 17, 39, 39});
        else
            CHECK(after == before);
    }
    CHECK(refusals > 2);
}
