// SPDX-License-Identifier: MIT
/// @file
/// pack and unpack: chosen fields of chosen particles as 64-bit words, for messages and files.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/list_of.hpp>
#include <tsubu/store/particle_store.hpp>

#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy
#include <span>         // std::span
#include <string>       // std::to_string
#include <tuple>        // std::get, std::tuple
#include <type_traits>  // std::remove_cv_t
#include <utility>      // std::index_sequence

namespace tsubu {

// Words of a particle: first the fields of a fixed size, in the order of the set, then those that vary. Each value
// begins a word, and what it leaves of its last one is 0:
//
//     | id | x | y | z | radius | contacts: how many | elements ... | shape: 1 or 0 | value if 1 |
//
// So each word of the first part has a place that is known when the program is compiled. Bits are copied, never
// converted (C4): an id past 2^53, a NaN, a denormal number arrive as they left.

namespace detail {

[[nodiscard]] constexpr std::size_t words_for(std::size_t bytes) noexcept { return (bytes + 7) / 8; }

/// Of a size that is known: a word is a copy, no call.
template <class Value>
[[gnu::always_inline]] inline void put_value(std::uint64_t* to, const Value& value) noexcept {
    if constexpr (sizeof(Value) % 8 != 0) to[words_for(sizeof(Value)) - 1] = 0;
    std::memcpy(to, &value, sizeof(Value));
}
inline void put_bytes(std::uint64_t*& to, const void* from, std::size_t bytes) noexcept {
    if (bytes == 0) return;
    to[words_for(bytes) - 1] = 0;
    std::memcpy(to, from, bytes);
    to += words_for(bytes);
}

template <class Set>
struct packer;
template <auto... F>
struct packer<fields<F...>> {
    template <class Field>
    using value = typename std::remove_cv_t<Field>::value_type;
    template <class Field>
    static constexpr bool is_list = stored<value<Field>>::is_list;
    template <class Field>
    static constexpr bool is_bonus = stored<value<Field>>::is_bonus;
    template <class Field>
    static constexpr bool is_fixed = !is_list<Field> && !is_bonus<Field>;
    template <class Field>
    static constexpr std::size_t fixed_words_of = is_fixed<Field> ? words_for(sizeof(value<Field>)) : 0;
    /// Of the part that is the same for all particles.
    static constexpr std::size_t fixed = (std::size_t{0} + ... + fixed_words_of<decltype(F)>);
    static constexpr bool varies = !(is_fixed<decltype(F)> && ...);
    /// Of a particle with empty lists, and no value that only some have.
    static constexpr std::size_t least = fixed + (std::size_t{0} + ... + (is_fixed<decltype(F)> ? 0U : 1U));
    /// Where the fields of a fixed size begin.
    static constexpr std::array<std::size_t, sizeof...(F)> place = [] {
        std::array<std::size_t, sizeof...(F)> result{};
        constexpr std::array<std::size_t, sizeof...(F)> words{fixed_words_of<decltype(F)>...};
        for (std::size_t k = 1; k < sizeof...(F); ++k) result[k] = result[k - 1] + words[k - 1];
        return result;
    }();

    template <class Store>
    [[nodiscard]] static std::size_t further_words(const Store& store, std::size_t i) noexcept {
        return (std::size_t{0} + ... + further_words_of<decltype(F)>(store, i));
    }
    template <class Field, class Store>
    [[nodiscard]] static std::size_t further_words_of(const Store& store, std::size_t i) noexcept {
        if constexpr (is_list<Field>)
            return words_for(store[std::remove_cv_t<Field>{}][i].span().size_bytes());
        else if constexpr (is_bonus<Field>)
            return store[std::remove_cv_t<Field>{}][i].has_value()
                       ? words_for(sizeof(typename value<Field>::element_type))
                       : 0;
        else
            return static_cast<void>(store), static_cast<void>(i), 0;
    }
    template <std::size_t K, class Field, class Column>
    [[gnu::always_inline]] static void put_fixed(std::uint64_t* to, const Column& column, std::size_t i) noexcept {
        if constexpr (is_fixed<Field>) put_value(to + place[K], column[i]);
    }
    template <class Field, class Column>
    static void put_varying(std::uint64_t*& to, const Column& column, std::size_t i) noexcept {
        if constexpr (is_list<Field>) {
            const auto list = column[i].span();
            *to++ = list.size();
            put_bytes(to, list.data(), list.size_bytes());
        } else if constexpr (is_bonus<Field>) {
            const auto bonus = column[i];
            *to++ = bonus.has_value() ? 1 : 0;
            if (bonus.has_value()) put_bytes(to, &*bonus, sizeof(*bonus));
        }
    }
    template <std::size_t K, class Field, class Column, class Settle>
    [[gnu::always_inline]] static void get_fixed(const std::uint64_t* from, const Column& column, std::size_t i,
                                                 const Settle& settle) {
        if constexpr (is_fixed<Field>) {
            std::memcpy(static_cast<void*>(&column[i]), from + place[K], sizeof(value<Field>));
            settle(std::remove_cv_t<Field>{}, column[i]);
        }
    }
    /// @return false if the words end before the value does, or say what cannot be.
    template <class Field, class Column>
    [[nodiscard]] static bool get_varying(const std::uint64_t*& from, const std::uint64_t* end, const Column& column,
                                          std::size_t i) {
        const auto left = static_cast<std::size_t>(end - from);
        if constexpr (is_list<Field>) {
            using element = typename value<Field>::element_type;
            if (left == 0) return false;
            const auto count = *from++;
            if (count > (left - 1) * 8 / sizeof(element)) return false;
            const auto list = column[i];
            list.resize(static_cast<std::size_t>(count));
            if (count != 0) std::memcpy(static_cast<void*>(list.begin()), from, list.span().size_bytes());
            from += words_for(list.span().size_bytes());
        } else if constexpr (is_bonus<Field>) {
            using element = typename value<Field>::element_type;
            constexpr auto words = words_for(sizeof(element));
            if (left == 0 || *from > 1 || (*from == 1 && left - 1 < words)) return false;
            const auto bonus = column[i];
            if (*from++ == 0) {
                bonus.reset();
            } else {
                element read;
                std::memcpy(static_cast<void*>(&read), from, sizeof(read));
                bonus.emplace(read);
                from += words;
            }
        }
        return true;
    }

