// SPDX-License-Identifier: MIT
/// @file
/// particle_store: what the particles of a rank carry.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/store/bonus_of.hpp>
#include <tsubu/store/column.hpp>
#include <tsubu/store/concepts.hpp>
#include <tsubu/store/detail/row_checks.hpp>
#include <tsubu/store/detail/stored.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/growth.hpp>
#include <tsubu/store/list_of.hpp>
#include <tsubu/store/particle_range.hpp>
#include <tsubu/store/soa.hpp>

#include <algorithm>    // std::lower_bound
#include <concepts>     // std::integral
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <memory>       // std::unique_ptr
#include <new>          // std::bad_alloc
#include <span>         // std::span
#include <string>       // std::to_string
#include <tuple>        // std::tuple
#include <type_traits>  // std::conditional_t, std::is_trivially_copyable_v
#include <utility>      // std::exchange, std::index_sequence, std::swap

namespace tsubu {

/// Of fields<...> only: a store is told each field that its particles carry.
template <class Fields, class Layout = soa, class Growth = geometric_growth>
class particle_store;

/// What do the particles of this rank carry? Owned ones first, 0 .. owned_count() - 1, then ghosts.
///
///     tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::radius>> g;
///     g.push_back(tsubu::id = 7, tsubu::radius = 0.5);
///     for (auto& r : g[tsubu::radius]) r *= 2;
///     for (auto grain : g.owned()) grain[tsubu::position<3>][2] += 1;
///
/// Columns, ranges and references are views: what ends them stands at "Invalidates"; debug builds tell it where one is
/// used that is older than the memory.
///
/// @tparam Fields  fields<...>
/// @tparam Layout  a particle_layout: soa, aos or aosoa<N>; a program is the same for all.
/// @tparam Growth  a growth_policy.
///
/// Invariant:   owned_count() <= size() <= capacity(), and size() < 2^31.
/// Invalidates: adding particles, reserve and permute end all views; removing ends those of removed particles; to
///              move a store, and to assign to it, ends its own.
/// Threads:     many readers, or one writer; different particles may be written by different threads.
template <auto... F, class Layout, class Growth>
class particle_store<fields<F...>, Layout, Growth> {
    static_assert(fields<F...>::count == sizeof...(F));  // first of all, what fields says of its arguments
    static_assert(sizeof...(F) > 0, "a store needs a field");
    using memory = typename Layout::template memory<typename detail::stored_of<decltype(F)>::type...>;
    using pools = std::tuple<typename detail::stored_of<decltype(F)>::pool...>;
    static_assert(particle_layout<Layout> && growth_policy<Growth>);
    static_assert((std::is_trivially_copyable_v<typename detail::stored_of<decltype(F)>::type> && ...),
                  "a field holds a trivially copyable type, list_of or bonus_of one");

public:
    using fields_type = fields<F...>;
    using layout_type = Layout;
    using growth_type = Growth;
    using reference = particle_reference<particle_store>;
    using const_reference = particle_reference<const particle_store>;
    using range = particle_range<particle_store>;
    using const_range = particle_range<const particle_store>;
    /// A particle that std::sort and its like hold outside of the store.
    using record = particle_record<fields_type, typename detail::stored_of<decltype(F)>::held...>;
    /// The sum of the sizes of the fields [bytes]; of a list what says where it lies.
    static constexpr std::size_t bytes_per_particle =
        (std::size_t{0} + ... + sizeof(typename detail::stored_of<decltype(F)>::type));
    template <class Field>
    static constexpr bool has = fields_type::template has<Field>;

