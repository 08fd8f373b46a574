// SPDX-License-Identifier: MIT
/// @file
/// domain: the box of a simulation, with its periodic images.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/border.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/detail/each_point.hpp>
#include <tsubu/domain/points.hpp>

#include <array>     // std::array
#include <concepts>  // std::floating_point
#include <cstddef>   // std::size_t
#include <cstdint>   // std::int64_t
#include <limits>    // std::numeric_limits
#include <span>      // std::span
#include <string>    // std::string
#include <utility>   // std::index_sequence

namespace tsubu {

/// How many periods away an image is, per axis [D].
template <std::size_t D>
using image_shift = vec<D, std::int64_t>;

/// A position in the box, and how many periods it was away.
template <std::size_t D, class Scalar>
struct wrapped {
    vec<D, Scalar> position;
    image_shift<D> shift;
};

/// The shortest edge, and its axis.
template <class Real>
struct shortest_extent {
    Real width;  ///< its length
    std::size_t axis;
};

/// Which axes are periodic, and how ownership is decided at faces.
template <std::size_t D, class Border>
struct domain_options {
    std::array<bool, D> periodic{};
    Border border{};
};

/// Where is x: inside, beyond a periodic face, and how far from its nearest image?
///
///     tsubu::domain<3> box{{0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, false}}};
///     auto [y, shift] = box.wrap({1.25, -0.5, 0.5});   // y = (.25, .5, .5), shift = (1, -1, 0)
///
/// Every formula is a loop over axes; see axis for their rounding.
///
/// Concept: box. Cost: all O(D); a point many periods away costs a call of std::fmod per axis. Deterministic: yes, the
/// same on every machine.
/// Choose it when faces are at right angles. Do not when the box is sheared (triclinic_box) or a sector (wedge).
/// Source: B1, B3 as decided.
///
/// @tparam D       1, 2 or 3.
/// @tparam Scalar  float, double, or lattice<Int>, whose axes are all periodic.
/// @tparam Border  a border_policy, which the decompositions of this domain ask.
///
/// Threads: any number of readers; nothing changes after construction.
template <std::size_t D, class Scalar = double, border_policy<Scalar> Border = exact>
class domain {
    static_assert(D >= 1 && D <= 3, "tsubu::domain has 1, 2 or 3 dimensions");

public:
    using scalar_type = Scalar;
    using real_type = typename axis<Scalar>::real_type;
    using position_type = vec<D, Scalar>;
    using real_position_type = vec<D, real_type>;
    using options = domain_options<D, Border>;
    static constexpr std::size_t dimension = D;

    /// @param lo, hi  lower and upper faces [m], [D]
    /// @throws input_error unless lo < hi on every axis, both and hi - lo finite; and for a lattice with an axis that
    ///         is not periodic.
    domain(const real_position_type& lo, const real_position_type& hi, const options& with = {})
        : domain(lo, hi, with, std::make_index_sequence<D>{}) {}
    /// The same box for positions of a narrower type: its faces rounded inwards, so that whatever is in it is in the
    /// wider one. @throws input_error if nothing is left.
    template <std::floating_point Wider>
    requires(std::floating_point<Scalar> &&
             sizeof(Wider) > sizeof(Scalar)) explicit domain(const domain<D, Wider, Border>& wider)
        : domain(faces_of(wider, false), faces_of(wider, true), options_of(wider)) {}

    /// A box whose cell is itself: see the concept box.
    [[nodiscard]] const domain& cell() const noexcept { return *this; }
    [[nodiscard]] static position_type to_cell(const position_type& x) noexcept { return x; }
    [[nodiscard]] static position_type from_cell(const position_type& x) noexcept { return x; }
    [[nodiscard]] const axis<Scalar>& along(std::size_t k) const noexcept { return axes_[k]; }
    [[nodiscard]] const Border& border() const noexcept { return border_; }

