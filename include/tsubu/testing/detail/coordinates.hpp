// SPDX-License-Identifier: MIT
/// @file
/// Coordinates to examine boxes and decompositions with.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>

#include <cstdint>      // std::int64_t, std::uint64_t
#include <limits>       // std::numeric_limits
#include <type_traits>  // std::make_unsigned_t

namespace tsubu::detail {

/// The coordinate beside x, up or down: nothing lies between them.
template <class Scalar>
[[nodiscard]] Scalar beside(Scalar x, bool up) {
    return up ? after(x) : before(x);
}
/// A coordinate of any size: of floating point, any finite number.
template <class Scalar>
[[nodiscard]] Scalar any_coordinate(random_stream& random) {
    constexpr auto lowest = interval<Scalar>::all().first;
    constexpr auto highest = interval<Scalar>::all().last;
    if constexpr (is_lattice<Scalar>) {
        return {static_cast<decltype(lowest.value)>(random())};
    } else {
        const auto most = static_cast<std::uint64_t>(ordinal(highest));
        const auto place = static_cast<std::int64_t>(random.below(most + 1));
        return at_ordinal<Scalar>(random.below(2) == 0 ? place : -place);
    }
}
/// A coordinate between two others, these included.
template <class Scalar>
[[nodiscard]] Scalar coordinate_between(Scalar first, Scalar last, random_stream& random) {
    if constexpr (is_lattice<Scalar>) {
        using Unsigned = std::make_unsigned_t<decltype(first.value)>;
        const auto steps =
            static_cast<Unsigned>(static_cast<Unsigned>(last.value) - static_cast<Unsigned>(first.value));
        const auto step =
            steps == (std::numeric_limits<Unsigned>::max)() ? random() : random.below(std::uint64_t{steps} + 1);
        return first + static_cast<decltype(first.value)>(static_cast<Unsigned>(step));
    } else {
        const auto x = first + static_cast<Scalar>(random.unit()) * (last - first);
        return x < first ? first : x > last ? last : x;
    }
}

}  // namespace tsubu::detail
