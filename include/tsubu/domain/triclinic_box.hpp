// SPDX-License-Identifier: MIT
/// @file
/// triclinic_box: a box whose edges are not at right angles.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/detail/reduced_basis.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>  // std::max, std::max_element
#include <array>      // std::array
#include <cmath>      // std::abs, std::floor, std::fma, std::fmod, std::hypot, std::ldexp
#include <concepts>   // std::floating_point
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <limits>     // std::numeric_limits
#include <string>     // std::to_string

namespace tsubu {

// One function says where a point is: to_cell. A decomposition of the cell owns its fractions, contains asks the cell,
// and wrap returns only what to_cell puts inside, so none of them can disagree with another, whatever rounds:
//
//         hi ______________            1 ______
//           /             /             |      |       a fraction in [-4 eps, 0) is 0: an image moved to a face that
//          /   x         /   to_cell    | f    |       rounds to just below it stays there;
//         /_____________/   -------->   |______|       a fraction that rounds to 1 is 0 of the next period.
//       lo                             0        1
//
// Its products are fused explicitly. Left to the compiler, one caller's might be fused and another's not, and the two
// would disagree about a point on a face.

/// A box with the edges a = (lx, 0, 0), b = (xy, ly, 0), c = (xz, yz, lz) of LAMMPS; in 2-D a = (lx, 0), b = (xy, ly).
///
///     tsubu::triclinic_box<3> box({0, 0, 0}, {1, 1, 1}, {0.5, 0, 0}, {true, true, true});   // xy = 0.5
///     auto [y, shift] = box.wrap({1.8, 1.25, 0.5});         // y = (.3, .25, .5), shift = (1, 1, 0)
///     tsubu::brick_decomposition<3> bricks(box.cell(), 8);  // the owner of x: bricks.owner(box.to_cell(x))
///
/// Concept:      box.
/// Cost:         all O(1). to_cell D divisions and D (D - 1) / 2 fused products: each a call, if the instruction
///               set has none. minimum_image: D comparisons if the points are near, else up to 27 candidates.
/// Deterministic: yes, the same on every machine.
/// Choose it when the box is sheared, or the unit cell of a crystal. Do not when all tilts are 0: domain is exact at
///               every scale, and faster.
/// Source:       LAMMPS manual, "Triclinic (non-orthogonal) simulation boxes"; B1, B3 as decided, in fractions.
///
/// @tparam D  2 or 3.
/// Threads: any number of readers; nothing changes after construction.
template <std::size_t D = 3, std::floating_point Scalar = double>
class triclinic_box {
    static_assert(D == 2 || D == 3, "tsubu::triclinic_box has 2 or 3 dimensions; in one there is nothing to tilt");

public:
    using scalar_type = Scalar;
    using real_type = Scalar;
    using position_type = vec<D, Scalar>;
    using real_position_type = position_type;
    using cell_type = domain<D, Scalar>;
    using tilts = vec<D*(D - 1) / 2, Scalar>;  ///< {xy}, or {xy, xz, yz}: the order of LAMMPS
    static constexpr std::size_t dimension = D;

    /// @param lo        the corner that all edges start at [m]
    /// @param lengths   lx, ly, lz [m]
    /// @param tilt      up to 7e13 lengths in double, 1e5 in float; LAMMPS admits half a one [m]
    /// @param periodic  along a, b, c.
    /// @throws input_error if a length is not above 0, a number not finite, the cell too thin for the scalar to tell
    ///         its faces apart beside its farthest corner, or a length more than the 4th root of the largest number
    ///         times another.
    triclinic_box(const position_type& lo, const position_type& lengths, const tilts& tilt,
                  const std::array<bool, D>& periodic)
        : lo_(lo), edges_(edges_of(lo, lengths, tilt)), cell_(unit_cell(periodic)), periods_(edges_, periodic) {}

    /// The fractions [0, 1) of the edges, or [0, 1] of those that are not periodic: what a decomposition divides.
    [[nodiscard]] const cell_type& cell() const noexcept { return cell_; }
    [[nodiscard]] const position_type& lo() const noexcept { return lo_; }
    /// a, b or c [m].
    [[nodiscard]] const position_type& edge(std::size_t k) const noexcept { return edges_[k]; }

    /// The fraction of each edge at x: a function of x alone, the same bits for every caller. Beyond the range of the
    /// scalar a fraction is infinite or NaN.
    [[nodiscard]] position_type to_cell(const position_type& x) const noexcept {
        position_type fraction{};
        for (std::size_t k = D; k-- > 0;) {
            Scalar along = x[k] - lo_[k];
            for (std::size_t j = D - 1; j > k; --j) along = std::fma(-edges_[j][k], fraction[j], along);
            fraction[k] = along / edges_[k][k];
        }
        for (auto& f : fraction)
            if (f < 0 && f >= -4 * epsilon) f = 0;
        return fraction;
    }
    [[nodiscard]] position_type from_cell(const position_type& fraction) const noexcept {
        auto x = lo_;
        for (std::size_t k = 0; k < D; ++k) x = moved(x, k, fraction[k]);
        return x;
    }
    /// B1, of the fractions.
    [[nodiscard]] bool contains(const position_type& x) const noexcept { return cell_.contains(to_cell(x)); }

