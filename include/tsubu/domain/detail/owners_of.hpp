// SPDX-License-Identifier: MIT
/// @file
/// The owner of each of many points.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/domain/detail/each_point.hpp>
#include <tsubu/domain/points.hpp>

#include <cstddef>  // std::size_t
#include <span>     // std::span

namespace tsubu::detail {

/// @throws input_error if the lengths differ.
template <class Decomposition, std::size_t D, class Scalar>
void owners_of(const char* where, const Decomposition& parts, const points<D, const Scalar>& x,
               std::span<rank_t> owners) {
    check_answers(where, owners.size(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) owners[i] = parts.owner(x[i]);
}

}  // namespace tsubu::detail
