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

#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy
#include <span>         // std::span
#include <string>       // std::to_string
#include <tuple>        // std::apply, std::tuple
#include <type_traits>  // std::remove_cv_t

namespace tsubu {

// Words of a particle, the fields in the order of the set; each value begins a word, and what it leaves of its last one
// is 0:
//
//     | id | x | y | z | radius | contacts: how many | elements ... | shape: 1 or 0 | value if 1 |
//
// Bits are copied, never converted (C4): an id past 2^53, a NaN, a denormal number arrive as they left.

namespace detail {

[[nodiscard]] constexpr std::size_t words_for(std::size_t bytes) noexcept { return (bytes + 7) / 8; }

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
    [[nodiscard]] static constexpr std::size_t least_words() noexcept {
        if constexpr (is_list<Field> || is_bonus<Field>)
            return 1;
        else
            return words_for(sizeof(value<Field>));
    }
    /// Of a particle with empty lists, and no value that only some have.
    static constexpr std::size_t least = (std::size_t{0} + ... + least_words<decltype(F)>());
    static constexpr bool varies = ((is_list<decltype(F)> || is_bonus<decltype(F)>) || ...);

    template <class Store>
    [[nodiscard]] static std::size_t further_words(const Store& store, std::size_t i) noexcept {
        return (std::size_t{0} + ... + further_words_of<decltype(F)>(store, i));
    }
    template <class Field, class Store>
    [[nodiscard]] static std::size_t further_words_of(const Store& store, std::size_t i) noexcept {
        if constexpr (is_list<Field>)
            return words_for(store[std::remove_cv_t<Field>{}][i].span().size_bytes());
        else if constexpr (is_bonus<Field>)
            return store[std::remove_cv_t<Field>{}][i].has_value() ? words_for(sizeof(typename value<Field>::element_type))
                                                                     : 0;
        else
            return static_cast<void>(store), static_cast<void>(i), 0;
    }
    template <class Field, class Column>
    static void put(std::uint64_t*& to, const Column& column, std::size_t i) noexcept {
        if constexpr (is_list<Field>) {
            const auto list = column[i].span();
            *to++ = list.size();
            put_bytes(to, list.data(), list.size_bytes());
        } else if constexpr (is_bonus<Field>) {
            const auto bonus = column[i];
            *to++ = bonus.has_value() ? 1 : 0;
            if (bonus.has_value()) put_bytes(to, &*bonus, sizeof(*bonus));
        } else {
            put_bytes(to, &column[i], sizeof(column[i]));
        }
    }
    /// @return false if the words end before the value does.
    template <class Field, class Column>
    [[nodiscard]] static bool get(const std::uint64_t*& from, const std::uint64_t* end, const Column& column, std::size_t i) {
        const auto left = static_cast<std::size_t>(end - from);
        if constexpr (is_list<Field>) {
            using element = typename value<Field>::element_type;
            if (left == 0) return false;
            const auto count = *from++;
            if (count > (left - 1) * 8 / sizeof(element) || words_for(count * sizeof(element)) > left - 1) return false;
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
        } else {
            constexpr auto words = words_for(sizeof(value<Field>));
            if (left < words) return false;
            std::memcpy(static_cast<void*>(&column[i]), from, sizeof(value<Field>));
            from += words;
        }
        return true;
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
    using packer = detail::packer<fields<F...>>;
    auto* to = out.data();
    const auto columns = std::tuple{store[std::remove_cv_t<decltype(F)>{}]...};
    for (const auto i : chosen)
        std::apply(
            [&](const auto&... column) {
                (packer::template put<decltype(F)>(to, column, static_cast<std::size_t>(i)), ...);
            },
            columns);
    return words;
}

/// Reads these fields of `count` particles into rows first .. first + count - 1, which exist.
/// @return the words read.
/// @throws input_error if the words end too early; rows before the one that is not whole are read then.
template <auto... F, class Store>
std::size_t unpack(Store& store, fields<F...>, std::size_t first, std::size_t count, std::span<const std::uint64_t> in) {
    static_assert((Store::template has<decltype(F)> && ...), "the store lacks a field that is to be unpacked");
    TSUBU_EXPECTS(first + count <= store.size(), "these particles do not exist; add_owned or add_ghosts first");
    using packer = detail::packer<fields<F...>>;
    const auto* from = in.data();
    const auto* const end = from + in.size();
    const auto columns = std::tuple{store[std::remove_cv_t<decltype(F)>{}]...};
    for (std::size_t i = first; i < first + count; ++i) {
        const bool whole = std::apply(
            [&](const auto&... column) { return (packer::template get<decltype(F)>(from, end, column, i) && ...); },
            columns);
        if (!whole)
            detail::raise<input_error>("unpack",
                                       std::to_string(in.size()) + " words end in particle " + std::to_string(i - first) +
                                           " of " + std::to_string(count),
                                       "unpack the fields that were packed");
    }
    return static_cast<std::size_t>(from - in.data());
}

}  // namespace tsubu
