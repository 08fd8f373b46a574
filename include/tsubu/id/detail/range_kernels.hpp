// SPDX-License-Identifier: MIT
/// @file
/// Lowest and highest of many ids at the speed of memory: one loop, compiled for each instruction set.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/id_range.hpp>

#include <cstddef>  // std::size_t
#include <cstring>  // std::memcpy
#include <span>     // std::span

namespace tsubu::detail {

#if defined(__x86_64__) && defined(__GNUC__)

// One body, inlined into a function for each instruction set, so that it is compiled with those instructions. Vectors
// of the compiler's own, so that minimum and maximum are plain expressions; two of each, so that none waits.
template <class Vector, particle_id Id>
[[gnu::always_inline]] inline id_range<Id> range_by(const Id* ids, std::size_t count) noexcept {
    constexpr std::size_t lanes = sizeof(Vector) / sizeof(Id);
    Vector low0 = ids[0] - Vector{};
    Vector low1 = low0;
    Vector high0 = low0;
    Vector high1 = low0;
    std::size_t i = 0;
    for (; i + 2 * lanes <= count; i += 2 * lanes) {
        Vector v0;
        Vector v1;
        std::memcpy(&v0, ids + i, sizeof(v0));
        std::memcpy(&v1, ids + i + lanes, sizeof(v1));
        low0 = v0 < low0 ? v0 : low0;
        high0 = v0 > high0 ? v0 : high0;
        low1 = v1 < low1 ? v1 : low1;
        high1 = v1 > high1 ? v1 : high1;
    }
    low0 = low1 < low0 ? low1 : low0;
    high0 = high1 > high0 ? high1 : high0;
    auto range = range_of(std::span<const Id>(ids + i, count - i));
    for (std::size_t k = 0; k < lanes; ++k) range = range.with(low0[k]).with(high0[k]);
    return range;
}

template <particle_id Id>
[[gnu::target("avx512f,avx512vl,avx512dq")]] id_range<Id> range_avx512(const Id* ids, std::size_t count) noexcept {
    using vector [[gnu::vector_size(64)]] = Id;
    return range_by<vector>(ids, count);
}

template <particle_id Id>
[[gnu::target("avx2")]] id_range<Id> range_avx2(const Id* ids, std::size_t count) noexcept {
    using vector [[gnu::vector_size(32)]] = Id;
    return range_by<vector>(ids, count);
}

#endif

/// range_of(ids), with the widest vectors of this machine.
template <particle_id Id>
[[nodiscard]] id_range<Id> vector_range_of(std::span<const Id> ids) noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    if (!ids.empty()) switch (best_instruction_set()) {
            case instruction_set::avx512: return range_avx512(ids.data(), ids.size());
            case instruction_set::avx2: return range_avx2(ids.data(), ids.size());
            case instruction_set::portable: break;
        }
#endif
    return range_of(ids);
}

}  // namespace tsubu::detail
