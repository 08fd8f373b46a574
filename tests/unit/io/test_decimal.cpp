// SPDX-License-Identifier: MIT
#include <tsubu/io/detail/decimal.hpp>

#include "support/catch.hpp"

#include <tsubu/core/random.hpp>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <type_traits>

namespace {

/// Whether read_number says and writes what std::from_chars does, to the bit; of what is too small for the type, 0.
template <class Number>
bool reads_as_standard(const std::string& text) {
    Number theirs{7};
    auto b = std::from_chars(text.data(), text.data() + text.size(), theirs);
    if constexpr (std::is_floating_point_v<Number>)
        if (b.ec == std::errc::result_out_of_range && std::abs(std::strtold(text.c_str(), nullptr)) < 1) {
            theirs = text[0] == '-' ? -Number{0} : Number{0};
            b.ec = std::errc{};
        }
    // Whatever follows the end of the text must not matter.
    bool same = true;
    for (const std::string behind : {"", "1", "12345678", " 1234567", ".5e7 1e-1"}) {
        Number ours{7};
        const auto all = text + behind;
        const auto a = tsubu::detail::read_number(all.data(), all.data() + text.size(), all.data() + all.size(), ours);
        same = same && a.ptr - all.data() == b.ptr - text.data() && a.ec == b.ec &&
               std::memcmp(&ours, &theirs, sizeof(Number)) == 0;
    }
    return same;
}
bool all_as_standard(const std::string& text) {
    return reads_as_standard<double>(text) && reads_as_standard<float>(text) && reads_as_standard<std::int64_t>(text) &&
           reads_as_standard<std::int32_t>(text);
}

}  // namespace

TEST_CASE("numbers of every form are read as the standard library reads them", "[io][decimal]") {
    for (const char* text :
         {"", "-", ".", "-.", ".5", "-.5", "1.", "1.e5", "1e5", "1e", "1e+", "1e-", "1e-x", "1e-0003", "1.25e-27",
          "1.25e-25", "25e-28", "9007199254740992e-22", "9007199254740992e-23", "1..2", "1.2.3", "--1", "+1", "0",
          "-0", "-0.0", "9007199254740993", "9007199254740993.0", "9223372036854775807", "-9223372036854775808",
          "9223372036854775808", "99999999999999999999", "2147483647", "2147483648", "-2147483648", "-2147483649",
          "0.00000000000000000001", "1234567890.123456789", "12345678901.123456789", "1234567890123456789.",
          "123456789012345678.9", "1.5x", "1x", "inf", "-inf", "nan", "-nan", "0x10", "1e400", "-1e400", "1e-400",
          "5e-324", "4.9e-324", "2.4e-324", "4.35", "1.7976931348623157e308", "1.7976931348623159e308",
          "0.30000000000000004", "12345678/", "1234567:", "8.5", "8 "}) {
        CAPTURE(text);
        CHECK(all_as_standard(text));
    }
}

TEST_CASE("numbers of every length are read as the standard library reads them", "[io][decimal]") {
    tsubu::random_stream random(7);
    std::size_t wrong = 0;
    const auto check = [&](const std::string& text) {
        if (all_as_standard(text)) return;
        if (++wrong == 1) UNSCOPED_INFO(text);
    };
    for (int k = 0; k < 20000; ++k) {
        std::string text = random.below(2) == 0 ? "" : "-";
        const auto digits = 1 + random.below(21);
        const auto point = random.below(24);
        for (std::uint64_t d = 0; d < digits; ++d) {
            if (d == point) text += '.';
            text += static_cast<char>('0' + random.below(10));
        }
        if (random.below(3) == 0) {
            text += random.below(2) == 0 ? 'e' : 'E';
            text += random.below(4) == 0 ? "" : random.below(3) == 0 ? "+" : "-";
            text += std::to_string(random.below(random.below(4) == 0 ? 1500 : 32));
        }
        check(text);
        text += random.below(2) == 0 ? '.' : 'e';
        check(text);
        char shown[64];
        static_cast<void>(std::snprintf(shown, sizeof(shown), "%.17g", 100 * (random.unit() - 0.5)));
        check(shown);
        static_cast<void>(std::snprintf(shown, sizeof(shown), "%.16e", std::pow(10, 40 * random.unit() - 30)));
        check(shown);
        // Halfway between two doubles, where rounding is decided by the last bit.
        const auto odd = (std::uint64_t{1} << 53) + 2 * random.below(std::uint64_t{1} << 52) + 1;
        check(std::to_string(odd));
        check(std::to_string(odd) + ".0");
        check(std::to_string(odd / 2) + ".5");
        check(std::to_string(odd) + "00e-2");
        check(std::to_string(odd) + "00000001e-8");
        check(std::to_string(odd - 1) + "99999999e-8");
    }
    CHECK(wrong == 0);
}

TEST_CASE("numbers too small for the type are zeros with their sign", "[io][decimal]") {
    const auto read = [](const std::string& text, auto number) {
        const std::string readable = text + std::string(16, ' ');
        const auto* const begin = readable.data();
        const auto [end, code] =
            tsubu::detail::read_number(begin, begin + text.size(), begin + readable.size(), number);
        CHECK(end == begin + text.size());
        CHECK(code == std::errc{});
        return number;
    };
    for (const auto* const text : {"1e-50", "0.00000000000000000000000000000000000000000000000000000001", "12345e-90"}) {
        CHECK(read(text, 1.0F) == 0);
        CHECK(std::signbit(read(std::string("-").append(text), 1.0F)));
    }
    CHECK(read("1e-400", 1.0) == 0);
    CHECK(read("0.0001e-99999999999999999999", 1.0) == 0);
    double beyond = 1;
    for (const std::string text : {"1e400", "100000e400", "0.001e500"})
        CHECK(tsubu::detail::read_number(text.data(), text.data() + text.size(), text.data() + text.size(), beyond).ec ==
              std::errc::result_out_of_range);
}
