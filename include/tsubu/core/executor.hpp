// SPDX-License-Identifier: MIT
/// @file
/// Who runs the parts of a loop: this thread, several threads (threads.hpp), or a pool of the caller's own.
#pragma once

#include <tsubu/version.hpp>

#include <concepts>  // std::same_as
#include <cstddef>   // std::size_t

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

/// No more than an executor: for concepts that ask for any of them.
struct executor_archetype {
    [[nodiscard]] std::size_t concurrency() const noexcept;
    template <class Part>
    void run(Part&& part) const;
};
static_assert(executor<executor_archetype>);

}  // namespace detail
}  // namespace tsubu
