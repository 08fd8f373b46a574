// SPDX-License-Identifier: MIT
/// @file
/// neighbor_rank: a rank whose subdomain, or an image of it, is near.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/domain/domain.hpp>

#include <compare>  // operator<=>
#include <cstddef>  // std::size_t

namespace tsubu {

/// A rank, and by how many periods its subdomain must be moved to lie within the cutoff: the ghosts from there carry
/// this shift.
template <std::size_t D>
struct neighbor_rank {
    rank_t rank;
    image_shift<D> shift;

    friend constexpr auto operator<=>(const neighbor_rank&, const neighbor_rank&) noexcept = default;
};

}  // namespace tsubu
