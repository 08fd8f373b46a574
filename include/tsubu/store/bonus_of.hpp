// SPDX-License-Identifier: MIT
/// @file
/// bonus_of: a value that only some particles have: the shape of the few that are no spheres.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/store/column.hpp>
#include <tsubu/store/growth.hpp>

#include <algorithm>    // std::copy_n
#include <concepts>     // std::integral
#include <cstddef>      // std::size_t
#include <span>         // std::span
#include <type_traits>  // std::conditional_t, std::is_trivially_copyable_v, std::type_identity_t
#include <utility>      // std::move

namespace tsubu {

/// The type of a field that only some particles have: an index per particle, and a dense array of the values of those
/// that have one, each with its particle.
///
///     inline constexpr tsubu::field<"shape", tsubu::bonus_of<ellipsoid>> shape{};
///     g[shape][i].emplace({1, 2, 3});
///     for (auto& e : g[shape].values()) ...
///
/// Bytes: 4 per particle, and sizeof(Value) + 4 per value, in blocks of 8192 (C2).
/// A type to name, without objects: `shape = ...` says how a value is given.
///
/// @tparam Value  trivially copyable.
template <class Value>
struct bonus_of {
    static_assert(std::is_trivially_copyable_v<Value>, "bonus_of holds a trivially copyable type");
    using element_type = Value;

    template <class... Any>
    constexpr bonus_of(const Any&...) {
        refuse<Value, Any...>();
    }
    template <class Any = Value>
    constexpr bonus_of(const std::type_identity_t<Any>&) {
        refuse<Any>();
    }

private:
    template <class Any, class...>
    static constexpr void refuse() {
        static_assert(sizeof(Any) == 0, "a value that only some have is given later: g[field][i].emplace(value)");
    }
};

namespace detail {

/// Where the value of a particle lies.
struct bonus_place {
    index_t at = absent;
};

/// Invariant: owner(place(i).at) == i for each particle i that has a value.
template <class Value>
class bonus_pool {
    static_assert(std::is_trivially_copyable_v<Value>, "bonus_of holds a trivially copyable type");

public:
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] Value& value(bonus_place place) noexcept { return values_[static_cast<std::size_t>(place.at)]; }
    [[nodiscard]] const Value& value(bonus_place place) const noexcept {
        return values_[static_cast<std::size_t>(place.at)];
    }
    [[nodiscard]] std::span<Value> values() noexcept { return {values_.data(), size_}; }
    [[nodiscard]] std::span<const Value> values() const noexcept { return {values_.data(), size_}; }
    [[nodiscard]] std::span<const index_t> owners() const noexcept { return {owners_.data(), size_}; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return values_.memory_bytes() + owners_.memory_bytes(); }

    /// For one value more: emplace does not throw then. Strong guarantee.
    void make_room() {
        if (size_ == values_.size()) grow();
    }
    /// Strong guarantee.
    void emplace(bonus_place& place, index_t owner, const Value& value) {
        const auto kept = value;  // it may lie in this pool
        if (place.at == absent) {
            make_room();
            place.at = static_cast<index_t>(size_++);
            owners_[static_cast<std::size_t>(place.at)] = owner;
        }
        this->value(place) = kept;
    }
    /// The last value moves into the hole; place_of(i) is the place of particle i.
    template <class PlaceOf>
    void reset(bonus_place& place, PlaceOf&& place_of) noexcept {
        if (place.at == absent) return;
        const auto hole = static_cast<std::size_t>(place.at);
        const auto last = --size_;
        place.at = absent;
        if (hole == last) return;
        values_[hole] = values_[last];
        owners_[hole] = owners_[last];
        place_of(owners_[hole]).at = static_cast<index_t>(hole);
    }
    /// The particle has another index now.
    void settle(bonus_place place, index_t owner) noexcept {
        if (place.at != absent) owners_[static_cast<std::size_t>(place.at)] = owner;
    }
    void clear() noexcept { size_ = 0; }

private:
    void grow() {
        const auto capacity = static_cast<std::size_t>(round_up(size_ + size_ / 2 + 1, bonus_block));
        buffer<Value> values(capacity, {});
        buffer<index_t> owners(capacity, {});
        std::copy_n(values_.data(), size_, values.data());
        std::copy_n(owners_.data(), size_, owners.data());
        values_ = std::move(values);
        owners_ = std::move(owners);
    }

