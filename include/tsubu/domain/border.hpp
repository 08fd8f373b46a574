// SPDX-License-Identifier: MIT
/// @file
/// Border policies: which coordinates a part of an axis owns, at its faces above all.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/cuts.hpp>
#include <tsubu/domain/interval.hpp>

#include <concepts>  // std::semiregular
#include <cstddef>   // std::size_t

namespace tsubu {

/// Which coordinates a part owns.
///  1. owned: of all parts of an axis exactly one owns each x inside the axis, none any other x (B3);
///  2. owned_extended: of all parts exactly one owns each finite x (B4, B5);
///  3. what a part owns inside the axis is the same by both;
///  4. owned_extended of part_of(x) has x: a border may move no cut, since owner() asks the cuts alone.
template <class Border, class Scalar>
concept border_policy = std::semiregular<Border> &&
    requires(const Border& border, const cuts<Scalar>& where, std::size_t part) {
    { border.owned(where, part) } -> std::same_as<interval<Scalar>>;
    { border.owned_extended(where, part) } -> std::same_as<interval<Scalar>>;
};

/// Ownership by the table of cuts alone.
///
/// Concept:       border_policy, laws 1 to 4 at every scale and for every scalar.
/// Cost:          two comparisons.
/// Deterministic: yes, the same on every machine.
/// Choose it when results of a code that pads its faces need not be reproduced. Do not when they must: padded.
/// Source:        B2 as decided, B3, B4.
struct exact {
    template <class Scalar>
    [[nodiscard]] constexpr interval<Scalar> owned(const cuts<Scalar>& where, std::size_t part) const noexcept {
        return where.owned(part);
    }
    template <class Scalar>
    [[nodiscard]] constexpr interval<Scalar> owned_extended(const cuts<Scalar>& where,
                                                            std::size_t part) const noexcept {
        return where.owned_extended(part);
    }
};
static_assert(border_policy<exact, double> && border_policy<exact, lattice<int>>);

/// The faces of the box moved out by an absolute length, as LIGGGHTS does; to compare with, and to reproduce it.
///
/// Concept:       border_policy in form only. It breaks law 1: it owns what lies up to epsilon outside, which is 10 %
///                of a box of 1e-7 m; and where epsilon vanishes beside an upper face that is closed (|x| >= 2^27 in
///                double, >= 0.25 in float) nobody owns that face. Law 2: of two or more parts the first two both own
///                the cut between them; of a single part nobody owns what lies below. Law 3: so with that cut, inside.
/// Cost:          two comparisons.
/// Deterministic: yes.
/// Choose it when results of a code that pads its faces are to be reproduced. Do not otherwise.
/// Source:        B2, B3, B4 as printed.
struct padded {
    double epsilon;  ///< [m]

    /// @param width  [m]; 1e-8 is what LIGGGHTS has. @throws input_error if it is negative or not finite.
    explicit padded(double width = 1e-8) : epsilon(width) {
        if (!(width >= 0) || !detail::is_finite(width))
            detail::raise<input_error>("padded", "epsilon = " + detail::shown(width),
                                       "give a finite length of at least 0");
    }

    template <std::floating_point Scalar>
    [[nodiscard]] constexpr interval<Scalar> owned(const cuts<Scalar>& where, std::size_t part) const noexcept {
        const auto end = end_of(where, part);
        const auto pad = static_cast<Scalar>(epsilon);
        return {part == 0 ? where.begin(0) - pad : where.begin(part),
                detail::next_below(part + 1 == where.parts() ? end + pad : end)};
    }
    template <std::floating_point Scalar>
    [[nodiscard]] constexpr interval<Scalar> owned_extended(const cuts<Scalar>& where,
                                                            std::size_t part) const noexcept {
        const auto all = interval<Scalar>::all();
        if (part + 1 == where.parts()) return {where.begin(part), all.last};
        if (part == 0) return {all.first, end_of(where, part)};  // closed: so has the next part
        return where.owned(part);
    }

private:
    template <class Scalar>
    [[nodiscard]] static constexpr Scalar end_of(const cuts<Scalar>& where, std::size_t part) noexcept {
        return part + 1 < where.parts() ? where.begin(part + 1) : where.whole().hi();
    }
};
static_assert(border_policy<padded, double> && border_policy<padded, float>);

}  // namespace tsubu
