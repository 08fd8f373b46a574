// SPDX-License-Identifier: MIT
/// @file
/// What does the message of an exception say?
#pragma once

#include <string>

/// The text of the Error that the call throws; says so if it throws nothing. Other exceptions pass through.
template <class Error, class Call>
std::string thrown(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

inline bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }
