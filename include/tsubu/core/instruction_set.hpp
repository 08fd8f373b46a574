// SPDX-License-Identifier: MIT
/// @file
/// Which vector instructions may the kernels use on this machine? Asked at run time: programs are built with plain -O2.
#pragma once

#include <tsubu/version.hpp>

#include <atomic>            // std::atomic
#include <cstdlib>           // std::getenv
#include <cstring>           // std::strcmp
#include <initializer_list>  // for (x : {a, b})

namespace tsubu {

/// What a kernel may be written in; each includes those before it.
enum class instruction_set : int {
    portable,  ///< what the compiler was told to build for
    avx2,      ///< AVX2, BMI1, BMI2, POPCNT
    avx512,    ///< AVX-512 F, BW, VL, DQ, CD
};

/// As TSUBU_INSTRUCTION_SET spells it.
[[nodiscard]] constexpr const char* name_of(instruction_set set) noexcept {
    switch (set) {
        case instruction_set::avx512: return "avx512";
        case instruction_set::avx2: return "avx2";
        case instruction_set::portable: break;
    }
    return "portable";
}

/// What this processor and this system can run, whatever was asked for. A few dozen instructions: not cached.
[[nodiscard]] inline instruction_set supported_instruction_set() noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    __builtin_cpu_init();  // we may be called before main
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("popcnt") || !__builtin_cpu_supports("bmi") ||
        !__builtin_cpu_supports("bmi2"))
        return instruction_set::portable;
    if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512bw") ||
        !__builtin_cpu_supports("avx512vl") || !__builtin_cpu_supports("avx512dq") ||
        !__builtin_cpu_supports("avx512cd"))
        return instruction_set::avx2;
    return instruction_set::avx512;
#else
    return instruction_set::portable;
#endif
}

namespace detail {

inline constexpr int instruction_set_unknown = -1;
inline std::atomic<int> instruction_set_in_use{instruction_set_unknown};

[[nodiscard, gnu::cold, gnu::noinline]] inline instruction_set detect_instruction_set() noexcept {
    auto best = supported_instruction_set();
    if (const char* const wanted = std::getenv("TSUBU_INSTRUCTION_SET"))
        for (const auto lower : {instruction_set::portable, instruction_set::avx2})
            if (lower < best && std::strcmp(wanted, name_of(lower)) == 0) best = lower;
    // Two threads that come here at once find the same; one of them may also have been overtaken by
    // use_instruction_set, whose choice stays.
    int expected = instruction_set_unknown;
    return instruction_set_in_use.compare_exchange_strong(expected, static_cast<int>(best), std::memory_order_relaxed)
               ? best
               : static_cast<instruction_set>(expected);
}

}  // namespace detail

/// The set that the kernels use: the best that the machine supports, or less if the environment variable
/// TSUBU_INSTRUCTION_SET (portable | avx2 | avx512) or use_instruction_set says so. One load after the first call.
[[nodiscard]] inline instruction_set best_instruction_set() noexcept {
    const int known = detail::instruction_set_in_use.load(std::memory_order_relaxed);
    return known == detail::instruction_set_unknown ? detail::detect_instruction_set()
                                                    : static_cast<instruction_set>(known);
}

/// Makes the kernels use `wanted` from now on, or the best that the machine supports if that is less. Answers do not
/// depend on it: for tests and measurements. find() of one id in a flat_storage follows at its next rebuild or growth.
/// @return the set that is in use now.
inline instruction_set use_instruction_set(instruction_set wanted) noexcept {
    const auto supported = supported_instruction_set();
    const auto chosen = wanted < supported ? wanted : supported;
    detail::instruction_set_in_use.store(static_cast<int>(chosen), std::memory_order_relaxed);
    return chosen;
}

}  // namespace tsubu
