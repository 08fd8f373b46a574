// SPDX-License-Identifier: MIT
/// @file
/// renumber: ids without gaps, the same whatever the number of ranks.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/agreed_exchange.hpp>
#include <tsubu/comm/detail/home_calls.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::adjacent_find, std::lower_bound, std::sort, std::upper_bound
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <string>     // std::to_string
#include <vector>     // std::vector

namespace tsubu {
namespace detail {

/// P - 1 ids that divide those of all ranks into P parts of about the same size: chosen from a sample of each rank.
template <particle_id Id, transport Transport>
[[nodiscard]] std::vector<std::uint64_t> splitters_of(Transport& on, const std::vector<Id>& sorted) {
    constexpr std::size_t sample = 64;  // of each rank: parts differ by a few per cent of their size
    std::vector<std::uint64_t> mine;
    for (std::size_t k = 0; k < sample && !sorted.empty(); ++k)
        mine.push_back(static_cast<std::uint64_t>(sorted[k * sorted.size() / sample]));
    std::vector<std::uint64_t> all;
    for (const auto& [from, words] : on.gather(mine)) all.insert(all.end(), words.begin(), words.end());
    std::sort(all.begin(), all.end());
    std::vector<std::uint64_t> splitters;
    for (std::size_t r = 1; r < on.ranks() && !all.empty(); ++r) splitters.push_back(all[r * all.size() / on.ranks()]);
    return splitters;
}

}  // namespace detail

/// New ids first, first + 1, ... for the particles of all ranks, in the order of the ids that they have: without gaps,
/// and independent of which rank owns what, and of how many ranks there are.
///
///     const auto fresh = tsubu::renumbered<std::int64_t>(on, ids);    // [ids.size()], for ids[0], ids[1], ...
///
/// Terms and contact lists name particles by id: give them the new ones too, before the old ones are forgotten.
///
/// @throws on all ranks or none: input_error if an id is negative, or owned twice; limit_error if Id has not so many;
///         std::bad_alloc on the rank itself.
/// Complexity: O(n log n), 8 bytes per id there and back; a sample of 512 bytes from each rank to each.
/// Collective: yes; a gather, two rounds of messages, a sum over the ranks below, reductions.
template <particle_id Id, transport Transport>
[[nodiscard]] std::vector<Id> renumbered(Transport& on, std::span<const Id> owned, Id first = 1) {
    constexpr auto where = "renumbered";
    agreement<> all(on.rank());
    std::vector<Id> sorted;
    all.attempt([&] {
        for (std::size_t i = 0; i < owned.size(); ++i)
            if (detail::is_negative(owned[i]))
                detail::raise<input_error>(where,
                                           "the id at index " + std::to_string(i) + " is " + std::to_string(owned[i]),
                                           "ids of particles are 0 or greater");
        sorted.assign(owned.begin(), owned.end());
        std::sort(sorted.begin(), sorted.end());
    });
    on.reduce(all.words(), reduction::sum);
    all.settle(where);

    const auto splitters = detail::splitters_of(on, sorted);
    detail::home_calls calls;
    mailbox asked;
    std::vector<std::uint64_t> here;  // the ids of this part, in order
    detail::agreed_exchange(
        on, where,
        [&](std::vector<parcel>& parcels) {
            calls = detail::home_calls(owned, on.ranks(), [&](std::size_t k) {
                const auto t = static_cast<std::uint64_t>(owned[k]);
                return static_cast<rank_t>(std::upper_bound(splitters.begin(), splitters.end(), t) - splitters.begin());
            });
            calls.add_parcels(parcels);
        },
        [&](mailbox& came) {
            here.reserve(came.words());
            for (const auto& [from, words] : came) here.insert(here.end(), words.begin(), words.end());
            std::sort(here.begin(), here.end());
            const auto twice = std::adjacent_find(here.begin(), here.end());
            if (twice != here.end())
                detail::raise<input_error>(where, "id " + std::to_string(*twice) + " is owned twice",
                                           "each id is owned once; ask duplicate_ids who owns it");
            asked = std::move(came);
        });

    std::uint64_t total[] = {here.size()};
    on.reduce(std::span<std::uint64_t>(total), reduction::sum);
    const auto most = static_cast<std::uint64_t>((std::numeric_limits<Id>::max)()) - static_cast<std::uint64_t>(first);
    if (total[0] != 0 && total[0] - 1 > most)
        detail::raise<limit_error>(where, std::to_string(total[0]) + " ids from " + std::to_string(first) + " on",
                                   "begin lower, or take ids of 64 bits");
    const auto below = static_cast<std::uint64_t>(first) + on.sum_before(here.size());
    detail::home_answers answers;
    std::vector<Id> fresh;
    detail::agreed_exchange(
        on, where,
        [&](std::vector<parcel>& parcels) {
            answers = detail::home_answers(asked, [&](std::uint64_t t) {
                return below + static_cast<std::uint64_t>(std::lower_bound(here.begin(), here.end(), t) - here.begin());
            });
            answers.add_parcels(parcels);
        },
        [&](const mailbox& came) {
            const auto found = calls.answers(came);
            fresh.resize(found.size());
            for (std::size_t k = 0; k < found.size(); ++k) fresh[k] = static_cast<Id>(found[k]);
        });
    return fresh;
}

}  // namespace tsubu
