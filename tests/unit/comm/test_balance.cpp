// SPDX-License-Identifier: MIT
#include <tsubu/comm/balance.hpp>

#include "comm_laws/balance_laws.hpp"
#include "comm_laws/on_ranks.hpp"

TEST_CASE("ranks get equal shares of the work", "[comm][balance]") {
    for (const auto ranks : comm_laws::some_ranks)
        comm_laws::check_on_ranks(ranks, [](auto& on, verdict& seen) { comm_laws::work_is_balanced(on, seen); });
}