    template <class Store, std::size_t... K>
    static void put_all(const Store& store, std::span<const index_t> chosen, std::uint64_t* to,
                        std::index_sequence<K...>) noexcept {
        const auto columns = std::tuple{store[std::remove_cv_t<decltype(F)>{}]...};
        for (const auto one : chosen) {
            const auto i = static_cast<std::size_t>(one);
            (put_fixed<K, decltype(F)>(to, std::get<K>(columns), i), ...);
            to += fixed;
            if constexpr (varies) (put_varying<decltype(F)>(to, std::get<K>(columns), i), ...);
        }
    }
    /// @return where the words that were read end; `first` becomes the first particle that is not whole, or `last`.
    template <class Store, class Settle, std::size_t... K>
    static const std::uint64_t* get_all(Store& store, std::size_t& first, std::size_t last, const std::uint64_t* from,
                                        const std::uint64_t* end, const Settle& settle, std::index_sequence<K...>) {
        const auto columns = std::tuple{store[std::remove_cv_t<decltype(F)>{}]...};
        for (; first < last; ++first) {
            if (static_cast<std::size_t>(end - from) < fixed) return from;
            (get_fixed<K, decltype(F)>(from, std::get<K>(columns), first, settle), ...);
            from += fixed;
            if constexpr (varies)
                if (!(get_varying<decltype(F)>(from, end, std::get<K>(columns), first) && ...)) return from;
        }
        return from;
    }
};

}  // namespace detail

/// How many words pack() takes for these fields of these particles. O(1), or O(n) if there are lists among them.
template <auto... F, class Store>
[[nodiscard]] std::size_t packed_words(const Store& store, fields<F...>, std::span<const index_t> chosen) {
    using packer = detail::packer<fields<F...>>;
    auto words = packer::least * chosen.size();
    if constexpr (packer::varies)
        for (const auto i : chosen) words += packer::further_words(store, static_cast<std::size_t>(i));
    return words;
}

/// Writes these fields of these particles, in this order. One pass; no allocation.
/// @return the words written, as many as packed_words says.
/// @throws input_error if `out` is too small; nothing is written then.
/// Precondition: 0 <= i < store.size() for each chosen i.
/// Source: C4.
template <auto... F, class Store>
std::size_t pack(const Store& store, fields<F...> set, std::span<const index_t> chosen, std::span<std::uint64_t> out) {
    static_assert((Store::template has<decltype(F)> && ...), "the store lacks a field that is to be packed");
    const auto words = packed_words(store, set, chosen);
    if (out.size() < words)
        detail::raise<input_error>("pack", std::to_string(out.size()) + " words for " + std::to_string(words),
                                   "ask packed_words()");
    detail::packer<fields<F...>>::put_all(store, chosen, out.data(), std::index_sequence_for<decltype(F)...>{});
    return words;
}

/// Reads these fields of `count` particles into rows first .. first + count - 1, which exist.
/// @param settle  settle(field, value) may change each value of a fixed size after it is read.
/// @return the words read.
/// @throws input_error if the words end too early; rows before the one that is not whole are read then.
template <auto... F, class Store, class Settle>
std::size_t unpack(Store& store, fields<F...>, std::size_t first, std::size_t count,
                   std::span<const std::uint64_t> in, const Settle& settle) {
    static_assert((Store::template has<decltype(F)> && ...), "the store lacks a field that is to be unpacked");
    TSUBU_EXPECTS(first + count <= store.size(), "these particles do not exist; add_owned or add_ghosts first");
    auto i = first;
    const auto* const end = detail::packer<fields<F...>>::get_all(store, i, first + count, in.data(),
                                                                  in.data() + in.size(), settle,
                                                                  std::index_sequence_for<decltype(F)...>{});
    if (i != first + count)
        detail::raise<input_error>("unpack",
                                   std::to_string(in.size()) + " words end in particle " + std::to_string(i - first) +
                                       " of " + std::to_string(count),
                                   "unpack the fields that were packed");
    return static_cast<std::size_t>(end - in.data());
}
/// The same, as the values are.
template <auto... F, class Store>
std::size_t unpack(Store& store, fields<F...> set, std::size_t first, std::size_t count,
                   std::span<const std::uint64_t> in) {
    return unpack(store, set, first, count, in, [](auto, auto&) {});
}

}  // namespace tsubu
