// SPDX-License-Identifier: MIT
/// @file
/// number_of: the mask of a vector comparison as a number.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#include <cstdint>  // std::uint32_t

#include <immintrin.h>  // __mmask16

namespace tsubu::detail {

/// A mask in a general register. GCC 12 may spill a mask as 8 or 16 bits and read it back as 32, whose upper part is then
/// whatever lay there before (seen with -O1 -fsanitize=undefined); an instruction of our own leaves it no choice.
[[gnu::target("avx512f"), gnu::always_inline]] inline std::uint32_t number_of(__mmask16 mask) noexcept {
    std::uint32_t number;
    asm("kmovw %1, %0" : "=r"(number) : "k"(mask));
    return number;
}

}  // namespace tsubu::detail
#endif
