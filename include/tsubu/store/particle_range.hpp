// SPDX-License-Identifier: MIT
/// @file
/// particle_reference and particle_range: one particle of a store, and some that follow one another.
#pragma once

#include <tsubu/core/expects.hpp>
#include <tsubu/store/field.hpp>

#include <compare>      // std::strong_ordering
#include <cstddef>      // std::ptrdiff_t, std::size_t
#include <iterator>     // std::random_access_iterator_tag
#include <tuple>        // std::get, std::tuple
#include <type_traits>  // std::is_const_v, std::remove_const_t
#include <utility>      // std::exchange, std::index_sequence

namespace tsubu {

/// All that lies in memory for one particle: what std::sort and its like hold while they move particles.
template <class Fields, class... Values>
struct particle_record {
    std::tuple<Values...> values;

    template <particle_field Field>
        requires(Fields::template has<Field>)
    [[nodiscard]] auto& operator[](Field) noexcept {
        return std::get<Fields::template place<Field>()>(values);
    }
    template <particle_field Field>
        requires(Fields::template has<Field>)
    [[nodiscard]] const auto& operator[](Field) const noexcept {
        return std::get<Fields::template place<Field>()>(values);
    }
};

/// One particle of a store, all of it: assigning to it assigns its fields, swapping swaps them. It stands for a place, as
/// the reference of std::vector<bool> does, so std::sort works on particles.
///
///     std::sort(g.owned().begin(), g.owned().end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
template <class Store>
class particle_reference {
    using store_type = std::remove_const_t<Store>;
    static constexpr bool is_const = std::is_const_v<Store>;

public:
    using record = typename store_type::record;

    particle_reference(Store& store, std::size_t i) noexcept : store_(&store), i_(i) {
        TSUBU_EXPECTS(i < store.size(), "no particle with this index; indices go from 0 to size() - 1");
    }
    particle_reference(const particle_reference&) = default;

    [[nodiscard]] std::size_t index() const noexcept { return i_; }
    template <particle_field Field>
        requires(store_type::fields_type::template has<Field>)
    [[nodiscard]] decltype(auto) operator[](Field) const noexcept {
        return (*store_)[Field{}][i_];
    }

    /// What lies in memory for the particle: a copy, or back again. Lists lie in their pool, and are told of by where.
    operator record() const noexcept { return values(indices{}); }
    const particle_reference& operator=(const record& values) const noexcept
        requires(!is_const)
    {
        set(values, indices{});
        return *this;
    }
    const particle_reference& operator=(const particle_reference& other) const noexcept
        requires(!is_const)
    {
        return *this = static_cast<record>(other);
    }
    particle_reference& operator=(const particle_reference& other) noexcept
        requires(!is_const)
    {
        static_cast<const particle_reference&>(*this) = static_cast<record>(other);
        return *this;
    }
    friend void swap(const particle_reference& a, const particle_reference& b) noexcept
        requires(!is_const)
    {
        a.swap_with(b);
    }
    /// For named references, where std::swap would be the better match, and swap nothing but where they lead.
    friend void swap(particle_reference& a, particle_reference& b) noexcept
        requires(!is_const)
    {
        a.swap_with(b);
    }

private:
    using indices = std::make_index_sequence<store_type::fields_type::count>;

    void swap_with(const particle_reference& other) const noexcept
        requires(!is_const)
    {
        TSUBU_EXPECTS(store_ == other.store_, "particles of two stores do not swap; pack one and unpack it there");
        store_->swap_rows(i_, other.i_);
    }
    template <std::size_t... K>
    [[nodiscard]] record values(std::index_sequence<K...>) const noexcept {
        return {{store_->memory_.template at<K>(i_)...}};
    }
    template <std::size_t... K>
    void set(const record& values, std::index_sequence<K...>) const noexcept {
        ((store_->memory_.template at<K>(i_) = std::get<K>(values.values)), ...);
        store_->settle_row(i_);
    }

    Store* store_;
    std::size_t i_;
};

/// Some particles of a store that follow one another: the owned ones, the ghosts, or all.
template <class Store>
class particle_range {
public:
    using reference = particle_reference<Store>;

    class iterator {
    public:
        using iterator_category = std::random_access_iterator_tag;
        using value_type = typename std::remove_const_t<Store>::record;
        using difference_type = std::ptrdiff_t;
        using reference = particle_reference<Store>;
        using pointer = void;

        iterator() = default;
        iterator(Store& store, std::size_t at) noexcept : store_(&store), at_(at) {}
        reference operator*() const noexcept { return {*store_, at_}; }
        reference operator[](difference_type n) const noexcept { return *(*this + n); }
        iterator& operator+=(difference_type n) noexcept {
            at_ = static_cast<std::size_t>(static_cast<difference_type>(at_) + n);
            return *this;
        }
        iterator& operator-=(difference_type n) noexcept { return *this += -n; }
        iterator& operator++() noexcept { return *this += 1; }
        iterator& operator--() noexcept { return *this += -1; }
        iterator operator++(int) noexcept { return std::exchange(*this, *this + 1); }
        iterator operator--(int) noexcept { return std::exchange(*this, *this - 1); }
        friend iterator operator+(iterator a, difference_type n) noexcept { return a += n; }
        friend iterator operator+(difference_type n, iterator a) noexcept { return a += n; }
        friend iterator operator-(iterator a, difference_type n) noexcept { return a -= n; }
        friend difference_type operator-(const iterator& a, const iterator& b) noexcept {
            return static_cast<difference_type>(a.at_) - static_cast<difference_type>(b.at_);
        }
        friend bool operator==(const iterator& a, const iterator& b) noexcept { return a.at_ == b.at_; }
        friend std::strong_ordering operator<=>(const iterator& a, const iterator& b) noexcept { return a.at_ <=> b.at_; }

    private:
        Store* store_ = nullptr;
        std::size_t at_ = 0;
    };

    particle_range(Store& store, std::size_t first, std::size_t count) noexcept
        : store_(&store), first_(first), count_(count) {}

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] iterator begin() const noexcept { return {*store_, first_}; }
    [[nodiscard]] iterator end() const noexcept { return {*store_, first_ + count_}; }
    [[nodiscard]] reference operator[](std::size_t i) const noexcept { return {*store_, first_ + i}; }
    /// The values of one field, of these particles.
    template <particle_field Field>
        requires(std::remove_const_t<Store>::fields_type::template has<Field>)
    [[nodiscard]] auto operator[](Field) const noexcept {
        return (*store_)[Field{}].part(first_, count_);
    }

private:
    Store* store_;
    std::size_t first_;
    std::size_t count_;
};

}  // namespace tsubu
