// SPDX-License-Identifier: MIT
/// @file
/// particle_reference and particle_range: one particle of a store, and some that follow one another.
#pragma once

#include <tsubu/core/expects.hpp>
#include <tsubu/store/column.hpp>
#include <tsubu/store/field.hpp>

#include <compare>      // std::strong_ordering
#include <concepts>     // std::integral
#include <cstddef>      // std::ptrdiff_t, std::size_t
#include <iterator>     // std::random_access_iterator_tag
#include <tuple>        // std::get, std::tuple
#include <type_traits>  // std::is_const_v, std::remove_const_t
#include <utility>      // std::exchange, std::index_sequence, std::move

namespace tsubu {

template <class Store>
class particle_reference;

/// One particle outside of its store: what std::sort and its like hold while they move particles. Made from an rvalue
/// it takes what lies in pools (lists, values that only some have) away from the particle; else it holds a copy. For as
/// long as one algorithm lasts: to keep a particle, pack it.
template <class Fields, class... Held>
struct particle_record {
    template <class Store>
    particle_record(particle_reference<Store> particle)  // by value: see detail::move_mark
        : values(held(particle, std::index_sequence_for<Held...>{})) {}

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

    std::tuple<Held...> values;

private:
    template <class Store, std::size_t... K>
    [[nodiscard]] static std::tuple<Held...> held(const particle_reference<Store>& particle,
                                                  std::index_sequence<K...>) {
        return {particle.template held<K>()...};
    }
};

namespace detail {

/// Tells `*a = std::move(*b)`, which algorithms write to bring particles into an order, from `*a = *b` and
/// `g[i] = g[j]`, where both are to have the lists afterwards. A parameter that is taken by value is made in place by a
/// call (*b), and copied from a name, but moved from std::move(*b). Who returns *b for std::move(*b) gets a copy: more
/// work, and as right.
template <bool HasPools>
struct move_mark {
    static constexpr bool is_moved = false;  // nothing lies in pools: a copy is as good
};
template <>
struct move_mark<true> {
    move_mark() = default;
    move_mark(const move_mark&) noexcept {}
    move_mark(move_mark&&) noexcept : is_moved(true) {}
    move_mark& operator=(const move_mark&) = delete;
    ~move_mark() = default;
    bool is_moved = false;
};

}  // namespace detail

/// One particle of a store, all of it: a view, which adding particles ends. Assigning to it assigns all fields, lists
/// included: copied, or given away by std::move. Swapping swaps them. It stands for a place, as the reference of
/// std::vector<bool> does, so std::sort works on particles.
///
///     const auto mine = g.owned();
///     std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
template <class Store>
class particle_reference {
    using store_type = std::remove_const_t<Store>;
    static constexpr bool is_const = std::is_const_v<Store>;
    static constexpr bool has_pools = store_type::has_pools;

public:
    using record = typename store_type::record;

    particle_reference(Store& store, std::size_t i) noexcept : store_(&store), i_(i), until_(store.current_lease()) {
        TSUBU_EXPECTS(i < store.size(), "no particle with this index; indices go from 0 to size() - 1");
    }
    particle_reference(const particle_reference&) = default;
    particle_reference(particle_reference&&) noexcept = default;
    ~particle_reference() = default;

    [[nodiscard]] std::size_t index() const noexcept { return i_; }
    template <particle_field Field>
        requires(store_type::fields_type::template has<Field>)
    [[nodiscard]] decltype(auto) operator[](Field) const noexcept {
        until_.check();
        return (*store_)[Field{}][i_];
    }

    /// After std::move the other particle has empty lists, else both have the same; they share nothing.
    /// Strong guarantee.
    const particle_reference& operator=(particle_reference other) const noexcept(!has_pools)  // see detail::move_mark
        requires(!is_const)
    {
        check();
        other.check();
        if (other.mark_.is_moved && store_ == other.store_)
            store_->move_row(other.i_, i_);
        else
            store_->copy_row_of(*other.store_, other.i_, i_);
        return *this;
    }
    const particle_reference& operator=(const particle_reference<const store_type>& other) const noexcept(!has_pools)
        requires(!is_const)
    {
        check();
        other.check();
        store_->copy_row_of(*other.store_, other.i_, i_);
        return *this;
    }
    const particle_reference& operator=(record&& values) const noexcept(!has_pools)
        requires(!is_const)
    {
        check();
        store_->put_row(i_, std::move(values));
        return *this;
    }
    const particle_reference& operator=(const record& values) const noexcept(!has_pools)
        requires(!is_const)
    {
        check();
        store_->put_row(i_, values);
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
    template <class Other>
    friend class particle_reference;
    template <class Fields, class... Held>
    friend struct particle_record;

    void check() const noexcept {
        until_.check();
        TSUBU_EXPECTS(i_ < store_->size(), "no particle with this index; indices go from 0 to size() - 1");
    }
    void swap_with(const particle_reference& other) const noexcept
        requires(!is_const)
    {
        check();
        other.check();
        TSUBU_EXPECTS(store_ == other.store_, "particles of two stores do not swap; pack one and unpack it there");
        store_->swap_rows(i_, other.i_);
    }
    template <std::size_t K>
    [[nodiscard]] auto held() const {
        check();
        return store_type::template held_of<K>(*store_, i_, mark_.is_moved);
    }

    Store* store_;
    std::size_t i_;
    [[no_unique_address]] lease until_;
    [[no_unique_address]] detail::move_mark<has_pools> mark_;
};

/// Some particles of a store that follow one another: the owned ones, the ghosts, or all; a view, which adding
/// particles ends.
template <class Store>
class particle_range {
public:
    using reference = particle_reference<Store>;

    /// From particle to particle; random access, and what it yields can be swapped, as sorting does.
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
        friend std::strong_ordering operator<=>(const iterator& a, const iterator& b) noexcept {
            return a.at_ <=> b.at_;
        }

    private:
        Store* store_ = nullptr;
        std::size_t at_ = 0;
    };

    particle_range(Store& store, std::size_t first, std::size_t count) noexcept
        : store_(&store), first_(first), count_(count), until_(store.current_lease()) {}

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] iterator begin() const noexcept {
        until_.check();
        return {*store_, first_};
    }
    [[nodiscard]] iterator end() const noexcept { return begin() + static_cast<std::ptrdiff_t>(count_); }
    template <std::integral Index>
    [[nodiscard]] reference operator[](Index index) const noexcept {
        const auto i = static_cast<std::size_t>(index);  // of a negative one: beyond all
        until_.check();
        TSUBU_EXPECTS(i < count_, "no particle with this index; indices go from 0 to size() - 1");
        return {*store_, first_ + i};
    }
    /// The values of one field, of these particles.
    template <particle_field Field>
        requires(std::remove_const_t<Store>::fields_type::template has<Field>)
    [[nodiscard]] auto operator[](Field) const noexcept {
        until_.check();
        return (*store_)[Field{}].part(first_, count_);
    }

private:
    Store* store_;
    std::size_t first_;
    std::size_t count_;
    [[no_unique_address]] lease until_;
};

}  // namespace tsubu