    buffer<Value> values_;
    buffer<index_t> owners_;
    std::size_t size_ = 0;
};

}  // namespace detail

/// The value of one particle, if it has one: a reference, as std::optional of it.
template <class Value, class PlaceOf, bool IsConst = false>
class bonus_reference {
    using pool = std::conditional_t<IsConst, const detail::bonus_pool<Value>, detail::bonus_pool<Value>>;
    using value_type = std::conditional_t<IsConst, const Value, Value>;

public:
    bonus_reference(pool& of, PlaceOf places, std::size_t i, lease until) noexcept
        : pool_(&of), places_(places), i_(i), until_(until) {}

    [[nodiscard]] bool has_value() const noexcept { return place().at != absent; }
    explicit operator bool() const noexcept { return has_value(); }
    [[nodiscard]] value_type& operator*() const noexcept {
        TSUBU_EXPECTS(has_value(), "this particle has no value of the field; ask has_value() first");
        return pool_->value(place());
    }
    [[nodiscard]] value_type* operator->() const noexcept { return &**this; }
    /// Gives the particle a value, or another. Strong guarantee.
    void emplace(const Value& value) const
        requires(!IsConst)
    {
        pool_->emplace(place(), static_cast<index_t>(i_), value);
    }
    /// Takes it away: the last value moves into its place.
    void reset() const noexcept
        requires(!IsConst)
    {
        pool_->reset(place(),
                     [&](index_t owner) -> auto& { return places_.at(static_cast<std::size_t>(owner)); });
    }

private:
    [[nodiscard]] auto& place() const noexcept {
        until_.check();
        return places_.at(i_);
    }

    pool* pool_;
    PlaceOf places_;
    std::size_t i_;
    [[no_unique_address]] lease until_;
};

/// The values of a field that only some particles have; by particle, or all that there are.
template <class Value, class Place, bool IsConst = false>
class bonus_column {
    using pool = std::conditional_t<IsConst, const detail::bonus_pool<Value>, detail::bonus_pool<Value>>;

public:
    bonus_column(Place place, std::size_t count, pool& of, lease until) noexcept
        : place_(place), count_(count), pool_(&of), until_(until) {}

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    template <std::integral Index>
    [[nodiscard]] bonus_reference<Value, Place, IsConst> operator[](Index index) const noexcept {
        const auto i = static_cast<std::size_t>(index);  // of a negative one: beyond all
        until_.check();
        TSUBU_EXPECTS(i < count_, "no particle with this index; indices go from 0 to size() - 1");
        return {*pool_, place_, first_ + i, until_};
    }
    /// By particle, those without a value too.
    [[nodiscard]] auto begin() const noexcept {
        until_.check();
        return detail::column_walk<bonus_column>(*this, 0);
    }
    [[nodiscard]] auto end() const noexcept { return detail::column_walk<bonus_column>(*this, count_); }
    /// The values that there are, in no order; owners()[k] is the particle of values()[k].
    [[nodiscard]] auto values() const noexcept {
        until_.check();
        return pool_->values();
    }
    [[nodiscard]] std::span<const index_t> owners() const noexcept {
        until_.check();
        return pool_->owners();
    }
    [[nodiscard]] bonus_column part(std::size_t first, std::size_t count) const noexcept {
        TSUBU_EXPECTS(first + count <= count_, "a part that reaches beyond the column; ask size()");
        auto some = *this;
        some.first_ += first;
        some.count_ = count;
        return some;
    }

private:
    Place place_;
    std::size_t first_ = 0;
    std::size_t count_;
    pool* pool_;
    [[no_unique_address]] lease until_;
};

}  // namespace tsubu
