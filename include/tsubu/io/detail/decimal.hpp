// SPDX-License-Identifier: MIT
/// @file
/// read_number: std::from_chars, with a short way for the numbers that files are full of.
#pragma once

#include <algorithm>     // std::min
#include <array>         // std::array
#include <bit>           // std::bit_cast, std::countl_zero, std::countr_zero, std::endian
#include <charconv>      // std::from_chars
#include <concepts>      // std::floating_point, std::integral
#include <cstddef>       // std::ptrdiff_t, std::size_t
#include <cstdint>       // std::int64_t, std::uint64_t
#include <cstring>       // std::memcpy
#include <system_error>  // std::errc
#include <type_traits>   // std::is_same_v, std::make_unsigned_t

namespace tsubu::detail {

// A decimal number m / 10^k with m < 10^19 and k <= 27 is the quotient of two words, m and 5^k, times a power of two.
// With both shifted until their top bits are set, the quotient of 2^63 m by 5^k has 63 or 64 bits, ten more than a
// double keeps. A product with the reciprocal of 5^k, which is known, is that quotient, or one less. Rounding to double
// asks only on which side of a tie the number lies; two in 512 are too close to one to tell, and there a division
// says it, and whether there is a rest. So "2.5", "0.30000000000000004" and, as LAMMPS writes, "1.2500000000000000e-03"
// go the short way; what is longer, larger or much smaller goes the long one.

#if defined(__SIZEOF_INT128__)
inline constexpr bool has_wide_division = true;
__extension__ using wide_word = unsigned __int128;
#else
inline constexpr bool has_wide_division = false;
using wide_word = void;
#endif

inline constexpr std::size_t most_digits = 19;  // 10^19 < 2^64
inline constexpr std::size_t most_tenths = 27;  // 5^27 < 2^63
/// 5^k, shifted until the top bit is set; 2^127 over that; and how far it was shifted.
struct power_of_five {
    std::uint64_t shifted;
    std::uint64_t reciprocal;
    int shift;
};
inline constexpr auto powers_of_five = [] {
    std::array<power_of_five, most_tenths + 1> powers{};
    std::uint64_t power = 1;
    for (auto& one : powers) {
        one.shift = std::countl_zero(power);
        one.shifted = power << one.shift;
        // By long division, 2^63 (a one, and 63 zeros) by the divisor, and 64 more zeros.
        std::uint64_t rest = std::uint64_t{1} << 63;
        if (rest == one.shifted) {
            one.reciprocal = ~std::uint64_t{0};  // of 1: 2^64 - 1 in place of 2^64
        } else {
            for (int bit = 0; bit < 64; ++bit) {
                const bool carries = rest >> 63 != 0;
                rest <<= 1;
                const bool goes = carries || rest >= one.shifted;
                if (goes) rest -= one.shifted;
                one.reciprocal = 2 * one.reciprocal + (goes ? 1U : 0U);
            }
        }
        power *= 5;
    }
    return powers;
}();
inline constexpr std::uint64_t few = 1'000'000'000'000'000;  // fifteen digits: below 2^53
inline constexpr std::size_t most_exact = 22;                // 10^22 is a double
inline constexpr auto exact_powers_of_ten = [] {
    std::array<double, most_exact + 1> powers{1};
    for (std::size_t k = 1; k <= most_exact; ++k) powers[k] = 10 * powers[k - 1];
    return powers;
}();
/// 10^k for what eight characters hold.
inline constexpr std::array<std::uint64_t, 9> short_powers_of_ten{1,      10,      100,      1000,     10000,
                                                                  100000, 1000000, 10000000, 100000000};

/// m / 10^k, rounded to nearest. Precondition: k <= most_tenths, has_wide_division.
template <class Wide = wide_word>
[[nodiscard]] inline double quotient_by_ten(std::uint64_t m, std::size_t k) noexcept {
    // Texts of people have fewer digits, those of programs more: either way the branch can be foreseen.
    if (m < few && k <= most_exact) return static_cast<double>(m) / exact_powers_of_ten[k];
    if (m == 0) return 0.0;
    const auto& five = powers_of_five[k];
    const auto shift = std::countl_zero(m);
    const auto shifted = m << shift;
    auto quotient = static_cast<std::uint64_t>((static_cast<Wide>(shifted) * five.reciprocal) >> 64);
    std::uint64_t rest = 1;
    if (((quotient + 1) & 0x1FF) <= 1) [[unlikely]] {  // a tie ends in a one and nine or ten zeros
        const auto dividend = static_cast<Wide>(shifted) << 63;
        quotient = static_cast<std::uint64_t>(dividend / five.shifted);
        rest = static_cast<std::uint64_t>(dividend) != quotient * five.shifted ? 1 : 0;
    }
    // A bit less, so that the conversion is one of signed words; what goes, and the rest, stay as the lowest bit.
    const auto rounded = static_cast<double>(static_cast<std::int64_t>((quotient >> 1) | (quotient & 1) | rest));
    const auto exponent = five.shift - shift - 62 - static_cast<int>(k);
    return rounded * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

[[nodiscard]] constexpr bool is_digit(char c) noexcept { return static_cast<unsigned char>(c - '0') < 10; }

/// How many of these eight characters are digits, until the first that is none.
[[nodiscard]] inline std::size_t leading_digits(std::uint64_t eight) noexcept {
    const auto above_nine = eight + 0x4646464646464646U;  // a carry into the top bit of each byte past '9'
    const auto below_zero = eight - 0x3030303030303030U;  // a carry spoils bytes behind the first that is none only
    return static_cast<std::size_t>(std::countr_zero((above_nine | below_zero) & 0x8080808080808080U)) / 8;
}
/// The number that the first `count` of these eight characters write. Precondition: 0 < count <= 8, all are digits.
[[nodiscard]] inline std::uint64_t value_of_digits(std::uint64_t eight, std::size_t count) noexcept {
    // The first digit is the lowest byte. Zeros come before it; then pairs, fours, all eight: each step adds ten, a
    // hundred, ten thousand times the one to its left.
    auto word = (eight - 0x3030303030303030U) << (64 - 8 * count);
    word = word * 10 + (word >> 8);
    constexpr std::uint64_t pairs = 0x000000ff000000ffU;
    return (((word & pairs) * (100 + (std::uint64_t{1000000} << 32))) +
            (((word >> 16) & pairs) * (1 + (std::uint64_t{10000} << 32)))) >>
           32;
}
/// Goes on with m by the digits from `at` on, up to `last`. @return the first that is none.
/// @param readable  up to which characters may be looked at, at least `last`: eight at once, one by one near the end
[[nodiscard]] inline const char* read_digits(const char* at, const char* last, const char* readable,
                                             std::uint64_t& m) noexcept {
    while (std::endian::native == std::endian::little && readable - at >= 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, at, 8);
        const auto count = (std::min)(leading_digits(eight), static_cast<std::size_t>(last - at));
        if (count == 0) return at;
        m = short_powers_of_ten[count] * m + value_of_digits(eight, count);
        at += count;
        if (count < 8) return at;
    }
    while (at != last && is_digit(*at)) m = 10 * m + static_cast<std::uint64_t>(*at++ - '0');
    return at;
}

/// Takes an exponent of at most three digits off the tenths. @return where it ends; `at`, an e, if it is none of these.
[[nodiscard]] inline const char* read_exponent(const char* at, const char* end, std::ptrdiff_t& tenths) noexcept {
    const char* first = at + 1;
    const bool is_negative = first != end && *first == '-';
    if (is_negative || (first != end && *first == '+')) ++first;
    std::ptrdiff_t exponent = 0;
    const char* last = first;
    while (last != end && last - first < 3 && is_digit(*last)) exponent = 10 * exponent + (*last++ - '0');
    if (last == first) return at;
    tenths += is_negative ? exponent : -exponent;
    return last;
}

/// Of a number that a type cannot hold: because it is too small?
[[nodiscard, gnu::cold]] inline bool is_tiny(const char* from, const char* end) noexcept {
    long long before_point = 0;  // digits from the first one that is not 0, or less than 0: zeros after the point
    bool has_point = false;
    bool has_begun = false;
    for (; from != end && *from != 'e' && *from != 'E'; ++from) {
        has_point = has_point || *from == '.';
        if (!is_digit(*from)) continue;
        has_begun = has_begun || *from != '0';
        if (has_begun && !has_point) ++before_point;
        if (!has_begun && has_point) --before_point;
    }
    if (from == end) return before_point <= 0;
    ++from;
    const bool is_below = *from == '-';
    long long exponent = 0;
    constexpr long long enough = 1000000000;  // more than any text of that length can balance
    for (; from != end; ++from)
        if (is_digit(*from) && exponent < enough) exponent = 10 * exponent + (*from - '0');
    return before_point + (is_below ? -exponent : exponent) <= 0;
}

/// As std::from_chars(from, end, value), to the bit; but numbers too small for the type are 0, with their sign.
/// @param readable  up to which characters may be looked at, at least `end`
template <class Number>
[[nodiscard]] std::from_chars_result read_number(const char* from, const char* end, const char* readable,
                                                 Number& value) noexcept {
    const char* at = from;
    const bool is_negative = at != end && *at == '-';
    at += is_negative ? 1 : 0;
    const char* const digits = at;
    std::uint64_t m = 0;
    const char* const last = end - digits > static_cast<std::ptrdiff_t>(most_digits) ? digits + most_digits : end;
    at = read_digits(at, last, readable, m);
    if constexpr (std::integral<Number>) {
        constexpr auto longest = static_cast<std::ptrdiff_t>(sizeof(Number) == 8 ? 18 : 9);  // these cannot overflow
        if (at != digits && at - digits <= longest && (at == end || !is_digit(*at)) && sizeof(Number) >= 4) {
            value = static_cast<Number>(is_negative ? -static_cast<std::int64_t>(m) : static_cast<std::int64_t>(m));
            return {at, std::errc{}};
        }
    } else if constexpr (std::is_same_v<Number, double> && has_wide_division) {
        const char* const point = at;
        std::ptrdiff_t tenths = 0;
        if (at != digits && at != end && *at == '.') {
            ++at;
            const char* const rest = end - at > last - point ? at + (digits + most_digits - point) : end;
            at = read_digits(at, rest, readable, m);
            tenths = at - point - 1;
        }
        if (at != digits && at != end && (*at == 'e' || *at == 'E')) at = read_exponent(at, end, tenths);
        if (at != digits && (at == end || (!is_digit(*at) && *at != '.' && *at != 'e' && *at != 'E')) && tenths >= 0 &&
            tenths <= static_cast<std::ptrdiff_t>(most_tenths)) {
            const auto magnitude = quotient_by_ten(m, static_cast<std::size_t>(tenths));
            value = is_negative ? -magnitude : magnitude;
            return {at, std::errc{}};
        }
    }
    const auto result = std::from_chars(from, end, value);
    if constexpr (std::floating_point<Number>)
        if (result.ec == std::errc::result_out_of_range && is_tiny(from, result.ptr)) {
            value = is_negative ? -Number{0} : Number{0};  // as near as the type has it
            return {result.ptr, std::errc{}};
        }
    return result;
}

}  // namespace tsubu::detail
