// SPDX-License-Identifier: MIT
/// @file
/// soa: one array per field.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/store/column.hpp>
#include <tsubu/store/concepts.hpp>

#include <algorithm>    // std::copy_n, std::max
#include <cstddef>      // std::size_t
#include <tuple>        // std::tuple
#include <type_traits>  // std::is_trivially_copyable_v
#include <utility>      // std::as_const, std::index_sequence, std::swap

namespace tsubu {
namespace detail {

/// A cache line of values, or more if they ask for it: arrays begin at one, so that vector loads do not cross lines. Not
/// a template of the values: one type of buffer then serves the arrays of nearly all fields.
template <std::size_t Alignment>
struct alignas(Alignment) line_of {
    unsigned char bytes[Alignment];
};

/// An array of uninitialised values that begins at a cache line.
template <class Value>
class aligned_array {
    static_assert(std::is_trivially_copyable_v<Value>,
                  "a field holds a trivially copyable type, list_of or bonus_of one");
    using line = line_of<(std::max)(std::size_t{64}, alignof(Value))>;

public:
    aligned_array() = default;
    explicit aligned_array(std::size_t count)
        : lines_((count * sizeof(Value) + sizeof(line) - 1) / sizeof(line), {}) {}
    [[nodiscard]] Value* data() noexcept { return reinterpret_cast<Value*>(lines_.data()); }
    [[nodiscard]] const Value* data() const noexcept { return reinterpret_cast<const Value*>(lines_.data()); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return lines_.memory_bytes(); }

private:
    buffer<line> lines_;
};

}  // namespace detail

/// One array per field, each from a cache line on.
///
/// Concept:  particle_layout.
/// Cost:     a value O(1); a particle that moves touches one cache line for each of its fields.
/// Bytes:    the sum of the sizes of the fields per particle.
/// Deterministic: yes.
/// Choose it unless a measurement says otherwise: loops over fields, neighbours and packing are as fast in it as in any
///           layout, or faster. Do not when particles are mostly moved as a whole, in random order: aos.
struct soa {
    /// The memory of one store.
    template <class... Values>
    class memory {
        static constexpr auto all = std::index_sequence_for<Values...>{};

    public:
        template <std::size_t K>
        using value = std::tuple_element_t<K, std::tuple<Values...>>;

        [[nodiscard]] std::size_t capacity() const noexcept { return capacity_; }
        [[nodiscard]] std::size_t memory_bytes() const noexcept {
            return std::apply([](const auto&... array) { return (std::size_t{0} + ... + array.memory_bytes()); },
                              arrays_);
        }
        template <std::size_t K>
        [[nodiscard, gnu::always_inline]] value<K>& at(std::size_t i) noexcept {
            return std::get<K>(arrays_).data()[i];
        }
        template <std::size_t K>
        [[nodiscard, gnu::always_inline]] const value<K>& at(std::size_t i) const noexcept {
            return std::get<K>(arrays_).data()[i];
        }
        template <std::size_t K>
        [[nodiscard]] contiguous_place<value<K>> place() noexcept {
            return {std::get<K>(arrays_).data()};
        }
        template <std::size_t K>
        [[nodiscard]] contiguous_place<const value<K>> place() const noexcept {
            return {std::get<K>(arrays_).data()};
        }
        void reallocate(std::size_t capacity, std::size_t kept) {
            reallocate(capacity, kept, all);
        }
        void copy_row(std::size_t from, std::size_t to) noexcept {
            std::apply([&](auto&... array) { ((array.data()[to] = array.data()[from]), ...); }, arrays_);
        }
        void swap_rows(std::size_t i, std::size_t j) noexcept {
            std::apply([&](auto&... array) { (std::swap(array.data()[i], array.data()[j]), ...); }, arrays_);
        }
        /// One field after the other: reads at random, writes in order. Strong guarantee: all memory is
        /// asked for first.
        template <class Index>
        void gather(const Index* order, std::size_t count) {
            gather(order, count, all);
        }

    private:
        template <std::size_t... K>
        void reallocate(std::size_t capacity, std::size_t kept, std::index_sequence<K...>) {
            std::tuple<detail::aligned_array<Values>...> fresh{detail::aligned_array<Values>(capacity)...};
            (std::copy_n(std::get<K>(arrays_).data(), kept, std::get<K>(fresh).data()), ...);
            arrays_ = std::move(fresh);
            capacity_ = capacity;
        }
        template <class Index, std::size_t... K>
        void gather(const Index* order, std::size_t count, std::index_sequence<K...>) {
            std::tuple<detail::aligned_array<Values>...> fresh{detail::aligned_array<Values>(capacity_)...};
            const auto gather_one = [&](const auto* from, auto* to) {
                for (std::size_t i = 0; i < count; ++i) to[i] = from[order[i]];
            };
            (gather_one(std::as_const(std::get<K>(arrays_)).data(), std::get<K>(fresh).data()), ...);
            arrays_ = std::move(fresh);
        }

        std::tuple<detail::aligned_array<Values>...> arrays_;
        std::size_t capacity_ = 0;
    };
};
static_assert(particle_layout<soa>);

}  // namespace tsubu