    particle_store() = default;
    explicit particle_store(Growth growth) : growth_(growth) {}
    particle_store(const particle_store& other)
        : pools_(other.pools_),
          growth_(other.growth_),
          memory_(other.memory_),
          size_(other.size_),
          owned_(other.owned_),
          revision_(other.revision_),
          allocation_(other.allocation_ == nullptr ? nullptr : std::make_unique<std::uint64_t>(0)) {}
    particle_store(particle_store&& other) noexcept
        : pools_(std::exchange(other.pools_, pools())),
          growth_(other.growth_),
          memory_(std::exchange(other.memory_, memory())),
          size_(std::exchange(other.size_, 0)),
          owned_(std::exchange(other.owned_, 0)),
          revision_(other.revision_++),
          allocation_(std::move(other.allocation_)) {
        end_views();
    }
    particle_store& operator=(particle_store other) noexcept {
        std::swap(pools_, other.pools_);
        std::swap(growth_, other.growth_);
        std::swap(memory_, other.memory_);
        std::swap(size_, other.size_);
        std::swap(owned_, other.owned_);
        std::swap(revision_, other.revision_);
        if (allocation_ == nullptr) std::swap(allocation_, other.allocation_);
        end_views();
        return *this;
    }
    ~particle_store() = default;

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t owned_count() const noexcept { return owned_; }
    /// How many are ghosts: those from index owned_count() on.
    [[nodiscard]] std::size_t ghost_count() const noexcept { return size_ - owned_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] std::size_t capacity() const noexcept { return memory_.capacity(); }
    /// A number that is another after particles have come, gone, or been permuted: what holds indices can tell whether
    /// they are of before. Rows that are assigned or sorted change nothing in it.
    [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
    /// What is held, lists and free room included.
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        auto bytes = memory_.memory_bytes();
        each_pool([&](const auto& pool) { bytes += pool.memory_bytes(); });
        return bytes;
    }

    /// The values of one field, of all particles.
    template <particle_field Field>
        requires(fields_type::template has<Field>)
    [[nodiscard]] auto operator[](Field) noexcept {
        return column_of<Field>(*this);
    }
    template <particle_field Field>
        requires(fields_type::template has<Field>)
    [[nodiscard]] auto operator[](Field) const noexcept {
        return column_of<Field>(*this);
    }
    /// Says which field is missing.
    template <particle_field Field>
        requires(!fields_type::template has<Field>)
    void operator[](Field) const noexcept {
        static_assert(has<Field>, "this store has no such field; name it in fields<...>");
    }
    /// All of one particle.
    template <std::integral Index>
    [[nodiscard]] reference operator[](Index i) noexcept {
        return {*this, static_cast<std::size_t>(i)};
    }
    template <std::integral Index>
    [[nodiscard]] const_reference operator[](Index i) const noexcept {
        return {*this, static_cast<std::size_t>(i)};
    }
    [[nodiscard]] range owned() noexcept { return {*this, 0, owned_}; }
    [[nodiscard]] const_range owned() const noexcept { return {*this, 0, owned_}; }
    [[nodiscard]] range ghosts() noexcept { return {*this, owned_, ghost_count()}; }
    [[nodiscard]] const_range ghosts() const noexcept { return {*this, owned_, ghost_count()}; }
    [[nodiscard]] range all() noexcept { return {*this, 0, size_}; }
    [[nodiscard]] const_range all() const noexcept { return {*this, 0, size_}; }

