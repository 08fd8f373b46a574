// SPDX-License-Identifier: MIT
/// @file
/// list_of: as many values as each particle has: bonds, contacts and what they remember.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/store/column.hpp>

#include <algorithm>         // std::copy_n, std::max
#include <concepts>          // std::integral
#include <cstddef>           // std::size_t
#include <cstdint>           // std::uint32_t, std::uint64_t
#include <initializer_list>  // std::initializer_list
#include <limits>            // std::numeric_limits
#include <span>              // std::span
#include <string>            // std::to_string
#include <type_traits>       // std::is_trivially_copyable_v
#include <utility>           // std::exchange, std::move

namespace tsubu {

// All lists of one field lie in one pool, each in a stretch with some room; a particle holds where:
//
//     particle   begin size room        pool
//        0         0    2    2          | a b | c . . . | d e f . | (free) ...
//        1         2    1    4            0     2         6
//        2         6    3    4
//
// A list that is full moves to the end of what is used, into twice the room. The stretch that it leaves is garbage,
// which compaction drops: when more than half of what is used is garbage, at the next operation of the store that
// touches rows. Since room doubles, garbage is less than the room of the lists that left it.
//
// No two particles share a stretch. An algorithm that moves particles takes a list out of its particle and gives it to
// another; in between the stretch counts as garbage, so that one that is never given is dropped like any other.

/// The type of a field with as many values as each particle has.
///
///     inline constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};
///
/// A type to name, without objects: `contacts = {...}` says how a list is filled.
///
/// @tparam Element  trivially copyable.
template <class Element>
struct list_of {
    static_assert(std::is_trivially_copyable_v<Element>, "list_of holds a trivially copyable type");
    using element_type = Element;

    template <class Any = Element>
    constexpr list_of(std::initializer_list<Element>) {
        refuse<Any>();
    }
    template <class Any>
    constexpr list_of(const Any&) {
        refuse<Any>();
    }

private:
    template <class Any>
    static constexpr void refuse() {
        static_assert(sizeof(Any) == 0, "a list is filled after its particle is there: g[field][i].push_back(element)");
    }
};

namespace detail {

/// Where the list of a particle lies.
struct list_extent {
    std::uint64_t begin = 0;
    std::uint32_t size = 0;
    std::uint32_t room = 0;
};

template <class Element>
class list_pool {
    static_assert(std::is_trivially_copyable_v<Element>, "list_of holds a trivially copyable type");

public:
    [[nodiscard]] Element* at(const list_extent& list) noexcept { return elements_.data() + list.begin; }
    [[nodiscard]] const Element* at(const list_extent& list) const noexcept { return elements_.data() + list.begin; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return elements_.memory_bytes(); }

