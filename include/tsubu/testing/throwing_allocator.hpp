// SPDX-License-Identifier: MIT
/// @file
/// An allocator that counts what it hands out and fails when it is told to.
#pragma once

#include <tsubu/version.hpp>

#include <cstddef>      // std::size_t
#include <limits>       // std::numeric_limits
#include <memory>       // std::allocator
#include <new>          // std::bad_alloc
#include <type_traits>  // std::true_type

namespace tsubu::testing {

/// The counter behind a family of throwing_allocators: how many bytes are out, and which allocation fails.
///
///     allocation_gate gate;
///     tsubu::flat_storage<std::int64_t, throwing_allocator<std::byte>> storage{throwing_allocator<std::byte>(gate)};
///     gate.refuse_from(2);   // the third allocation from now on throws std::bad_alloc, and all after it
///
/// Threads: one at a time.
class allocation_gate {
public:
    allocation_gate() = default;
    allocation_gate(const allocation_gate&) = delete;  // allocators point to this very gate
    allocation_gate& operator=(const allocation_gate&) = delete;

    /// Every allocation succeeds again.
    void open() noexcept { refuse(never, never); }
    /// Of the allocations that follow, the one with this number fails, and no other; the first is number 0.
    void refuse_at(std::size_t number) noexcept { refuse(number, number + 1); }
    /// Of the allocations that follow, the one with this number fails, and all after it.
    void refuse_from(std::size_t number) noexcept { refuse(number, never); }

    /// Allocations that failed since the last call of open or refuse.
    [[nodiscard]] std::size_t refused() const noexcept { return refused_; }
    /// Allocations asked for since then, failed ones included.
    [[nodiscard]] std::size_t asked() const noexcept { return asked_; }
    /// What is handed out and not yet given back. [bytes]
    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

    /// For the allocator. @throws std::bad_alloc if this allocation is to fail.
    void take(std::size_t bytes) {
        const auto number = asked_++;
        if (number >= first_ && number < last_) {
            ++refused_;
            throw std::bad_alloc();
        }
        bytes_ += bytes;
    }
    /// Counts memory as free again.
    void give_back(std::size_t bytes) noexcept { bytes_ -= bytes; }

private:
    static constexpr std::size_t never = (std::numeric_limits<std::size_t>::max)();

    void refuse(std::size_t first, std::size_t last) noexcept {
        first_ = first;
        last_ = last;
        asked_ = 0;
        refused_ = 0;
    }

    std::size_t first_ = never;
    std::size_t last_ = never;
    std::size_t asked_ = 0;
    std::size_t refused_ = 0;
    std::size_t bytes_ = 0;
};

/// std::allocator behind an allocation_gate; default-constructed it has none and behaves as std::allocator.
/// Invalidates: the gate must outlive all that was allocated through it.
template <class Value>
class throwing_allocator {
public:
    using value_type = Value;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;

    throwing_allocator() = default;
    explicit throwing_allocator(allocation_gate& gate) noexcept : gate_(&gate) {}
    template <class Other>
    throwing_allocator(const throwing_allocator<Other>& other) noexcept : gate_(other.gate()) {}

    [[nodiscard]] Value* allocate(std::size_t count) {
        if (gate_ != nullptr) gate_->take(count * sizeof(Value));
        return std::allocator<Value>().allocate(count);
    }
    void deallocate(Value* values, std::size_t count) noexcept {
        if (gate_ != nullptr) gate_->give_back(count * sizeof(Value));
        std::allocator<Value>().deallocate(values, count);
    }
    [[nodiscard]] allocation_gate* gate() const noexcept { return gate_; }

    template <class Other>
    friend bool operator==(const throwing_allocator& a, const throwing_allocator<Other>& b) noexcept {
        return a.gate() == b.gate();
    }

private:
    allocation_gate* gate_ = nullptr;
};

}  // namespace tsubu::testing
