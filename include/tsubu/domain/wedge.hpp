// SPDX-License-Identifier: MIT
/// @file
/// wedge: one sector of a body that looks the same after a turn.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>  // std::max
#include <cmath>      // std::abs, std::asin, std::atan2, std::cos, std::floor, std::hypot, std::nearbyint, std::sin
#include <concepts>   // std::convertible_to, std::floating_point
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <limits>     // std::numeric_limits
#include <numbers>    // std::numbers::pi_v
#include <string>     // std::to_string
#include <vector>     // std::vector

namespace tsubu {

/// Whether the values of a field turn when an image is turned: velocities, forces and torques do, radii and ids do not.
/// A field says so by a member `static constexpr bool rotates_with_images = true`; a copy of a value that turns is
/// wedge::rotate of it.
template <class Field>
inline constexpr bool rotates_with_images = false;
template <class Field>
requires requires {
    { Field::rotates_with_images } -> std::convertible_to<bool>;
}
inline constexpr bool rotates_with_images<Field> = Field::rotates_with_images;

/// The sector of angle 2 pi / n, from the direction of x counter-clockwise, about an axis parallel to z; turned by that
/// angle again and again it makes the whole body.
///
///     tsubu::wedge<> drum(6, {0, 0}, 0.5, -1, 1, true);    // a sixth of a drum of radius 0.5, periodic along it
///     auto [y, shift] = drum.wrap(x);                      // shift[0] sectors on
///     v = drum.rotate(v, {-shift[0], 0, 0});               // so its velocity turns back
///
/// Cell coordinates are (angle / sector angle, distance from the axis r [m], z [m]): periodic, never periodic, as
/// asked. Shifts are (sectors, 0, periods of z); sectors modulo n are the same place.
///
/// Concept:      box.
/// Cost:         all O(1): an arc tangent and a root for to_cell, two of each for minimum_image, products for an image.
/// Bytes:        2 n numbers in a table.
/// Deterministic: on one kind of machine, since arc tangents differ in their last bit.
/// Choose it when body and load are the same in every sector: a rotor, a shear cell, a vertical drum. Do not when
///               gravity is across the axis, as in a horizontal drum: that differs from sector to sector. The arc
///               tangent is that of the machine: its last bit, and so the owner of a point on a face, may differ on
///               ranks of another kind.
///
/// Threads: any number of readers; nothing changes after construction.
template <std::floating_point Scalar = double>
class wedge {
public:
    using scalar_type = Scalar;
    using real_type = Scalar;
    using position_type = vec<3, Scalar>;
    using real_position_type = position_type;
    using cell_type = domain<3, Scalar>;
    static constexpr std::size_t dimension = 3;

    /// @param sectors     n, from 2 to 65536
    /// @param axis_at     x and y of the axis [m]
    /// @param r_max       [m]
    /// @param z_lo, z_hi  [m]
    /// @throws input_error if n is out of range, r_max not above 0, z_lo not below z_hi, a number not finite, or r_max
    ///         too small for the scalar to tell directions beside axis_at.
    wedge(std::size_t sectors, const vec<2, Scalar>& axis_at, Scalar r_max, Scalar z_lo, Scalar z_hi, bool z_periodic)
        : axis_at_(axis_at),
          cell_(cell_of(sectors, axis_at, r_max, z_lo, z_hi, z_periodic)),
          angle_(2 * std::numbers::pi_v<Scalar> / static_cast<Scalar>(sectors)),
          turns_(sectors) {
        // Whole quarter turns are exact, and a turn back is the transposed one.
        for (std::size_t k = 0; k <= sectors / 2; ++k) {
            const auto quarters = 4 * k / sectors;
            const auto rest = static_cast<Scalar>(4 * k % sectors) / static_cast<Scalar>(sectors);
            const Scalar c = std::cos(std::numbers::pi_v<Scalar> / 2 * rest);
            const Scalar s = std::sin(std::numbers::pi_v<Scalar> / 2 * rest);
            turns_[k] = quarters == 0 ? turn{c, s} : quarters == 1 ? turn{-s, c} : turn{-c, -s};
            if (k > 0) turns_[sectors - k] = {turns_[k].cosine, -turns_[k].sine};
        }
    }

    [[nodiscard]] std::size_t sectors() const noexcept { return turns_.size(); }
    /// Where the axis pierces the plane of x and y.
    [[nodiscard]] const vec<2, Scalar>& axis_at() const noexcept { return axis_at_; }
    /// The cell coordinates of the sector: what a decomposition divides.
    [[nodiscard]] const cell_type& cell() const noexcept { return cell_; }