    /// Whether x is in the box (B1): lo <= x < hi along a periodic axis, lo <= x <= hi along any other. NaN is not.
    [[nodiscard]] bool contains(const position_type& x) const noexcept {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k) inside &= axes_[k].contains(x[k]);
        return inside;
    }
    /// mask[i] = 1 if the domain contains point i, else 0. @throws input_error if the lengths differ.
    void contains(const points<D, const Scalar>& x, std::span<unsigned char> mask) const {
        detail::check_answers("domain::contains", mask.size(), x.size());
        detail::inside(insides(), x, 0, x.size(), mask.data());
    }
    /// The image of x in the box: axis::wrap along each axis. @throws input_error if a coordinate is not finite.
    [[nodiscard]] wrapped<D, Scalar> wrap(const position_type& x) const {
        check_finite(x, [] { return std::string(); });
        // Not a loop: see image.
        return [&]<std::size_t... K>(std::index_sequence<K...>) {
            return [](auto... along) {
                return wrapped<D, Scalar>{{along.position...}, {along.shift...}};
            }(axes_[K].wrap(x[K])...);
        }
        (std::make_index_sequence<D>{});
    }
    /// Wraps each of many points where it stands, and adds to shift[i] how many periods it was away.
    /// @return how many points changed.
    /// @throws input_error if the lengths differ, or at the first point that is not finite: the points before it are
    ///         wrapped, and their shifts say so.
    std::size_t wrap(const points<D, Scalar>& x, std::span<image_shift<D>> shift) const {
        detail::check_answers("domain::wrap", shift.size(), x.size());
        std::size_t changed = 0;
        if constexpr (is_lattice<Scalar>) return changed;  // there is no outside
        detail::tell_outside<D, Scalar>(insides(), x, [&](std::size_t i, bool outside) {
            if (!outside) return;
            const auto from = x[i];
            check_finite(from, [&] { return " of point " + std::to_string(i); });
            const auto to = wrap(from);
            if (to.position == from) return;  // beyond a face that is not periodic
            x.set(i, to.position);
            for (std::size_t k = 0; k < D; ++k) shift[i][k] = detail::saturated_sum(shift[i][k], to.shift[k]);
            ++changed;
        });
        return changed;
    }
    /// Where a wrapped position was, in real units, to within rounding, unless a shift is at its end.
    [[nodiscard]] real_position_type unwrap(const wrapped<D, Scalar>& at) const noexcept {
        return image(at.position, at.shift);
    }
    /// x moved by so many periods of each axis: where the ghost with this shift is, in real units.
    [[nodiscard]] real_position_type image(const position_type& x, const image_shift<D>& shift) const noexcept {
        // Not a loop, whose results would go through memory one by one and come back two at a time, which stalls.
        return [&]<std::size_t... K>(std::index_sequence<K...>) {
            return real_position_type{axes_[K].unwrap({x[K], shift[K]})...};
        }
        (std::make_index_sequence<D>{});
    }
    /// The shortest displacement from b to an image of a [m]; from a to b it is the opposite, always.
    [[nodiscard]] real_position_type minimum_image(const position_type& a, const position_type& b) const noexcept {
        real_position_type d{};
        for (std::size_t k = 0; k < D; ++k) d[k] = axes_[k].minimum_image(a[k], b[k]);
        return d;
    }
    /// The shortest edge [m] and its axis (B7, B8); of equal edges the lowest axis.
    [[nodiscard]] shortest_extent<real_type> min_extent() const noexcept {
        shortest_extent<real_type> shortest{axes_[0].length(), 0};
        for (std::size_t k = 1; k < D; ++k)
            if (axes_[k].length() < shortest.width) shortest = {axes_[k].length(), k};
        return shortest;
    }
    /// Beyond a periodic face, or nearer to one than the cutoff [m] (B9): x < lo + cutoff or x > hi - cutoff there.
    /// @throws input_error if the cutoff is negative or NaN.
    [[nodiscard]] bool near_periodic_face(const real_position_type& x, real_type cutoff) const {
        return is_near(between_periodic_faces(cutoff), [&](std::size_t k) { return x[k]; });
    }
    /// mask[i] = 1 if point i is near. @throws input_error as above, and if the lengths differ.
    void near_periodic_face(const points<D, const real_type>& x, real_type cutoff,
                            std::span<unsigned char> mask) const {
        detail::check_answers("domain::near_periodic_face", mask.size(), x.size());
        x.visit([&](auto at) {
            detail::each_point(x.size(), mask.data(), [at, between = between_periodic_faces(cutoff)](std::size_t i) {
                return static_cast<unsigned char>(is_near(between, [&](std::size_t k) { return at(i, k); }));
            });
        });
    }
    /// The axis in real units; for floating point the axis itself.
    [[nodiscard]] const axis<real_type>& real_axis(std::size_t k) const noexcept { return axes_[k].real(); }

