// SPDX-License-Identifier: MIT
/// @file
/// Points sorted into cells at least as wide as a cutoff, so that what is near lies in a cell beside.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>  // std::max, std::min
#include <array>      // std::array
#include <cmath>      // std::cbrt, std::sqrt
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t
#include <string>     // std::to_string

namespace tsubu::detail {

// Cells along x follow each other, then rows along y, then layers along z; points are sorted by cell, so that three cells
// in a row are one stretch of points. A layer of empty cells around all is what stencils at the border look at.
//
//     . . . . . .        stencil of a cell c in 2-D, each pair once:
//     . a b c d .            * * *      the stretch of three cells above,
//     . e f g h .            c *        and what follows in c and the cell to its right
//     . . . . . .

inline void check_reach(const char* where, double reach) {
    if (!(reach > 0) || !is_finite(reach))
        raise<input_error>(where, "neighbours up to a distance of " + shown(reach),
                           "give a finite length above 0: the range of the forces, and a skin");
}

/// Points in the order of their cells.
template <std::size_t D, class Real>
class cells {
public:
    /// @param x       positions: size() and operator[], finite
    /// @param cutoff  [m]
    /// Complexity: O(N). @throws input_error at a position that is not finite.
    template <class Positions>
    cells(const Positions& x, Real cutoff) : count_(static_cast<std::size_t>(x.size())) {
        lay_out(x, cutoff);
        sort(x);
    }

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    /// Coordinate k of the points, in their order here.
    [[nodiscard]] const Real* along(std::size_t k) const noexcept { return x_[k].data(); }
    /// Where each was before.
    [[nodiscard]] const index_t* origin() const noexcept { return origin_.data(); }
    /// body(point, stretches): the points in stretches [first, last) are near the point, each pair once; of each point
    /// in the order of cells. The stretches of points in one cell differ only in where the first begins.
    template <class Body>
    void each_half(Body&& body) const {
        constexpr std::size_t rows = D == 1 ? 0 : D == 2 ? 1 : 4;
        const std::size_t steps[4] = {width_[0], plane_ - width_[0], plane_, plane_ + width_[0]};
        each_cell([&](std::size_t c) {
            std::array<stretch, rows + 1> near;
            for (std::size_t r = 0; r < rows; ++r) near[r + 1] = {begin_[c + steps[r] - 1], begin_[c + steps[r] + 2]};
            for (auto a = begin_[c]; a < begin_[c + 1]; ++a) {
                near[0] = {a + 1, begin_[c + 2]};
                body(a, near);
            }
        });
    }
    /// The same with each pair from both sides; the point itself is among what is near.
    template <class Body>
    void each_full(Body&& body) const {
        constexpr std::size_t rows = D == 1 ? 1 : D == 2 ? 3 : 9;
        each_cell([&](std::size_t c) {
            std::array<stretch, rows> near;
            std::size_t r = 0;
            for (std::size_t z = 0; z < (D == 3 ? 3U : 1U); ++z)
                for (std::size_t y = 0; y < (D >= 2 ? 3U : 1U); ++y) {
                    const auto row = c + (D == 3 ? z * plane_ - plane_ : 0) + (D >= 2 ? y * width_[0] - width_[0] : 0);
                    near[r++] = {begin_[row - 1], begin_[row + 2]};
                }
            for (auto a = begin_[c]; a < begin_[c + 1]; ++a) body(a, near);
        });
    }

    struct stretch {
        std::uint32_t first;
        std::uint32_t last;
    };

private:
    // Cells are as wide as the cutoff, or wider where the points are so sparse that most would be empty.
    template <class Positions>
    void lay_out(const Positions& x, Real cutoff) {
        vec<D, Real> hi{};
        if (count_ != 0) lo_ = hi = x[0];
        Real checked = 0;
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t k = 0; k < D; ++k) {
                lo_[k] = (std::min)(lo_[k], x[i][k]);
                hi[k] = (std::max)(hi[k], x[i][k]);
                checked += x[i][k] * 0;  // not 0 as soon as one is not finite
            }
        if (!(checked == 0)) refuse(x);
        const auto most = static_cast<Real>((std::min)(4 * count_ + 64, std::size_t{1} << 30));
        Real edge = cutoff;
        for (;; edge *= Real(1.25)) {
            Real cells_in_all = 1;
            for (std::size_t k = 0; k < D; ++k) cells_in_all *= (hi[k] - lo_[k]) / edge + 1;
            if (!(cells_in_all > most)) break;
        }
        inverse_edge_ = 1 / edge;
        std::size_t all = 1;
        for (std::size_t k = 0; k < D; ++k) {
            // One cell for what rounding brings beyond, and one empty one at each end.
            width_[k] = static_cast<std::size_t>((hi[k] - lo_[k]) * inverse_edge_) + 3;
            all *= width_[k];
        }
        for (auto k = D; k < 3; ++k) width_[k] = 1;
        plane_ = width_[0] * width_[1];
        begin_ = buffer<std::uint32_t>(all + 2, {});
        std::fill(begin_.begin(), begin_.end(), 0U);
    }
    template <class Positions>
    [[noreturn]] static void refuse(const Positions& x) {
        for (std::size_t i = 0;; ++i)
            for (std::size_t k = 0; k < D; ++k)
                if (!is_finite(x[i][k]))
                    raise<input_error>("neighbor",
                                       "coordinate " + std::to_string(k) + " of particle " + std::to_string(i) +
                                           " is " + shown(x[i][k]),
                                       "find what made it: a time step past the limit, or an overlap of its start");
    }
    template <class Position>
    [[nodiscard]] std::size_t cell_of(const Position& at) const noexcept {
        std::size_t c = 0;
        for (auto k = D; k-- > 0;)
            c = c * width_[k] + static_cast<std::uint32_t>(static_cast<std::int32_t>((at[k] - lo_[k]) * inverse_edge_)) + 1;
        return c;
    }
    template <class Positions>
    void sort(const Positions& x) {
        buffer<std::uint32_t> cell(count_, {});
        for (std::size_t i = 0; i < count_; ++i) {
            cell[i] = static_cast<std::uint32_t>(cell_of(x[i]));
            ++begin_[cell[i] + 2];
        }
        for (std::size_t c = 2; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
        for (auto& along : x_) along = buffer<Real>(count_, {});
        origin_ = buffer<index_t>(count_, {});
        for (std::size_t i = 0; i < count_; ++i) {
            const auto at = begin_[cell[i] + 1]++;
            for (std::size_t k = 0; k < D; ++k) x_[k][at] = x[i][k];
            origin_[at] = static_cast<index_t>(i);
        }
    }
    template <class Body>
    void each_cell(Body&& body) const {
        const auto inner = [](std::size_t width) { return width > 1 ? width - 1 : 1; };
        for (std::size_t z = width_[2] > 1 ? 1 : 0; z < inner(width_[2]); ++z)
            for (std::size_t y = width_[1] > 1 ? 1 : 0; y < inner(width_[1]); ++y) {
                const auto row = z * plane_ + y * width_[0];
                for (std::size_t c = row + 1; c < row + width_[0] - 1; ++c) body(c);
            }
    }

    std::size_t count_;
    vec<D, Real> lo_{};
    Real inverse_edge_ = 0;
    std::array<std::size_t, 3> width_{1, 1, 1};
    std::size_t plane_ = 1;
    buffer<std::uint32_t> begin_;  // [cells + 2]: of each cell, after sorting
    std::array<buffer<Real>, D> x_;
    buffer<index_t> origin_;
};

}  // namespace tsubu::detail
