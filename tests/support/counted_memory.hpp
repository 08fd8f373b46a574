// SPDX-License-Identifier: MIT
/// @file
/// Counts how often a thread asks for memory, and refuses it from a given time on. It replaces operator new: for one
/// source file of a program.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr auto no_limit = (std::numeric_limits<std::size_t>::max)();
thread_local std::size_t asked = 0;          // how often memory was asked for
thread_local std::size_t granted = no_limit;  // how often it still is

[[gnu::noinline]] void* memory_for(std::size_t bytes, std::size_t alignment) {
    ++asked;
    if (granted == 0) throw std::bad_alloc();
    if (granted != no_limit) --granted;
    void* const memory = std::aligned_alloc(alignment, (bytes + alignment) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
[[gnu::noinline]] void give_back(void* memory) noexcept { std::free(memory); }

}  // namespace

void* operator new(std::size_t bytes) { return memory_for(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return memory_for(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    try {
        return memory_for(bytes, alignof(std::max_align_t));
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }

namespace {

/// How often the call asks for memory.
template <class Call>
std::size_t times_asked(Call&& call) {
    const auto before = asked;
    call();
    return asked - before;
}

}  // namespace
