// SPDX-License-Identifier: MIT
/// @file
/// decomposition: how a domain is divided among ranks; and the table of its models.
///
/// | model | subdomains | owner(x) | choose it when |
/// |---|---|---|---|
/// | brick_decomposition | a grid of cuts along each axis | O(1) for equal parts | particles fill the box evenly, or only one axis is uneven |
/// | bisection_decomposition | a tree of cuts, each through a weighted middle | O(log ranks) | particles are uneven: a heap, a jet, a drum |
#pragma once

#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/neighbor_rank.hpp>
#include <tsubu/domain/subdomain.hpp>

#include <concepts>  // std::same_as
#include <cstddef>   // std::size_t
#include <vector>    // std::vector

namespace tsubu {

/// How a domain is divided among ranks, the same on all of them.
///  1. subdomain(0) .. subdomain(ranks() - 1) own the domain without gap or overlap: of all ranks one owns each point of it,
///     and none any other; of owns_extended one each finite point, and none any other;
///  2. owner(x) is the rank whose owns_extended has x, bit for bit; for a point of the domain so has its owns;
///  3. neighbors(rank, cutoff) has (other, shift) if some point of other's subdomain, moved by shift periods, lies within
///     the cutoff of some point of rank's; never (rank, 0); each once, in increasing order of rank and shift;
///  4. neighbourhood is mutual: (b, s) is a neighbour of a exactly if (a, -s) is one of b.
template <class Decomposition>
concept decomposition = requires(const Decomposition& parts, typename Decomposition::position_type x,
                                 typename Decomposition::real_type cutoff, std::size_t rank) {
    { parts.ranks() } noexcept -> std::same_as<std::size_t>;
    { parts.owner(x) } noexcept -> std::same_as<std::size_t>;
    { parts.subdomain(rank) } -> std::same_as<subdomain<Decomposition::dimension, typename Decomposition::scalar_type>>;
    { parts.neighbors(rank, cutoff) } -> std::same_as<std::vector<neighbor_rank<Decomposition::dimension>>>;
    parts.whole();
};

}  // namespace tsubu
