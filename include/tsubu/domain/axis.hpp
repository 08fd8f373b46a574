// SPDX-License-Identifier: MIT
/// @file
/// axis: one direction of a box: where it begins and ends, and what lies beyond.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>

#include <cmath>        // std::fma, std::fmod, std::nearbyint, std::remainder
#include <concepts>     // std::floating_point
#include <cstdint>      // std::int64_t
#include <limits>       // std::numeric_limits
#include <type_traits>  // std::make_unsigned_t

namespace tsubu {

/// A coordinate that was brought into the box, and how many periods it was away: position + shift L is where it was.
template <class Scalar>
struct wrapped_coordinate {
    Scalar position;
    std::int64_t shift;
};

namespace detail {

/// The sum of two image counters; past the ends of the type, its end.
[[nodiscard]] constexpr std::int64_t saturated_sum(std::int64_t a, std::int64_t b) noexcept {
    using limits = std::numeric_limits<std::int64_t>;
    if (b > 0 && a > (limits::max)() - b) return (limits::max)();
    if (b < 0 && a < (limits::min)() - b) return (limits::min)();
    return a + b;
}

}  // namespace detail

/// One direction of a box. Every member is total: any finite number has a result, in O(1).
///
/// Equations with L = hi - lo, as the scalar rounds it; a periodic axis is lo <= x < hi, since hi is the image of lo,
/// any other lo <= x <= hi (B1).
template <class Scalar = double>
class axis {
    static_assert(std::floating_point<Scalar> && sizeof(Scalar) <= sizeof(double),
                  "axis takes float, double or a lattice");

public:
    using scalar_type = Scalar;
    using real_type = Scalar;  ///< the type of lengths

    /// @throws input_error unless lo < hi, both and hi - lo finite.
    constexpr axis(Scalar lo, Scalar hi, bool periodic)
        : lo_(lo), hi_(hi), last_(periodic ? detail::next_below(hi) : hi), length_(hi - lo), periodic_(periodic) {
        if (!detail::is_finite(lo) || !detail::is_finite(hi))
            detail::raise<input_error>("axis",
                                       "the face " + detail::shown(detail::is_finite(lo) ? hi : lo) +
                                           " is not a finite number",
                                       "give finite faces; a face that nothing reaches may lie far away");
        if (!(lo < hi))
            detail::raise<input_error>("axis", "lo = " + detail::shown(lo) + " is not below hi = " + detail::shown(hi),
                                       "give the lower face first, and a box that is not empty");
        if (!detail::is_finite(length_))
            detail::raise<input_error>("axis",
                                       "the length from " + detail::shown(lo) + " to " + detail::shown(hi) +
                                           " is more than the scalar holds",
                                       "scale the unit of length");
    }

    [[nodiscard]] constexpr Scalar lo() const noexcept { return lo_; }
    [[nodiscard]] constexpr Scalar hi() const noexcept { return hi_; }
    [[nodiscard]] constexpr Scalar length() const noexcept { return length_; }
    [[nodiscard]] constexpr bool is_periodic() const noexcept { return periodic_; }
    /// The coordinates of the axis (B1).
    [[nodiscard]] constexpr interval<Scalar> inside() const noexcept { return {lo_, last_}; }
    [[nodiscard]] constexpr bool contains(Scalar x) const noexcept { return inside().contains(x); }

    /// The image of x on a periodic axis, and how many periods it was away; any other axis leaves x alone. What rounds
    /// to hi is lo of the next period. |position + shift L - x| is a few units in the last place of the largest of
    /// them. Beyond 2^53 periods (2^24 in float) no number tells one from the next; beyond 2^63 shift stays at its end.
    /// @throws input_error if x is not finite.
    [[nodiscard]] constexpr wrapped_coordinate<Scalar> wrap(Scalar x) const {
        if (inside().contains(x)) return {x, 0};
        if (!periodic_ || !(x - hi_ < length_ && lo_ - x <= length_)) return wrap_from_afar(x);
        return x >= hi_ ? settled(x - length_, 1) : settled(x + length_, -1);
    }
    /// Where x was before wrap, to within rounding, unless shift is at its end.
    [[nodiscard]] constexpr Scalar unwrap(wrapped_coordinate<Scalar> at) const noexcept {
        return at.position + static_cast<Scalar>(at.shift) * length_;
    }
    /// For functions that list images within a reach. @throws input_error if it is more than 2^20 periods: 50 MB of
    /// images along one axis, beyond which the unit of a cutoff is wrong.
    void check_reach(const char* where, Scalar reach) const {
        if (periodic_ && reach / length_ > Scalar(1 << 20))
            detail::raise<input_error>(where,
                                       "the cutoff reaches " + detail::shown(reach) + " along an axis, more than 2^20 "
                                       "periods of " + detail::shown(length_),
                                       "take a smaller cutoff, or a larger box");
    }
    /// As a lattice has them, for code that takes either: the axis itself, wrap, and x.
    [[nodiscard]] constexpr const axis& real() const noexcept { return *this; }
    [[nodiscard]] constexpr wrapped_coordinate<Scalar> from_real(Scalar x) const { return wrap(x); }
    [[nodiscard]] constexpr Scalar to_real(Scalar x) const noexcept { return x; }
    /// The shortest of the displacements d + n L; of two, that which an even n gives, so that -d has the opposite
    /// answer. Not periodic: d.
    [[nodiscard]] Scalar minimum_image(Scalar d) const noexcept {
        if (!periodic_ || (d <= length_ / 2 && d >= -length_ / 2)) return d;
        return std::remainder(d, length_);  // exact
    }
    /// The shortest displacement from b to an image of a [m]; if not periodic, a - b.
    [[nodiscard]] Scalar minimum_image(Scalar a, Scalar b) const noexcept {
        const Scalar d = a - b;
        if (!periodic_ || detail::is_finite(d)) return minimum_image(d);
        return minimum_image(std::remainder(a, length_) - std::remainder(b, length_));
    }

private:
    // Rounding may leave the period by one step: up to hi, which is lo of the next one, or below lo.
    [[nodiscard]] constexpr wrapped_coordinate<Scalar> settled(Scalar position, std::int64_t shift) const noexcept {
        if (position >= hi_) return {lo_, shift + 1};
        return {position < lo_ ? lo_ : position, shift};
    }
    // The remainders are exact, so no digit is lost before the last addition, however far x is.
    [[nodiscard, gnu::cold]] constexpr wrapped_coordinate<Scalar> wrap_from_afar(Scalar x) const {
        if (!detail::is_finite(x))
            detail::raise<input_error>("axis::wrap", "the coordinate " + detail::shown(x) + " is not finite",
                                       "find the particle with this position: it was lost before");
        if (!periodic_) return {x, 0};
        Scalar beyond = std::fmod(x, length_) - std::fmod(lo_, length_);
        if (beyond < 0) beyond += length_;
        if (beyond < 0) beyond += length_;
        if (beyond >= length_) beyond -= length_;
        const Scalar position = settled(lo_ + beyond, 0).position;  // its shift shows in the position
        const Scalar periods = std::nearbyint(x / length_ - position / length_);
        constexpr Scalar end = 9223372036854775808.0;  // 2^63
        if (periods >= end) return {position, (std::numeric_limits<std::int64_t>::max)()};
        if (periods <= -end) return {position, (std::numeric_limits<std::int64_t>::min)()};
        return {position, static_cast<std::int64_t>(periods)};
    }

