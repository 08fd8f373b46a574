// SPDX-License-Identifier: MIT
/// @file
/// Refuses parameters that cannot be: the law, the name, the value, the remedy.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/domain/interval.hpp>

#include <string>  // std::string

namespace tsubu::dem::detail {

[[noreturn]] inline void refuse_parameter(const char* where, const char* what, double value, const char* unit,
                                          const char* remedy) {
    std::string text = std::string(what) + " = " + tsubu::detail::shown(value);
    if (*unit != '\0') text = text + " " + unit;
    tsubu::detail::raise<input_error>(where, text, remedy);
}
/// @param where  whose parameter it is: "dem::hooke_normal"
/// @param unit   "" if there is none
/// @throws input_error unless the value is finite and above 0.
inline void check_positive(const char* where, const char* what, double value, const char* unit,
                           const char* remedy = "give a finite number above 0") {
    if (!(value > 0) || !tsubu::detail::is_finite(value)) refuse_parameter(where, what, value, unit, remedy);
}
/// @throws input_error unless the value is finite and at least 0.
inline void check_not_negative(const char* where, const char* what, double value, const char* unit) {
    if (!(value >= 0) || !tsubu::detail::is_finite(value))
        refuse_parameter(where, what, value, unit, "give a finite number of at least 0");
}

}  // namespace tsubu::dem::detail
