// SPDX-License-Identifier: MIT
/// @file
/// An exchange before and after which ranks may fail: then all throw.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>

#include <new>      // std::bad_alloc
#include <utility>  // std::forward
#include <vector>   // std::vector

namespace tsubu::detail {

/// prepare(parcels) on every rank, then take(mailbox), which may keep it; if either throws on one rank, all throw, and
/// those that have prepared take nothing. What parcels refer to must live until agreed_exchange returns.
/// @param left  how things are if it throws: see agreement::settle
/// Collective: yes; the messages and two reductions.
template <transport Transport, class Prepare, class Take>
void agreed_exchange(Transport& on, const char* where, Prepare&& prepare, Take&& take,
                     const char* left = "nothing was done on any rank") {
    std::vector<parcel> parcels;
    agreement<> before(on.rank());
    before.attempt([&] { std::forward<Prepare>(prepare)(parcels); });
    if (before.has_failed_here()) parcels.clear();
    agreement<> after(on.rank());
    mailbox came;
    try {
        came = on.exchange({parcels.data(), parcels.size()}, before.words());
    } catch (const std::bad_alloc&) {  // of what came; the exchange is over
        after.attempt([] { throw; });
    }
    before.settle(where, left);
    after.attempt([&] { std::forward<Take>(take)(came); });
    on.reduce(after.words(), reduction::sum);
    after.settle(where, left);
}

}  // namespace tsubu::detail
