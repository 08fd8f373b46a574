// SPDX-License-Identifier: MIT
/// @file
/// One rank is refused memory, at every place in turn: all ranks learn of it, and the next call works.
#pragma once

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/core/error.hpp>

#include "support/catch.hpp"
#include "support/counted_memory.hpp"

#include <cstddef>
#include <new>
#include <string>
#include <vector>

namespace comm_laws {

/// Runs body(on, limited) as each of three ranks, again and again: limited(call) makes a call of all ranks, for which
/// rank 1 is granted 0, 1, 2, ... requests for memory, until it is done. Then body may look at what is left.
/// CHECKs that rank 1 got a std::bad_alloc and the others an error, or none of them any.
/// @return how many were too few.
template <class Body>
std::size_t refusals_until_done(Body&& body) {
    constexpr tsubu::rank_t poor = 1;
    for (std::size_t requests = 0; requests < 1000; ++requests) {
        std::vector<std::string> outcomes(3);
        tsubu::run_ranks(3, [&](tsubu::local_transport& on) {
            auto& outcome = outcomes[on.rank()];
            body(on, [&](auto&& call) {
                if (on.rank() == poor) counted_memory::granted = requests;
                const char* seen = "done";
                try {
                    call();
                } catch (const std::bad_alloc&) {
                    seen = "no memory";
                } catch (const tsubu::error&) {
                    seen = "told";
                }
                counted_memory::granted = counted_memory::no_limit;
                outcome = seen;
            });
            if (on.sum_before(1) != on.rank()) outcome += ", and the ranks are not together";
        });
        INFO(requests << " requests granted");
        if (outcomes == std::vector<std::string>(3, "done")) return requests;
        CHECK(outcomes == std::vector<std::string>{"told", "no memory", "told"});
    }
    return 0;
}

}  // namespace comm_laws
