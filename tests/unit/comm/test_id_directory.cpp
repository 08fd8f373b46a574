// SPDX-License-Identifier: MIT
#include <tsubu/comm/id_directory.hpp>

#include "comm_laws/id_laws.hpp"
#include "comm_laws/on_ranks.hpp"

TEST_CASE("ids are found, handed out, renumbered and told when they are double", "[comm][A13][T6]") {
    for (const auto ranks : comm_laws::some_ranks)
        comm_laws::check_on_ranks(ranks, [](auto& on, verdict& seen) { comm_laws::ids_are_served(on, seen); });
}
