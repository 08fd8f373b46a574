// SPDX-License-Identifier: MIT
/// @file
/// Which ids are owned more than once, over all ranks?
#pragma once

#include <tsubu/comm/detail/agreed_exchange.hpp>
#include <tsubu/comm/detail/home_calls.hpp>
#include <tsubu/comm/detail/id_list.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::sort
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <map>        // std::map
#include <span>       // std::span
#include <utility>    // std::pair
#include <vector>     // std::vector

namespace tsubu {

// Each id has a home: rank splitmix64(id) mod P. Every rank sends its ids there, once, or twice if it owns two copies
// or more; so a home gets about N_total / P ids whatever they look like, and no id comes more than 2 P times, even if
// every particle carries the same. Home sorts them, and tells those ranks that hold a duplicate, and nobody else:
// gathered on all ranks, a file that was read twice would put all its ids on each of them.

/// An id that more than one particle owns. One rank alone (first_rank == last_rank) owns it twice or more; which
/// indices, owned_duplicates (id/copies.hpp) tells there.
template <particle_id Id>
struct duplicate_id {
    Id id;
    rank_t first_rank;  ///< the lowest rank that owns it
    rank_t last_rank;   ///< the highest rank that owns it
    friend constexpr bool operator==(const duplicate_id&, const duplicate_id&) = default;
};

/// The answer of duplicate_ids on one rank.
template <particle_id Id>
struct duplicate_report {
    std::vector<duplicate_id<Id>> here;  ///< duplicates that this rank owns a copy of, by increasing id
    std::uint64_t total = 0;             ///< different ids that are owned more than once; the same on all ranks

    /// The same on all ranks, so that all can stop together.
    [[nodiscard]] bool empty() const noexcept { return total == 0; }
};

namespace detail {

/// Ids of this rank, each at most twice.
template <particle_id Id>
[[nodiscard]] std::vector<Id> at_most_twice(std::span<const Id> owned) {
    check_ids("duplicate_ids", owned);
    std::vector<Id> sorted(owned.begin(), owned.end());
    std::sort(sorted.begin(), sorted.end());
    std::size_t kept = 0;
    for (const auto t : sorted)
        if (kept < 2 || sorted[kept - 2] != t) sorted[kept++] = t;
    sorted.resize(kept);
    return sorted;
}

/// At home: id, first and last rank of each duplicate, for each rank that is to be told.
class duplicates_at_home {
public:
    duplicates_at_home() = default;
    explicit duplicates_at_home(const mailbox& came) {
        std::vector<std::pair<std::uint64_t, rank_t>> copies;
        copies.reserve(came.words());
        for (const auto& [from, ids] : came)
            for (const auto t : ids) copies.emplace_back(t, from);
        std::sort(copies.begin(), copies.end());
        for (std::size_t first = 0, end = 0; first < copies.size(); first = end) {
            while (end < copies.size() && copies[end].first == copies[first].first) ++end;
            if (end - first == 1) continue;
            ++total_;
            for (auto k = first; k < end; ++k)
                if (k == first || copies[k].second != copies[k - 1].second)
                    told_[copies[k].second].insert(told_[copies[k].second].end(),
                                                   {copies[first].first, copies[first].second, copies[end - 1].second});
        }
    }
    void add_parcels(std::vector<parcel>& parcels) const {
        for (const auto& [rank, words] : told_) parcels.push_back({rank, words});
    }
    /// Different duplicates whose home is here.
    [[nodiscard]] std::uint64_t total() const noexcept { return total_; }

private:
    std::map<rank_t, std::vector<std::uint64_t>> told_;
    std::uint64_t total_ = 0;
};

}  // namespace detail

/// Which ids are owned more than once, over all ranks?
///
///     auto twice = tsubu::duplicate_ids(on, ids_of_owned);                     // rank 0 {1, 2}, rank 1 {2, 3}
///     for (auto d : twice.here) print(d.id, d.first_rank, d.last_rank);        // on ranks 0 and 1: 2 0 1
///     if (!twice.empty()) stop();                                              // the same on all ranks
///
/// For reading and for tests, not for every step: all ids travel once.
///
/// @param owned  ids of the owned particles of this rank, no ghosts, in any order: a vector, a span, an array
/// @throws on all ranks, or on none: input_error if one rank passes a negative id; limit_error if one is out of memory
///         (that rank itself: std::bad_alloc); what the transport throws.
/// Complexity:  O(n log n) with n = N_total / P; 8 bytes sent and 24 held per owned id.
/// Collective:  yes; Id must be the same on all ranks. A message of about 8 n / P bytes to each rank, one to each that
///              is told, five reductions. The result does not depend on the order in which messages arrive.
/// Source:      A13.
template <transport Transport, detail::id_list Ids>
[[nodiscard]] duplicate_report<detail::element_of<Ids>> duplicate_ids(Transport& on, const Ids& owned) {
    using Id = detail::element_of<Ids>;
    constexpr auto where = "duplicate_ids";
    detail::home_calls calls;
    detail::duplicates_at_home found;
    detail::agreed_exchange(
        on, where,
        [&](std::vector<parcel>& parcels) {
            const auto ids = detail::at_most_twice(detail::span_of(owned));
            calls = detail::home_calls(std::span<const Id>(ids), on.ranks(),
                                       [&](Id t) { return detail::home_of(t, on.ranks()); });
            calls.add_parcels(parcels);
        },
        [&](const mailbox& came) { found = detail::duplicates_at_home(came); });
    duplicate_report<Id> report;
    detail::agreed_exchange(
        on, where, [&](std::vector<parcel>& parcels) { found.add_parcels(parcels); },
        [&](const mailbox& came) {
            for (const auto& [home, words] : came)
                for (std::size_t k = 0; k < words.size(); k += 3)
                    report.here.push_back({static_cast<Id>(words[k]), static_cast<rank_t>(words[k + 1]),
                                           static_cast<rank_t>(words[k + 2])});
            std::sort(report.here.begin(), report.here.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
        });
    std::uint64_t total[] = {found.total()};
    on.reduce(std::span<std::uint64_t>(total), reduction::sum);
    report.total = total[0];
    return report;
}

}  // namespace tsubu
