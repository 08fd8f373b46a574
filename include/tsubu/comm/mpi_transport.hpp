// SPDX-License-Identifier: MIT
/// @file
/// mpi_transport: the ranks of a communicator.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/comm/detail/own_communicator.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/message_memory.hpp>
#include <tsubu/comm/mpi_error.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::copy_n
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <exception>  // std::current_exception, std::exception_ptr, std::rethrow_exception
#include <memory>     // std::make_unique, std::unique_ptr
#include <new>        // std::bad_alloc
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::exchange, std::move, std::swap
#include <vector>     // std::vector

namespace tsubu {
namespace detail {

/// Requests that start together, again and again; freed with the object.
class persistent_requests {
public:
    persistent_requests() = default;
    persistent_requests(persistent_requests&& other) noexcept
        : requests_(std::exchange(other.requests_, {})), are_active_(other.are_active_) {}
    persistent_requests& operator=(persistent_requests&& other) noexcept {
        std::swap(requests_, other.requests_);
        std::swap(are_active_, other.are_active_);
        return *this;
    }
    ~persistent_requests() {
        for (auto& one : requests_)
            if (one != MPI_REQUEST_NULL) MPI_Request_free(&one);
    }
    [[nodiscard]] MPI_Request& add() { return requests_.emplace_back(MPI_REQUEST_NULL); }
    /// One after the other: MPI_Startall may start the pieces of a message in any order, and all have one tag.
    void start() {
        are_active_ = true;
        for (auto& one : requests_) check_mpi(MPI_Start(&one), "MPI_Start");
    }
    void wait() {
        if (!requests_.empty()) check_mpi(MPI_Waitall(count(), requests_.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
        are_active_ = false;
    }
    [[nodiscard]] bool are_active() const noexcept { return are_active_ && !requests_.empty(); }

private:
    [[nodiscard]] int count() const noexcept { return static_cast<int>(requests_.size()); }

    std::vector<MPI_Request> requests_;
    bool are_active_ = false;
};

}  // namespace detail

/// The ranks of an MPI communicator.
///
///     tsubu::mpi_transport on(MPI_COMM_WORLD);   // or any other; it is duplicated, and freed with the object
///     tsubu::migrate(particles, parts, on);
///
/// Its messages and errors never meet those of the program: they go over a communicator of its own, whose errors come
/// as mpi_error. The program has MPI running before, and ends it after; mpi_environment does both.
///
/// Concept:      transport.
/// Cost:         exchange: a message per parcel, and one reduction that tells when all have come, so that nobody needs
///               to know who sends (NBX); channel: persistent requests, started and waited for, nothing else.
/// Deterministic: yes, but for the rounding of sums of floating-point numbers, which is the MPI library's.
/// Choose it when the program runs under mpirun. Do not in tests of exchange logic: local_transport has sanitizers.
/// Collective:   construction and destruction.
/// Threads:      one at a time.
/// Source:       Hoefler, Siebert & Lumsdaine 2010, "Scalable communication protocols for dynamic sparse data
///               exchange", doi:10.1145/1693453.1693476.
class mpi_transport {
public:
    /// @param most_words  of one message, the same on all ranks; longer ones are sent in pieces. 2^27 words are 1 GiB,
    ///                    below the 2 GiB at which implementations begin to fail.
    /// @throws input_error if MPI is not running, or the communicator is null or an intercommunicator; on all ranks, if
    ///         most_words is not the same, or not 1 to 2^31 - 1; mpi_error.
    explicit mpi_transport(MPI_Comm over, std::size_t most_words = std::size_t{1} << 27)
        : own_(over, "mpi_transport"),
          most_words_(most_words),
          counts_(ranks()),
          lengths_(ranks()),
          places_(ranks()) {
        std::uint64_t ends[] = {most_words, ~std::uint64_t{most_words}};
        reduce(ends, reduction::greatest);
        const auto least = ~ends[1];
        if (least == 0 || ends[0] > most_count)
            detail::raise<input_error>("mpi_transport",
                                       std::to_string(least == 0 ? least : ends[0]) + " words per message",
                                       "give 1 to 2^31 - 1");
        if (least != ends[0])
            detail::raise<input_error>("mpi_transport",
                                       std::to_string(least) + " to " + std::to_string(ends[0]) + " words per message",
                                       "give the same on all ranks");
    }

