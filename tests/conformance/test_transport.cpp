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

TEMPLATE_LIST_TEST_CASE("a broken transport is caught by the number of its law", "[comm][conformance]",
                        broken::transport_twins) {
    static_assert(tsubu::transport<TestType>);
    const auto seen = comm_laws::verdicts_of(3, [](auto& on, verdict& here) {
        TestType twin(on);
        check_transport(twin, 1, 60, here);
    });
    std::set<std::string> all;
    for (const auto& one : seen) {
        all.insert(one.broken.begin(), one.broken.end());
        if (!one.first.empty()) UNSCOPED_INFO(one.first);
    }
    CHECK(all == std::set<std::string>{TestType::breaks});
}

TEST_CASE("the text of a broken law of a transport names the rank, the step and the seed", "[comm][conformance]") {
    const auto seen = comm_laws::verdicts_of(2, [](auto& on, verdict& here) {
        broken::sum_with_its_own twin(on);
        check_transport(twin, 77, 5, here);
    });
    INFO(seen[1].first);
    CHECK(seen[1].first.rfind("law 4: ", 0) == 0);
    CHECK(seen[1].first.find("rank 1 of 2, step ") != std::string::npos);
    CHECK(seen[1].first.find("seed 77") != std::string::npos);
}
