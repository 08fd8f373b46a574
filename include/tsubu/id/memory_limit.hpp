// SPDX-License-Identifier: MIT
/// @file
/// How much memory an id map may take before it refuses.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/id/sizing.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <string>   // std::to_string

namespace tsubu {

/// Upper bound on the table of a storage policy. [bytes]
///
/// The default grows with the particles: 64 times what LIGGGHTS' chained scheme would hold for them (40 bytes per
/// particle), but never less than 16 MiB, below which no machine minds. So a dense table is refused when
/// T_max / N passes about 640, and one particle with id 2 000 000 000 does not silently take 8 GB.
///
///     tsubu::dense_storage<> table{tsubu::memory_limit{1u << 30}};   // at most 1 GiB
class memory_limit {
public:
    /// 64 x the bytes of the chained style: the bound that the specification sets as default (A5).
    static constexpr std::uint64_t chained_multiple = 64;
    /// Below this the default refuses nothing.
    static constexpr std::uint64_t floor_bytes = std::uint64_t{16} << 20;

    constexpr memory_limit() noexcept = default;
    constexpr explicit memory_limit(std::uint64_t bytes) noexcept : bytes_(bytes) {}

    /// The bound for a map of `count` ids. [bytes]
    [[nodiscard]] constexpr std::uint64_t bytes(std::size_t count) const noexcept {
        if (bytes_ != proportional) return bytes_;
        const std::uint64_t chained = chained_multiple * chained_bytes_per_id * count;
        return chained < floor_bytes ? floor_bytes : chained;
    }
    /// May a map of `count` ids hold this many bytes?
    [[nodiscard]] constexpr bool admits(std::uint64_t needed, std::size_t count) const noexcept {
        return needed <= bytes(count);
    }
    /// @throws limit_error that names the place, the id that forces the size, the bytes, and what to use instead.
    void check(const char* where, std::uint64_t needed, std::size_t count, std::uint64_t t,
               const char* instead) const {
        if (admits(needed, count)) return;
        detail::raise<limit_error>(where,
                                   "id " + std::to_string(t) + " among " + std::to_string(count) +
                                       " ids needs a table of " + std::to_string(needed) + " bytes, the limit is " +
                                       std::to_string(bytes(count)),
                                   instead);
    }

private:
    static constexpr std::uint64_t proportional = ~std::uint64_t{0};  // the default rule, no fixed number
    std::uint64_t bytes_ = proportional;
};

}  // namespace tsubu
