// SPDX-License-Identifier: MIT
/// @file
/// An allocator that counts the bytes it holds and asks for huge pages where tsubu's own tables do.
#pragma once

#include <tsubu/core/buffer.hpp>

#include <cstddef>      // std::size_t
#include <memory>       // std::allocator
#include <type_traits>  // std::true_type, std::false_type

namespace bench {

/// For the rivals: they get the same pages as our tables, and tell their memory by the same measure.
/// The counter belongs to the owner of the container and outlives it; both are swapped together.
template <class Value>
class counting_allocator {
public:
    using value_type = Value;
    using propagate_on_container_swap = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using is_always_equal = std::false_type;

    explicit counting_allocator(std::size_t* bytes) noexcept : bytes_(bytes) {}
    template <class Other>
    counting_allocator(const counting_allocator<Other>& other) noexcept : bytes_(other.counter()) {}

    [[nodiscard]] Value* allocate(std::size_t count) {
        Value* const memory = std::allocator<Value>{}.allocate(count);
        *bytes_ += count * sizeof(Value);
        if (count * sizeof(Value) >= tsubu::huge_page_threshold)
            tsubu::advise_huge_pages(memory, count * sizeof(Value));
        return memory;
    }
    void deallocate(Value* memory, std::size_t count) noexcept {
        *bytes_ -= count * sizeof(Value);
        std::allocator<Value>{}.deallocate(memory, count);
    }
    [[nodiscard]] std::size_t* counter() const noexcept { return bytes_; }

    template <class Other>
    friend bool operator==(const counting_allocator& a, const counting_allocator<Other>& b) noexcept {
        return a.counter() == b.counter();
    }

private:
    std::size_t* bytes_;
};

}  // namespace bench
