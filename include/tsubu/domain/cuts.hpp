// SPDX-License-Identifier: MIT
/// @file
/// cuts: where an axis is divided among ranks.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/axis.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>         // std::upper_bound
#include <cstddef>           // std::size_t
#include <cstdint>           // std::uint64_t
#include <initializer_list>  // std::initializer_list
#include <limits>            // std::numeric_limits
#include <string>            // std::to_string
#include <type_traits>       // std::make_unsigned_t
#include <utility>           // std::move
#include <vector>            // std::vector

namespace tsubu {

/// The parts of one axis, by the coordinates where they begin: part k is begin(k) <= x < begin(k + 1). One table for
/// insertion, reading, migration and ghosts: what one part does not take, the next one does, whatever was rounded to
/// get there. The first part begins at lo itself, and the last ends at hi itself (B2, decided).
template <class Scalar = double>
class cuts {
public:
    /// One part: the whole axis.
    constexpr explicit cuts(const axis<Scalar>& whole) : cuts(whole, std::size_t{1}) {}
    /// `parts` of equal length: begin(k) = lo + L / (parts / k); on a lattice the first coordinate of share k.
    /// @throws input_error if parts is 0, or more than the scalar tells apart here.
    constexpr cuts(const axis<Scalar>& whole, std::size_t parts) : whole_(whole) {
        if (parts == 0) detail::raise<input_error>("cuts", "an axis in 0 parts", "divide it into at least 1");
        begins_.reserve(parts);
        begins_.push_back(whole.lo());
        for (std::size_t k = 1; k < parts; ++k) begins_.push_back(uniform(whole, k, parts));
        check("uniform cuts");
    }
    /// Parts that begin at lo and at each of the given coordinates.
    /// @throws input_error unless they increase, inside the axis.
    constexpr cuts(const axis<Scalar>& whole, std::vector<Scalar> inner) : whole_(whole), begins_(std::move(inner)) {
        begins_.insert(begins_.begin(), whole.lo());
        check("given cuts");
    }

    /// The same: {0.5} is one cut, never a number of parts.
    constexpr cuts(const axis<Scalar>& whole, std::initializer_list<Scalar> inner)
        : cuts(whole, std::vector<Scalar>(inner)) {}

    [[nodiscard]] constexpr std::size_t parts() const noexcept { return begins_.size(); }
    [[nodiscard]] constexpr const axis<Scalar>& whole() const noexcept { return whole_; }
    [[nodiscard]] constexpr Scalar begin(std::size_t part) const noexcept { return begins_[part]; }
    /// The coordinates of a part (B3): up to the one before the next part, or the last of the axis.
    [[nodiscard]] constexpr interval<Scalar> owned(std::size_t part) const noexcept {
        return {begins_[part], part + 1 < parts() ? detail::before(begins_[part + 1]) : whole_.inside().last};
    }
    /// The same, with the first part reaching down and the last one reaching up to everything (B4, B5): exactly one
    /// part has any finite x.
    [[nodiscard]] constexpr interval<Scalar> owned_extended(std::size_t part) const noexcept {
        return {part == 0 ? interval<Scalar>::all().first : begins_[part],
                part + 1 < parts() ? detail::before(begins_[part + 1]) : interval<Scalar>::all().last};
    }
    /// The part whose owned_extended has x: O(1) for equal parts, O(log parts) in the worst case.
    /// Precondition: x is not NaN.
    [[nodiscard]] constexpr std::size_t part_of(Scalar x) const noexcept {
        // Guessed by a division, which may be wrong by its rounding or by uneven cuts; the table decides.
        const auto guess = guessed(x);
        if (owned_extended(guess).contains(x)) return guess;
        if (guess + 1 < parts() && owned_extended(guess + 1).contains(x)) return guess + 1;
        if (guess > 0 && owned_extended(guess - 1).contains(x)) return guess - 1;
        const auto after = std::upper_bound(begins_.begin() + 1, begins_.end(), x);
        return static_cast<std::size_t>(after - begins_.begin()) - 1;
    }

private:
    // Neither a product that is added nor a sum that overflows: the same with and without fused multiply-add.
    [[nodiscard]] static constexpr Scalar uniform(const axis<Scalar>& whole, std::size_t k,
                                                  std::size_t parts) noexcept {
        if constexpr (is_lattice<Scalar>) {
            using Int = decltype(whole.lo().value);
            // floor(k 2^b / parts), by long division: quotient and remainder of 2^(b-1), since 2^64 fits no word, each
            // times 2 k.
            constexpr auto half = static_cast<std::uint64_t>((std::numeric_limits<Int>::max)()) + 1;
            const std::uint64_t quotient = half / parts;
            const std::uint64_t rest = half % parts;
            const std::uint64_t steps = 2 * quotient * k + 2 * rest * k / parts;
            return whole.lo() + static_cast<Int>(steps);
        } else {
            return whole.lo() + whole.length() / (static_cast<Scalar>(parts) / static_cast<Scalar>(k));
        }
    }
    [[nodiscard]] constexpr std::size_t guessed(Scalar x) const noexcept {
        const auto last = parts() - 1;
        if (last == 0) return 0;
        if constexpr (is_lattice<Scalar>) {
            using Unsigned = std::make_unsigned_t<decltype(x.value)>;
            constexpr int bits = std::numeric_limits<Unsigned>::digits;
            constexpr int used = bits < 32 ? bits : 32;
            const std::uint64_t above = static_cast<Unsigned>(x - whole_.lo());
            return static_cast<std::size_t>((above >> (bits - used)) * parts() >> used);
        } else {
            // Far points first: their share would overflow.
            if (!(x > whole_.lo())) return 0;
            if (x >= begins_[last]) return last;
            const Scalar share = (x - whole_.lo()) / whole_.length() * static_cast<Scalar>(parts());
            return share < static_cast<Scalar>(last) ? static_cast<std::size_t>(share) : last;
        }
    }
    // A part that begins at a closed face would have no width.
    [[nodiscard]] constexpr bool is_below_top(Scalar x) const noexcept {
        if constexpr (is_lattice<Scalar>)
            return true;
        else
            return x < whole_.hi();
    }
    constexpr void check(const char* kind) const {
        for (std::size_t k = 1; k < parts(); ++k)
            if (!(begins_[k - 1] < begins_[k]) || !is_below_top(begins_[k]))
                detail::raise<input_error>("cuts",
                                           std::string(kind) + ": part " + std::to_string(k) + " of " +
                                               std::to_string(parts()) + " begins at " + detail::shown(begins_[k]) +
                                               ", which does not lie between the begin of part " +
                                               std::to_string(k - 1) + ", " + detail::shown(begins_[k - 1]) +
                                               ", and the end of the axis, " + detail::shown(whole_.real().hi()),
                                           "give cuts that increase inside the axis, without its faces; at most as "
                                           "many parts as it has numbers");
    }

    axis<Scalar> whole_;
    std::vector<Scalar> begins_;
};

}  // namespace tsubu
