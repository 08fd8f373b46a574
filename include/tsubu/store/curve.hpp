// SPDX-License-Identifier: MIT
/// @file
/// Space-filling curves: an order of particles in which neighbours in space are neighbours in memory.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>

#include <algorithm>  // std::sort
#include <array>      // std::array
#include <concepts>   // std::same_as
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t, std::uint64_t
#include <utility>    // std::pair
#include <vector>     // std::vector

namespace tsubu {

/// A curve through a grid of 2^bits cells along each axis.
///  1. key(cell) is the place of the cell on the curve: different for different cells, below 2^(D bits).
template <class Curve>
concept space_curve = requires(const Curve& curve, const std::array<std::uint32_t, 3>& cell) {
    { curve.template key<3>(cell, 21U) } -> std::same_as<std::uint64_t>;
};

/// The bits of the coordinates, one of each in turn, with long jumps at powers of 2.
///
/// Concept: space_curve. Cost: a few shifts and masks per axis. Deterministic: yes.
/// Choose it to bring neighbours together in memory: the order takes a third of the time that hilbert_curve's takes, and
/// looking at neighbours in soa is as fast after it. Do not when stretches of the order are to be connected pieces of
/// space.
/// Source: Morton 1966, "A computer oriented geodetic data base".
struct morton_curve {
    template <std::size_t D>
    [[nodiscard]] constexpr std::uint64_t key(const std::array<std::uint32_t, D>& cell, unsigned bits) const noexcept {
        std::uint64_t result = 0;
        for (unsigned bit = bits; bit-- > 0;)
            for (std::size_t k = 0; k < D; ++k) result = result << 1 | (cell[k] >> bit & 1U);
        return result;
    }
};
static_assert(space_curve<morton_curve>);

/// A curve without jumps: each cell is beside the one before it.
///
/// Concept: space_curve. Cost: a step for each bit and axis. Deterministic: yes.
/// Choose it when stretches of the order are to be connected pieces of space. Do not when sorting itself takes the time:
/// morton_curve.
/// Source: Skilling 2004, "Programming the Hilbert curve", doi:10.1063/1.1751381.
struct hilbert_curve {
    template <std::size_t D>
    [[nodiscard]] constexpr std::uint64_t key(std::array<std::uint32_t, D> cell, unsigned bits) const noexcept {
        const std::uint32_t top = std::uint32_t{1} << (bits - 1);
        for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
            const std::uint32_t below = bit - 1;
            for (std::size_t k = 0; k < D; ++k) {
                if ((cell[k] & bit) != 0) {
                    cell[0] ^= below;  // invert
                } else {  // exchange
                    const std::uint32_t swapped = (cell[0] ^ cell[k]) & below;
                    cell[0] ^= swapped;
                    cell[k] ^= swapped;
                }
            }
        }
        for (std::size_t k = 1; k < D; ++k) cell[k] ^= cell[k - 1];  // Gray code
        std::uint32_t flips = 0;
        for (std::uint32_t bit = top; bit > 1; bit >>= 1)
            if ((cell[D - 1] & bit) != 0) flips ^= bit - 1;
        for (auto& coordinate : cell) coordinate ^= flips;
        return morton_curve{}.key(cell, bits);
    }
};
static_assert(space_curve<hilbert_curve>);

/// The indices of points in the order of a curve through the cell of a box; of equal places the lower index first.
///
///     g.permute(tsubu::order_along(tsubu::hilbert_curve{}, box, g.owned()[tsubu::position<3>]));
///
/// @param where      a box; points outside count as at its nearest face.
/// @param positions  something with size() and operator[], such as a column [N]
/// Complexity: O(N log N), 20 N bytes of memory at the peak.
template <space_curve Curve, class Box, class Positions>
[[nodiscard]] std::vector<index_t> order_along(const Curve& curve, const Box& where, const Positions& positions) {
    constexpr std::size_t D = Box::dimension;
    // A coordinate has 32 bits, and 2^(D bits), the number of keys, is to fit 64.
    constexpr unsigned bits = D == 1 ? 32 : D == 2 ? 31 : 21;
    using real = typename Box::real_type;
    constexpr auto cells = static_cast<real>(std::uint64_t{1} << bits);
    const auto count = static_cast<std::size_t>(positions.size());
    std::vector<std::pair<std::uint64_t, index_t>> keys(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = where.to_cell(positions[i]);
        std::array<std::uint32_t, D> cell{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto& axis = where.cell().real_axis(k);
            const real share = (where.cell().along(k).to_real(at[k]) - axis.lo()) / axis.length() * cells;
            // Not a number: the first cell.
            cell[k] = share > 0 ? share < cells - 1 ? static_cast<std::uint32_t>(share)
                                                    : static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1)
                                : 0;
        }
        keys[i] = {curve.template key<D>(cell, bits), static_cast<index_t>(i)};
    }
    std::sort(keys.begin(), keys.end());
    std::vector<index_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = keys[i].second;
    return order;
}

}  // namespace tsubu