    [[nodiscard]] rank_t rank() const noexcept { return static_cast<rank_t>(own_.rank()); }
    [[nodiscard]] std::size_t ranks() const noexcept { return static_cast<std::size_t>(own_.size()); }

    /// @throws when the exchange is over on all ranks: input_error if there is no such rank, std::bad_alloc if there is
    ///         no room for what goes, and nothing has gone then, or for what came; at once: mpi_error.
    [[nodiscard]] mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        // Who is through may begin the next exchange, while another still looks for messages of this one.
        const int tag = exchange_tag + std::exchange(parity_, 1 - parity_);
        incoming came{mailbox(memory_), mailbox(memory_), nullptr};
        std::vector<MPI_Request> sends;
        try {
            std::size_t pieces = 0;
            for (const auto& one : parcels) {
                detail::check_parcel("mpi_transport::exchange", one, ranks());
                if (one.rank == rank())
                    came.box.add(one);
                else
                    pieces += one.words.size() / most_words_ + 1;
            }
            sends.reserve(pieces);
        } catch (...) {  // the others count on this rank: it takes part, and sends nothing
            came.thrown = std::current_exception();
            parcels = {};
        }
        for (const auto& one : parcels)
            if (one.rank != rank())
                each_piece(one.words, [&](std::span<const std::uint64_t> piece) {
                    check_mpi(MPI_Issend(piece.data(), static_cast<int>(piece.size()), MPI_UINT64_T,
                                         static_cast<int>(one.rank), tag, own_.get(),
                                         &sends.emplace_back(MPI_REQUEST_NULL)),
                              "MPI_Issend");
                });

        // A send that was synchronous is over when its receiver has begun to take it. When those of this rank are, it
        // joins the reduction; when all ranks have joined, all messages have come.
        std::uint64_t nothing[1] = {0};
        if (sums.empty()) sums = nothing;  // a reduction of no numbers would wait for nobody
        check_count(sums.size(), "exchange");
        MPI_Request reduced = MPI_REQUEST_NULL;
        for (int done = 0; done == 0;) {
            receive_one(tag, came);
            if (reduced != MPI_REQUEST_NULL) {
                check_mpi(MPI_Test(&reduced, &done, MPI_STATUS_IGNORE), "MPI_Test");
                continue;
            }
            int sent = 0;
            check_mpi(MPI_Testall(static_cast<int>(sends.size()), sends.data(), &sent, MPI_STATUSES_IGNORE),
                      "MPI_Testall");
            if (sent != 0)
                check_mpi(MPI_Iallreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_UINT64_T,
                                         MPI_SUM, own_.get(), &reduced),
                          "MPI_Iallreduce");
        }
        if (came.thrown) std::rethrow_exception(came.thrown);
        return whole(came);
    }
    void reduce(std::span<std::uint64_t> numbers, reduction how) { reduce_as(numbers, MPI_UINT64_T, how); }
    void reduce(std::span<double> numbers, reduction how) { reduce_as(numbers, MPI_DOUBLE, how); }
    /// @throws limit_error on all ranks if they have 2^31 words or more in all; if one has no room for them,
    ///         std::bad_alloc there, and limit_error on the others; mpi_error.
    [[nodiscard]] mailbox gather(std::span<const std::uint64_t> words) {
        const std::uint64_t mine = words.size();
        check_mpi(MPI_Allgather(&mine, 1, MPI_UINT64_T, counts_.data(), 1, MPI_UINT64_T, own_.get()), "MPI_Allgather");
        std::uint64_t total = 0;
        for (const auto count : counts_) total += count;
        if (total > most_count)
            detail::raise<limit_error>("mpi_transport::gather", std::to_string(total) + " words from all ranks",
                                       "gather fewer than 2^31; exchange does not need all on one rank");
        for (std::size_t k = 0, at = 0; k < ranks(); at += counts_[k++]) {
            lengths_[k] = static_cast<int>(counts_[k]);
            places_[k] = static_cast<int>(at);
        }
        message_memory::array<std::uint64_t> all;
        mailbox came(memory_);
        agreement<> room(rank());
        room.attempt([&] {
            all = memory_.take<std::uint64_t>(static_cast<std::size_t>(total));
            for (std::size_t k = 0; k < ranks(); ++k)
                static_cast<void>(came.add(static_cast<rank_t>(k), static_cast<std::size_t>(counts_[k])));
        });
        reduce(room.words(), reduction::sum);
        room.settle("mpi_transport::gather");
        check_mpi(MPI_Allgatherv(words.data(), static_cast<int>(mine), MPI_UINT64_T, all.data(), lengths_.data(),
                                 places_.data(), MPI_UINT64_T, own_.get()),
                  "MPI_Allgatherv");
        for (std::size_t k = 0; k < ranks(); ++k) came.fill(k, all.data() + places_[k]);
        return came;
    }
    [[nodiscard]] std::uint64_t sum_before(std::uint64_t n) {
        std::uint64_t sum = 0;
        check_mpi(MPI_Exscan(&n, &sum, 1, MPI_UINT64_T, MPI_SUM, own_.get()), "MPI_Exscan");
        return rank() == 0 ? 0 : sum;  // what MPI leaves on rank 0 is undefined
    }
    [[nodiscard]] int next_tag() noexcept {
        constexpr int tags = 32767 - first_channel_tag;  // every implementation has so many
        return first_channel_tag + std::exchange(channels_, (channels_ + 1) % tags);
    }
    [[nodiscard]] message_memory& memory() noexcept { return memory_; }

