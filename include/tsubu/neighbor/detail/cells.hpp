// SPDX-License-Identifier: MIT
/// @file
/// Points sorted into cells at least as wide as a cutoff, so that what is near lies in a cell beside.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/lanes.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/neighbor/detail/list_checks.hpp>
#include <tsubu/neighbor/detail/stencil_points.hpp>
#include <tsubu/neighbor/positions.hpp>

#include <algorithm>  // std::fill, std::max, std::min
#include <array>      // std::array
#include <cmath>      // std::sqrt
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int32_t, std::uint32_t
#include <limits>     // std::numeric_limits
#include <string>     // std::to_string

namespace tsubu::detail {

// Cells along x follow each other, then rows along y, then layers along z; points are sorted by cell, so that three
// cells in a row are one stretch of points. A layer of empty cells around all is what stencils at the border look at.
//
//     . . . . . .        stencil of a cell c in 2-D, each pair once:
//     . a b c d .            * * *      the stretch of three cells above,
//     . e f g h .            c *        and c with the cell to its right
//     . . . . . .
//
// A stretch holds a few points only, and how many cannot be predicted. So the points of a stencil are first copied one
// stretch behind the other, and then compared with each point of the cell in one loop, as many at a time as there are
// lanes. Empty cells are never looked at: the others are listed, in the order of their first points. If points lie
// along a curve, pairs do too.

/// Points in the order of their cells.
template <std::size_t D, class Real>
class cells {
public:
    /// @param x       positions: size() and x[i][k], finite
    /// @param cutoff  [m]
    /// Complexity: O(N). @throws input_error at a position that is not finite.
    template <class Positions>
    cells(const char* where, const Positions& x, Real cutoff) : count_(static_cast<std::size_t>(x.size())) {
        lay_out(where, x, cutoff);
        sort(x);
    }

