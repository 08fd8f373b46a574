// SPDX-License-Identifier: MIT
/// @file
/// local_transport: ranks that are threads of one process.
#pragma once

#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/message_memory.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>           // std::copy, std::copy_n, std::max, std::min
#include <array>               // std::array
#include <condition_variable>  // std::condition_variable
#include <cstddef>             // std::size_t
#include <cstdint>             // std::uint64_t
#include <exception>           // std::exception_ptr
#include <limits>              // std::numeric_limits
#include <map>                 // std::map
#include <mutex>               // std::mutex
#include <span>                // std::span
#include <string>              // std::to_string
#include <thread>              // std::thread
#include <tuple>               // std::tuple
#include <type_traits>         // std::is_same_v
#include <utility>             // std::move
#include <vector>              // std::vector

namespace tsubu {
namespace detail {

/// What the threads of a local_transport share: where they meet, and what they lay down for each other.
class meeting_place {
public:
    explicit meeting_place(std::size_t ranks) : posts_(ranks), how_left_(ranks, here) {}
    [[nodiscard]] std::size_t ranks() const noexcept { return posts_.size(); }

    /// What a rank shows the others between two meetings.
    struct post {
        std::span<const parcel> parcels;
        std::span<const std::uint64_t> words;
        std::span<const double> numbers;
    };
    [[nodiscard]] post& at(std::size_t rank) noexcept { return posts_[rank]; }

    /// Waits until all ranks are here. @throws lost_rank_error if one has ended, and so never comes.
    void meet() {
        std::unique_lock lock(mutex_);
        if (lost_ != nobody) refuse(lost_);
        if (++waiting_ == ranks()) {
            waiting_ = 0;
            ++meetings_;
            changed_.notify_all();
            return;
        }
        const auto now = meetings_;
        changed_.wait(lock, [&] { return meetings_ != now || lost_ != nobody; });
        if (meetings_ == now) refuse(lost_);
    }
    void put(rank_t from, rank_t to, int tag, std::vector<std::uint64_t> words) {
        const std::lock_guard lock(mutex_);
        auto& on = ways_[{from, to, tag}];
        on.messages.emplace(on.sent++, std::move(words));
        changed_.notify_all();
    }
    /// Which message on this way the next call asks for: the first that are put are for the first that asked, in
    /// whatever order they take them.
    [[nodiscard]] std::uint64_t ask(rank_t from, rank_t to, int tag) {
        const std::lock_guard lock(mutex_);
        return ways_[{from, to, tag}].asked++;
    }
    /// What was put before its sender ended is still there to be taken. @throws lost_rank_error if it never comes.
    [[nodiscard]] std::vector<std::uint64_t> take(rank_t from, rank_t to, int tag, std::uint64_t which) {
        std::unique_lock lock(mutex_);
        const auto found = ways_.find({from, to, tag});  // there since ask
        auto& messages = found->second.messages;
        changed_.wait(lock, [&] { return messages.count(which) != 0 || how_left_[from] != here; });
        if (messages.count(which) == 0) refuse(from);
        auto words = std::move(messages.extract(which).mapped());
        // Halos come and go, each with tags of its own: nothing is kept of those that are through.
        if (messages.empty() && found->second.sent == found->second.asked) ways_.erase(found);
        return words;
    }
    enum presence : char { here, returned, thrown };
    /// A rank has ended: nobody is to wait for it.
    void leave(std::size_t rank, presence how) noexcept {
        const std::lock_guard lock(mutex_);
        how_left_[rank] = how;
        if (lost_ == nobody) lost_ = rank;
        changed_.notify_all();
    }

private:
    struct way {
        std::map<std::uint64_t, std::vector<std::uint64_t>> messages;
        std::uint64_t sent = 0;
        std::uint64_t asked = 0;
    };

    static constexpr auto nobody = (std::numeric_limits<std::size_t>::max)();
    [[noreturn]] void refuse(std::size_t rank) const {
        const auto who = "rank " + std::to_string(rank);
        if (how_left_[rank] == thrown)
            raise<lost_rank_error>("local_transport", who + " has ended by an exception", "see that one");
        raise<lost_rank_error>("local_transport", who + " has returned, and is waited for",
                               "call the same functions on all ranks");
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<post> posts_;
    std::map<std::tuple<rank_t, rank_t, int>, way> ways_;
    std::vector<presence> how_left_;
    std::size_t lost_ = nobody;  // the first that has ended
    std::size_t waiting_ = 0;
    std::uint64_t meetings_ = 0;
};

}  // namespace detail

/// One of several ranks of a process, each in a thread: made by run_ranks.
///
/// Concept:      transport.
/// Cost:         two meetings of all threads per collective, one more for each 64 numbers after the first ones;
///               O(ranks) per rank for an exchange.
/// Deterministic: yes: what comes is ordered by the rank that sent it.
/// Choose it when tests are to see many ranks, under sanitizers and in a debugger. Do not for speed.
class local_transport {
public:
    local_transport(detail::meeting_place& place, rank_t rank) noexcept : place_(&place), rank_(rank) {}

