// SPDX-License-Identifier: MIT
/// @file
/// The points of some cells, side by side: which of them are near one of them?
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/lanes.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/unrolled.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint32_t
#include <cstring>  // std::memcpy
#include <limits>   // std::numeric_limits

namespace tsubu::detail {

/// The points [first, last) of some order.
struct point_stretch {
    std::uint32_t first;
    std::uint32_t last;
};

/// Copies of points, few enough to stay in the first-level cache unless very many are near each other.
template <std::size_t D, class Real>
class stencil_points {
    using V = lanes<Real>;

public:
    /// How many are copied at once, needed or not. A stretch is mostly no longer than one or two of these: a loop that
    /// runs once is cheaper than one of which the end cannot be predicted.
    static constexpr std::uint32_t chunk = 4;
    /// By how much columns are longer than their points.
    static constexpr std::uint32_t spare = 2 * chunk;

    /// @param longer  most stretches are longer than a chunk
    explicit stencil_points(bool longer) : longer_(longer) { make_room(512); }

    /// Takes the points of the stretches. @param columns, origin  longer by `spare` than there are points
    template <std::size_t Count>
    [[gnu::always_inline]] void gather(const std::array<buffer<Real>, D>& columns, const index_t* origin,
                                       const std::array<point_stretch, Count>& stretches) {
        std::size_t all = 0;
        for (const auto& one : stretches) all += one.last - one.first;
        if (all > room_) make_room(2 * all);
        std::array<const Real*, D> from{};
        std::array<Real*, D> to{};
        for (std::size_t k = 0; k < D; ++k) {
            from[k] = columns[k].data();
            to[k] = x_[k].data();
        }
        auto* const index = index_.data();
        const auto step = longer_ ? 2 * chunk : chunk;
        std::size_t n = 0;
        for (const auto& one : stretches) {
            auto b = std::size_t{one.first};
            auto m = n;
            do {
                copy_chunk(from, to, origin, index, b, m);
                if (longer_) copy_chunk(from, to, origin, index, b + chunk, m + chunk);
                b += step;
                m += step;
            } while (b < one.last);
            n += one.last - one.first;
        }
        // What fills the last lanes is infinitely far, and has an index.
        for (std::size_t l = 0; l < V::count; ++l) {
            for (std::size_t k = 0; k < D; ++k) to[k][n + l] = std::numeric_limits<Real>::infinity();
            index[n + l] = origin[0];
        }
        count_ = n;
    }
    [[nodiscard]] index_t index(std::size_t k) const noexcept { return index_[k]; }
    /// How many values near() may write, and more than are points.
    [[nodiscard]] std::size_t most() const noexcept { return count_ + V::count; }
    /// Writes value(j) of each point j from `begin` on that is near point k, itself too. @return where they end
    template <class Reach, class Value, class Make>
    [[nodiscard, gnu::always_inline]] Value* near(std::size_t k, std::size_t begin, const Reach& reach, Value* to,
                                                  Make value) const {
        std::array<const Real*, D> x{};
        std::array<V, D> at;
        for (std::size_t d = 0; d < D; ++d) {
            x[d] = x_[d].data();
            at[d] = V(x[d][k]);
        }
        const auto* const index = index_.data();
        const auto i = index[k];
        const auto count = count_;
        for (auto b = begin; b < count; b += V::count) {
            V square(Real(0));
            unrolled<D>([&](auto d) {
                typename V::native other;
                std::memcpy(&other, x[d] + b, sizeof(other));
                const V apart = at[d] - V(other);
                square += apart * apart;
            });
            V limit;
            for (std::size_t l = 0; l < V::count; ++l) limit.set(l, reach.template square<Real>(i, index[b + l]));
            const auto bits = (square < limit).bits();
            // Branch-free: whether two are near cannot be predicted.
            for (std::size_t l = 0; l < V::count; ++l) {
                *to = value(index[b + l]);
                to += bits >> l & 1U;
            }
        }
        return to;
    }

private:
    [[gnu::always_inline]] static void copy_chunk(const std::array<const Real*, D>& from,
                                                  const std::array<Real*, D>& to, const index_t* origin, index_t* index,
                                                  std::size_t b, std::size_t m) {
        unrolled<D>([&](auto k) { std::memcpy(to[k] + m, from[k] + b, chunk * sizeof(Real)); });
        std::memcpy(index + m, origin + b, chunk * sizeof(index_t));
    }
    [[gnu::noinline]] void make_room(std::size_t count) {
        const auto size = count + spare + V::count;
        for (auto& along : x_) along = buffer<Real>(size, {});
        index_ = buffer<index_t>(size, {});
        room_ = count;
    }

    bool longer_;
    std::size_t room_ = 0;
    std::size_t count_ = 0;
    std::array<buffer<Real>, D> x_;
    buffer<index_t> index_;
};

}  // namespace tsubu::detail
