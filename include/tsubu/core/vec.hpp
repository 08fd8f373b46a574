// SPDX-License-Identifier: MIT
/// @file
/// vec: D numbers that belong to one point.
#pragma once

#include <array>    // std::array
#include <cstddef>  // std::size_t

namespace tsubu {

/// A point or a displacement in D dimensions: [D], in the unit of its context.
template <std::size_t D, class Scalar = double>
using vec = std::array<Scalar, D>;

}  // namespace tsubu
