// SPDX-License-Identifier: MIT
/// @file
/// On what machine, with what compiler, flags and commit was this measured? report.py refuses figures without it.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/version.hpp>

#include <ctime>    // std::strftime
#include <fstream>  // std::ifstream
#include <string>   // std::string
#include <thread>   // std::thread::hardware_concurrency
#include <utility>  // std::pair
#include <vector>   // std::vector

#if __has_include("bench_commit.hpp")
#include "bench_commit.hpp"  // TSUBU_BENCH_COMMIT: written by the build, so that it cannot be stale
#endif
#ifndef TSUBU_BENCH_COMMIT
#define TSUBU_BENCH_COMMIT "unknown"
#endif
#ifndef TSUBU_BENCH_FLAGS
#define TSUBU_BENCH_FLAGS "unknown"
#endif

namespace bench {

/// The value of the first line of a file that begins with `key`, after the colon; the first line if there is no key.
[[nodiscard]] inline std::string line_of(const char* path, const std::string& key = "") {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (line.compare(0, key.size(), key) != 0) continue;
        const auto colon = key.empty() ? std::string::npos : line.find(": ");
        return colon == std::string::npos ? line : line.substr(colon + 2);
    }
    return "unknown";
}

[[nodiscard]] inline std::string compiler_name() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown";
#endif
}

[[nodiscard]] inline std::string time_now() {
    const std::time_t now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    return text;
}

[[nodiscard]] inline std::vector<std::pair<std::string, std::string>> run_context() {
    return {
        {"date", time_now()},
        {"machine", line_of("/proc/cpuinfo", "model name")},
        {"cores", std::to_string(std::thread::hardware_concurrency())},
        {"l2_cache", line_of("/sys/devices/system/cpu/cpu0/cache/index2/size")},
        {"l3_cache", line_of("/sys/devices/system/cpu/cpu0/cache/index3/size")},
        {"huge_pages", line_of("/sys/kernel/mm/transparent_hugepage/enabled")},
        {"compiler", compiler_name()},
        {"flags", TSUBU_BENCH_FLAGS},
        {"commit", TSUBU_BENCH_COMMIT},
        {"instruction_set", tsubu::name_of(tsubu::best_instruction_set())},
#if defined(NDEBUG)
        {"assertions", "off"},
#else
        {"assertions", "on"},
#endif
    };
}

}  // namespace bench
