// SPDX-License-Identifier: MIT
/// @file
/// message_memory: what messages are made in, kept for the next ones.
#pragma once

#include <tsubu/core/buffer.hpp>

#include <cstddef>      // std::byte, std::max_align_t, std::nullptr_t, std::size_t
#include <limits>       // std::numeric_limits
#include <memory>       // std::make_shared, std::shared_ptr
#include <new>          // std::bad_array_new_length
#include <span>         // std::span
#include <type_traits>  // std::is_trivially_copyable_v
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu {

/// Memory that is used again: a message of some MiB costs less to send than pages cost to get from the system and to
/// give back.
///
///     auto words = on.memory().take<std::uint64_t>(count);   // uninitialised; goes back with `words`
///
/// Copies are handles of one memory. What is out when the last handle goes is freed when it comes back. A handle of
/// none keeps nothing.
///
/// Complexity: take: O(1), and an allocation if nothing that is kept is large enough.
/// Threads:    one at a time.
class message_memory {
    using block = buffer<std::byte>;
    struct shelf {
        std::vector<block> kept;
        std::size_t bytes = 0;  // of them
    };

public:
    /// What comes back beyond this is freed: messages so large take longer than their pages. [bytes]
    static constexpr std::size_t most_kept = std::size_t{64} << 20;
    /// More than a call of this library has at once, with a message from each of 26 neighbours.
    static constexpr std::size_t most_blocks = 64;

    /// So many values of a trivial type.
    template <class Value>
    class array {
        static_assert(std::is_trivially_copyable_v<Value> && alignof(Value) <= alignof(std::max_align_t));

    public:
        array() = default;
        array(array&& other) noexcept { swap(other); }
        array& operator=(array&& other) noexcept {
            array(std::move(other)).swap(*this);
            return *this;
        }
        ~array() {
            if (shelf_ != nullptr) put_back(*shelf_, std::move(block_));
        }
        void swap(array& other) noexcept {
            block_.swap(other.block_);
            shelf_.swap(other.shelf_);
            std::swap(count_, other.count_);
        }

        [[nodiscard]] Value* data() noexcept { return reinterpret_cast<Value*>(block_.data()); }
        [[nodiscard]] const Value* data() const noexcept { return reinterpret_cast<const Value*>(block_.data()); }
        [[nodiscard]] std::size_t size() const noexcept { return count_; }
        [[nodiscard]] Value* begin() noexcept { return data(); }
        [[nodiscard]] const Value* begin() const noexcept { return data(); }
        [[nodiscard]] Value* end() noexcept { return data() + count_; }
        [[nodiscard]] const Value* end() const noexcept { return data() + count_; }
        [[nodiscard]] Value& operator[](std::size_t k) noexcept { return data()[k]; }
        [[nodiscard]] const Value& operator[](std::size_t k) const noexcept { return data()[k]; }
        /// Keeps the first n. Precondition: n <= size().
        void shrink(std::size_t n) noexcept { count_ = n; }
        [[nodiscard]] std::span<Value> first(std::size_t n) noexcept { return {data(), n}; }
        [[nodiscard]] std::span<const Value> first(std::size_t n) const noexcept { return {data(), n}; }

    private:
        friend class message_memory;
        array(block&& memory, std::size_t count, const std::shared_ptr<shelf>& from) noexcept
            : block_(std::move(memory)), shelf_(from), count_(count) {}

        block block_;
        std::shared_ptr<shelf> shelf_;
        std::size_t count_ = 0;
    };

    message_memory() : shelf_(std::make_shared<shelf>()) {}
    /// A handle of none.
    explicit message_memory(std::nullptr_t) noexcept {}

    /// @throws std::bad_alloc, std::bad_array_new_length.
    template <class Value>
    [[nodiscard]] array<Value> take(std::size_t count) {
        if (count > (std::numeric_limits<std::size_t>::max)() / 2 / sizeof(Value)) throw std::bad_array_new_length();
        return {block_of(count * sizeof(Value)), count, shelf_};
    }
    /// What is kept for later; not what is out.
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return shelf_ == nullptr ? 0 : shelf_->bytes; }
    /// Gives what is kept back to the system.
    void clear() noexcept {
        if (shelf_ != nullptr) *shelf_ = {};
    }

private:
    static constexpr std::size_t least_of_note = std::size_t{64} << 10;  // [bytes]

    // The smallest that is large enough, but not a large one for a small request, which the next large one would miss;
    // else a new one with some room for requests that grow.
    [[nodiscard]] block block_of(std::size_t bytes) {
        if (shelf_ == nullptr) return block(bytes, {});
        auto& kept = shelf_->kept;
        const auto most = 4 * bytes + least_of_note;
        auto best = kept.end();
        for (auto one = kept.begin(); one != kept.end(); ++one)
            if (one->size() >= bytes && one->size() <= most && (best == kept.end() || one->size() < best->size()))
                best = one;
        if (best == kept.end()) return block(bytes + bytes / 4 + sizeof(std::max_align_t), {});
        block found = std::move(*best);
        shelf_->bytes -= found.size();
        *best = std::move(kept.back());
        kept.pop_back();
        return found;
    }
    static void put_back(shelf& to, block&& memory) noexcept {
        if (memory.empty() || to.bytes + memory.size() > most_kept || to.kept.size() == most_blocks) return;
        try {
            to.bytes += memory.size();
            to.kept.push_back(std::move(memory));
        } catch (...) {  // no room for where it would be noted: push_back has not moved it
            to.bytes -= memory.size();
        }
    }

    std::shared_ptr<shelf> shelf_;
};

}  // namespace tsubu
