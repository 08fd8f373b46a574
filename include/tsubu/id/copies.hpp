// SPDX-License-Identifier: MIT
/// @file
/// Which copy of a particle is nearest, and which ids are owned twice.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/id/same_id_links.hpp>

#include <cstddef>  // std::size_t
#include <vector>   // std::vector

namespace tsubu {

/// Which copy of this particle is nearest?
///
/// The copy that find() returns is the one with the lowest index: it may be farther than a ghost. Ties go to the
/// lowest index; a copy whose distance is NaN is never nearer than another.
///
///     auto j = tsubu::closest_image(same, where.find(partner), [&](auto k) { return squared_distance(x[i], x[k]); });
///
/// @param first     where.find(id)
/// @param distance  callable: index -> distance, or its square, in any ordered type
/// @return the index of the nearest copy; absent if first is
/// Complexity: one distance per copy.
/// Source: A1, A13.
template <class Distance>
[[nodiscard]] index_t closest_image(const same_id_links& same, index_t first, Distance&& distance) {
    if (first == absent) return absent;
    const auto is_nan = [](const auto& value) { return value != value; };  // NOLINT(misc-redundant-expression)
    auto nearest = first;
    auto least = distance(first);
    for (auto k = same.next(first); k != absent; k = same.next(k)) {
        const auto d = distance(k);
        if (d < least || (is_nan(least) && !is_nan(d))) {
            nearest = k;
            least = d;
        }
    }
    return nearest;
}

/// Two owned copies of one id on this rank.
struct duplicate {
    index_t first;
    index_t second;
    friend constexpr bool operator==(const duplicate&, const duplicate&) = default;
};

/// Which ids are owned twice on this rank? Each such copy with the one before it, in increasing index.
///
/// {4, 9, 4}, all owned: (0, 2). Ghosts are no duplicates. Over all ranks: duplicate_ids in comm/.
///
/// @param owned_count  n; indices below it are owned
/// Complexity: O(n).
/// Source: A13.
[[nodiscard]] inline std::vector<duplicate> owned_duplicates(const same_id_links& same, std::size_t owned_count) {
    std::vector<duplicate> found;
    const auto links = same.links();
    for (std::size_t i = 0; i < owned_count && i < links.size(); ++i)
        if (links[i] != absent && static_cast<std::size_t>(links[i]) < owned_count)
            found.push_back({static_cast<index_t>(i), links[i]});
    return found;
}

}  // namespace tsubu
