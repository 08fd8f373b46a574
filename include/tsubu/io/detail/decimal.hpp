// SPDX-License-Identifier: MIT
/// @file
/// read_number: std::from_chars, with a short way for the numbers that files are full of.
#pragma once

#include <array>         // std::array
#include <bit>           // std::bit_cast, std::countl_zero, std::endian
#include <charconv>      // std::from_chars
#include <concepts>      // std::floating_point, std::integral
#include <cstddef>       // std::ptrdiff_t, std::size_t
#include <cstdint>       // std::int64_t, std::uint64_t
#include <cstring>       // std::memcpy
#include <system_error>  // std::errc
#include <type_traits>   // std::is_same_v, std::make_unsigned_t

namespace tsubu::detail {

// A decimal number m / 10^k with m < 10^19 and k <= 19 is one division of 128 by 64 bits away from its double: with m and
// 10^k shifted until their top bits are set, the quotient of 2^63 m by 10^k has 63 or 64 bits, ten more than a double keeps.
// Its last bit is set if there is a remainder, so that the conversion to double, which rounds to nearest, sees on which side
// of a tie the number lies. Whatever is longer, or has an exponent, goes the long way.

#if defined(__SIZEOF_INT128__)
inline constexpr bool has_wide_division = true;
__extension__ using wide_word = unsigned __int128;
#else
inline constexpr bool has_wide_division = false;
#endif

inline constexpr std::size_t most_digits = 19;  // 10^19 < 2^64
inline constexpr auto powers_of_ten = [] {
    std::array<std::uint64_t, most_digits + 1> powers{1};
    for (std::size_t k = 1; k <= most_digits; ++k) powers[k] = 10 * powers[k - 1];
    return powers;
}();

/// m / 10^k, rounded to nearest. Precondition: k <= 19, has_wide_division.
[[nodiscard]] inline double quotient_by_ten(std::uint64_t m, std::size_t k) noexcept {
#if defined(__SIZEOF_INT128__)
    constexpr std::uint64_t exact = std::uint64_t{1} << 53;
    if (m == 0) return 0.0;
    if (m <= exact) return static_cast<double>(m) / static_cast<double>(powers_of_ten[k]);  // both exact: 10^22 is
    const auto shift_m = std::countl_zero(m);
    const auto shift_d = std::countl_zero(powers_of_ten[k]);
    const auto divisor = powers_of_ten[k] << shift_d;
    const auto dividend = static_cast<wide_word>(m << shift_m) << 63;
    const auto quotient = static_cast<std::uint64_t>(dividend / divisor);
    const bool has_rest = static_cast<std::uint64_t>(dividend) != quotient * divisor;
    const auto exponent = shift_d - shift_m - 63;
    const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
    return static_cast<double>(quotient | (has_rest ? 1U : 0U)) * scale;
#else
    return static_cast<double>(m) / static_cast<double>(k);  // never called
#endif
}

[[nodiscard]] constexpr bool is_digit(char c) noexcept { return static_cast<unsigned char>(c - '0') < 10; }

/// Whether these eight characters are digits, and the number they write if so.
[[nodiscard]] inline bool read_eight(const char* at, std::uint64_t& value) noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, at, 8);
    if constexpr (std::endian::native != std::endian::little) return false;
    const auto above_nine = word + 0x4646464646464646U;  // a carry into the top bit of each byte past '9'
    const auto below_zero = word - 0x3030303030303030U;
    if (((above_nine | below_zero) & 0x8080808080808080U) != 0) return false;
    // Pairs, then fours, then all eight: each step adds ten, a hundred, ten thousand times the one to its left.
    word = below_zero * 10 + (below_zero >> 8);
    constexpr std::uint64_t pairs = 0x000000ff000000ffU;
    value = (((word & pairs) * (100 + (std::uint64_t{1000000} << 32))) +
             (((word >> 16) & pairs) * (1 + (std::uint64_t{10000} << 32)))) >>
            32;
    return true;
}
/// Goes on with m by the digits from `at` on, up to `last`. @return the first that is none.
[[nodiscard]] inline const char* read_digits(const char* at, const char* last, std::uint64_t& m) noexcept {
    for (std::uint64_t eight = 0; last - at >= 8 && read_eight(at, eight); at += 8) m = 100000000 * m + eight;
    while (at != last && is_digit(*at)) m = 10 * m + static_cast<std::uint64_t>(*at++ - '0');
    return at;
}

/// As std::from_chars(from, end, value), to the bit.
template <class Number>
[[nodiscard]] std::from_chars_result read_number(const char* from, const char* end, Number& value) noexcept {
    const char* at = from;
    const bool is_negative = at != end && *at == '-';
    at += is_negative ? 1 : 0;
    const char* const digits = at;
    std::uint64_t m = 0;
    const char* const last = end - digits > static_cast<std::ptrdiff_t>(most_digits) ? digits + most_digits : end;
    while (at != last && is_digit(*at)) m = 10 * m + static_cast<std::uint64_t>(*at++ - '0');
    if constexpr (std::integral<Number>) {
        constexpr auto longest = static_cast<std::ptrdiff_t>(sizeof(Number) == 8 ? 18 : 9);  // these cannot overflow
        if (at != digits && at - digits <= longest && (at == end || !is_digit(*at)) && sizeof(Number) >= 4) {
            value = static_cast<Number>(is_negative ? -static_cast<std::int64_t>(m) : static_cast<std::int64_t>(m));
            return {at, std::errc{}};
        }
    } else if constexpr (std::is_same_v<Number, double> && has_wide_division) {
        const char* const point = at;
        std::size_t fraction = 0;
        if (at != digits && at != end && *at == '.') {
            ++at;
            const char* const rest = end - at > last - point ? at + (digits + most_digits - point) : end;
            at = read_digits(at, rest, m);
            fraction = static_cast<std::size_t>(at - point) - 1;
        }
        if (at != digits && (at == end || (!is_digit(*at) && *at != '.' && *at != 'e' && *at != 'E'))) {
            const auto magnitude = quotient_by_ten(m, fraction);
            value = is_negative ? -magnitude : magnitude;
            return {at, std::errc{}};
        }
    }
    return std::from_chars(from, end, value);
}

}  // namespace tsubu::detail
