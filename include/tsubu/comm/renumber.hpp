// SPDX-License-Identifier: MIT
/// @file
/// renumber: ids without gaps, the same whatever the number of ranks.
#pragma once

#include <tsubu/comm/detail/agreed.hpp>
#include <tsubu/comm/detail/agreed_exchange.hpp>
#include <tsubu/comm/detail/home_calls.hpp>
#include <tsubu/comm/detail/id_list.hpp>
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

/// Some of the ids of a rank, evenly from the lowest to the highest.
template <particle_id Id>
[[nodiscard]] std::vector<std::uint64_t> sample_of(std::span<const Id> ids) {
    constexpr std::size_t count = 64;  // parts differ by a few per cent of their size
    std::vector<Id> sorted(ids.begin(), ids.end());
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint64_t> sample;
    for (std::size_t k = 0; k < count && !sorted.empty(); ++k)
        sample.push_back(static_cast<std::uint64_t>(sorted[k * sorted.size() / count]));
    return sample;
}
/// P - 1 ids that divide those of all ranks into P parts of about the same size.
[[nodiscard]] inline std::vector<std::uint64_t> splitters_of(const mailbox& samples, std::size_t ranks) {
    std::vector<std::uint64_t> all;
    for (const auto& [from, words] : samples) all.insert(all.end(), words.begin(), words.end());
    std::sort(all.begin(), all.end());
    std::vector<std::uint64_t> splitters;
    for (std::size_t r = 1; r < ranks && !all.empty(); ++r) splitters.push_back(all[r * all.size() / ranks]);
    return splitters;
}

}  // namespace detail

/// New ids first, first + 1, ... for the particles of all ranks, in the order of the ids that they have: without gaps,
/// and independent of which rank owns what, and of how many ranks there are.
///
///     const auto fresh = tsubu::renumbered(on, ids);    // [ids.size()], for ids[0], ids[1], ...
///
/// Terms and contact lists name particles by id: give them the new ones too, before the old ones are forgotten.
///
/// @param owned  ids of the owned particles of this rank, in any order: a vector, a span, an array
/// @param first  the lowest new id, at least 0
/// @throws on all ranks or none: input_error if an id or `first` is negative, an id is owned twice, or `first` differs
///         between ranks; limit_error if the type of ids has not so many; std::bad_alloc on the rank itself.
/// Complexity: O(n log n), 8 bytes per id there and back; a sample of 512 bytes from each rank to each.
/// Collective: yes; the same type of ids and the same `first` on all ranks. A gather, two rounds of messages, a sum
///             over the ranks below, eight reductions.
template <transport Transport, detail::id_list Ids>
[[nodiscard]] std::vector<detail::element_of<Ids>> renumbered(Transport& on, const Ids& owned,
                                                              detail::element_of<Ids> first = 1) {
    using Id = detail::element_of<Ids>;
    constexpr auto where = "renumbered";
    const auto ids = detail::span_of(owned);
    std::vector<std::uint64_t> sample;
    detail::agreed(on, where, [&] {
        if (detail::is_negative(first))
            detail::raise<input_error>(where, "the first id is to be " + std::to_string(first),
                                       "ids of particles are 0 or greater");
        detail::check_ids(where, ids);
        sample = detail::sample_of(ids);
    });
    const auto first_word = static_cast<std::uint64_t>(first);
    std::uint64_t ends[] = {first_word, ~first_word};
    on.reduce(std::span<std::uint64_t>(ends), reduction::least);
    if (ends[0] != ~ends[1])
        detail::raise<input_error>(where,
                                   "the first id is " + std::to_string(ends[0]) + " on one rank, and " +
                                       std::to_string(~ends[1]) + " on another",
                                   "give the same on all");
    std::vector<std::uint64_t> splitters;
    detail::agreed_gather(on, where, sample,
                          [&](const mailbox& came) { splitters = detail::splitters_of(came, on.ranks()); });
    detail::home_calls calls;
    mailbox asked;
    std::vector<std::uint64_t> here;  // the ids of this part, in order
    detail::agreed_exchange(
        on, where,
        [&](std::vector<parcel>& parcels) {
            calls = detail::home_calls(ids, on.ranks(), [&](Id t) {
                const auto above =
                    std::upper_bound(splitters.begin(), splitters.end(), static_cast<std::uint64_t>(t));
                return static_cast<rank_t>(above - splitters.begin());
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
    const auto most = static_cast<std::uint64_t>((std::numeric_limits<Id>::max)()) - first_word;
    if (total[0] != 0 && total[0] - 1 > most)
        detail::raise<limit_error>(where, std::to_string(total[0]) + " ids from " + std::to_string(first) + " on",
                                   "begin lower, or take ids of 64 bits");
    const auto below = first_word + on.sum_before(here.size());
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