    /// The image of x whose fraction of each periodic edge is in [0, 1), and how many edges it was away; the position
    /// is x itself if it was there already. Along edges that are not periodic x stays as far out as it is. From 2^62
    /// periods on, shift is at its end and the position anywhere in the cell.
    /// @throws input_error if x is not finite, or so far out along an edge that is not periodic, and tilted, or the
    /// cell
    ///         tilted by so many lengths, that no number beside it is inside.
    [[nodiscard]] wrapped<D, Scalar> wrap(const position_type& x) const {
        for (std::size_t k = 0; k < D; ++k)
            if (!detail::is_finite(x[k]))
                detail::raise<input_error>("triclinic_box::wrap",
                                           "the coordinate " + detail::shown(x[k]) + " on axis " + std::to_string(k) +
                                               " is not finite",
                                           "find the particle with this position: it was lost before");
        wrapped<D, Scalar> at{x, {}};
        // One pass for ordinary points, one for each edge that x is far out along, and a few for rounding.
        constexpr int passes = 8;
        for (int pass = 0; pass < passes; ++pass) {
            const auto fraction = to_cell(at.position);
            bool inside = true;
            for (std::size_t k = D; k-- > 0;) {
                if (is_inside(fraction, k)) continue;
                inside = false;
                if (!(std::abs(fraction[k]) < most_periods)) {
                    bring_near(at, k);
                    break;  // the fractions of the edges before it depend on this one
                }
                move_back(at, k, std::floor(fraction[k]));
            }
            if (inside) return at;
        }
        settle(at, x);
        return at;
    }
    /// x moved by so many of each edge: the position of a ghost with this shift.
    [[nodiscard]] position_type image(const position_type& x, const image_shift<D>& shift) const noexcept {
        auto y = x;
        for (std::size_t k = 0; k < D; ++k) y = moved(y, k, static_cast<Scalar>(shift[k]));
        return y;
    }
    /// Where a wrapped position was, to within rounding.
    [[nodiscard]] position_type unwrap(const wrapped<D, Scalar>& at) const noexcept {
        return image(at.position, at.shift);
    }
    /// The shortest displacement from b to an image of a [m], however strong the tilt; from a to b it is the opposite,
    /// always. Its error is a few units in the last place of a - b, which must be finite, also when told in edges.
    [[nodiscard]] position_type minimum_image(const position_type& a, const position_type& b) const noexcept {
        position_type d{};
        for (std::size_t k = 0; k < D; ++k) d[k] = a[k] - b[k];
        return periods_.shortest(d);
    }
    /// How far a length reaches in the fraction of each edge: cutoff / (height of the box over the face that the edge
    /// ends at), and a few units in the last place for the rounding of to_cell. @throws input_error if the cutoff is
    /// negative or not finite.
    [[nodiscard]] position_type cell_reach(Scalar cutoff) const {
        detail::check_cutoff("triclinic_box::cell_reach", cutoff);
        position_type reach{};
        for (std::size_t k = 0; k < D; ++k) {
            // 1 / height is the length of the gradient of fraction k, here times l_k: 1 along axis k, and upwards
            // what is left to cancel of the tilts.
            position_type gradient{};
            gradient[k] = 1;
            for (std::size_t j = k + 1; j < D; ++j) {
                for (std::size_t i = k; i < j; ++i) gradient[j] -= gradient[i] * edges_[j][i];
                gradient[j] /= edges_[j][j];
            }
            Scalar length = gradient[0];
            for (std::size_t j = 1; j < D; ++j) length = std::hypot(length, gradient[j]);
            reach[k] = cutoff / edges_[k][k] * length * (1 + 16 * epsilon) +
                       8 * epsilon * farthest(lo_, edges_, k) / edges_[k][k];
        }
        return reach;
    }
    /// The same between any two parts of the cell.
    template <class Part>
    [[nodiscard]] position_type cell_reach(Scalar cutoff, const Part&, const Part&) const {
        return cell_reach(cutoff);
    }

private:
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    static constexpr Scalar most_periods = 4611686018427387904.0;  // 2^62: shift has room for what later passes add