    /// The cell coordinates of x: a function of x alone. The angle is in [-n/2, n/2] sectors; one in [-4 eps, 0) is 0,
    /// and so is that of a point on the axis.
    [[nodiscard]] position_type to_cell(const position_type& x) const noexcept {
        const Scalar dx = x[0] - axis_at_[0] + Scalar{0};  // -0 becomes 0: its arc tangent would be another
        const Scalar dy = x[1] - axis_at_[1] + Scalar{0};
        const Scalar sector = std::atan2(dy, dx) / angle_;
        return {sector < 0 && sector >= -4 * epsilon ? 0 : sector, std::hypot(dx, dy), x[2]};
    }
    [[nodiscard]] position_type from_cell(const position_type& at) const noexcept {
        return {axis_at_[0] + at[1] * std::cos(at[0] * angle_), axis_at_[1] + at[1] * std::sin(at[0] * angle_), at[2]};
    }
    /// B1, of the cell coordinates.
    [[nodiscard]] bool contains(const position_type& x) const noexcept { return cell_.contains(to_cell(x)); }

    /// The image of x in the sector, and how many sectors and periods of z it was away; x and y are untouched if they
    /// were there already. A point with r <= r_max has an image with r <= r_max, whatever rounds.
    /// @throws input_error if x, or its distance from the axis, is not finite.
    [[nodiscard]] wrapped<3, Scalar> wrap(const position_type& x) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (!detail::is_finite(x[k]))
                detail::raise<input_error>("wedge::wrap",
                                           "the coordinate " + detail::shown(x[k]) + " on axis " + std::to_string(k) +
                                               " is not finite",
                                           "find the particle with this position: it was lost before");
        const auto from = to_cell(x);
        if (!detail::is_finite(from[1]))
            detail::raise<input_error>("wedge::wrap",
                                       "(" + detail::shown(x[0]) + ", " + detail::shown(x[1]) +
                                           ") is farther from the axis than the scalar tells",
                                       "find the particle with this position: it was lost before");
        wrapped<3, Scalar> at{x, {}};
        const auto [z, periods] = cell_.along(2).wrap(x[2]);
        at.position[2] = z;
        at.shift[2] = periods;
        const bool was_within = cell_.along(1).contains(from[1]);
        Scalar shrink = epsilon * (1 + (std::abs(axis_at_[0]) + std::abs(axis_at_[1])) / cell_.along(1).hi());
        // One turn for ordinary points; more for those that round across a face, or over r_max.
        constexpr int passes = 8;
        for (int pass = 0; pass < passes; ++pass) {
            const auto now = to_cell(at.position);
            if (!cell_.along(0).contains(now[0])) {
                const auto sectors_on = static_cast<std::int64_t>(std::floor(now[0]));
                at.shift[0] += sectors_on;
                at.position = turned_about_axis(at.position, -sectors_on);
            } else if (was_within && !cell_.along(1).contains(now[1])) {
                for (std::size_t k = 0; k < 2; ++k)
                    at.position[k] = axis_at_[k] + (at.position[k] - axis_at_[k]) * (1 - shrink);
                shrink *= 2;
            } else {
                return at;
            }
        }
        settle(at);
        return at;
    }
    /// x turned by shift[0] sectors about the axis, and moved by shift[2] periods of z.
    [[nodiscard]] position_type image(const position_type& x, const image_shift<3>& shift) const noexcept {
        auto y = turned_about_axis(x, shift[0]);
        y[2] = cell_.along(2).unwrap({x[2], shift[2]});
        return y;
    }
    /// Where a wrapped position was, to within rounding.
    [[nodiscard]] position_type unwrap(const wrapped<3, Scalar>& at) const noexcept {
        return image(at.position, at.shift);
    }
    /// The value of a vector field in that image: turned, not moved. Of the fields for which rotates_with_images.
    [[nodiscard]] vec<3, Scalar> rotate(const vec<3, Scalar>& vector, const image_shift<3>& shift) const noexcept {
        const auto [c, s] = turn_by(shift[0]);
        return {c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]};
    }
    /// The shortest displacement from b to an image of a [m]. That from a to an image of b is as long, and the opposite
    /// after the turn that takes one image to the other. NaN if a or b is not finite.
    [[nodiscard]] vec<3, Scalar> minimum_image(const position_type& a, const position_type& b) const noexcept {
        const Scalar sectors_on = std::nearbyint(to_cell(b)[0] - to_cell(a)[0]);
        auto d = turned_about_axis(a, std::abs(sectors_on) > 0 ? static_cast<std::int64_t>(sectors_on) : 0);
        for (std::size_t k = 0; k < 2; ++k) d[k] -= b[k];
        d[2] = cell_.along(2).minimum_image(a[2], b[2]);
        return d;
    }

    /// The same image by the fewest sectors: more than -n/2 and at most n/2.
    [[nodiscard]] image_shift<3> same_image(const image_shift<3>& shift) const noexcept {
        const auto n = static_cast<std::int64_t>(sectors());
        auto on = shift[0] % n;
        if (on < 0) on += n;
        return {2 * on > n ? on - n : on, shift[1], shift[2]};
    }
    /// How far a length reaches between two parts of the cell, along the angle, r and z. At a distance r from the axis,
    /// and an angle t away, a point is at least r sin t from everything there, and beyond a quarter turn at least r.
    /// @throws input_error if the cutoff is negative or not finite.
    template <class Part>
    [[nodiscard]] position_type cell_reach(Scalar cutoff, const Part& a, const Part& b) const {
        detail::check_cutoff("wedge::cell_reach", cutoff);
        const Scalar inner = (std::max)(a.lo()[1], b.lo()[1]) * (1 - 16 * epsilon);
        const Scalar sectors_on = cutoff < inner ? std::asin(cutoff / inner) / angle_ * (1 + 16 * epsilon) + 8 * epsilon
                                                 : static_cast<Scalar>(sectors() / 2 + 1);
        const Scalar rounding = 8 * epsilon * (std::abs(axis_at_[0]) + std::abs(axis_at_[1]) + cell_.along(1).hi());
        return {sectors_on + rounding / (std::max)(inner, rounding), cutoff + rounding, cutoff};
    }

