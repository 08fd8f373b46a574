// SPDX-License-Identifier: MIT
/// @file
/// Which ids are owned more than once, over all ranks?
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/comm/detail/own_communicator.hpp>
#include <tsubu/comm/detail/parcels.hpp>
#include <tsubu/comm/mpi_error.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::sort
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::pair, std::move
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
    int first_rank;  ///< the lowest rank that owns it
    int last_rank;   ///< the highest rank that owns it
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

/// Ids of this rank, each at most twice, ordered by their homes.
template <particle_id Id>
[[nodiscard]] parcels<Id> ids_for_their_homes(std::span<const Id> owned, int rank_count) {
    for (std::size_t i = 0; i < owned.size(); ++i)
        if (is_negative(owned[i]))
            raise<input_error>("duplicate_ids",
                               "the id at index " + std::to_string(i) + " is " + std::to_string(owned[i]),
                               "ids of particles are 0 or greater");
    const auto home = [ranks = static_cast<std::uint64_t>(rank_count)](Id t) {
        return static_cast<std::size_t>(splitmix64(static_cast<std::uint64_t>(t)) % ranks);
    };
    std::vector<Id> sorted(owned.begin(), owned.end());
    std::sort(sorted.begin(), sorted.end());
    std::size_t kept = 0;
    for (const auto t : sorted)
        if (kept < 2 || sorted[kept - 2] != t) sorted[kept++] = t;
    sorted.resize(kept);

    parcels<Id> outgoing;
    outgoing.counts.assign(static_cast<std::size_t>(rank_count), 0);
    for (const auto t : sorted) ++outgoing.counts[home(t)];
    std::vector<std::size_t> next(outgoing.counts.size(), 0);
    for (std::size_t r = 1; r < next.size(); ++r) next[r] = next[r - 1] + outgoing.counts[r - 1];
    outgoing.values.resize(kept);
    for (const auto t : sorted) outgoing.values[next[home(t)]++] = t;
    return outgoing;
}

/// At home: what each rank must be told. @param[out] total  number of different duplicates whose home is here
template <particle_id Id>
[[nodiscard]] parcels<duplicate_id<Id>> duplicates_at_home(const parcels<Id>& incoming, std::uint64_t& total) {
    std::vector<std::pair<Id, int>> copies;
    copies.reserve(incoming.values.size());
    std::size_t at = 0;
    for (std::size_t r = 0; r < incoming.counts.size(); ++r)
        for (std::size_t k = 0; k < incoming.counts[r]; ++k)
            copies.emplace_back(incoming.values[at++], static_cast<int>(r));
    std::sort(copies.begin(), copies.end());

    std::vector<std::pair<int, duplicate_id<Id>>> told;
    for (std::size_t first = 0, end = 0; first < copies.size(); first = end) {
        while (end < copies.size() && copies[end].first == copies[first].first) ++end;
        if (end - first == 1) continue;
        ++total;
        const duplicate_id<Id> found{copies[first].first, copies[first].second, copies[end - 1].second};
        for (auto k = first; k < end; ++k)
            if (k == first || copies[k].second != copies[k - 1].second) told.emplace_back(copies[k].second, found);
    }
    std::sort(told.begin(), told.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second.id < b.second.id;
    });
    parcels<duplicate_id<Id>> outgoing;
    outgoing.counts.assign(incoming.counts.size(), 0);
    outgoing.values.reserve(told.size());
    for (const auto& [rank, found] : told) {
        ++outgoing.counts[static_cast<std::size_t>(rank)];
        outgoing.values.push_back(found);
    }
    return outgoing;
}

/// @param max_count  most values that one rank may send or receive; less than the limit of MPI only in tests
template <particle_id Id>
[[nodiscard]] duplicate_report<Id> find_duplicate_ids(MPI_Comm over, std::span<const Id> owned, std::size_t max_count) {
    constexpr auto where = "duplicate_ids";
    const own_communicator on(over, where);
    parcels<Id> ids;
    on.all_or_none(where, [&] { ids = ids_for_their_homes(owned, on.size()); });
    ids = exchange(on, ids, where, max_count);

    std::uint64_t at_home = 0;
    parcels<duplicate_id<Id>> told;
    on.all_or_none(where, [&] { told = duplicates_at_home(ids, at_home); });
    told = exchange(on, told, where, max_count);

    duplicate_report<Id> report{std::move(told.values), 0};
    std::sort(report.here.begin(), report.here.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    check_mpi(MPI_Allreduce(&at_home, &report.total, 1, MPI_UINT64_T, MPI_SUM, on.get()), "MPI_Allreduce");
    return report;
}

}  // namespace detail

/// Which ids are owned more than once, over all ranks?
///
///     auto twice = tsubu::duplicate_ids<std::int64_t>(comm, ids_of_owned);     // rank 0 {1, 2}, rank 1 {2, 3}
///     for (auto d : twice.here) print(d.id, d.first_rank, d.last_rank);        // on ranks 0 and 1: 2 0 1
///     if (!twice.empty()) stop();                                              // the same on all ranks
///
/// For reading and for tests, not for every step: all ids travel once.
///
/// @param over   any intracommunicator; it is duplicated for the call, its error handler stays as it is
/// @param owned  ids of the owned particles of this rank, no ghosts, in any order
/// @throws on all ranks, or on none: input_error if one rank passes a negative id; limit_error if one would send or
///         receive 2^31 values or more, or is out of memory (that rank itself: std::bad_alloc). mpi_error where MPI
///         reports an error, which may be on some ranks only.
/// Complexity:  O(n log n) with n = N_total / P; 8 bytes sent and 24 held per owned id of 64 bits.
/// Collective:  yes, over `over`; Id must be the same on all ranks. A duplication of the communicator, two alltoall of
///              4 bytes per pair of ranks, two alltoallv (about 8 n / P bytes to each rank, then what is told), seven
///              allreduces of 8 bytes. The result does not depend on the order in which messages arrive.
/// Threads:     one call at a time per communicator.
/// Source:      A13.
template <particle_id Id>
[[nodiscard]] duplicate_report<Id> duplicate_ids(MPI_Comm over, std::span<const Id> owned) {
    return detail::find_duplicate_ids(over, owned, detail::max_message_count);
}

}  // namespace tsubu
