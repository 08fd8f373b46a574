// SPDX-License-Identifier: MIT
/// @file
/// A block of plain values from an allocator, uninitialised, with huge pages where they pay.
#pragma once

#include <tsubu/core/error.hpp>

#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::uintptr_t
#include <cstring>      // std::memcpy
#include <memory>       // std::allocator_traits
#include <new>          // std::bad_array_new_length
#include <type_traits>  // std::is_trivially_copyable_v
#include <utility>      // std::exchange, std::move, std::swap

#if defined(__linux__)
#include <sys/mman.h>  // madvise
#endif

namespace tsubu {

/// From how many bytes on a buffer asks for huge pages. A second-level TLB of 2048 entries covers 8 MiB in pages
/// of 4 KiB, so random access to tables well beyond that pays a page walk per look-up. [bytes]
inline constexpr std::size_t huge_page_threshold = std::size_t{32} << 20;

/// Asks the system to back this memory with huge pages (Linux, transparent huge pages in mode "madvise" or
/// "always"; elsewhere nothing happens). Only the whole pages inside the range are asked for; a refusal is not an
/// error, since the memory is as good, only slower.
inline void advise_huge_pages(void* begin, std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    constexpr std::uintptr_t page = std::uintptr_t{2} << 20;  // x86-64 and AArch64 with 4 KiB base pages
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    const auto first = (address + page - 1) & ~(page - 1);
    const auto last = (address + bytes) & ~(page - 1);
    if (last > first)
        static_cast<void>(::madvise(static_cast<std::byte*>(begin) + (first - address), last - first, MADV_HUGEPAGE));
#else
    static_cast<void>(begin);
    static_cast<void>(bytes);
#endif
}

/// `count` values of a trivial type, uninitialised, freed with the object.
///
/// What a storage policy keeps its table in: a vector would write every element once for nothing, and would fault
/// the pages in before huge pages could be asked for.
///
///     tsubu::buffer<tsubu::index_t> table(count, {});
///     std::fill(table.begin(), table.end(), tsubu::absent);
///
/// @tparam Value      trivially copyable; its alignment is honoured (a cache line may be a value).
/// @tparam Allocator  any allocator; it is rebound to Value.
///
/// Complexity: construction O(1), copy O(n).
/// Threads:    many readers or one writer.
template <class Value, class Allocator = std::allocator<Value>>
class buffer {
    static_assert(std::is_trivially_copyable_v<Value>, "tsubu::buffer holds plain values only");
    using value_allocator = typename std::allocator_traits<Allocator>::template rebind_alloc<Value>;
    using traits = std::allocator_traits<value_allocator>;

public:
    buffer() noexcept(noexcept(value_allocator())) : allocator_() {}
    explicit buffer(const Allocator& allocator) noexcept : allocator_(allocator) {}
    /// @throws std::bad_array_new_length if the bytes do not fit std::size_t, and whatever the allocator throws;
    ///         nothing is held then.
    buffer(std::size_t count, const Allocator& allocator) : allocator_(allocator) { allocate(count); }

    buffer(const buffer& other)
        : allocator_(traits::select_on_container_copy_construction(other.allocator_)) {
        allocate(other.count_);
        copy_from(other);
    }
    buffer(buffer&& other) noexcept
        : allocator_(std::move(other.allocator_)),
          values_(std::exchange(other.values_, nullptr)),
          count_(std::exchange(other.count_, 0)) {}
    /// The allocator becomes that of the right-hand side: tables move with the memory they live in.
    buffer& operator=(const buffer& other) {
        if (this != &other) buffer(other).swap(*this);
        return *this;
    }
    buffer& operator=(buffer&& other) noexcept {
        buffer(std::move(other)).swap(*this);
        return *this;
    }
    ~buffer() {
        if (values_ != nullptr) traits::deallocate(allocator_, values_, count_);
    }

    void swap(buffer& other) noexcept {
        std::swap(allocator_, other.allocator_);
        std::swap(values_, other.values_);
        std::swap(count_, other.count_);
    }

    [[nodiscard]] Value* data() noexcept { return values_; }
    [[nodiscard]] const Value* data() const noexcept { return values_; }
    [[nodiscard]] Value* begin() noexcept { return values_; }
    [[nodiscard]] const Value* begin() const noexcept { return values_; }
    [[nodiscard]] Value* end() noexcept { return values_ + count_; }
    [[nodiscard]] const Value* end() const noexcept { return values_ + count_; }
    [[nodiscard]] Value& operator[](std::size_t k) noexcept { return values_[k]; }
    [[nodiscard]] const Value& operator[](std::size_t k) const noexcept { return values_[k]; }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return count_ * sizeof(Value); }
    [[nodiscard]] Allocator get_allocator() const noexcept { return Allocator(allocator_); }

private:
    void allocate(std::size_t count) {
        if (count == 0) return;
        if (count > static_cast<std::size_t>(-1) / sizeof(Value)) throw std::bad_array_new_length();
        values_ = traits::allocate(allocator_, count);
        count_ = count;
        if (memory_bytes() >= huge_page_threshold) advise_huge_pages(values_, memory_bytes());
    }
    void copy_from(const buffer& other) noexcept {
        if (count_ != 0) std::memcpy(static_cast<void*>(values_), other.values_, memory_bytes());
    }

    [[no_unique_address]] value_allocator allocator_;
    Value* values_ = nullptr;
    std::size_t count_ = 0;
};

}  // namespace tsubu