private:
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    struct turn {
        Scalar cosine;
        Scalar sine;
    };

    static cell_type cell_of(std::size_t sectors, const vec<2, Scalar>& axis_at, Scalar r_max, Scalar z_lo, Scalar z_hi,
                             bool z_periodic) {
        constexpr std::size_t most = 65536;  // of which each has its turn in a table
        if (sectors < 2 || sectors > most)
            detail::raise<input_error>("wedge", std::to_string(sectors) + " sectors", "give 2 to 65536");
        if (!(r_max > 0) || !detail::is_finite(r_max))
            detail::raise<input_error>("wedge", "r_max = " + detail::shown(r_max), "give a finite length above 0");
        for (const auto at : axis_at)
            // 64 steps of the scalar between axis and rim, as for triclinic_box. An infinite or NaN axis fails it too.
            if (!(64 * epsilon * (std::abs(at) + r_max) <= r_max))
                detail::raise<input_error>("wedge",
                                           "r_max = " + detail::shown(r_max) + " beside an axis at " +
                                               detail::shown(at),
                                           "give a finite axis, nearer to the origin");
        return cell_type({0, 0, z_lo}, {1, r_max, z_hi}, {.periodic = {true, false, z_periodic}});
    }
    [[nodiscard]] turn turn_by(std::int64_t sectors_on) const noexcept {
        const auto n = static_cast<std::int64_t>(turns_.size());
        const auto rest = sectors_on % n;
        return turns_[static_cast<std::size_t>(rest < 0 ? rest + n : rest)];
    }
    [[nodiscard]] position_type turned_about_axis(const position_type& x, std::int64_t sectors_on) const noexcept {
        const auto [c, s] = turn_by(sectors_on);
        if (s == 0 && c > 0) return x;  // no turn: not rounded beside axis_at
        const Scalar dx = x[0] - axis_at_[0];
        const Scalar dy = x[1] - axis_at_[1];
        return {axis_at_[0] + (c * dx - s * dy), axis_at_[1] + (s * dx + c * dy), x[2]};
    }
    /// For a position that rounds across the face between two sectors, whichever image is taken: onto the face itself,
    /// where the angle is 0 without rounding.
    void settle(wrapped<3, Scalar>& at) const noexcept {
        const auto now = to_cell(at.position);
        if (now[0] >= 1) ++at.shift[0];
        at.position[0] = axis_at_[0] + now[1];
        while (at.position[0] - axis_at_[0] > cell_.along(1).hi() && now[1] <= cell_.along(1).hi() * (1 + 64 * epsilon))
            at.position[0] = detail::next_below(at.position[0]);
        at.position[1] = axis_at_[1];
    }

    vec<2, Scalar> axis_at_;
    cell_type cell_;
    Scalar angle_;             // of a sector [rad]
    std::vector<turn> turns_;  // [n]: by 0 .. n - 1 sectors
};

static_assert(reaching_box<wedge<>> && cyclic_box<wedge<float>>);

}  // namespace tsubu
