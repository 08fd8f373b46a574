// SPDX-License-Identifier: MIT
/// @file
/// The lowest and the highest of a set of ids.
#pragma once

#include <tsubu/core/types.hpp>

#include <algorithm>  // std::min, std::max
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span

namespace tsubu {

/// The closed interval that a set of ids spans; lowest > highest if the set is empty.
template <particle_id Id>
struct id_range {
    Id lowest = (std::numeric_limits<Id>::max)();
    Id highest = (std::numeric_limits<Id>::min)();

    [[nodiscard]] constexpr bool empty() const noexcept { return lowest > highest; }
    [[nodiscard]] constexpr bool contains(Id t) const noexcept { return lowest <= t && t <= highest; }
    /// highest - lowest, exact for every pair. Precondition: not empty().
    [[nodiscard]] constexpr std::uint64_t extent() const noexcept {
        using unsigned_type = detail::unsigned_id<Id>;
        return static_cast<unsigned_type>(static_cast<unsigned_type>(highest) - static_cast<unsigned_type>(lowest));
    }
    /// The least range that holds this one and the id.
    [[nodiscard]] constexpr id_range with(Id t) const noexcept {
        return {(std::min)(lowest, t), (std::max)(highest, t)};
    }
    friend constexpr bool operator==(const id_range&, const id_range&) = default;
};

/// The range of these ids.
/// Complexity: one pass; four independent minima and maxima, so that it runs at the speed of the loads.
template <particle_id Id>
[[nodiscard]] constexpr id_range<Id> range_of(std::span<const Id> ids) noexcept {
    constexpr std::size_t lanes = 4;
    id_range<Id> lane[lanes];
    const std::size_t whole = ids.size() / lanes * lanes;
    for (std::size_t i = 0; i < whole; i += lanes)
        for (std::size_t k = 0; k < lanes; ++k) lane[k] = lane[k].with(ids[i + k]);
    for (const Id t : ids.last(ids.size() % lanes)) lane[0] = lane[0].with(t);
    for (std::size_t k = 1; k < lanes; ++k) {
        lane[0].lowest = (std::min)(lane[0].lowest, lane[k].lowest);
        lane[0].highest = (std::max)(lane[0].highest, lane[k].highest);
    }
    return lane[0];
}

}  // namespace tsubu
