// SPDX-License-Identifier: MIT
/// @file
/// Local work of all ranks, between their messages: if it throws on one rank, all throw.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>

#include <cstdint>  // std::uint64_t
#include <new>      // std::bad_alloc
#include <span>     // std::span
#include <utility>  // std::forward

namespace tsubu::detail {

/// @param work  what this rank does; may throw anything.
/// Collective: yes; one reduction.
template <transport Transport, class Work>
void agreed(Transport& on, const char* where, Work&& work) {
    agreement<> all(on.rank());
    all.attempt(std::forward<Work>(work));
    on.reduce(all.words(), reduction::sum);
    all.settle(where);
}
/// The same for what is done with a word or more of each rank: take(mailbox).
/// Collective: yes; a gather and one reduction.
template <transport Transport, class Take>
void agreed_gather(Transport& on, const char* where, std::span<const std::uint64_t> words, Take&& take) {
    agreement<> all(on.rank());
    mailbox came;
    try {
        came = on.gather(words);
    } catch (const std::bad_alloc&) {  // of what came; the gather is over
        all.attempt([] { throw; });
    } catch (const limit_error&) {  // on all ranks: together they have too much, or one has no room
        all.attempt([] { throw; });
    }
    all.attempt([&] { std::forward<Take>(take)(came); });
    on.reduce(all.words(), reduction::sum);
    all.settle(where);
}

}  // namespace tsubu::detail
