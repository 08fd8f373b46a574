// SPDX-License-Identifier: MIT
#include <tsubu/comm/shared_restart.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "comm_laws/on_ranks.hpp"
#include "unit/io/scratch_folder.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace {

struct contact {
    std::int64_t with;
    double overlap;
};
inline constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};
using carried = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, contacts>;
using store = tsubu::particle_store<carried>;
const tsubu::domain<3> box{{0, 0, 0}, {1, 2, 3}, {.periodic = {true, true, true}}};

/// All particles of all ranks, by id, as words.
template <class Transport>
std::vector<std::uint64_t> all_words(Transport& on, const store& g) {
    std::vector<std::pair<std::int64_t, tsubu::index_t>> order;
    for (std::size_t i = 0; i < g.owned_count(); ++i)
        order.emplace_back(g[tsubu::id][i], static_cast<tsubu::index_t>(i));
    std::sort(order.begin(), order.end());
    std::vector<tsubu::index_t> chosen;
    for (const auto& one : order) chosen.push_back(one.second);
    std::vector<std::uint64_t> mine;
    for (const auto i : chosen) {
        const tsubu::index_t one[] = {i};
        std::vector<std::uint64_t> words(tsubu::packed_words(g, carried{}, one));
        tsubu::pack(g, carried{}, one, words);
        mine.push_back(words.size());
        mine.insert(mine.end(), words.begin(), words.end());
    }
    std::vector<std::vector<std::uint64_t>> particles;
    for (const auto& [rank, words] : on.gather(mine))
        for (std::size_t at = 0; at < words.size(); at += 1 + words[at])
            particles.emplace_back(words.begin() + static_cast<std::ptrdiff_t>(at + 1),
                                   words.begin() + static_cast<std::ptrdiff_t>(at + 1 + words[at]));
    std::sort(particles.begin(), particles.end());
    std::vector<std::uint64_t> all;
    for (const auto& one : particles) all.insert(all.end(), one.begin(), one.end());
    return all;
}

}  // namespace

TEST_CASE("a run goes on from four to three to seven ranks bit for bit", "[comm][restart]") {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    std::vector<std::uint64_t> first;
    comm_laws::check_on_ranks(4, [&](auto& on, verdict& seen) {
        store g;
        tsubu::random_stream random(5 + on.rank());
        for (int k = 0; k < 300; ++k) {
            const auto i = static_cast<std::size_t>(
                g.push_back(tsubu::id = 1000 * std::int64_t{on.rank()} + k,
                            tsubu::velocity<3> = {random.unit(), -0.0, 1e-310},
                            tsubu::position<3> = {random.unit(), 2 * random.unit(), 3 * random.unit()}));
            for (int n = 0; n < k % 4; ++n) g[contacts][i].push_back({k + n, random.unit()});
        }
        tsubu::migrate(g, tsubu::brick_decomposition<3>(box, 4), on);
        tsubu::write_restart(on, path, g, carried{}, {.step = 77, .box = tsubu::restart_box(box), .words = {4}});
        const auto words = all_words(on, g);
        if (on.rank() == 0) first = words;
        seen(!words.empty(), "there are particles");
    });
    CHECK(folder.files() == 1);
    for (const auto ranks : {std::size_t{3}, std::size_t{7}, std::size_t{1}})
        comm_laws::check_on_ranks(ranks, [&](auto& on, verdict& seen) {
            const tsubu::brick_decomposition<3> bricks(box, ranks);
            store g;
            const auto state = tsubu::read_restart(on, path, g, carried{}, bricks);
            seen(state.step == 77 && state.words == std::vector<std::uint64_t>{4}, "the state");
            for (const auto& x : g.owned()[tsubu::position<3>])
                seen(bricks.owner(x) == on.rank(), "each on the rank that owns its position");
            seen(all_words(on, g) == first, "the same particles, bit for bit");
            tsubu::write_restart(on, path, g, carried{}, {.step = 77, .box = {}, .words = {4}});  // for the next
        });
}

TEST_CASE("a restart that fails on one rank fails on all, and leaves the old file", "[comm][restart]") {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    const auto nowhere = folder / "none" + "/run.restart";
    comm_laws::check_on_ranks(3, [&](auto& on, verdict& seen) {
        store g;
        g.push_back(tsubu::id = std::int64_t{on.rank()});
        seen(thrown<tsubu::error>([&] { tsubu::write_restart(on, nowhere, g, carried{}); }) != "nothing was thrown",
             "a folder that does not exist");
        seen(thrown<tsubu::error>([&] {
                 tsubu::read_restart(on, nowhere, g, carried{}, tsubu::brick_decomposition<3>(box, 3));
             }) != "nothing was thrown",
             "a file that does not exist");
        seen(g.owned_count() == 1, "the store is as before");
        tsubu::write_restart(on, path, g, carried{});
    });
    CHECK(folder.files() == 1);
    {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(-8, std::ios::end);
        file.put('?');  // in the part of the last rank
    }
    comm_laws::check_on_ranks(3, [&](auto& on, verdict& seen) {
        store g;
        g.push_back(tsubu::id = 9);
        seen(thrown<tsubu::error>([&] {
                 tsubu::read_restart(on, path, g, carried{}, tsubu::brick_decomposition<3>(box, 3));
             }) != "nothing was thrown",
             "a damaged file");
        seen(g.owned_count() == 1 && g[tsubu::id][0] == 9, "the store is as before");
    });
}
