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
#include <new>        // std::bad_alloc
#include <span>       // std::span
#include <string>     // std::string
#include <utility>    // std::forward

namespace tsubu {

/// Thrown on ranks that have not failed themselves, if another failed by what is neither input nor limit: a file, or
/// what a user's function throws.
class other_rank_error : public error {
public:
    using error::error;
};

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
        } catch (const limit_error&) {
            fail(exhausted);
        } catch (const std::bad_alloc&) {
            fail(exhausted);
        } catch (...) {
            fail(failed);
        }
    }
    /// Whether this rank has caught an exception; of the others it knows nothing before the reduction.
    [[nodiscard]] bool has_failed_here() const noexcept { return own_ != nullptr; }
    /// What this rank adds to sum k; after the reduction the sum.
    [[nodiscard]] std::uint64_t& operator[](std::size_t k) noexcept { return words_[own_words + k]; }
    /// What is to be summed over all ranks.
    [[nodiscard]] std::span<std::uint64_t> words() noexcept { return {words_.data(), words_.size()}; }
    /// Whether a rank has failed; after the reduction.
    [[nodiscard]] bool has_failed() const noexcept { return failures() != 0; }
    /// After the reduction. @throws on all ranks or none: on a rank that has failed what its work threw; on the others
    /// an input_error if one has refused its input, else a limit_error if one exceeded a limit or its memory, else an
    /// other_rank_error, with the rank, or how many they are.
    /// @param left  how things are then, for the message
    void settle(const char* where, const char* left = "nothing was done on any rank") const {
        if (own_) std::rethrow_exception(own_);
        if (!has_failed()) return;
        // The sum of their numbers, which for one is its own.
        const auto who =
            failures() == 1 ? "rank " + std::to_string(words_[which]) : std::to_string(failures()) + " ranks";
        const auto remedy = "see the message there; " + std::string(left);
        if (words_[refused] != 0) detail::raise<input_error>(where, who + " refused the input", remedy.c_str());
        if (words_[exhausted] != 0)
            detail::raise<limit_error>(where, who + " exceeded a limit, or the memory", remedy.c_str());
        detail::raise<other_rank_error>(where, who + " failed", remedy.c_str());
    }

private:
    enum place : std::size_t { refused, exhausted, failed, which, own_words };

    [[nodiscard]] std::uint64_t failures() const noexcept {
        return words_[refused] + words_[exhausted] + words_[failed];
    }
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