    Scalar lo_;
    Scalar hi_;
    Scalar last_;  // hi, or before it
    Scalar length_;
    bool periodic_;
};

/// A periodic axis whose coordinates are a lattice: every one is inside; only what leaves it for real units rounds.
template <class Int>
class axis<lattice<Int>> {
public:
    using scalar_type = lattice<Int>;
    using real_type = double;

    /// @throws input_error as for floating point, and if the axis is not periodic.
    constexpr axis(double lo, double hi, bool periodic) : real_(lo, hi, true) {
        if (!periodic)
            detail::raise<input_error>("axis", "an axis of a lattice that is not periodic",
                                       "make it periodic, or take double: a lattice has no outside");
    }

    [[nodiscard]] constexpr lattice<Int> lo() const noexcept { return interval<lattice<Int>>::all().first; }
    [[nodiscard]] constexpr double length() const noexcept { return real_.length(); }
    [[nodiscard]] static constexpr bool is_periodic() noexcept { return true; }
    [[nodiscard]] constexpr interval<lattice<Int>> inside() const noexcept { return interval<lattice<Int>>::all(); }
    [[nodiscard]] static constexpr bool contains(lattice<Int>) noexcept { return true; }
    [[nodiscard]] static constexpr wrapped_coordinate<lattice<Int>> wrap(lattice<Int> x) noexcept { return {x, 0}; }
    /// The faces and the length in real units.
    [[nodiscard]] constexpr const axis<double>& real() const noexcept { return real_; }

    /// The nearest lattice coordinate, and the periods that x was away: an error of at most L / 2^(b+1), and of what
    /// double rounds where b > 52; what rounds up to hi is lo of the next period. @throws input_error if x is not
    /// finite.
    [[nodiscard]] wrapped_coordinate<lattice<Int>> from_real(double x) const {
        const auto [position, shift] = real_.wrap(x);
        const double at = std::nearbyint((position - real_.lo()) / real_.length() * steps);
        if (at >= steps) return {lo(), detail::saturated_sum(shift, 1)};
        return {lo() + static_cast<Int>(static_cast<std::make_unsigned_t<Int>>(at)), shift};
    }
    /// The position of a lattice coordinate [m], in [lo, hi], the same on every machine: rounded once, or twice where
    /// b > 53.
    [[nodiscard]] double to_real(lattice<Int> at) const noexcept {
        const double x = std::fma(from_lower_face(at) / steps, length(), real_.lo());
        return x < real_.hi() ? x : real_.hi();
    }
    /// Where a wrapped coordinate was [m], to within rounding, unless shift is at its end.
    [[nodiscard]] double unwrap(wrapped_coordinate<lattice<Int>> at) const noexcept {
        return real_.unwrap({to_real(at.position), at.shift});
    }
    /// The shortest displacement from b to a [m]; half a period is +L/2 to the higher coordinate, -L/2 to the lower.
    [[nodiscard]] constexpr double minimum_image(lattice<Int> a, lattice<Int> b) const noexcept {
        const Int way = a - b;
        if (way == (std::numeric_limits<Int>::min)()) return a > b ? length() / 2 : -length() / 2;
        return length_of(static_cast<double>(way));
    }
    /// The length of so many lattice steps [m].
    [[nodiscard]] constexpr double length_of(double count) const noexcept { return count / steps * length(); }

private:
    // 2^b; a quotient by it is exact, and a product with L that comes after does not underflow.
    static constexpr double steps = -2.0 * static_cast<double>((std::numeric_limits<Int>::min)());

    [[nodiscard]] static constexpr double from_lower_face(lattice<Int> x) noexcept {
        return static_cast<double>(static_cast<std::make_unsigned_t<Int>>(
            static_cast<std::make_unsigned_t<Int>>(x.value) -
            static_cast<std::make_unsigned_t<Int>>((std::numeric_limits<Int>::min)())));
    }

    axis<double> real_;
};

}  // namespace tsubu