    static std::array<position_type, D> edges_of(const position_type& lo, const position_type& lengths,
                                                 const tilts& tilt) {
        std::array<position_type, D> edges{};
        for (std::size_t k = 0, next = 0; k < D; ++k) {
            if (!(lengths[k] > 0) || !detail::is_finite(lengths[k]))
                detail::raise<input_error>("triclinic_box",
                                           "the length " + detail::shown(lengths[k]) + " of edge " + std::to_string(k),
                                           "give finite lengths above 0");
            edges[k][k] = lengths[k];
            for (std::size_t j = 0; j < k; ++j, ++next) {
                if (!detail::is_finite(tilt[next]))
                    detail::raise<input_error>("triclinic_box",
                                               "the tilt " + detail::shown(tilt[next]) + " of edge " +
                                                   std::to_string(k) + " along axis " + std::to_string(j),
                                               "give finite tilts: xy, xz, yz");
                edges[k][j] = tilt[next];
            }
        }
        for (std::size_t k = 0; k < D; ++k) {
            const Scalar reach = farthest(lo, edges, k);
            // 64 steps of the scalar at the farthest corner: wrap needs a few of them on either side of a face.
            if (!(64 * epsilon * reach <= lengths[k]) || !detail::is_finite(reach))
                detail::raise<input_error>("triclinic_box",
                                           "the length " + detail::shown(lengths[k]) + " of edge " + std::to_string(k) +
                                               " beside coordinates up to " + detail::shown(reach),
                                           "tilt less, move the origin nearer, or take a wider scalar");
            // So that the squares of both, relative to the larger, are normal numbers.
            constexpr int fourth_root = std::numeric_limits<Scalar>::max_exponent / 4;
            if (lengths[k] < std::ldexp(*std::max_element(lengths.begin(), lengths.end()), -fourth_root))
                detail::raise<input_error>("triclinic_box",
                                           "the length " + detail::shown(lengths[k]) + " of edge " + std::to_string(k) +
                                               " is too small beside the others",
                                           "give lengths of a more similar size");
        }
        return edges;
    }
    /// No coordinate of the box is larger, nor any term that it is the sum of.
    static Scalar farthest(const position_type& lo, const std::array<position_type, D>& edges, std::size_t k) noexcept {
        Scalar reach = std::abs(lo[k]);
        for (std::size_t j = k; j < D; ++j) reach += std::abs(edges[j][k]);
        return reach;
    }
    static cell_type unit_cell(const std::array<bool, D>& periodic) {
        position_type one{};
        one.fill(1);
        return cell_type(position_type{}, one, {.periodic = periodic});
    }

    [[nodiscard]] position_type moved(const position_type& x, std::size_t k, Scalar steps) const noexcept {
        auto y = x;
        for (std::size_t j = 0; j <= k; ++j) y[j] = std::fma(steps, edges_[k][j], x[j]);
        return y;
    }
    void move_back(wrapped<D, Scalar>& at, std::size_t k, Scalar steps) const noexcept {
        at.position = moved(at.position, k, -steps);
        at.shift[k] = later(at.shift[k], steps);
    }
    // A shift that is at its end stays there.
    static std::int64_t later(std::int64_t shift, Scalar steps) noexcept {
        using limits = std::numeric_limits<std::int64_t>;
        return shift == (limits::max)() || shift == (limits::min)() ? shift : shift + static_cast<std::int64_t>(steps);
    }
    [[nodiscard]] bool is_inside(const position_type& fraction, std::size_t k) const noexcept {
        return !cell_.along(k).is_periodic() || cell_.along(k).contains(fraction[k]);
    }
    /// For a coordinate with no digit left below the period.
    void bring_near(wrapped<D, Scalar>& at, std::size_t k) const noexcept {
        using limits = std::numeric_limits<std::int64_t>;
        at.shift[k] = at.position[k] > lo_[k] ? (limits::max)() : (limits::min)();
        at.position[k] = lo_[k] + std::fmod(at.position[k], edges_[k][k]);
    }
    /// For a position that rounds to just outside, whichever image is taken: moved into the cell by the fewest steps of
    /// the scalar, doubled until it is in. Last edge first: each step along it moves the fractions of those before it.
    void settle(wrapped<D, Scalar>& at, const position_type& x) const {
        for (std::size_t k = D; k-- > 0;) {
            Scalar step = epsilon * (std::max)(std::abs(at.position[k]), farthest(lo_, edges_, k));
            for (int tries = 0;; ++tries) {
                const auto fraction = to_cell(at.position);
                if (is_inside(fraction, k)) break;
                // 64 steps are the cell (see edges_of), so that 6 doublings cross it; the rest are for the edges.
                if (tries == 12 || !(std::abs(fraction[k]) < most_periods))
                    detail::raise<input_error>("triclinic_box::wrap",
                                               "no number beside " + detail::shown(x) + " is in the cell",
                                               "find the particle with this position: it is far outside");
                if (tries == 0 || fraction[k] >= 1) {
                    move_back(at, k, std::floor(fraction[k]));
                } else {
                    at.position[k] += step;
                    step *= 2;
                }
            }
        }
    }

    position_type lo_;
    std::array<position_type, D> edges_;  // [D] of [D]: edges_[k] has components 0 .. k
    cell_type cell_;
    detail::reduced_basis<D, Scalar> periods_;
};

static_assert(reaching_box<triclinic_box<2>> && reaching_box<triclinic_box<3, float>>);

}  // namespace tsubu
