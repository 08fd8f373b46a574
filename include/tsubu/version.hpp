// SPDX-License-Identifier: MIT
/// @file
/// Which tsubu is this? The one place where the version is written; CMake reads it from here.
/// Deliberately without an include guard: a second, different copy in one translation unit is an error.
///
/// Versions are semantic. From 1.0 on, what compiles with a version compiles with every later one of the same major
/// version, and means the same; before that, with every later one of the same minor version.

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "tsubu needs C++20: compile with -std=c++20 or link the CMake target tsubu::tsubu"
#endif

#if !defined(TSUBU_VERSION)
/// To compare with: `#if TSUBU_VERSION >= 200`, from 0.2.0 on.
#define TSUBU_VERSION 100  // major * 10000 + minor * 100 + patch: 0.1.0
#elif TSUBU_VERSION != 100
#error "two different versions of tsubu meet in one translation unit; check the include paths"
#endif
