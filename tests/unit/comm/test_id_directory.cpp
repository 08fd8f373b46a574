// SPDX-License-Identifier: MIT
#include <tsubu/comm/id_directory.hpp>

#include "comm_laws/id_laws.hpp"
#include "comm_laws/on_ranks.hpp"
#include "comm_laws/refused_memory.hpp"

TEST_CASE("ids are found, handed out, renumbered and told when they are double", "[comm][A13][T6]") {
    for (const auto ranks : comm_laws::some_ranks)
        comm_laws::check_on_ranks(ranks, [](auto& on, verdict& seen) { comm_laws::ids_are_served(on, seen); });
}
TEST_CASE("where one rank has no memory for ids, all ranks learn of it", "[comm][T7]") {
    const auto refusals = [](auto&& call) {
        return comm_laws::refusals_until_done([&](tsubu::local_transport& on, auto&& limited) {
            std::vector<std::int64_t> ids;
            for (int k = 0; k < 20; ++k) ids.push_back(k + 100 * std::int64_t{on.rank()});
            tsubu::id_directory<> owners;
            owners.rebuild(on, std::span<const std::int64_t>(ids));
            on.memory().clear();
            limited([&] { call(on, ids, owners); });
        });
    };
    CHECK(refusals([](auto& on, const auto& ids, auto&) { static_cast<void>(tsubu::renumbered(on, ids)); }) > 10);
    CHECK(refusals([](auto& on, const auto& ids, auto&) { static_cast<void>(tsubu::duplicate_ids(on, ids)); }) > 10);
    CHECK(refusals([](auto& on, const auto& ids, auto& owners) { owners.rebuild(on, ids); }) > 10);
    CHECK(refusals([](auto& on, const auto& ids, auto& owners) { static_cast<void>(owners.find(on, ids)); }) > 10);
}