    // Two of one rank would count its tags apart.
    local_transport(const local_transport&) = delete;
    local_transport& operator=(const local_transport&) = delete;

    [[nodiscard]] rank_t rank() const noexcept { return rank_; }
    [[nodiscard]] std::size_t ranks() const noexcept { return place_->ranks(); }

    /// @throws input_error if there is no such rank, before any message: the others then get a lost_rank_error;
    ///         std::bad_alloc if there is no room for what came, when the exchange is over on all ranks.
    [[nodiscard]] mailbox exchange(std::span<const parcel> parcels, std::span<std::uint64_t> sums) {
        for (const auto& one : parcels) detail::check_parcel("local_transport::exchange", one, ranks());
        mailbox came(memory_);
        together({parcels, sums, {}}, sums, reduction::sum, [&] {
            for (std::size_t from = 0; from < ranks(); ++from)
                for (const auto& one : place_->at(from).parcels)
                    if (one.rank == rank_) came.add(parcel{static_cast<rank_t>(from), one.words});
        });
        return came;
    }
    void reduce(std::span<std::uint64_t> numbers, reduction how) {
        together({{}, numbers, {}}, numbers, how, [] {});
    }
    void reduce(std::span<double> numbers, reduction how) {
        together({{}, {}, numbers}, numbers, how, [] {});
    }
    [[nodiscard]] mailbox gather(std::span<const std::uint64_t> words) {
        mailbox came(memory_);
        look_at({rank_, words}, [&](const parcel& theirs) { came.add(theirs); });
        return came;
    }
    [[nodiscard]] std::uint64_t sum_before(std::uint64_t n) {
        std::uint64_t sum = 0;
        look_at({rank_, {&n, 1}}, [&](const parcel& theirs) { sum += theirs.rank < rank_ ? theirs.words[0] : 0; });
        return sum;
    }
    [[nodiscard]] int next_tag() noexcept { return tag_++; }
    [[nodiscard]] message_memory& memory() noexcept { return memory_; }

    /// See transport.
    class channel {
    public:
        channel(local_transport& on, int tag, std::vector<lane> out, std::vector<lane> in)
            : place_(on.place_),
              rank_(on.rank_),
              tag_(tag),
              out_lanes_(std::move(out)),
              in_lanes_(std::move(in)),
              out_(detail::words_of(out_lanes_)),
              in_(detail::words_of(in_lanes_)) {}
        [[nodiscard]] std::span<std::uint64_t> out() noexcept { return out_; }
        [[nodiscard]] std::span<const std::uint64_t> in() const noexcept { return in_; }
        void start() {
            auto at = out_.begin();
            for (const auto& [to, words] : out_lanes_) {
                const auto end = at + static_cast<std::ptrdiff_t>(words);
                place_->put(rank_, to, tag_, {at, end});
                at = end;
            }
            asked_.clear();
            for (const auto& one : in_lanes_) asked_.push_back(place_->ask(one.rank, rank_, tag_));
        }
        void finish() {
            auto at = in_.begin();
            for (std::size_t k = 0; k < asked_.size(); ++k) {
                const auto [from, words] = in_lanes_[k];
                const auto came = place_->take(from, rank_, tag_, asked_[k]);
                if (came.size() != words)
                    detail::raise<input_error>("local_transport::channel",
                                               "rank " + std::to_string(from) + " sent " + std::to_string(came.size()) +
                                                   " words where " + std::to_string(words) + " were expected",
                                               "call the same functions with the same fields on all ranks");
                at = std::copy(came.begin(), came.end(), at);
            }
        }

