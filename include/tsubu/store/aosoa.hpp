// SPDX-License-Identifier: MIT
/// @file
/// aosoa: N of each field, block by block.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/store/column.hpp>
#include <tsubu/store/concepts.hpp>
#include <tsubu/store/detail/record.hpp>

#include <cstddef>  // std::byte, std::size_t
#include <cstring>  // std::memcpy
#include <tuple>    // std::tuple_element_t
#include <utility>  // std::move, std::swap

namespace tsubu {

/// Blocks of N particles, in each N values of one field after the other.
///
/// Concept:  particle_layout.
/// Cost:     a value O(1), at the price of an index split in two.
/// Bytes:    the sum of the sizes of the fields per particle, in whole blocks.
/// Deterministic: yes.
/// Choose it when kernels of one's own take vectors of N values of several fields at once (explicit SIMD). Do not
///           otherwise: what a compiler makes of loops by index is slower than in soa.
///
/// @tparam N  particles per block; a power of 2, else an index costs a division.
template <std::size_t N = 16>
struct aosoa {
    static_assert(N > 0, "a block holds at least one particle");

    /// The memory of one store.
    template <class... Values>
    class memory {
        using record = detail::record<N, Values...>;
        // A block begins at a cache line where that costs at most 1 %.
        static constexpr std::size_t whole_lines = (record::size + 63) / 64 * 64;
        static constexpr bool fills_lines = (whole_lines - record::size) * 100 <= record::size;
        struct alignas(fills_lines && record::alignment < 64 ? 64 : record::alignment) block {
            std::byte bytes[record::size];
        };

    public:
        template <std::size_t K>
        using value = std::tuple_element_t<K, std::tuple<Values...>>;

        [[nodiscard]] std::size_t capacity() const noexcept { return blocks_.size() * N; }
        [[nodiscard]] std::size_t memory_bytes() const noexcept { return blocks_.memory_bytes(); }
        template <std::size_t K>
        [[nodiscard, gnu::always_inline]] value<K>& at(std::size_t i) noexcept {
            return place<K>().at(i);
        }
        template <std::size_t K>
        [[nodiscard, gnu::always_inline]] const value<K>& at(std::size_t i) const noexcept {
            return place<K>().at(i);
        }
        template <std::size_t K>
        [[nodiscard]] blocked_place<value<K>, sizeof(block), N, record::offset[K]> place() noexcept {
            return {reinterpret_cast<std::byte*>(blocks_.data())};
        }
        template <std::size_t K>
        [[nodiscard]] blocked_place<const value<K>, sizeof(block), N, record::offset[K]> place() const noexcept {
            return {reinterpret_cast<const std::byte*>(blocks_.data())};
        }
        void reallocate(std::size_t capacity, std::size_t kept) {
            buffer<block> fresh((capacity + N - 1) / N, {});
            if (kept != 0) std::memcpy(fresh.data(), blocks_.data(), (kept + N - 1) / N * sizeof(block));
            blocks_ = std::move(fresh);
        }
        void copy_row(std::size_t from, std::size_t to) noexcept {
            each([&]<std::size_t K>() { at<K>(to) = at<K>(from); });
        }
        void swap_rows(std::size_t i, std::size_t j) noexcept {
            each([&]<std::size_t K>() { std::swap(at<K>(i), at<K>(j)); });
        }
        template <class Index>
        void gather(const Index* order, std::size_t count) {
            memory fresh;
            fresh.reallocate(capacity(), 0);
            for (std::size_t i = 0; i < count; ++i)
                each([&]<std::size_t K>() {
                    fresh.template at<K>(i) = at<K>(static_cast<std::size_t>(order[i]));
                });
            blocks_ = std::move(fresh.blocks_);
        }

    private:
        template <class Body>
        static void each(Body&& body) {
            [&]<std::size_t... K>(std::index_sequence<K...>) {
                (body.template operator()<K>(), ...);
            }(std::index_sequence_for<Values...>{});
        }

        buffer<block> blocks_;
    };
};
static_assert(particle_layout<aosoa<16>>);

}  // namespace tsubu
