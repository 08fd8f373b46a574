// SPDX-License-Identifier: MIT
/// @file
/// Is this particle a copy that a periodic face made; is it the one that stands for its id here?
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/domain/detail/each_point.hpp>
#include <tsubu/domain/domain.hpp>

#include <algorithm>  // std::min
#include <cstddef>    // std::size_t
#include <span>       // std::span

namespace tsubu {

/// Whether a ghost with this shift comes through a periodic face (B9): exact for any cutoff, where the position alone
/// (domain::near_periodic_face) can only tell that it may.
template <std::size_t D>
[[nodiscard]] constexpr bool is_periodic_ghost(const image_shift<D>& shift) noexcept {
    return shift != image_shift<D>{};
}
/// mask[i] = 1 if particle i is one. @throws input_error if the lengths differ.
template <std::size_t D>
void is_periodic_ghost(std::span<const image_shift<D>> shifts, std::span<unsigned char> mask) {
    detail::check_answers("is_periodic_ghost", mask.size(), shifts.size());
    for (std::size_t i = 0; i < shifts.size(); ++i) mask[i] = is_periodic_ghost(shifts[i]);
}

/// Whether particle i stands for its id on this rank: the owned one, or the first ghost (B10). In an id_map that was
/// built from all ids, owned first, it is the one that the map finds.
///
/// @param where  an id_map
/// @param ids    of all particles of this rank [N]
template <class Map>
[[nodiscard]] bool is_owned_or_first_ghost(const Map& where, std::span<const typename Map::id_type> ids,
                                           index_t i) noexcept {
    return where.find(ids[static_cast<std::size_t>(i)]) == i;
}
/// mask[i] = 1 if particle i is, by batched look-ups. @throws input_error if the lengths differ.
template <class Map>
void is_owned_or_first_ghost(const Map& where, std::span<const typename Map::id_type> ids,
                             std::span<unsigned char> mask) {
    detail::check_answers("is_owned_or_first_ghost", mask.size(), ids.size());
    constexpr std::size_t block = 1024;
    index_t found[block];
    for (std::size_t begin = 0; begin < ids.size(); begin += block) {
        const auto length = (std::min)(block, ids.size() - begin);
        where.find(ids.subspan(begin, length), std::span(found, length));
        for (std::size_t j = 0; j < length; ++j) mask[begin + j] = found[j] == static_cast<index_t>(begin + j);
    }
}

}  // namespace tsubu
