// SPDX-License-Identifier: MIT
/// @file
/// Who runs the parts of a loop: this thread, several threads, or a pool of the caller's own.
/// Heaviest include: <thread>.
#pragma once

#include <tsubu/core/error.hpp>

#include <concepts>   // std::same_as
#include <cstddef>    // std::size_t
#include <exception>  // std::exception
#include <thread>     // std::thread
#include <vector>     // std::vector

namespace tsubu {

/// Runs part(0) .. part(concurrency() - 1), each once, and returns when all have ended.
///  1. run(part) calls part exactly once for each k in [0, concurrency());
///  2. what the parts wrote happens before run returns;
///  3. the parts that tsubu passes do not throw, and run does not add an exception of its own.
template <class Executor>
concept executor = requires(const Executor& on, void (&part)(std::size_t)) {
    { on.concurrency() } noexcept -> std::same_as<std::size_t>;
    on.run(part);
};

/// The calling thread alone.
struct this_thread {
    [[nodiscard]] static constexpr std::size_t concurrency() noexcept { return 1; }
    template <class Part>
    static void run(Part&& part) {
        part(std::size_t{0});
    }
};
static_assert(executor<this_thread>);

namespace detail {

/// What only several threads need is not compiled for an executor that never has them.
template <class Executor>
inline constexpr bool may_have_threads = !std::same_as<Executor, this_thread>;

}  // namespace detail

/// A given number of threads, started for the call and joined at its end (about 20 us each): for loops of a
/// millisecond and more. Those who keep a pool wrap it in the two members of the concept.
class threads {
public:
    /// @throws input_error if count is 0.
    explicit threads(std::size_t count) : count_(count) {
        if (count == 0) detail::raise<input_error>("threads", "0 threads were asked for", "ask for at least 1");
    }
    [[nodiscard]] std::size_t concurrency() const noexcept { return count_; }

    /// Part 0 runs on the calling thread. Where the system has no thread left, the calling thread runs the part.
    template <class Part>
    void run(Part&& part) const {
        std::vector<std::thread> team;
        std::size_t started = 1;
        try {
            team.reserve(count_ - 1);
            for (; started < count_; ++started) team.emplace_back([&part, k = started] { part(k); });
        } catch (const std::exception&) {
            // std::system_error: no more threads. The parts that were not started run below.
        }
        part(std::size_t{0});
        for (std::size_t k = started; k < count_; ++k) part(k);
        for (auto& member : team) member.join();
    }

private:
    std::size_t count_;
};
static_assert(executor<threads>);

}  // namespace tsubu