    /// Makes room for `wanted` elements; those that are there stay. Strong guarantee.
    void reserve(list_extent& list, std::size_t wanted) {
        if (wanted <= list.room) return;
        if (wanted > (std::numeric_limits<std::uint32_t>::max)() / 2)
            raise<limit_error>("list_of", std::to_string(wanted) + " values of one particle",
                               "a particle holds fewer than 2^31");
        constexpr std::size_t least = 2;  // most lists stay short
        const auto room = (std::max)({wanted, std::size_t{2} * list.room, least});
        if (used_ + room > elements_.size()) grow(used_ + room);
        std::copy_n(at(list), list.size, elements_.data() + used_);
        garbage_ += list.room;
        list.begin = used_;
        list.room = static_cast<std::uint32_t>(room);
        used_ += room;
    }
    void release(list_extent& list) noexcept {
        garbage_ += list.room;
        list = {};
    }
    /// Makes the list what another is, which may lie in this pool. Strong guarantee.
    void copy(list_extent& to, const list_extent& from, const list_pool& of) {
        reserve(to, from.size);
        std::copy_n(of.at(from), from.size, at(to));
        to.size = from.size;
    }
    /// The particle has an empty list then.
    [[nodiscard]] list_extent take(list_extent& list) noexcept {
        garbage_ += list.room;
        return std::exchange(list, {});
    }
    /// Precondition: `taken` was taken in this era, and was not given yet.
    void give(list_extent& to, const list_extent& taken) noexcept {
        release(to);
        garbage_ -= taken.room;
        to = taken;
    }
    /// Changes when lists that have been taken are dropped.
    [[nodiscard]] std::uint64_t era() const noexcept { return era_; }
    [[nodiscard]] bool wants_compaction() const noexcept { return garbage_ > used_ / 2 && used_ > 1024; }
    /// each(visit) calls visit(extent) for every list there is, in the order that is wanted.
    template <class Each>
    void compact(Each&& each) {
        std::size_t needed = 0;
        each([&](list_extent& list) { needed += list.size; });
        buffer<Element> fresh(needed + needed / 4, {});
        std::size_t at = 0;
        each([&](list_extent& list) {
            std::copy_n(elements_.data() + list.begin, list.size, fresh.data() + at);
            list.begin = at;
            list.room = list.size;
            at += list.size;
        });
        elements_ = std::move(fresh);
        used_ = at;
        garbage_ = 0;
        ++era_;
    }
    void clear() noexcept {
        used_ = garbage_ = 0;
        ++era_;
    }

private:
    void grow(std::size_t needed) {
        buffer<Element> fresh((std::max)(needed, elements_.size() + elements_.size() / 2), {});
        std::copy_n(elements_.data(), used_, fresh.data());
        elements_ = std::move(fresh);
    }

    buffer<Element> elements_;
    std::size_t used_ = 0;
    std::size_t garbage_ = 0;
    std::uint64_t era_ = 0;
};

/// The list of a particle that an algorithm holds outside of the store: its only owner. It can be moved, and read.
template <class Element>
class held_list {
public:
    held_list(list_pool<Element>& of, list_extent taken) noexcept : pool_(&of), list_(taken), era_(of.era()) {}
    held_list(held_list&& other) noexcept
        : pool_(other.pool_), list_(std::exchange(other.list_, {})), era_(other.era_) {}
    held_list& operator=(held_list&& other) noexcept {
        pool_ = other.pool_;
        list_ = std::exchange(other.list_, {});
        era_ = other.era_;
        return *this;
    }
    ~held_list() = default;

    [[nodiscard]] std::size_t size() const noexcept { return list_.size; }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    [[nodiscard]] const Element* begin() const noexcept { return pool().at(list_); }
    [[nodiscard]] const Element* end() const noexcept { return begin() + size(); }
    [[nodiscard]] const Element& operator[](std::size_t k) const noexcept {
        TSUBU_EXPECTS(k < size(), "no element with this number in the list; ask size()");
        return begin()[k];
    }
    [[nodiscard]] std::span<const Element> span() const noexcept { return {begin(), size()}; }
    /// Room in `to` for a copy: what follows does not throw. Strong guarantee.
    void reserve(list_pool<Element>& of, list_extent& to) const { of.reserve(to, size()); }
    /// Gives it away, or a copy to another store.
    void give(list_pool<Element>& of, list_extent& to) {
        if (pool_ != &of) return copy(of, to);
        TSUBU_EXPECTS(is_there(), "a list was held while the store dropped it; give it back before the store changes");
        of.give(to, is_there() ? std::exchange(list_, {}) : list_extent{});
    }
    void copy(list_pool<Element>& of, list_extent& to) const { of.copy(to, list_, pool()); }
    [[nodiscard]] bool lies_in(const list_pool<Element>& of) const noexcept { return pool_ == &of; }

private:
    [[nodiscard]] bool is_there() const noexcept { return list_.room == 0 || era_ == pool_->era(); }
    [[nodiscard]] const list_pool<Element>& pool() const noexcept {
        TSUBU_EXPECTS(is_there(), "a list was held while the store dropped it; give it back before the store changes");
        return *pool_;
    }

