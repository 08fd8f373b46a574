// SPDX-License-Identifier: MIT
/// @file
/// Values for every rank, exchanged in one MPI_Alltoallv.
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/comm/detail/own_communicator.hpp>
#include <tsubu/comm/mpi_error.hpp>
#include <tsubu/core/error.hpp>

#include <cstddef>      // std::size_t
#include <limits>       // std::numeric_limits
#include <string>       // std::to_string
#include <type_traits>  // std::is_trivially_copyable_v
#include <vector>       // std::vector

namespace tsubu::detail {

/// What goes to, or came from, each rank: `counts[r]` values for rank r, in the order of the ranks.
template <class Value>
struct parcels {
    std::vector<Value> values;
    std::vector<std::size_t> counts;
};

/// Counts and displacements of MPI are int.
inline constexpr std::size_t max_message_count = static_cast<std::size_t>((std::numeric_limits<int>::max)());

/// A value as MPI sees it: its bytes. All ranks run on machines of the same representation.
template <class Value>
class byte_type {
    static_assert(std::is_trivially_copyable_v<Value>, "only plain values travel as bytes");

public:
    byte_type() {
        check_mpi(MPI_Type_contiguous(static_cast<int>(sizeof(Value)), MPI_BYTE, &type_), "MPI_Type_contiguous");
        check_mpi(MPI_Type_commit(&type_), "MPI_Type_commit");
    }
    byte_type(const byte_type&) = delete;
    byte_type& operator=(const byte_type&) = delete;
    ~byte_type() { MPI_Type_free(&type_); }
    [[nodiscard]] MPI_Datatype get() const noexcept { return type_; }

private:
    MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// Sends each rank its parcel and returns what came.
///
/// @param max_count  most values that one rank may send or receive; tests pass less than max_message_count
/// @throws limit_error on all ranks if one of them exceeds max_count or its memory; nothing has been sent then
/// Collective: yes; one alltoall of 4 bytes per rank, one alltoallv, two allreduces.
template <class Value>
[[nodiscard]] parcels<Value> exchange(const own_communicator& on, const parcels<Value>& outgoing, const char* where,
                                      std::size_t max_count = max_message_count) {
    const auto ranks = static_cast<std::size_t>(on.size());
    const auto check_count = [&](std::size_t count, const char* verb) {
        if (count > max_count)
            raise<limit_error>(where,
                               "rank " + std::to_string(on.rank()) + " would " + verb + " " + std::to_string(count) +
                                   " values, one exchange carries " + std::to_string(max_count),
                               "spread the particles over more ranks");
    };
    struct layout {
        std::vector<int> counts, offsets;
    } send, receive;
    const auto place = [ranks](layout& of) {
        for (std::size_t r = 1; r < ranks; ++r) of.offsets[r] = of.offsets[r - 1] + of.counts[r - 1];
    };
    on.all_or_none(where, [&] {
        check_count(outgoing.values.size(), "send");
        for (auto* side : {&send, &receive}) {
            side->counts.resize(ranks);
            side->offsets.resize(ranks);
        }
        for (std::size_t r = 0; r < ranks; ++r) send.counts[r] = static_cast<int>(outgoing.counts[r]);
        place(send);
    });
    check_mpi(MPI_Alltoall(send.counts.data(), 1, MPI_INT, receive.counts.data(), 1, MPI_INT, on.get()),
              "MPI_Alltoall");

    parcels<Value> incoming;
    on.all_or_none(where, [&] {
        incoming.counts.assign(receive.counts.begin(), receive.counts.end());
        std::size_t total = 0;
        for (const auto count : incoming.counts) total += count;
        check_count(total, "receive");
        place(receive);
        incoming.values.resize(total);
    });
    const byte_type<Value> type;
    check_mpi(MPI_Alltoallv(outgoing.values.data(), send.counts.data(), send.offsets.data(), type.get(),
                            incoming.values.data(), receive.counts.data(), receive.offsets.data(), type.get(),
                            on.get()),
              "MPI_Alltoallv");
    return incoming;
}

}  // namespace tsubu::detail
