// SPDX-License-Identifier: MIT
/// @file
/// The points of some cells, side by side: which of them are near one of them?
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/lanes.hpp>
#include <tsubu/core/types.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint32_t
#include <cstring>  // std::memcpy
#include <limits>   // std::numeric_limits
#include <span>     // std::span

namespace tsubu::detail {

/// The points [first, last) of some order.
struct stretch {
    std::uint32_t first;
    std::uint32_t last;
};

/// Copies of points, few enough to stay in the first-level cache unless very many are near each other.
template <std::size_t D, class Real>
class stencil_points {
    using V = lanes<Real>;

public:
    /// How many are copied at once, needed or not: most stretches are no longer than one or two chunks, and a loop that
    /// runs once or twice is cheaper than one that runs as often as there are points.
    static constexpr std::uint32_t chunk = 8;

    stencil_points() { make_room(512); }

    /// Takes the points of the stretches. @param columns, origin  can be read up to a chunk behind the last point
    template <std::size_t Count>
    [[gnu::always_inline]] void gather(const std::array<buffer<Real>, D>& columns, const index_t* origin,
                                       const std::array<stretch, Count>& stretches) {
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
        std::size_t n = 0;
        for (const auto& one : stretches) {
            auto b = std::size_t{one.first};
            auto m = n;
            do {
                for (std::size_t k = 0; k < D; ++k) std::memcpy(to[k] + m, from[k] + b, chunk * sizeof(Real));
                std::memcpy(index + m, origin + b, chunk * sizeof(index_t));
                b += chunk;
                m += chunk;
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
    /// The indices of the points from `begin` on that are near point k, in their order. Holds until the next call.
    template <class Reach>
    [[nodiscard, gnu::always_inline]] std::span<const index_t> near(std::size_t k, std::size_t begin, const Reach& reach) {
        std::array<V, D> at;
        for (std::size_t d = 0; d < D; ++d) at[d] = V(x_[d][k]);
        const auto i = index_[k];
        std::array<const Real*, D> x{};
        for (std::size_t d = 0; d < D; ++d) x[d] = x_[d].data();
        const auto* const index = index_.data();
        auto* const found = found_.data();
        std::size_t count = 0;
        for (auto b = begin; b < count_; b += V::count) {
            V square(Real(0));
            for (std::size_t d = 0; d < D; ++d) {
                typename V::native other;
                std::memcpy(&other, x[d] + b, sizeof(other));
                const V apart = at[d] - V(other);
                square += apart * apart;
            }
            V limit;
            for (std::size_t l = 0; l < V::count; ++l) limit.set(l, reach.template square<Real>(i, index[b + l]));
            const auto bits = (square < limit).bits();
            // Branch-free: whether two are near cannot be predicted.
            for (std::size_t l = 0; l < V::count; ++l) {
                found[count] = index[b + l];
                count += bits >> l & 1U;
            }
        }
        return {found, count};
    }

private:
    [[gnu::noinline]] void make_room(std::size_t count) {
        const auto size = count + chunk + V::count;
        for (auto& along : x_) along = buffer<Real>(size, {});
        index_ = buffer<index_t>(size, {});
        found_ = buffer<index_t>(size, {});
        room_ = count;
    }

    std::size_t room_ = 0;
    std::size_t count_ = 0;
    std::array<buffer<Real>, D> x_;
    buffer<index_t> index_;
    buffer<index_t> found_;
};

}  // namespace tsubu::detail