    list_pool<Element>* pool_;
    list_extent list_;
    std::uint64_t era_;
};

}  // namespace detail

/// The list of one particle: a view, which adding particles ends. Its elements move when a list of the field grows:
/// what begin() and span() gave ends then, and the list can be asked again.
template <class Element, bool IsConst = false>
class list_reference {
    using pool = std::conditional_t<IsConst, const detail::list_pool<Element>, detail::list_pool<Element>>;
    using extent = std::conditional_t<IsConst, const detail::list_extent, detail::list_extent>;
    using value = std::conditional_t<IsConst, const Element, Element>;

public:
    list_reference(pool& of, extent& list, lease until) noexcept : pool_(&of), list_(&list), until_(until) {}

    [[nodiscard]] std::size_t size() const noexcept {
        until_.check();
        return list_->size;
    }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    [[nodiscard]] value* begin() const noexcept {
        until_.check();
        return pool_->at(*list_);
    }
    [[nodiscard]] value* end() const noexcept { return begin() + size(); }
    [[nodiscard]] value& operator[](std::size_t k) const noexcept {
        TSUBU_EXPECTS(k < size(), "no element with this number in the list; ask size()");
        return begin()[k];
    }
    [[nodiscard]] std::span<value> span() const noexcept { return {begin(), size()}; }
    /// Complexity: amortised O(1). Strong guarantee.
    void push_back(const Element& element) const
        requires(!IsConst)
    {
        const auto kept = element;  // it may lie in this pool
        reserve(size() + 1);
        begin()[list_->size++] = kept;
    }
    /// The last one moves into its place.
    void swap_remove(std::size_t k) const noexcept
        requires(!IsConst)
    {
        (*this)[k] = (*this)[size() - 1];
        --list_->size;
    }
    void clear() const noexcept
        requires(!IsConst)
    {
        until_.check();
        list_->size = 0;
    }
    /// Room for as many: adding up to there neither throws nor moves elements. Strong guarantee.
    void reserve(std::size_t count) const
        requires(!IsConst)
    {
        until_.check();
        pool_->reserve(*list_, count);
    }
    /// New elements are not initialised. Strong guarantee.
    void resize(std::size_t count) const
        requires(!IsConst)
    {
        reserve(count);
        list_->size = static_cast<std::uint32_t>(count);
    }
    /// Strong guarantee. Precondition: the elements do not lie in this store.
    void assign(std::span<const Element> elements) const
        requires(!IsConst)
    {
        resize(elements.size());
        std::copy_n(elements.data(), elements.size(), begin());
    }

private:
    pool* pool_;
    extent* list_;
    [[no_unique_address]] lease until_;
};

/// The lists of some particles, which can be indexed and walked.
///
///     for (auto list : g[contacts]) list.clear();
template <class Element, class Place, bool IsConst = false>
class list_column {
    using pool = std::conditional_t<IsConst, const detail::list_pool<Element>, detail::list_pool<Element>>;

public:
    list_column(Place place, std::size_t count, pool& of, lease until) noexcept
        : place_(place), count_(count), pool_(&of), until_(until) {}

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    template <std::integral Index>
    [[nodiscard]] list_reference<Element, IsConst> operator[](Index index) const noexcept {
        const auto i = static_cast<std::size_t>(index);  // of a negative one: beyond all
        until_.check();
        TSUBU_EXPECTS(i < count_, "no particle with this index; indices go from 0 to size() - 1");
        return {*pool_, place_.at(i), until_};
    }
    [[nodiscard]] auto begin() const noexcept {
        until_.check();
        return detail::column_walk<list_column>(*this, 0);
    }
    [[nodiscard]] auto end() const noexcept { return detail::column_walk<list_column>(*this, count_); }
    [[nodiscard]] list_column part(std::size_t first, std::size_t count) const noexcept {
        TSUBU_EXPECTS(first + count <= count_, "a part that reaches beyond the column; ask size()");
        return {place_.from(first), count, *pool_, until_};
    }

private:
    Place place_;
    std::size_t count_;
    pool* pool_;
    [[no_unique_address]] lease until_;
};

}  // namespace tsubu