    /// Room for n particles, owned and ghost, in whole blocks. Strong guarantee. @throws limit_error from 2^31 on.
    void reserve(std::size_t n) {
        if (n > max_index_count) detail::refuse_count(n, size_);
        if (n > capacity()) reallocate(round_up(n));
    }
    /// A new owned particle, with the values given and zeros for the others; its index.
    /// Complexity: amortised O(1). Strong guarantee.
    /// @throws input_error if there are ghosts: they come after the owned ones; limit_error at 2^31 particles.
    template <class... Given>
    index_t push_back(const field_value<Given>&... given) {
        const auto i = add_owned(1);
        set(i, given...);
        return static_cast<index_t>(i);
    }
    /// A new ghost, behind all particles; as push_back.
    /// @throws limit_error at 2^31 particles.
    template <class... Given>
    index_t push_back_ghost(const field_value<Given>&... given) {
        const auto i = add_ghosts(1);
        set(i, given...);
        return static_cast<index_t>(i);
    }
    /// `count` owned particles more, all zeros; the index of the first. As push_back.
    std::size_t add_owned(std::size_t count) { return add_owned(count, fields<>{}); }
    /// The same, but what these fields hold is not set: the caller sets it before it is read. Lists and bonus values
    /// begin empty.
    template <auto... Unset>
    std::size_t add_owned(std::size_t count, fields<Unset...> unset) {
        static_assert((has<decltype(Unset)> && ...), "the store lacks a field that is to be left unset");
        detail::refuse_ghosts("particle_store::add_owned", ghost_count());
        const auto first = add(count, unset);
        owned_ = size_;
        return first;
    }
    /// `count` ghosts more, all zeros; the index of the first. As push_back_ghost.
    std::size_t add_ghosts(std::size_t count) { return add(count, fields<>{}); }
    /// The same with fields that the caller sets.
    template <auto... Unset>
    std::size_t add_ghosts(std::size_t count, fields<Unset...> unset) {
        static_assert((has<decltype(Unset)> && ...), "the store lacks a field that is to be left unset");
        return add(count, unset);
    }
    /// Removes all ghosts; their memory is kept for the next.
    void clear_ghosts() noexcept { shrink(owned_); }
    /// Removes all particles; their memory is kept.
    void clear() noexcept {
        shrink(0);
        owned_ = 0;
        each_list([]<std::size_t K>(auto& pool) { pool.clear(); });
    }
    /// Removes an owned particle; the last one moves into its place.
    /// @throws input_error if there are ghosts, or no such particle.
    void swap_remove(std::size_t i) {
        detail::refuse_ghosts("particle_store::swap_remove", ghost_count());
        if (i >= owned_)
            detail::raise<input_error>("particle_store::swap_remove",
                                       "index " + std::to_string(i) + " of " + std::to_string(owned_) +
                                           " owned particles",
                                       "indices go from 0 to owned_count() - 1");
        const auto last = owned_ - 1;
        if (i == last)
            release_row(i);
        else
            move_row(last, i);
        --owned_;
        --size_;
        ++revision_;
        compact_if_due();
    }
    /// Removes owned particles: the last ones that stay move into their places, both in the order of indices.
    /// @param gone  in ascending order, each once.
    /// @throws input_error, and removes nothing, if there are ghosts, or `gone` is not as said.
    /// Complexity: O(gone).
    void remove(std::span<const index_t> gone) {
        detail::refuse_ghosts("particle_store::remove", ghost_count());
        detail::check_ascending("particle_store::remove", gone, owned_);
        const auto kept = owned_ - gone.size();
        auto among_last = std::lower_bound(gone.begin(), gone.end(), kept, [](index_t i, std::size_t n) {
            return static_cast<std::size_t>(i) < n;
        });
        auto to = gone.begin();
        for (auto from = kept; from < owned_; ++from) {
            if (among_last != gone.end() && static_cast<std::size_t>(*among_last) == from) {
                release_row(from);
                ++among_last;
            } else {
                move_row(from, static_cast<std::size_t>(*to++));
            }
        }
        size_ = owned_ = kept;
        ++revision_;
        compact_if_due();
    }
    /// Particle i becomes particle order[i] of before, for all owned ones; one pass over each field.
    /// @throws input_error if there are ghosts, or the lengths differ. Precondition: order is a permutation.
    void permute(std::span<const index_t> order) {
        detail::refuse_ghosts("particle_store::permute", ghost_count());
        detail::check_order_length("particle_store::permute", order.size(), owned_);
        TSUBU_EXPECTS(detail::is_permutation(order), "this is not a permutation; give each index once");
        ++revision_;
        memory_.gather(order.data(), owned_);
        if (allocation_ != nullptr) ++*allocation_;
        if constexpr (has_bonus)
            for (std::size_t i = 0; i < owned_; ++i) settle_row(i);
        compact_if_due();
    }
    /// Drops what lists have left behind, and lays them in the order of the particles. Done by itself when more than
    /// half is left behind, if there is memory for it. Strong guarantee.
    void compact() {
        each_list([&]<std::size_t K>(auto& pool) {
            pool.compact([&](auto&& visit) {
                for (std::size_t i = 0; i < size_; ++i) visit(memory_.template at<K>(i));
            });
        });
    }

private:
    void end_views() noexcept {
        if (allocation_ != nullptr) ++*allocation_;
    }
    template <class Store>
    friend class particle_reference;
    template <class Store>
    friend class particle_range;

    template <std::size_t K>
    using kind_of = std::tuple_element_t<K, std::tuple<detail::stored_of<decltype(F)>...>>;
    template <std::size_t K>
    using field_of = std::tuple_element_t<K, std::tuple<decltype(F)...>>;
    template <std::size_t K>
    using bonus_place_of = typename kind_of<K>::type;
    static constexpr bool has_bonus = (detail::stored_of<decltype(F)>::is_bonus || ...);
    static constexpr bool has_pools = has_bonus || (detail::stored_of<decltype(F)>::is_list || ...);

