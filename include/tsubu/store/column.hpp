// SPDX-License-Identifier: MIT
/// @file
/// column: one field of many particles, however it lies in memory.
#pragma once

#include <tsubu/core/expects.hpp>

#include <compare>      // std::strong_ordering
#include <concepts>     // std::integral
#include <cstddef>      // std::ptrdiff_t, std::size_t
#include <cstdint>      // std::uint64_t
#include <iterator>     // std::input_iterator_tag, std::random_access_iterator_tag
#include <span>         // std::ranges::enable_borrowed_range, std::span
#include <type_traits>  // std::conditional_t, std::is_same_v
#include <utility>      // std::declval, std::exchange

namespace tsubu {

/// Which allocation of a store a view was made for. A view that is used after the store has moved its memory is told so
/// in debug builds, at the place where it is used.
class lease {
public:
    lease() = default;
    /// Of a store that holds no memory there is nothing to outlive: nullptr.
    explicit lease(const std::uint64_t* now) noexcept : now_(now), then_(now == nullptr ? 0 : *now) {}
    void check() const noexcept {
        TSUBU_EXPECTS(now_ == nullptr || *now_ == then_,
                      "this view of a store is older than its memory; take a new one after particles were added");
    }

private:
    [[maybe_unused]] const std::uint64_t* now_ = nullptr;  // unused where nothing is checked
    [[maybe_unused]] std::uint64_t then_ = 0;
};

/// One value after the other: what soa has, and std::span is made of.
template <class Value>
struct contiguous_place {
    Value* start = nullptr;
    [[nodiscard, gnu::always_inline]] Value& at(std::size_t i) const noexcept { return start[i]; }
    [[nodiscard]] contiguous_place from(std::size_t i) const noexcept { return {start + i}; }
};
/// A value at a given place in each record of a given size: what aos has.
template <class Value, std::size_t Stride, std::size_t Offset>
struct strided_place {
    using byte = std::conditional_t<std::is_const_v<Value>, const std::byte, std::byte>;
    byte* start = nullptr;
    [[nodiscard, gnu::always_inline]] Value& at(std::size_t i) const noexcept {
        return *reinterpret_cast<Value*>(start + i * Stride + Offset);
    }
    [[nodiscard]] strided_place from(std::size_t i) const noexcept { return {start + i * Stride}; }
};
/// N values in each block of a given size, `Offset` bytes from where it begins: what aosoa<N> has.
template <class Value, std::size_t Block, std::size_t N, std::size_t Offset>
struct blocked_place {
    using byte = std::conditional_t<std::is_const_v<Value>, const std::byte, std::byte>;
    byte* start = nullptr;
    std::size_t first = 0;
    [[nodiscard, gnu::always_inline]] Value& at(std::size_t i) const noexcept {
        const auto j = first + i;
        // As arrays of arrays: out of a sum of bytes g++ makes one product, and computes it anew for each field.
        auto& block = reinterpret_cast<byte(*)[Block]>(start)[j / N];
        return (*reinterpret_cast<Value(*)[N]>(block + Offset))[j % N];
    }
    [[nodiscard]] blocked_place from(std::size_t i) const noexcept { return {start, first + i}; }
};

/// One field of some particles, which can be indexed and walked; a view, which adding particles ends.
///
///     auto v = g[tsubu::velocity<3>];
///     for (std::size_t i = 0; i < v.size(); ++i) v[i][2] -= 9.81 * dt;
///
/// Of soa it is a contiguous range: it converts to std::span, and so to points.
template <class Value, class Place>
class column {
    static constexpr bool is_contiguous = std::is_same_v<Place, contiguous_place<Value>>;

public:
    using value_type = std::remove_const_t<Value>;

    /// From element to element; random access.
    class cursor {
    public:
        using iterator_category = std::random_access_iterator_tag;
        using value_type = std::remove_const_t<Value>;
        using difference_type = std::ptrdiff_t;
        using reference = Value&;
        using pointer = Value*;

