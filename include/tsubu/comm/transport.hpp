// SPDX-License-Identifier: MIT
/// @file
/// transport: how the ranks of a simulation reach each other; and the table of the models.
///
/// | transport       | ranks                            | choose it when                                              |
/// |-----------------|----------------------------------|-------------------------------------------------------------|
/// | self_transport  | one                              | the program runs in one process: periodic images of itself  |
/// | local_transport | threads of one process           | many ranks are to be tested, under sanitizers, without MPI  |
/// | mpi_transport   | processes (<tsubu/mpi.hpp>)      | there is MPI                                                |
#pragma once

#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/message_memory.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <concepts>  // std::constructible_from, std::move_constructible, std::same_as
#include <cstddef>   // std::size_t
#include <cstdint>   // std::uint64_t
#include <span>      // std::span
#include <vector>    // std::vector

namespace tsubu {

/// How the numbers of all ranks become one.
enum class reduction { sum, least, greatest };

/// So many words to, or from, a rank, again and again.
struct lane {
    rank_t rank;
    std::size_t words;
};

/// Thrown on a rank that waits for one that has returned, or ended by an exception.
class lost_rank_error : public error {
public:
    using error::error;
};

/// Messages of 64-bit words between ranks. 1 to 4 and the making of channels are collective: every rank calls them, in
/// the same order, with as many sums or numbers; a message may go to any rank, this one included.
///  1. exchange(parcels, sums): each parcel arrives once, whole, at its rank, which need not know of it before; the
///     mailbox has what came by rank of the sender, of one sender in the order of its parcels. Each of the sums becomes
///     that over all ranks, modulo 2^64; so they do if it throws on a rank, std::bad_alloc where there is no room
///     for what goes or came. Cost: the messages that are sent, and one reduction;
///  2. reduce(numbers, how) makes each number the sum, the least or the greatest over all ranks, the same on all;
///  3. gather(words) has one parcel from each rank, in their order. Where there is no room for them it throws
///     std::bad_alloc when it is over, and may throw limit_error on the others then;
///  4. sum_before(n) is the sum over the ranks below this one;
///  5. channel(on, tag, out, in) brings words(out) of this rank to the others with every start(), and has theirs in
///     words(in) after finish(). Both are laid out lane by lane; the words that go out are left alone in between, and
///     each start() is finished before the next. Ranks make matching channels, with one tag, and the two ends of a lane
///     start it equally often; next_tag() is the same on all ranks. A lane has another rank than this one. The
///     transport outlives its channels;
///  6. memory() is what messages of this rank are made in.
/// A rank that has thrown is waited for by none: see agreement for errors that all ranks are to learn of.
template <class Transport>
concept transport = requires(Transport& on, const Transport& here, std::span<const parcel> parcels,
                             std::span<std::uint64_t> sums, std::span<double> numbers,
                             std::span<const std::uint64_t> words, std::vector<lane> lanes,
                             typename Transport::channel& way) {
    { here.rank() } noexcept -> std::same_as<rank_t>;
    { here.ranks() } noexcept -> std::same_as<std::size_t>;
    { on.exchange(parcels, sums) } -> std::same_as<mailbox>;
    on.reduce(sums, reduction::sum);
    on.reduce(numbers, reduction::greatest);
    { on.gather(words) } -> std::same_as<mailbox>;
    { on.sum_before(std::uint64_t{}) } -> std::same_as<std::uint64_t>;
    { on.next_tag() } -> std::same_as<int>;
    { on.memory() } noexcept -> std::same_as<message_memory&>;
    requires std::constructible_from<typename Transport::channel, Transport&, int, std::vector<lane>,
                                     std::vector<lane>>;
    requires std::move_constructible<typename Transport::channel>;
    { way.out() } -> std::same_as<std::span<std::uint64_t>>;
    { way.in() } -> std::same_as<std::span<const std::uint64_t>>;
    way.start();
    way.finish();
};

namespace detail {

/// All words of some lanes.
[[nodiscard]] inline std::size_t words_of(const std::vector<lane>& lanes) noexcept {
    std::size_t words = 0;
    for (const auto& one : lanes) words += one.words;
    return words;
}

}  // namespace detail
}  // namespace tsubu
