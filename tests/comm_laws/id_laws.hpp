// SPDX-License-Identifier: MIT
/// @file
/// What the services for ids promise, on any transport. Every rank knows all ids, and who owns which.
#pragma once

#include <tsubu/comm/duplicate_ids.hpp>
#include <tsubu/comm/id_directory.hpp>
#include <tsubu/comm/new_ids.hpp>
#include <tsubu/comm/renumber.hpp>
#include <tsubu/core/random.hpp>

#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace comm_laws {

/// Ids that `count` particles might have, shuffled among ranks; the last rank has none.
template <class Id>
struct dealt_ids {
    std::vector<Id> all;
    std::vector<tsubu::rank_t> owners;

    dealt_ids(std::uint64_t seed, std::size_t count, std::size_t ranks) {
        tsubu::random_stream random(seed);
        std::set<Id> different;
        while (different.size() < count)
            different.insert(static_cast<Id>(random.below(3) == 0 ? random.below(1000) + 1 : random.below(2000000000)));
        for (const auto t : different) {
            all.push_back(t);
            owners.push_back(static_cast<tsubu::rank_t>(ranks == 1 ? 0 : random.below(ranks - 1)));
        }
    }
    [[nodiscard]] std::vector<Id> of(tsubu::rank_t rank) const {
        std::vector<Id> mine;
        for (std::size_t k = all.size(); k-- > 0;)  // not in order
            if (owners[k] == rank) mine.push_back(all[k]);
        return mine;
    }
};

template <class Id, class Transport, class Check>
void directory_finds_owners(Transport& on, std::uint64_t seed, Check&& check) {
    const dealt_ids<Id> dealt(seed, 300, on.ranks());
    const auto mine = dealt.of(on.rank());
    tsubu::id_directory<Id> owners;
    owners.rebuild(on, std::span<const Id>(mine));
    auto asked = dealt.all;
    if (on.rank() == 0) asked.clear();  // a rank without questions
    for (const auto t : {Id{0}, static_cast<Id>(-1)}) asked.push_back(t);
    const auto found = owners.find(on, std::span<const Id>(asked));
    check(found.size() == asked.size(), "directory: an answer for each question");
    for (std::size_t k = 0; k + 2 < asked.size(); ++k) check(found[k] == dealt.owners[k], "directory: the owner");
    check(found[found.size() - 1] == tsubu::no_rank && found[found.size() - 2] == tsubu::no_rank,
          "directory: ids that nobody owns");

    // An id that two ranks own, or one twice, is refused on all; the directory stays as it was.
    auto doubled = mine;
    if (on.rank() == 0) doubled.push_back(dealt.all.back());
    const auto message =
        thrown<tsubu::error>([&] { owners.rebuild(on, std::span<const Id>(doubled)); });
    check(message != "nothing was thrown", "directory: a duplicate is refused on all ranks");
    const auto still = owners.find(on, std::span<const Id>(dealt.all));
    check(std::equal(still.begin(), still.end(), dealt.owners.begin()), "directory: as before after a refusal");
}

