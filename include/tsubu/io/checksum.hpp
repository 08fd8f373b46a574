// SPDX-License-Identifier: MIT
/// @file
/// crc64: have these bytes changed on their way?
#pragma once

#include <array>    // std::array
#include <cstddef>  // std::byte, std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::as_bytes, std::span

namespace tsubu {
namespace detail {

inline constexpr std::size_t crc64_stride = 16;  // bytes per step: the look-ups of one step do not wait for each other

/// table[k][b] is what byte b adds to the remainder, k bytes before the end of a step.
inline constexpr auto crc64_table = [] {
    constexpr std::uint64_t reflected_polynomial = 0xC96C5795D7870F42;  // ECMA-182, lowest bit first
    std::array<std::array<std::uint64_t, 256>, crc64_stride> table{};
    for (std::size_t b = 0; b < 256; ++b) {
        std::uint64_t remainder = b;
        for (int bit = 0; bit < 8; ++bit)
            remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? reflected_polynomial : 0);
        table[0][b] = remainder;
    }
    for (std::size_t k = 1; k < crc64_stride; ++k)
        for (std::size_t b = 0; b < 256; ++b) table[k][b] = (table[k - 1][b] >> 8) ^ table[0][table[k - 1][b] & 0xFF];
    return table;
}();

/// Eight bytes, the first one lowest, on every machine; compilers make one load of it.
[[nodiscard]] constexpr std::uint64_t crc64_word(const std::byte* at) noexcept {
    std::uint64_t word = 0;
    for (unsigned k = 0; k < 8; ++k) word |= std::to_integer<std::uint64_t>(at[k]) << (8 * k);
    return word;
}

}  // namespace detail

/// The checksum CRC-64/XZ of bytes that come one after the other.
///
///     tsubu::crc64 sum;
///     sum.add(std::as_bytes(std::span(words)));
///     if (sum.value() != expected) ...
///
/// Finds every change of one bit, and every change within 64 bits that follow one another; of other changes all but one
/// in 2^64. It is no protection from whoever changes bytes on purpose.
///
/// Complexity: O(n); about 2 bytes per nanosecond.
/// Source:     the CRC that .xz files carry: polynomial of ECMA-182, reflected, first and last inverted.
class crc64 {
public:
    constexpr void add(std::span<const std::byte> bytes) noexcept {
        const auto& table = detail::crc64_table;
        const auto* at = bytes.data();
        auto left = bytes.size();
        auto remainder = remainder_;
        for (; left >= detail::crc64_stride; left -= detail::crc64_stride, at += detail::crc64_stride) {
            const auto first = detail::crc64_word(at) ^ remainder;
            const auto second = detail::crc64_word(at + 8);
            remainder = 0;
            for (unsigned k = 0; k < 8; ++k)
                remainder ^= table[15 - k][(first >> (8 * k)) & 0xFF] ^ table[7 - k][(second >> (8 * k)) & 0xFF];
        }
        for (; left != 0; --left, ++at)
            remainder = (remainder >> 8) ^ table[0][(remainder ^ std::to_integer<std::uint64_t>(*at)) & 0xFF];
        remainder_ = remainder;
    }
    /// Of all bytes so far; of none 0.
    [[nodiscard]] constexpr std::uint64_t value() const noexcept { return ~remainder_; }

private:
    std::uint64_t remainder_ = ~std::uint64_t{0};
};

/// The checksum of some bytes, or of the bytes of some values.
[[nodiscard]] constexpr std::uint64_t crc64_of(std::span<const std::byte> bytes) noexcept {
    crc64 sum;
    sum.add(bytes);
    return sum.value();
}
/// The same of 64-bit words, byte by byte as they lie in memory.
[[nodiscard]] inline std::uint64_t crc64_of(std::span<const std::uint64_t> words) noexcept {
    return crc64_of(std::as_bytes(words));
}

}  // namespace tsubu
