// SPDX-License-Identifier: MIT
/// @file
/// agreement: all ranks throw, or none does.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>

#include <array>      // std::array
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <exception>  // std::exception_ptr
#include <span>       // std::span
#include <string>     // std::string
#include <utility>    // std::forward

namespace tsubu {

/// Work that is local, in an operation of all ranks: what it throws is kept until all have been told.
///
///     tsubu::agreement<1> all(on.rank());
///     all.attempt([&] { check(particles); });
///     all[0] = particles.size();
///     const auto came = on.exchange(parcels, all.words());   // or on.reduce(all.words(), tsubu::reduction::sum)
///     all.settle("check");                                   // throws on every rank if one has failed
///     const auto particles_of_all_ranks = all[0];
///
/// @tparam Sums  how many numbers are summed over the ranks along the way.
template <std::size_t Sums = 0>
class agreement {
public:
    explicit agreement(rank_t rank) noexcept : rank_(rank) {}

    /// Does the work, unless something has failed before.
    template <class Work>
    void attempt(Work&& work) noexcept {
        if (own_) return;
        try {
            std::forward<Work>(work)();
        } catch (const input_error&) {
            fail(refused);
        } catch (...) {  // limit_error, std::bad_alloc, what a user's function throws
            fail(exhausted);
        }
    }
    [[nodiscard]] bool has_failed_here() const noexcept { return own_ != nullptr; }
    /// What this rank adds to sum k; after the reduction the sum.
    [[nodiscard]] std::uint64_t& operator[](std::size_t k) noexcept { return words_[own_words + k]; }
    /// What is to be summed over all ranks.
    [[nodiscard]] std::span<std::uint64_t> words() noexcept { return {words_.data(), words_.size()}; }
    /// Whether a rank has failed; after the reduction.
    [[nodiscard]] bool has_failed() const noexcept { return words_[refused] != 0 || words_[exhausted] != 0; }
    /// After the reduction. @throws on all ranks or none: on a rank that has failed what its work threw; on the others
    /// an input_error if one has refused its input, else a limit_error, with the rank, or how many they are.
    void settle(const char* where) const {
        if (own_) std::rethrow_exception(own_);
        const auto failed = words_[refused] + words_[exhausted];
        if (failed == 0) return;
        // The sum of their numbers, which for one is its own.
        const auto who = failed == 1 ? "rank " + std::to_string(words_[which]) : std::to_string(failed) + " ranks";
        if (words_[refused] != 0) detail::raise<input_error>(where, who + " refused the input", remedy);
        detail::raise<limit_error>(where, who + " exceeded a limit, or the memory", remedy);
    }

private:
    enum place : std::size_t { refused, exhausted, which, own_words };
    static constexpr const char* remedy = "see the message there; nothing was done on any rank";

    void fail(place how) noexcept {
        own_ = std::current_exception();
        words_[how] = 1;
        words_[which] = rank_;
    }

    std::array<std::uint64_t, own_words + Sums> words_{};
    std::exception_ptr own_;
    rank_t rank_;
};

}  // namespace tsubu
