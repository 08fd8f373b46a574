// SPDX-License-Identifier: MIT
/// @file
/// The transports without MPI keep the laws; twins that break one are caught.
#include "broken_transports.hpp"

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/testing/transport_conformance.hpp>

#include "comm_laws/on_ranks.hpp"

#include <cstddef>
#include <set>
#include <string>

namespace {

using namespace tsubu::testing;

}  // namespace

TEST_CASE("one rank that sends to itself keeps all laws of a transport", "[comm][conformance]") {
    tsubu::self_transport on;
    verdict seen;
    check_transport(on, 3, 300, seen);
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 3000);
}

TEST_CASE("threads keep all laws of a transport", "[comm][conformance]") {
    for (const std::size_t ranks : {1U, 2U, 3U, 4U, 8U})
        comm_laws::check_on_ranks(ranks, [&](auto& on, verdict& seen) { check_transport(on, ranks, 60, seen); });
}

TEST_CASE("a broken transport is caught by the number of its law", "[comm][conformance]") {
    for (const auto& broken_one : broken::transport_twins()) {
        const auto seen = comm_laws::verdicts_of(3, [&](auto& on, verdict& here) {
            const auto twin = broken_one.make(on);
            check_transport(*twin, 1, 60, here);
        });
        std::set<std::string> all;
        std::string first;
        for (const auto& one : seen) {
            all.insert(one.broken.begin(), one.broken.end());
            first += one.first + "\n";
        }
        INFO(broken_one.name << ": " << first);
        CHECK(all == std::set<std::string>{broken_one.breaks});
    }
}

TEST_CASE("the text of a broken law of a transport names the rank, the step and the seed", "[comm][conformance]") {
    const auto seen = comm_laws::verdicts_of(2, [](auto& on, verdict& here) {
        broken::sum_with_its_own twin(on);
        broken::sound_transport& as_one = twin;
        check_transport(as_one, 77, 5, here);
    });
    INFO(seen[1].first);
    CHECK(seen[1].first.rfind("law 4: ", 0) == 0);
    CHECK(seen[1].first.find("rank 1 of 2, step ") != std::string::npos);
    CHECK(seen[1].first.find("seed 77") != std::string::npos);
}
