// SPDX-License-Identifier: MIT
#include <tsubu/comm/shared_restart.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "comm_laws/on_ranks.hpp"
#include "comm_laws/refused_memory.hpp"
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

TEST_CASE("a restart whose particles are not all in the box leaves the store as it was", "[comm][restart]") {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    const tsubu::domain<3> open_box{{0, 0, 0}, {1, 2, 3}};
    comm_laws::check_on_ranks(3, [&](auto& on, verdict& seen) {
        const tsubu::brick_decomposition<3> bricks(open_box, 3);
        store g;
        g.push_back(tsubu::id = std::int64_t{on.rank()}, tsubu::position<3> = {0.5, 1, on.rank() == 1 ? 7.0 : 1.5});
        tsubu::write_restart(on, path, g, carried{});
        g.clear();
        tsubu::migrate(g, bricks, on);
        const auto owner = bricks.owner({0.5, 1, 0.5});
        if (on.rank() == owner) g.push_back(tsubu::id = 99, tsubu::position<3> = {0.5, 1, 0.5});
        seen(thrown<tsubu::error>([&] { tsubu::read_restart(on, path, g, carried{}, bricks); }) != "nothing was thrown",
             "a particle outside is refused");
        seen(g.owned_count() == (on.rank() == owner ? 1U : 0U) && (g.empty() || g[tsubu::id][0] == 99),
             "the store is as before");
        const tsubu::brick_decomposition<3> for_two(open_box, 2);
        const auto text = thrown<tsubu::input_error>(
            [&] { tsubu::read_restart(on, folder / "no.restart", g, carried{}, for_two); });
        seen(says(text, "a decomposition for 2 ranks on 3"), "the decomposition is looked at before the file");
    });
}

TEST_CASE("ranks that disagree about the state write nothing", "[comm][restart]") {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    comm_laws::check_on_ranks(3, [&](auto& on, verdict& seen) {
        store g;
        const auto refused = [&](const tsubu::restart_state& state) {
            const auto text = thrown<tsubu::input_error>([&] { tsubu::write_restart(on, path, g, carried{}, state); });
            return says(text, "the state on rank 2 is not that on rank 0");
        };
        const bool is_other = on.rank() == 2;
        seen(refused({.step = is_other ? 8 : 7, .box = {}, .words = {}}), "the step");
        seen(refused({.step = 7, .box = is_other ? tsubu::restart_box(box) : tsubu::restart_box{}, .words = {}}),
             "the box");
        seen(refused({.step = 7, .box = {}, .words = std::vector<std::uint64_t>(is_other ? 1 : 0)}), "the words");
    });
    CHECK(folder.files() == 0);
}

TEST_CASE("a restart on a rank without memory is known to all ranks", "[comm][restart][T7]") {
    const scratch_folder folder;
    const auto path = folder / "run.restart";
    const auto particle_of = [](tsubu::rank_t rank) {
        store g;
        const auto i = static_cast<std::size_t>(g.push_back(tsubu::id = std::int64_t{rank}));
        g[contacts][i].push_back({1, 0.5});
        return g;
    };
    const tsubu::restart_state written{.step = 7, .box = {}, .words = {1}};
    bool is_as_before = true;
    CHECK(comm_laws::refusals_until_done([&](tsubu::local_transport& on, auto&& limited) {
              const auto g = particle_of(on.rank());
              on.memory().clear();
              limited([&] { tsubu::write_restart(on, path, g, carried{}, written); });
          }) > 10);
    CHECK(folder.files() == 1);
    CHECK(comm_laws::refusals_until_done([&](tsubu::local_transport& on, auto&& limited) {
              const tsubu::brick_decomposition<3> bricks(box, 3);
              auto g = particle_of(on.rank() + 10);
              for (auto& x : g.owned()[tsubu::position<3>]) x = bricks.subdomain(on.rank()).lo();
              tsubu::restart_state state;
              on.memory().clear();
              limited([&] { state = tsubu::read_restart(on, path, g, carried{}, bricks); });
              if (on.rank() == 1 && state.step != 7) is_as_before = is_as_before && g.owned_count() == 1;
          }) > 10);
    CHECK(is_as_before);
}
