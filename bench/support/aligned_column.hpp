// SPDX-License-Identifier: MIT
/// @file
/// A vector that begins at a cache line.
#pragma once

#include <cstddef>  // std::size_t
#include <new>      // std::align_val_t
#include <vector>   // std::vector

namespace bench {

template <class Value>
struct cache_line_allocator {
    using value_type = Value;
    static constexpr std::align_val_t alignment{64};

    cache_line_allocator() = default;
    template <class Other>
    explicit cache_line_allocator(const cache_line_allocator<Other>&) noexcept {}

    [[nodiscard]] Value* allocate(std::size_t count) {
        return static_cast<Value*>(::operator new(count * sizeof(Value), alignment));
    }
    void deallocate(Value* memory, std::size_t) noexcept { ::operator delete(memory, alignment); }

    friend bool operator==(cache_line_allocator, cache_line_allocator) noexcept { return true; }
};

/// So that no vector read by a kernel, and none of the plain read, straddles two lines: what malloc returns may or may
/// not begin at one, which is worth a tenth of the time, and is no property of what is measured.
template <class Value>
using aligned_column = std::vector<Value, cache_line_allocator<Value>>;

}  // namespace bench
