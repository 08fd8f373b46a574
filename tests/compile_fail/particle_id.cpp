// SPDX-License-Identifier: MIT
#include <tsubu/id/id_range.hpp>

#include <cstdint>

#if !defined(CASE)
using id_type = std::int64_t;
#elif CASE == 1
using id_type = bool;
#elif CASE == 2
using id_type = float;
#elif CASE == 3
using id_type = std::int16_t;
#elif CASE == 4
using id_type = wchar_t;
#endif

static_assert(tsubu::id_range<id_type>{}.empty());
