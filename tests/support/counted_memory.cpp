// SPDX-License-Identifier: MIT
#include "support/counted_memory.hpp"

#include <cstddef>
#include <cstdlib>
#include <new>

thread_local std::size_t counted_memory::asked = 0;
thread_local std::size_t counted_memory::granted = no_limit;

namespace {

using counted_memory::asked;
using counted_memory::granted;
using counted_memory::no_limit;

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
