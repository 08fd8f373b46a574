// SPDX-License-Identifier: MIT
/// @file
/// What tsubu throws: every message says where, what with the values, and the remedy.
#pragma once

#include <tsubu/version.hpp>

#include <stdexcept>  // std::runtime_error
#include <string>     // std::string

namespace tsubu {

/// Base of every exception that tsubu throws itself. (std::bad_alloc passes through unchanged.)
class error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The input breaks the contract: a negative id, spans of different length, an index that does not fit.
class input_error : public error {
public:
    using error::error;
};

/// The input is legal, but more than a stated limit admits: memory, number of particles, size of a type.
class limit_error : public error {
public:
    using error::error;
};

namespace detail {

// Cold and out of line, so that the functions that call them stay small enough to inline.
template <class Error>
[[noreturn, gnu::cold, gnu::noinline]] void raise(const char* where, const std::string& what, const char* remedy) {
    throw Error("tsubu::" + std::string(where) + ": " + what + "; " + remedy);
}

}  // namespace detail
}  // namespace tsubu