template <class Id, class Transport, class Check>
void new_ids_never_collide(Transport& on, std::uint64_t seed, Check&& check) {
    const dealt_ids<Id> dealt(seed, 50, on.ranks());
    const auto mine = dealt.of(on.rank());
    auto ids = tsubu::new_ids<Id>::above(on, std::span<const Id>(mine));
    std::set<std::uint64_t> seen(dealt.all.begin(), dealt.all.end());
    std::uint64_t handed_out = 0;
    for (int round = 0; round < 5; ++round) {
        if (round == 3) ids = tsubu::new_ids<Id>(ids.next());  // as after a restart
        const auto count = (on.rank() + static_cast<std::size_t>(round)) % 3;
        const auto first = ids.take(on, count);
        std::vector<std::uint64_t> words;
        for (std::size_t k = 0; k < count; ++k) words.push_back(static_cast<std::uint64_t>(first) + k);
        std::uint64_t last = 0;
        for (const auto& [rank, told] : on.gather(words))
            for (const auto t : told) {
                check(seen.insert(t).second, "new ids: each once");
                check(last == 0 || t == last + 1, "new ids: one after the other over the ranks");
                last = t;
                ++handed_out;
            }
    }
    const auto greatest = static_cast<std::uint64_t>(*std::max_element(dealt.all.begin(), dealt.all.end()));
    check(ids.next() == greatest + 1 + handed_out, "new ids: without gaps");
    tsubu::new_ids<std::int32_t> few(2147483640);
    check(says(thrown<tsubu::limit_error>([&] { static_cast<void>(few.take(on, on.rank() == 0 ? 9 : 0)); }), "9 ids"),
          "new ids: refused past the type");
    check(few.take(on, 0) == 2147483640, "new ids: none was handed out by a refusal");
    const auto last = static_cast<tsubu::rank_t>(on.ranks() - 1);
    check(few.take(on, on.rank() == last ? 8 : 0) == 2147483640, "new ids: up to the last of the type");
    check(few.next() == 2147483648, "new ids: then there is none left");
    const auto is_refused = [&](auto& ids_left) {
        return thrown<tsubu::limit_error>([&] { static_cast<void>(ids_left.take(on, 1)); }) != "nothing was thrown";
    };
    check(is_refused(few), "new ids: none past the last");
    static_cast<void>(few.take(on, 0));
    constexpr auto greatest_word = (std::numeric_limits<std::uint64_t>::max)();
    tsubu::new_ids<std::uint64_t> words(greatest_word - 1);
    check(words.take(on, on.rank() == last ? 1 : 0) == greatest_word - 1, "new ids: words up to 2^64 - 2");
    check(is_refused(words), "new ids: those that are handed out do not begin anew");
    std::vector<std::uint64_t> top;
    if (on.rank() == last) top.push_back(greatest_word);
    check(thrown<tsubu::error>([&] { static_cast<void>(tsubu::new_ids<std::uint64_t>::above(on, top)); }) !=
              "nothing was thrown",
          "new ids: none is above 2^64 - 1");
}

template <class Id, class Transport, class Check>
void renumbering_depends_on_ids_alone(Transport& on, std::uint64_t seed, Check&& check) {
    const dealt_ids<Id> dealt(seed, 300, on.ranks());
    const auto mine = dealt.of(on.rank());
    const auto fresh = tsubu::renumbered(on, mine, Id{7});
    check(fresh.size() == mine.size(), "renumbered: one for each");
    for (std::size_t k = 0; k < fresh.size(); ++k) {
        const auto place = std::lower_bound(dealt.all.begin(), dealt.all.end(), mine[k]) - dealt.all.begin();
        check(fresh[k] == static_cast<Id>(place + 7), "renumbered: in the order of the ids");
    }
    auto doubled = mine;
    if (on.rank() == 0) doubled.push_back(dealt.all.front());
    check(thrown<tsubu::error>([&] { static_cast<void>(tsubu::renumbered(on, doubled)); }) != "nothing was thrown",
          "renumbered: a duplicate is refused on all ranks");
    check(thrown<tsubu::error>([&] { static_cast<void>(tsubu::renumbered(on, mine, Id{-5})); }) !=
              "nothing was thrown",
          "renumbered: not from a negative id on");
    if (on.ranks() == 1) return;
    const auto own_first = static_cast<Id>(on.rank() == 0 ? 4 : 3);
    check(says(thrown<tsubu::input_error>([&] { static_cast<void>(tsubu::renumbered(on, mine, own_first)); }),
               "3 on one rank, and 4 on another"),
          "renumbered: the first id is the same on all ranks");
    const std::vector<Id> none;
    check(tsubu::renumbered(on, on.rank() == 0 ? std::span<const Id>(mine) : std::span<const Id>(none)).size() ==
              (on.rank() == 0 ? mine.size() : 0),
          "renumbered: ranks without particles");
}

template <class Transport, class Check>
void duplicates_are_told(Transport& on, std::uint64_t seed, Check&& check) {
    tsubu::random_stream random(seed);
    std::map<std::int64_t, std::vector<tsubu::rank_t>> owners;
    std::vector<std::int64_t> mine;
    for (tsubu::rank_t rank = 0; rank < on.ranks(); ++rank)
        for (auto k = random.below(40); k > 0; --k) {
            const auto t = static_cast<std::int64_t>(random.below(60));
            owners[t].push_back(rank);
            if (rank == on.rank()) mine.push_back(t);
        }
    std::vector<tsubu::duplicate_id<std::int64_t>> expected;
    std::size_t total = 0;
    for (const auto& [t, ranks] : owners) {
        if (ranks.size() < 2) continue;
        ++total;
        if (std::find(ranks.begin(), ranks.end(), on.rank()) != ranks.end())
            expected.push_back({t, ranks.front(), ranks.back()});
    }
    const auto found = tsubu::duplicate_ids(on, std::span<const std::int64_t>(mine));
    check(found.total == total, "duplicates: their number");
    check(found.here == expected, "duplicates: told to those that own them");
}

/// Whatever the ids lie in: twice the same in each.
template <class Transport, class Check>
void ids_lie_in_a_row(Transport& on, Check&& check) {
    const auto first = std::int64_t{1000} * on.rank();
    std::vector<std::int64_t> in_vector{first + 3, first + 1, first + 2};
    const std::array<std::int64_t, 3> in_array{first + 3, first + 1, first + 2};
    const std::int64_t in_plain_array[] = {first + 3, first + 1, first + 2};
    const auto expected = tsubu::renumbered(on, in_vector);
    const auto is_same = [&](const auto& ids) {
        return tsubu::duplicate_ids(on, ids).empty() && tsubu::renumbered(on, ids) == expected;
    };
    check(is_same(std::span<std::int64_t>(in_vector)), "a row: span");
    check(is_same(std::span<const std::int64_t>(in_vector)), "a row: span of const");
    check(is_same(in_array), "a row: array");
    check(is_same(in_plain_array), "a row: plain array");
    in_vector[0] = in_vector[1];
    check(tsubu::duplicate_ids(on, in_vector).total == on.ranks(), "a row: vector");
}

template <class Transport, class Check>
void ids_are_served(Transport& on, Check&& check) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        directory_finds_owners<std::int64_t>(on, seed, check);
        directory_finds_owners<std::uint32_t>(on, seed, check);
        new_ids_never_collide<std::int64_t>(on, seed, check);
        renumbering_depends_on_ids_alone<std::int64_t>(on, seed, check);
        renumbering_depends_on_ids_alone<std::int32_t>(on, seed, check);
        duplicates_are_told(on, seed, check);
    }
    ids_lie_in_a_row(on, check);
    // There is no number for the last one.
    const auto before = 2 * static_cast<std::int32_t>(on.rank());
    const std::vector<std::int32_t> short_ids{before, before + 1};
    const auto top = std::numeric_limits<std::int32_t>::max() - 2 * static_cast<std::int32_t>(on.ranks()) + 1;
    check(tsubu::renumbered(on, short_ids, top)[1] == top + before + 1, "renumbered: up to the last of the type");
    check(thrown<tsubu::limit_error>([&] { static_cast<void>(tsubu::renumbered(on, short_ids, top + 1)); }) !=
              "nothing was thrown",
          "renumbered: refused past the type");
    std::vector<std::int64_t> ids{5, 6};
    if (on.rank() + 1 == on.ranks()) ids[1] = -3;
    const std::span<const std::int64_t> negative(ids);
    tsubu::id_directory<> owners;
    const auto refused = [&](auto&& call) { return thrown<tsubu::error>(call) != "nothing was thrown"; };
    check(refused([&] { owners.rebuild(on, negative); }), "directory: a negative id is refused on all");
    check(refused([&] { static_cast<void>(tsubu::new_ids<>::above(on, negative)); }), "new ids: so it is");
    check(refused([&] { static_cast<void>(tsubu::renumbered(on, negative)); }), "renumbered: so it is");
    check(refused([&] { static_cast<void>(tsubu::duplicate_ids(on, negative)); }), "duplicates: so it is");
}

}  // namespace comm_laws
