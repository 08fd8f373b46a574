// SPDX-License-Identifier: MIT
/// @file
/// domain: the box of a simulation, with its periodic images.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/border.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <utility>  // std::index_sequence

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
    Real width;
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
    using border_type = Border;
    using position_type = vec<D, Scalar>;
    using real_position_type = vec<D, real_type>;
    using options = domain_options<D, Border>;
    static constexpr std::size_t dimension = D;

    /// @throws input_error unless lo < hi on every axis, all of them finite; and for a lattice with an axis that is not
    ///         periodic.
    domain(const real_position_type& lo, const real_position_type& hi, const options& with = {})
        : domain(lo, hi, with, std::make_index_sequence<D>{}) {}

    [[nodiscard]] const axis<Scalar>& along(std::size_t k) const noexcept { return axes_[k]; }
    [[nodiscard]] const Border& border() const noexcept { return border_; }

    /// B1.
    [[nodiscard]] bool contains(const position_type& x) const noexcept {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k) inside &= axes_[k].contains(x[k]);
        return inside;
    }
    /// The image of x in the box. @throws input_error if a coordinate is not finite.
    [[nodiscard]] wrapped<D, Scalar> wrap(const position_type& x) const {
        wrapped<D, Scalar> result{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto [position, shift] = axes_[k].wrap(x[k]);
            result.position[k] = position;
            result.shift[k] = shift;
        }
        return result;
    }
    /// Where a wrapped position was, to within rounding.
    [[nodiscard]] position_type unwrap(const wrapped<D, Scalar>& at) const noexcept
        requires(!is_lattice<Scalar>)
    {
        position_type x{};
        for (std::size_t k = 0; k < D; ++k) x[k] = axes_[k].unwrap({at.position[k], at.shift[k]});
        return x;
    }
    /// The shortest displacement from b to an image of a [m]; from a to b it is the opposite, always.
    [[nodiscard]] real_position_type minimum_image(const position_type& a, const position_type& b) const noexcept {
        real_position_type d{};
        for (std::size_t k = 0; k < D; ++k) {
            if constexpr (is_lattice<Scalar>)
                d[k] = axes_[k].minimum_image(a[k], b[k]);
            else
                d[k] = axes_[k].minimum_image(a[k] - b[k]);
        }
        return d;
    }
    /// B7, B8; of equal edges that of the lowest axis.
    [[nodiscard]] shortest_extent<real_type> min_extent() const noexcept {
        shortest_extent<real_type> shortest{axes_[0].length(), 0};
        for (std::size_t k = 1; k < D; ++k)
            if (axes_[k].length() < shortest.width) shortest = {axes_[k].length(), k};
        return shortest;
    }
    /// Within r_c of a periodic face, on either side of it (B9): x < lo + r_c or x > hi - r_c on a periodic axis.
    /// @throws input_error if r_c is negative or NaN.
    [[nodiscard]] bool near_periodic_face(const real_position_type& x, real_type cutoff) const {
        if (!(cutoff >= 0))
            detail::raise<input_error>("domain::near_periodic_face", "cutoff = " + detail::shown(cutoff),
                                       "give a length of at least 0");
        bool near = false;
        for (std::size_t k = 0; k < D; ++k) {
            const auto& real = real_axis(k);
            near = near || (axes_[k].is_periodic() && (x[k] < real.lo() + cutoff || x[k] > real.hi() - cutoff));
        }
        return near;
    }
    /// The axis in real units; for floating point the axis itself.
    [[nodiscard]] const axis<real_type>& real_axis(std::size_t k) const noexcept {
        if constexpr (is_lattice<Scalar>)
            return axes_[k].real();
        else
            return axes_[k];
    }

    /// Lattice coordinates of a position, and the periods that it was away; rounds to the nearest.
    /// @throws input_error if a coordinate is not finite.
    [[nodiscard]] wrapped<D, Scalar> from_real(const real_position_type& x) const
        requires is_lattice<Scalar>
    {
        wrapped<D, Scalar> result{};
        for (std::size_t k = 0; k < D; ++k) {
            const auto [position, shift] = axes_[k].from_real(x[k]);
            result.position[k] = position;
            result.shift[k] = shift;
        }
        return result;
    }
    [[nodiscard]] real_position_type to_real(const position_type& x) const noexcept {
        if constexpr (is_lattice<Scalar>) {
            real_position_type real{};
            for (std::size_t k = 0; k < D; ++k) real[k] = axes_[k].to_real(x[k]);
            return real;
        } else {
            return x;
        }
    }

private:
    template <std::size_t... K>
    domain(const real_position_type& lo, const real_position_type& hi, const options& with, std::index_sequence<K...>)
        : axes_{axis<Scalar>(lo[K], hi[K], with.periodic[K])...}, border_(with.border) {}

    std::array<axis<Scalar>, D> axes_;
    [[no_unique_address]] Border border_;
};

}  // namespace tsubu
