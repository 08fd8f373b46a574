// SPDX-License-Identifier: MIT
/// @file
/// How often a thread asks for memory, and refusing it from a given time on: counted_memory.cpp replaces operator new.
#pragma once

#include <cstddef>
#include <limits>

namespace counted_memory {

inline constexpr auto no_limit = (std::numeric_limits<std::size_t>::max)();
extern thread_local std::size_t asked;    // how often memory was asked for
extern thread_local std::size_t granted;  // how often it still is

/// How often the call asks for memory.
template <class Call>
std::size_t times_asked(Call&& call) {
    const auto before = asked;
    call();
    return asked - before;
}

}  // namespace counted_memory