        cursor() = default;
        cursor(Place place, std::size_t at) noexcept : place_(place), at_(at) {}
        Value& operator*() const noexcept { return place_.at(at_); }
        Value* operator->() const noexcept { return &place_.at(at_); }
        Value& operator[](difference_type n) const noexcept { return *(*this + n); }
        cursor& operator+=(difference_type n) noexcept {
            at_ = static_cast<std::size_t>(static_cast<difference_type>(at_) + n);
            return *this;
        }
        cursor& operator-=(difference_type n) noexcept { return *this += -n; }
        cursor& operator++() noexcept { return *this += 1; }
        cursor& operator--() noexcept { return *this += -1; }
        cursor operator++(int) noexcept { return std::exchange(*this, *this + 1); }
        cursor operator--(int) noexcept { return std::exchange(*this, *this - 1); }
        friend cursor operator+(cursor a, difference_type n) noexcept { return a += n; }
        friend cursor operator+(difference_type n, cursor a) noexcept { return a += n; }
        friend cursor operator-(cursor a, difference_type n) noexcept { return a -= n; }
        friend difference_type operator-(const cursor& a, const cursor& b) noexcept {
            return static_cast<difference_type>(a.at_) - static_cast<difference_type>(b.at_);
        }
        friend bool operator==(const cursor& a, const cursor& b) noexcept { return a.at_ == b.at_; }
        friend std::strong_ordering operator<=>(const cursor& a, const cursor& b) noexcept { return a.at_ <=> b.at_; }

    private:
        Place place_{};
        std::size_t at_ = 0;
    };
    using iterator = std::conditional_t<is_contiguous, Value*, cursor>;

    column(Place place, std::size_t count, lease until) noexcept : place_(place), count_(count), until_(until) {}

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    template <std::integral Index>
    [[nodiscard, gnu::always_inline]] Value& operator[](Index index) const noexcept {
        const auto i = static_cast<std::size_t>(index);  // of a negative one: beyond all
        until_.check();
        TSUBU_EXPECTS(i < count_, "no particle with this index; indices go from 0 to size() - 1");
        return place_.at(i);
    }
    [[nodiscard]] iterator begin() const noexcept {
        until_.check();
        if constexpr (is_contiguous)
            return place_.start;
        else
            return cursor(place_, 0);
    }
    [[nodiscard]] iterator end() const noexcept { return begin() + static_cast<std::ptrdiff_t>(count_); }
    /// Of soa only.
    [[nodiscard]] Value* data() const noexcept
        requires is_contiguous
    {
        until_.check();
        return place_.start;
    }
    [[nodiscard]] std::span<Value> span() const noexcept
        requires is_contiguous
    {
        return {data(), count_};
    }
    /// `count` of them, from `first` on.
    [[nodiscard]] column part(std::size_t first, std::size_t count) const noexcept {
        TSUBU_EXPECTS(first + count <= count_, "a part that reaches beyond the column; ask size()");
        return {place_.from(first), count, until_};
    }

private:
    Place place_;
    std::size_t count_;
    [[no_unique_address]] lease until_;
};

namespace detail {

/// Walks a column whose values are made when they are asked for.
template <class Column>
class column_walk {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = decltype(std::declval<const Column&>()[std::size_t{}]);
    using difference_type = std::ptrdiff_t;
    using reference = value_type;
    using pointer = void;

    column_walk(const Column& of, std::size_t at) noexcept : of_(of), at_(at) {}
    reference operator*() const noexcept { return of_[at_]; }
    column_walk& operator++() noexcept {
        ++at_;
        return *this;
    }
    column_walk operator++(int) noexcept {
        auto before = *this;
        ++at_;
        return before;
    }
    friend bool operator==(const column_walk& a, const column_walk& b) noexcept { return a.at_ == b.at_; }

private:
    Column of_;
    std::size_t at_;
};

}  // namespace detail
}  // namespace tsubu

/// A column is a view: what it leads to outlives it.
template <class Value, class Place>
inline constexpr bool std::ranges::enable_borrowed_range<tsubu::column<Value, Place>> = true;
