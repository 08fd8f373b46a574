// SPDX-License-Identifier: MIT
/// @file
/// h5md_unit: the unit of a field as H5MD writes it.
#pragma once

#include <cstddef>      // std::size_t
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <vector>       // std::vector

namespace tsubu::detail {

/// "m/s^2" as "m s-2": factors with their powers, separated by blanks. What is no product of powers, or could be read
/// in two ways ("J/kg K"), stays as it is.
/// Source: H5MD, module units 1.0.
[[nodiscard]] inline std::string h5md_unit(std::string_view unit) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    struct factor {
        std::string_view symbol;
        int power;
    };
    std::vector<factor> factors;
    bool divided = false;
    std::size_t at = 0;
    const auto as_it_is = [&] { return std::string(unit); };
    while (at < unit.size()) {
        bool divides = false;
        if (!factors.empty() || unit[at] == '/') {
            const char between = unit[at++];
            divides = between == '/';
            if (!divides && (between != ' ' && between != '*')) return as_it_is();
            if (!divides && divided) return as_it_is();
            divided = divided || divides;
        }
        const auto begin = at;
        if (unit.substr(at).starts_with("1/")) {  // 1/s
            if (at != 0) return as_it_is();
            at = 1;
            factors.push_back({"", 0});
            continue;
        }
        while (at < unit.size() && is_letter(unit[at])) ++at;
        if (at == begin) return as_it_is();
        const auto symbol = unit.substr(begin, at - begin);
        if (at < unit.size() && unit[at] == '^') ++at;
        int sign = divides ? -1 : 1;
        if (at < unit.size() && (unit[at] == '+' || unit[at] == '-')) sign *= unit[at++] == '-' ? -1 : 1;
        const auto digits = at;
        int power = 0;
        while (at < unit.size() && is_digit(unit[at]) && at - digits < 3) power = 10 * power + (unit[at++] - '0');
        if (at == digits) {
            const char before = unit[at - 1];
            if (before == '^' || before == '+' || before == '-') return as_it_is();
            power = 1;
        }
        if (power == 0) return as_it_is();
        for (const auto& other : factors)
            if (other.symbol == symbol) return as_it_is();
        factors.push_back({symbol, sign * power});
    }
    std::string text;
    for (const auto& [symbol, power] : factors) {
        if (power == 0) continue;
        if (!text.empty()) text += ' ';
        text += symbol;
        if (power == 1) continue;
        if (power > 0) text += '+';
        text += std::to_string(power);
    }
    return text;
}

}  // namespace tsubu::detail
