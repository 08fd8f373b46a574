// SPDX-License-Identifier: MIT
/// @file
/// Catch2, version 3 or 2: what the tests include instead of either.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
