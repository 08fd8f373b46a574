// SPDX-License-Identifier: MIT
/// @file
/// Laws on the threads of a local_transport, judged where the test framework may be asked: on the main thread.
#pragma once

#include <tsubu/comm/local_transport.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace comm_laws {

inline constexpr std::size_t some_ranks[] = {1, 2, 3, 4, 8};

using body_on_rank = std::function<void(tsubu::local_transport&, verdict&)>;

/// body(on, check) as each rank; the verdicts of all.
[[nodiscard]] inline std::vector<verdict> verdicts_of(std::size_t ranks, const body_on_rank& body) {
    std::vector<verdict> seen(ranks);
    tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) { body(on, seen[on.rank()]); });
    return seen;
}
/// CHECKs that all laws that body(on, check) examines are kept on all ranks, and that each rank examined some.
inline void check_on_ranks(std::size_t ranks, const body_on_rank& body) {
    const auto seen = verdicts_of(ranks, body);
    for (std::size_t rank = 0; rank < ranks; ++rank) {
        INFO("rank " << rank << " of " << ranks << ": " << seen[rank].first);
        CHECK(seen[rank].broken.empty());
        CHECK(seen[rank].checked > 0);
    }
}

}  // namespace comm_laws
