// SPDX-License-Identifier: MIT
/// @file
/// threads: an executor that starts threads for each loop.
/// Heaviest include: <thread>.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/executor.hpp>

#include <cstddef>    // std::size_t
#include <exception>  // std::exception
#include <thread>     // std::thread
#include <vector>     // std::vector

namespace tsubu {

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
