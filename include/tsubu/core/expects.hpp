// SPDX-License-Identifier: MIT
/// @file
/// Preconditions of hot paths: checked in debug builds, free under NDEBUG.
#pragma once

#include <tsubu/version.hpp>

#include <cstdio>   // std::fprintf
#include <cstdlib>  // std::abort

namespace tsubu::detail {

[[noreturn, gnu::cold, gnu::noinline]] inline void precondition_violated(const char* condition, const char* message,
                                                                         const char* file, int line) noexcept {
    std::fprintf(stderr, "%s:%d: tsubu: precondition violated: %s (%s)\n", file, line, message, condition);
    std::abort();
}

}  // namespace tsubu::detail

/// TSUBU_EXPECTS(condition, "what is wrong; what to do instead"): an expression, so that it can stand in a
/// constructor's initialiser; the plain condition, so that && short-circuits.
#if defined(NDEBUG)
#define TSUBU_EXPECTS(condition, message) static_cast<void>(0)
#else
#define TSUBU_EXPECTS(condition, message) \
    ((condition) ? static_cast<void>(0)   \
                 : ::tsubu::detail::precondition_violated(#condition, message, __FILE__, __LINE__))
#endif