    /// body(near, k, begin): point k of `near` and those from `begin` on are all candidates, each pair once.
    template <class Body>
    void each_half(Body&& body) const {
        constexpr std::size_t rows = D == 1 ? 0 : D == 2 ? 1 : 4;
        const std::size_t steps[4] = {width_[0], plane_ - width_[0], plane_, plane_ + width_[0]};
        each_cell([&](stencil_points<D, Real>& near, std::size_t c) {
            std::array<point_stretch, rows + 1> stretches;
            stretches[0] = {begin_[c], begin_[c + 2]};
            for (std::size_t r = 0; r < rows; ++r)
                stretches[r + 1] = {begin_[c + steps[r] - 1], begin_[c + steps[r] + 2]};
            near.gather(columns_, origin_.data(), stretches);
            const auto own = begin_[c + 1] - begin_[c];
            for (std::uint32_t k = 0; k < own; ++k) body(near, k, k + 1);
        });
    }
    /// body(near, k): all of `near` are candidates for its point k, itself too; for each point of an index below `end`.
    template <class Body>
    void each_full(index_t end, Body&& body) const {
        constexpr std::size_t rows = D == 1 ? 1 : D == 2 ? 3 : 9;
        each_cell([&](stencil_points<D, Real>& near, std::size_t c) {
            // Of the points of a cell the first has the lowest index.
            if (origin_[begin_[c]] >= end) return;
            std::array<point_stretch, rows> stretches;
            stretches[0] = {begin_[c - 1], begin_[c + 2]};
            std::size_t r = 1;
            for (std::size_t z = 0; z < (D == 3 ? 3U : 1U); ++z)
                for (std::size_t y = 0; y < (D >= 2 ? 3U : 1U); ++y) {
                    const auto row = c + (D == 3 ? z * plane_ - plane_ : 0) + (D >= 2 ? y * width_[0] - width_[0] : 0);
                    if (row != c) stretches[r++] = {begin_[row - 1], begin_[row + 2]};
                }
            near.gather(columns_, origin_.data(), stretches);
            const auto first = begin_[c] - begin_[c - 1];
            const auto own = begin_[c + 1] - begin_[c];
            for (auto k = first; k < first + own && near.index(k) < end; ++k) body(near, k);
        });
    }

private:
    // Cells are as wide as the cutoff, or wider where the points are so sparse that most would be empty. A few points
    // far from all others would make them so wide that all others share one: then cells fill the place of most points
    // only, and those outside count as in the nearest. Two that are near each other are still in cells side by side.
    template <class Positions>
    void lay_out(const char* where, const Positions& x, Real cutoff) {
        const auto most = static_cast<Real>((std::min)(cells_per_point * count_ + 64, std::size_t{1} << 30));
        auto [lo, hi] = bounds(where, x);
        auto edge = fitting_edge(lo, hi, cutoff, most);
        if (edge > 2 * cutoff) {
            keep_most(x, lo, hi);
            edge = fitting_edge(lo, hi, cutoff, most);
        }
        lo_ = lo;
        inverse_edge_ = 1 / edge;
        std::size_t all = 1;
        for (std::size_t k = 0; k < D; ++k) {
            last_[k] = static_cast<Real>(static_cast<std::int32_t>((hi[k] - lo[k]) * inverse_edge_));
            width_[k] = static_cast<std::size_t>(last_[k]) + 3;  // an empty one at each end
            all *= width_[k];
        }
        plane_ = width_[0] * (D >= 2 ? width_[1] : 1);
        begin_ = buffer<std::uint32_t>(all + 2, {});
        std::fill(begin_.begin(), begin_.end(), 0U);
    }
    struct corners {
        vec<D, Real> lo{};
        vec<D, Real> hi{};
    };
    template <class Positions>
    [[nodiscard]] corners bounds(const char* where, const Positions& x) const {
        corners of;
        vec<D, Real> checked{};  // not 0 as soon as one is not finite; one sum for each axis, since they take turns
        if (count_ != 0)
            for (std::size_t k = 0; k < D; ++k) of.lo[k] = of.hi[k] = x[0][k];
        for (std::size_t i = 0; i < count_; ++i) {
            const auto& at = x[i];
            for (std::size_t k = 0; k < D; ++k) {
                of.lo[k] = (std::min)(of.lo[k], at[k]);
                of.hi[k] = (std::max)(of.hi[k], at[k]);
                checked[k] += at[k] * 0;
            }
        }
        for (std::size_t k = 0; k < D; ++k) {
            if (!(checked[k] == 0)) refuse(where, x);
            if (!is_finite(of.hi[k] - of.lo[k]))
                raise<input_error>(where,
                                   "coordinate " + std::to_string(k) + " from " + shown(of.lo[k]) + " to " +
                                       shown(of.hi[k]) + ", of which the difference is not finite",
                                   what_to_find);
        }
        return of;
    }
    // How wide cells are, so that there are at most so many.
    [[nodiscard]] static Real fitting_edge(const vec<D, Real>& lo, const vec<D, Real>& hi, Real cutoff, Real most) {
        Real longest = 0;
        for (std::size_t k = 0; k < D; ++k) longest = (std::max)(longest, hi[k] - lo[k]);
        // Rounding puts a point into a wrong cell by up to two units in the last place of the number of the cell.
        auto edge = cutoff + 8 * std::numeric_limits<Real>::epsilon() * (cutoff + longest);
        for (;; edge *= Real(1.125)) {
            Real all = 1;
            for (std::size_t k = 0; k < D; ++k) all *= (hi[k] - lo[k]) / edge + 3;
            if (!(all > most)) return edge;
        }
    }
    // Four standard deviations to each side of the mean: of points spread evenly that is all, and a few that are far
    // away are outside; those less far after the next round.
    template <class Positions>
    void keep_most(const Positions& x, vec<D, Real>& lo, vec<D, Real>& hi) const {
        for (int round = 0; round < 16; ++round) {
            vec<D, Real> inverse;
            for (std::size_t k = 0; k < D; ++k) inverse[k] = hi[k] > lo[k] ? 1 / (hi[k] - lo[k]) : 0;
            vec<D, double> sum{};
            vec<D, double> squares{};
            auto least = hi;
            auto greatest = lo;
            double inside = 0;
            for (std::size_t i = 0; i < count_; ++i) {
                vec<D, double> u;
                bool is_inside = true;
                for (std::size_t k = 0; k < D; ++k) {
                    u[k] = static_cast<double>((x[i][k] - lo[k]) * inverse[k]);
                    if (x[i][k] < lo[k] || x[i][k] > hi[k]) is_inside = false;
                }
                if (!is_inside) continue;
                for (std::size_t k = 0; k < D; ++k) {
                    sum[k] += u[k];
                    squares[k] += u[k] * u[k];
                    least[k] = (std::min)(least[k], x[i][k]);
                    greatest[k] = (std::max)(greatest[k], x[i][k]);
                }
                ++inside;
            }
            if (inside == 0) return;
            bool has_shrunk = false;
            for (std::size_t k = 0; k < D; ++k) {
                const auto length = hi[k] - lo[k];
                const double mean = sum[k] / inside;
                // What is far smaller than the whole is lost in rounding: that is left to the next round.
                constexpr double lost = 1e-12;
                const double four = 4 * std::sqrt((std::max)(squares[k] / inside - mean * mean, 0.0) + lost);
                hi[k] = (std::min)(greatest[k], lo[k] + static_cast<Real>(mean + four) * length);
                lo[k] = (std::max)(least[k], lo[k] + static_cast<Real>(mean - four) * length);
                lo[k] = (std::min)(lo[k], hi[k]);
                has_shrunk |= hi[k] - lo[k] < Real(0.7) * length;
            }
            if (!has_shrunk) return;
        }
    }
    static constexpr auto what_to_find = "find what made it: a time step past the limit, or an overlap of its start";
    template <class Positions>
    [[noreturn, gnu::cold, gnu::noinline]] static void refuse(const char* where, const Positions& x) {
        for (std::size_t i = 0;; ++i)
            for (std::size_t k = 0; k < D; ++k)
                if (!is_finite(x[i][k]))
                    raise<input_error>(where,
                                       "coordinate " + std::to_string(k) + " of particle " + std::to_string(i) +
                                           " is " + shown(x[i][k]),
                                       what_to_find);
    }
    template <class Position>
    [[nodiscard]] std::uint32_t cell_of(const Position& at) const noexcept {
        std::size_t c = 0;
        for (auto k = D; k-- > 0;) {
            const auto number = (std::min)((std::max)((at[k] - lo_[k]) * inverse_edge_, Real(0)), last_[k]);
            c = c * width_[k] + static_cast<std::uint32_t>(static_cast<std::int32_t>(number)) + 1;
        }
        return static_cast<std::uint32_t>(c);
    }
    template <class Positions>
    void sort(const Positions& x) {
        buffer<std::uint32_t> cell(count_, {});
        filled_ = buffer<std::uint32_t>((std::min)(count_, begin_.size()) + 1, {});
        filled_count_ = 0;
        auto* const begin = begin_.data();
        for (std::size_t i = 0; i < count_; ++i) {
            const auto c = cell_of(x[i]);
            cell[i] = c;
            filled_[filled_count_] = c;
            filled_count_ += begin[c + 2]++ == 0 ? 1U : 0U;
        }
        std::uint32_t sum = 0;
        for (std::size_t c = 2; c < begin_.size(); ++c) begin[c] = sum += begin[c];
        // Chunks are copied from any point on.
        for (auto& along : columns_) along = buffer<Real>(count_ + stencil_points<D, Real>::spare, {});
        origin_ = buffer<index_t>(count_ + stencil_points<D, Real>::spare, {});
        for (std::size_t i = 0; i < count_; ++i) {
            const auto to = begin[cell[i] + 1]++;
            const auto& at = x[i];
            for (std::size_t k = 0; k < D; ++k) columns_[k][to] = at[k];
            origin_[to] = static_cast<index_t>(i);
        }
    }
    template <class Body>
    void each_cell(Body&& body) const {
        stencil_points<D, Real> near(2 * count_ > 3 * filled_count_);
        for (std::size_t f = 0; f < filled_count_; ++f) body(near, filled_[f]);
    }

    static constexpr std::size_t cells_per_point = 4;

    std::size_t count_;
    vec<D, Real> lo_{};
    Real inverse_edge_ = 0;
    vec<D, Real> last_{};  // along each axis the number of the last cell that may have points
    std::array<std::size_t, D> width_{};
    std::size_t plane_ = 1;
    buffer<std::uint32_t> begin_;  // [cells + 2]: of each cell, after sorting
    buffer<std::uint32_t> filled_;
    std::size_t filled_count_ = 0;
    std::array<buffer<Real>, D> columns_;
    buffer<index_t> origin_;  // where each was before
};

/// What each list of neighbours begins with. @throws input_error, limit_error
template <class Positions, class Reach>
[[nodiscard]] auto sorted_into_cells(const char* where, const Positions& x, std::size_t owned, const Reach& reach) {
    using real = number_of_position<Positions>;
    const auto count = static_cast<std::size_t>(x.size());
    const double greatest = reach.greatest(count);
    check_list<real>(where, count, owned, greatest);
    return cells<dimension_of<position_in<Positions>>, real>(where, x, static_cast<real>(greatest));
}

}  // namespace tsubu::detail