    [[nodiscard]] lease current_lease() const noexcept { return lease(allocation_.get()); }
    template <class Field, class Self>
    [[nodiscard]] static auto column_of(Self& self) noexcept {
        constexpr auto k = fields_type::template place<Field>();
        using value_type = typename Field::value_type;
        auto place = self.memory_.template place<k>();
        const auto until = self.current_lease();
        constexpr bool is_const = std::is_const_v<Self>;
        if constexpr (detail::stored<value_type>::is_list)
            return list_column<typename value_type::element_type, decltype(place), is_const>(
                place, self.size_, std::get<k>(self.pools_), until);
        else if constexpr (detail::stored<value_type>::is_bonus)
            return bonus_column<typename value_type::element_type, decltype(place), is_const>(
                place, self.size_, std::get<k>(self.pools_), until);
        else
            return column<std::conditional_t<is_const, const value_type, value_type>, decltype(place)>(
                place, self.size_, until);
    }
    template <auto... Unset>
    std::size_t add(std::size_t count, fields<Unset...>) {
        if (count > max_index_count - size_) detail::refuse_count(count, size_);
        const auto needed = size_ + count;
        compact_if_due();  // ghosts that come and go with lists leave garbage
        if (needed > capacity()) reallocate(growth_.next(capacity(), needed));
        const auto first = size_;
        size_ = needed;
        ++revision_;
        each_value([&]<std::size_t K>() {
            constexpr bool lies_outside = kind_of<K>::is_list || kind_of<K>::is_bonus;
            if constexpr (lies_outside || !fields<Unset...>::template has<field_of<K>>)
                for (auto i = first; i < needed; ++i) memory_.template at<K>(i) = {};
        });
        return first;
    }
    void reallocate(std::uint64_t wanted) {
        if (allocation_ == nullptr) allocation_ = std::make_unique<std::uint64_t>(0);
        memory_.reallocate(static_cast<std::size_t>(wanted), size_);
        ++*allocation_;
    }
    void shrink(std::size_t count) noexcept {
        for (auto i = count; i < size_; ++i) release_row(i);
        size_ = count;
        ++revision_;
    }
    template <class... Given>
    void set([[maybe_unused]] std::size_t i, const field_value<Given>&... given) {
        static_assert((has<Given> && ...), "this store has no such field; name it in fields<...>");
        // What lies in pools refuses by itself: see list_of and bonus_of.
        constexpr bool has_pooled = ((detail::stored_of<Given>::is_list || detail::stored_of<Given>::is_bonus) || ...);
        if constexpr ((has<Given> && ...) && !has_pooled)
            (static_cast<void>(memory_.template at<fields_type::template place<Given>()>(i) = given.value), ...);
    }
    /// What lies outside the row is given up.
    void release_row([[maybe_unused]] std::size_t i) noexcept {
        each_list([&]<std::size_t K>(auto& pool) { pool.release(memory_.template at<K>(i)); });
        each_bonus([&]<std::size_t K>(auto&) { reset_bonus<K>(i); });
    }
    /// After a row has come here: what lies outside is told where its particle is.
    void settle_row([[maybe_unused]] std::size_t i) noexcept {
        each_bonus([&]<std::size_t K>(auto& pool) {
            pool.settle(memory_.template at<K>(i), static_cast<index_t>(i));
        });
    }
    void swap_rows(std::size_t i, std::size_t j) noexcept {
        memory_.swap_rows(i, j);
        settle_row(i);
        settle_row(j);
    }
    /// Row `to` becomes what row `from` is, which then has empty lists and no values that only some have.
    void move_row(std::size_t from, std::size_t to) noexcept {
        if (from == to) return;
        release_row(to);
        memory_.copy_row(from, to);  // lists go along: where they lie is in the row
        each_list([&]<std::size_t K>(auto&) { memory_.template at<K>(from) = {}; });
        each_bonus([&]<std::size_t K>(auto&) { memory_.template at<K>(from) = {}; });
        settle_row(to);
    }
    /// Row `to` becomes a copy of row `from` of a store, maybe this one. Strong guarantee.
    void copy_row_of(const particle_store& other, std::size_t from, std::size_t to) noexcept(!has_pools) {
        if (this == &other && from == to) return;
        each_list([&]<std::size_t K>(auto& pool) {
            pool.reserve(memory_.template at<K>(to), other.memory_.template at<K>(from).size);
        });
        each_bonus([&]<std::size_t K>(auto& pool) {
            if (other.memory_.template at<K>(from).at != absent) pool.make_room();
        });
        each_value([&]<std::size_t K>() {  // there is memory for all of it: nothing throws
            auto& value = memory_.template at<K>(to);
            const auto& wanted = other.memory_.template at<K>(from);
            if constexpr (kind_of<K>::is_list)
                std::get<K>(pools_).copy(value, wanted, std::get<K>(other.pools_));
            else if constexpr (kind_of<K>::is_bonus)
                put_bonus<K>(to, wanted.at == absent ? nullptr : &std::get<K>(other.pools_).value(wanted));
            else
                value = wanted;
        });
    }
    /// What a record holds of value K: taken away from the row if it is moved, else a copy.
    template <std::size_t K, class Self>
    [[nodiscard]] static typename kind_of<K>::held held_of(Self& self, std::size_t i, bool is_moved) {
        auto& value = self.memory_.template at<K>(i);
        if constexpr (kind_of<K>::is_list) {
            static_assert(!std::is_const_v<Self>,
                          "a record needs room for its lists, and this store is const; pack it");
            auto& pool = std::get<K>(self.pools_);
            if (is_moved) return {pool, pool.take(value)};
            detail::list_extent copy;
            pool.copy(copy, value, pool);
            return {pool, pool.take(copy)};
        } else if constexpr (kind_of<K>::is_bonus) {
            if (value.at == absent) return {};
            const typename kind_of<K>::held held = std::get<K>(self.pools_).value(value);
            if constexpr (!std::is_const_v<Self>)
                if (is_moved) self.template reset_bonus<K>(i);
            return held;
        } else {
            return value;
        }
    }
    /// The row becomes what the record holds: taken away from an rvalue, copied from another. Strong guarantee.
    template <class Record>
    void put_row(std::size_t i, Record&& given) noexcept(!has_pools) {
        each_list([&]<std::size_t K>(auto& pool) {
            const auto& list = std::get<K>(given.values);
            if (std::is_const_v<std::remove_reference_t<Record>> || !list.lies_in(pool))
                list.reserve(pool, memory_.template at<K>(i));
        });
        each_bonus([&]<std::size_t K>(auto& pool) {
            if (std::get<K>(given.values).has_value()) pool.make_room();
        });
        each_value([&]<std::size_t K>() {
            auto& value = memory_.template at<K>(i);
            auto& held = std::get<K>(given.values);
            if constexpr (kind_of<K>::is_bonus)
                put_bonus<K>(i, held.has_value() ? &*held : nullptr);
            else if constexpr (!kind_of<K>::is_list)
                value = held;
            else if constexpr (std::is_const_v<std::remove_reference_t<Record>>)
                held.copy(std::get<K>(pools_), value);
            else
                held.give(std::get<K>(pools_), value);
        });
    }
    /// The row's value becomes the one given, or none.
    template <std::size_t K, class Value>
    void put_bonus(std::size_t i, const Value* given) {
        if (given == nullptr) return reset_bonus<K>(i);
        std::get<K>(pools_).emplace(memory_.template at<K>(i), static_cast<index_t>(i), *given);
    }
    template <std::size_t K>
    void reset_bonus(std::size_t i) noexcept {
        std::get<K>(pools_).reset(memory_.template at<K>(i), [&](index_t owner) -> bonus_place_of<K>& {
            return memory_.template at<K>(static_cast<std::size_t>(owner));
        });
    }
    /// Compaction only saves memory: where there is none for it, the next operation tries again.
    void compact_if_due() noexcept {
        bool due = false;
        each_list([&]<std::size_t K>(auto& pool) { due = due || pool.wants_compaction(); });
        if (!due) return;
        try {
            compact();
        } catch (const std::bad_alloc&) {
        }
    }
    template <class Body>
    static void each_value(Body&& body) {
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            (body.template operator()<K>(), ...);
        }(std::make_index_sequence<sizeof...(F)>{});
    }
    template <class Body>
    void each_list(Body&& body) {
        each_value([&]<std::size_t K>() {
            if constexpr (kind_of<K>::is_list) body.template operator()<K>(std::get<K>(pools_));
        });
    }
    template <class Body>
    void each_bonus(Body&& body) {
        each_value([&]<std::size_t K>() {
            if constexpr (kind_of<K>::is_bonus) body.template operator()<K>(std::get<K>(pools_));
        });
    }
    template <class Body>
    void each_pool(Body&& body) const {
        each_value([&]<std::size_t K>() {
            if constexpr (!std::is_same_v<std::tuple_element_t<K, pools>, std::tuple<>>) body(std::get<K>(pools_));
        });
    }

    pools pools_;
    [[no_unique_address]] Growth growth_{};
    memory memory_;
    std::size_t size_ = 0;
    std::size_t owned_ = 0;
    std::uint64_t revision_ = 0;
    std::unique_ptr<std::uint64_t> allocation_;  // which one: see lease; there is a number if there is memory
};

}  // namespace tsubu