    /// The coordinates of a position, and the periods that it was away: wrap, and on a lattice the nearest place.
    /// @throws input_error if a coordinate is not finite.
    [[nodiscard]] wrapped<D, Scalar> from_real(const real_position_type& x) const {
        wrapped<D, Scalar> result{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto [position, shift] = detail::with_axis(k, "domain", [&] { return axes_[k].from_real(x[k]); });
            result.position[k] = position;
            result.shift[k] = shift;
        }
        return result;
    }
    /// The position in real units [m], as axis::to_real.
    [[nodiscard]] real_position_type to_real(const position_type& x) const noexcept {
        real_position_type real{};
        for (std::size_t k = 0; k < D; ++k) real[k] = axes_[k].to_real(x[k]);
        return real;
    }

private:
    template <std::size_t... K>
    domain(const real_position_type& lo, const real_position_type& hi, const options& with, std::index_sequence<K...>)
        : axes_{axis_of(K, lo[K], hi[K], with.periodic[K])...}, border_(with.border) {}
    static axis<Scalar> axis_of(std::size_t k, real_type lo, real_type hi, bool periodic) {
        return detail::with_axis(k, "domain", [&] { return axis<Scalar>(lo, hi, periodic); });
    }

    template <class Wider>
    static position_type faces_of(const domain<D, Wider, Border>& wider, bool upper) noexcept {
        position_type faces{};
        for (std::size_t k = 0; k < D; ++k) {
            const Wider face = upper ? wider.along(k).hi() : wider.along(k).lo();
            const auto nearest = static_cast<Scalar>(face);
            faces[k] = upper ? (nearest > face ? detail::before(nearest) : nearest)
                             : (nearest < face ? detail::after(nearest) : nearest);
        }
        return faces;
    }
    template <class Wider>
    static options options_of(const domain<D, Wider, Border>& wider) noexcept {
        options with{{}, wider.border()};
        for (std::size_t k = 0; k < D; ++k) with.periodic[k] = wider.along(k).is_periodic();
        return with;
    }
    [[nodiscard]] std::array<interval<Scalar>, D> insides() const noexcept {
        std::array<interval<Scalar>, D> box{};
        for (std::size_t k = 0; k < D; ++k) box[k] = axes_[k].inside();
        return box;
    }
    template <class Whose>
    static void check_finite(const position_type& x, Whose&& whose) {
        if constexpr (!is_lattice<Scalar>)
            for (std::size_t k = 0; k < D; ++k)
                if (!detail::is_finite(x[k]))
                    detail::raise<input_error>("domain::wrap",
                                               "the coordinate " + detail::shown(x[k]) + " on axis " +
                                                   std::to_string(k) + whose() + " is not finite",
                                               "find the particle with this position: it was lost before");
    }
    /// Of each axis what is not near a periodic face: everything, if it is not periodic; nothing, if the cutoff is
    /// large.
    [[nodiscard]] std::array<interval<real_type>, D> between_periodic_faces(real_type cutoff) const {
        if (!(cutoff >= 0))
            detail::raise<input_error>("domain::near_periodic_face", "cutoff = " + detail::shown(cutoff),
                                       "give a length of at least 0");
        constexpr auto infinity = std::numeric_limits<real_type>::infinity();
        std::array<interval<real_type>, D> between{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto& real = real_axis(k);
            between[k] = real.is_periodic() ? interval<real_type>{real.lo() + cutoff, real.hi() - cutoff}
                                            : interval<real_type>{-infinity, infinity};
        }
        return between;
    }
    template <class Coordinate>
    [[nodiscard, gnu::always_inline]] static bool is_near(const std::array<interval<real_type>, D>& between,
                                                          Coordinate x) noexcept {
        bool near = false;
        for (std::size_t k = 0; k < D; ++k) {
            const bool below = x(k) < between[k].first;
            const bool above = x(k) > between[k].last;
            near |= below | above;
        }
        return near;
    }

    std::array<axis<Scalar>, D> axes_;
    [[no_unique_address]] Border border_;
};

}  // namespace tsubu