    /// See transport.
    class channel {
    public:
        channel(mpi_transport& on, int tag, const std::vector<lane>& out, const std::vector<lane>& in)
            : out_words_(detail::words_of(out)),
              in_words_(detail::words_of(in)),
              out_(std::make_unique<std::uint64_t[]>(out_words_)),
              in_(std::make_unique<std::uint64_t[]>(in_words_)) {
            std::size_t at = 0;
            for (const auto& one : in) {
                on.each_piece(std::span(in_.get() + at, one.words), [&](std::span<std::uint64_t> piece) {
                    check_mpi(MPI_Recv_init(piece.data(), static_cast<int>(piece.size()), MPI_UINT64_T,
                                            static_cast<int>(one.rank), tag, on.own_.get(), &requests_.add()),
                              "MPI_Recv_init");
                });
                at += one.words;
            }
            at = 0;
            for (const auto& one : out) {
                on.each_piece(std::span(out_.get() + at, one.words), [&](std::span<std::uint64_t> piece) {
                    check_mpi(MPI_Send_init(piece.data(), static_cast<int>(piece.size()), MPI_UINT64_T,
                                            static_cast<int>(one.rank), tag, on.own_.get(), &requests_.add()),
                              "MPI_Send_init");
                });
                at += one.words;
            }
        }
        channel(channel&&) noexcept = default;
        ~channel() {
            // Messages that were started and not waited for still read and write this memory: it stays, for good. To
            // wait here could be for ever.
            if (!requests_.are_active()) return;
            static_cast<void>(out_.release());
            static_cast<void>(in_.release());
        }

        [[nodiscard]] std::span<std::uint64_t> out() noexcept { return {out_.get(), out_words_}; }
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept { return {in_.get(), in_words_}; }
        void start() { requests_.start(); }
        void finish() { requests_.wait(); }

