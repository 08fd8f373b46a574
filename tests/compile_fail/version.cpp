// SPDX-License-Identifier: MIT
#include <tsubu/version.hpp>

#if defined(CASE) && CASE == 1
#undef TSUBU_VERSION
#define TSUBU_VERSION 99  // as if another copy had been included
#endif

#include <tsubu/version.hpp>  // a second time the same one: no error

static_assert(TSUBU_VERSION > 0);
