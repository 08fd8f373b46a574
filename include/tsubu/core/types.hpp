// SPDX-License-Identifier: MIT
/// @file
/// The words every room uses: id, index, absent.
///
/// id     global and stable name of a particle, given once for the whole simulation; t as a parameter
/// index  local and dense place of a particle on this rank: owned 0..n-1, then ghosts n..N-1
/// rank   one process (or one participant of a transport)
/// owned  the one copy of a particle that its rank integrates
/// ghost  a copy of a particle that another rank owns, or that a periodic face repeats
/// image  any copy with the same id, owned or ghost
#pragma once

#include <tsubu/version.hpp>

#include <concepts>     // std::integral, std::same_as, std::signed_integral
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::uint32_t
#include <limits>       // std::numeric_limits
#include <type_traits>  // std::make_unsigned_t

namespace tsubu {

/// Local index of a particle. 32 bits: a rank holds fewer than 2^31 particles, and half the memory of every map
/// is indices.
using index_t = std::int32_t;

/// One of the processes, or threads, that share a simulation: 0, 1, ... as in MPI.
using rank_t = std::uint32_t;

/// The index of nothing: what a look-up answers for an id that is not on this rank.
inline constexpr index_t absent = -1;

/// Largest number of particles, owned and ghost, on one rank: every index, and index + 1, fits index_t.
inline constexpr std::size_t max_index_count = static_cast<std::size_t>((std::numeric_limits<index_t>::max)());

/// A type that may hold global ids: an integer of 32 or 64 bits, signed or unsigned, but no character.
/// Negative values are legal as questions (the answer is `absent`), never as ids of particles.
template <class Id>
concept particle_id = std::integral<Id> && (sizeof(Id) == 4 || sizeof(Id) == 8) && !std::same_as<Id, wchar_t> &&
                      !std::same_as<Id, char32_t>;

namespace detail {

template <particle_id Id>
using unsigned_id = std::make_unsigned_t<Id>;

template <particle_id Id>
[[nodiscard]] constexpr bool is_negative(Id t) noexcept {
    if constexpr (std::signed_integral<Id>)
        return t < 0;
    else
        return false;
}

}  // namespace detail
}  // namespace tsubu