    private:
        std::size_t out_words_;
        std::size_t in_words_;
        std::unique_ptr<std::uint64_t[]> out_;
        std::unique_ptr<std::uint64_t[]> in_;
        detail::persistent_requests requests_;  // last: freed before the memory that they use
    };

private:
    static constexpr int exchange_tag = 0;
    static constexpr int first_channel_tag = 2;
    static constexpr std::size_t most_count = 2147483647;  // of an int of MPI

    static void check_mpi(int code, const char* call) { detail::check_mpi(code, call); }

    // Pieces of most_words, and a last one that is shorter, perhaps empty: that it is shorter tells that it is the
    // last.
    template <class Word, class Body>
    void each_piece(std::span<Word> words, Body&& body) const {
        for (; words.size() >= most_words_; words = words.subspan(most_words_)) body(words.first(most_words_));
        body(words);
    }

    // What has come so far.
    struct incoming {
        mailbox box;  // of parcels of this rank to itself; in the end of all
        mailbox pieces;  // of one sender in their order
        std::exception_ptr thrown;
    };
    void receive_one(int tag, incoming& came) {
        int found = 0;
        MPI_Message message = MPI_MESSAGE_NULL;
        MPI_Status status;
        check_mpi(MPI_Improbe(MPI_ANY_SOURCE, tag, own_.get(), &found, &message, &status), "MPI_Improbe");
        if (found == 0) return;
        int count = 0;
        check_mpi(MPI_Get_count(&status, MPI_UINT64_T, &count), "MPI_Get_count");
        std::span<std::uint64_t> room;
        try {
            room = came.pieces.add(static_cast<rank_t>(status.MPI_SOURCE), static_cast<std::size_t>(count));
        } catch (const std::bad_alloc&) {
            // It is taken and thrown away, or its sender would wait for ever.
            came.thrown = std::current_exception();
            const int code = MPI_Mrecv(nullptr, 0, MPI_UINT64_T, &message, MPI_STATUS_IGNORE);
            int kind = MPI_SUCCESS;
            MPI_Error_class(code, &kind);
            if (kind != MPI_ERR_TRUNCATE) check_mpi(code, "MPI_Mrecv");
            return;
        }
        check_mpi(MPI_Mrecv(room.data(), count, MPI_UINT64_T, &message, MPI_STATUS_IGNORE), "MPI_Mrecv");
    }
    // Joins the pieces of each parcel.
    [[nodiscard]] mailbox whole(incoming& came) const {
        auto& pieces = came.pieces;
        pieces.sort();
        mailbox box = std::move(came.box);
        for (std::size_t first = 0, last = 0; first < pieces.size(); first = last + 1) {
            std::size_t words = 0;
            for (last = first; pieces[last].words.size() == most_words_; ++last) words += most_words_;
            words += pieces[last].words.size();
            if (last == first) {
                box.add(pieces[first].rank, pieces.take(first));
                continue;
            }
            auto* to = box.add(pieces[first].rank, words).data();
            for (auto k = first; k <= last; ++k)
                to = std::copy_n(pieces[k].words.data(), pieces[k].words.size(), to);
        }
        box.sort();
        return box;
    }
    static void check_count(std::size_t count, const char* where) {
        if (count > most_count)
            detail::raise<limit_error>(("mpi_transport::" + std::string(where)).c_str(),
                                       std::to_string(count) + " numbers to reduce", "give fewer than 2^31");
    }
    template <class Number>
    void reduce_as(std::span<Number> numbers, MPI_Datatype type, reduction how) const {
        check_count(numbers.size(), "reduce");
        const auto operation = how == reduction::sum ? MPI_SUM : how == reduction::least ? MPI_MIN : MPI_MAX;
        check_mpi(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), type, operation,
                                own_.get()),
                  "MPI_Allreduce");
    }

    detail::own_communicator own_;
    std::size_t most_words_;
    message_memory memory_;
    std::vector<std::uint64_t> counts_;  // for gather [ranks], there from the beginning
    std::vector<int> lengths_;
    std::vector<int> places_;
    int parity_ = 0;
    int channels_ = 0;
};
static_assert(transport<mpi_transport>);

}  // namespace tsubu