    private:
        detail::meeting_place* place_;
        rank_t rank_;
        int tag_;
        std::vector<lane> out_lanes_;
        std::vector<lane> in_lanes_;
        std::vector<std::uint64_t> out_;
        std::vector<std::uint64_t> in_;
        std::vector<std::uint64_t> asked_;  // of each lane, by the last start
    };

private:
    // Shows what this rank has, meets, looks at what the others show, and meets again. Then each number that was shown
    // becomes that of all ranks, some at a time: that asks for no memory, so that ranks can tell each other that they
    // have none.
    template <class Number, class Look>
    void together(const detail::meeting_place::post& mine, std::span<Number> numbers, reduction how, Look&& look) {
        place_->at(rank_) = mine;
        place_->meet();
        bool is_same = true;  // if not, all ranks see it
        for (std::size_t from = 0; from < ranks(); ++from)
            is_same = is_same && shown<Number>(from).size() == numbers.size();
        std::exception_ptr thrown;
        try {
            if (!is_same) refuse_counts<Number>(numbers.size());
            look();
        } catch (...) {  // kept: the others still look at what this rank shows
            thrown = std::current_exception();
        }
        std::array<Number, 64> found{};
        const auto total = is_same ? numbers.size() : 0;
        std::size_t done = 0;
        do {
            const auto count = (std::min)(found.size(), total - done);
            for (std::size_t k = 0; k < count; ++k) found[k] = reduced<Number>(done + k, how);
            place_->meet();
            std::copy_n(found.begin(), count, numbers.subspan(done).begin());
            done += count;
        } while (done < total);
        if (thrown) std::rethrow_exception(thrown);
    }
    // At what each rank shows.
    template <class Look>
    void look_at(const parcel& mine, Look&& look) {
        together({{&mine, 1}, {}, {}}, std::span<std::uint64_t>(), reduction::sum, [&] {
            for (std::size_t from = 0; from < ranks(); ++from)
                for (const auto& one : place_->at(from).parcels) look(one);
        });
    }
    template <class Number>
    [[nodiscard]] std::span<const Number> shown(std::size_t from) const noexcept {
        if constexpr (std::is_same_v<Number, double>)
            return place_->at(from).numbers;
        else
            return place_->at(from).words;
    }
    template <class Number>
    [[nodiscard]] Number reduced(std::size_t k, reduction how) const noexcept {
        auto result = shown<Number>(0)[k];
        for (std::size_t from = 1; from < ranks(); ++from) {
            const auto other = shown<Number>(from)[k];
            result = how == reduction::sum     ? result + other
                     : how == reduction::least ? (std::min)(result, other)
                                               : (std::max)(result, other);
        }
        return result;
    }
    template <class Number>
    void refuse_counts(std::size_t count) const {
        for (std::size_t from = 0; from < ranks(); ++from)
            if (const auto theirs = shown<Number>(from).size(); theirs != count)
                detail::raise<input_error>("local_transport",
                                           "rank " + std::to_string(from) + " reduces " + std::to_string(theirs) +
                                               " numbers, this one " + std::to_string(count),
                                           "call the same functions on all ranks");
    }

    detail::meeting_place* place_;
    rank_t rank_;
    int tag_ = 0;
    message_memory memory_;
};
static_assert(transport<local_transport>);

/// Runs body(on) as each of so many ranks, in a thread each, and waits for all.
///
///     tsubu::run_ranks(4, [](tsubu::local_transport& on) { ... });
///
/// A rank that waits for one that has returned gets a lost_rank_error, as it does for one that has thrown.
///
/// @throws what the lowest rank threw that did not merely wait for another one; std::system_error or std::bad_alloc if
///         a thread cannot be started; all threads have ended then.
template <class Body>
void run_ranks(std::size_t ranks, Body&& body) {
    using detail::meeting_place;
    meeting_place place(ranks);
    std::vector<std::exception_ptr> thrown(ranks);
    std::vector<char> has_waited(ranks, 0);  // not vector<bool>, whose bits threads would share
    const auto run = [&](std::size_t rank) noexcept {
        try {
            local_transport on(place, static_cast<rank_t>(rank));
            body(on);
        } catch (const lost_rank_error&) {
            thrown[rank] = std::current_exception();
            has_waited[rank] = 1;
        } catch (...) {
            thrown[rank] = std::current_exception();
        }
        place.leave(rank, thrown[rank] ? meeting_place::thrown : meeting_place::returned);
    };
    std::exception_ptr not_started;
    std::vector<std::thread> threads;
    try {
        threads.reserve(ranks);
        for (std::size_t rank = 0; rank < ranks; ++rank) threads.emplace_back(run, rank);
    } catch (...) {  // kept: those that have started are to end first
        not_started = std::current_exception();
        for (auto rank = threads.size(); rank < ranks; ++rank) place.leave(rank, meeting_place::thrown);
    }
    for (auto& one : threads) one.join();
    if (not_started) std::rethrow_exception(not_started);
    for (const bool waited : {false, true})
        for (std::size_t rank = 0; rank < ranks; ++rank)
            if (thrown[rank] && (has_waited[rank] != 0) == waited) std::rethrow_exception(thrown[rank]);
}

}  // namespace tsubu
