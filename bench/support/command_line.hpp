// SPDX-License-Identifier: MIT
/// @file
/// What the programs of the suite have in common on their command lines.
#pragma once

#include "options.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>      // std::size_t
#include <cstdio>       // std::fprintf, std::fputs
#include <cstdlib>      // EXIT_FAILURE, EXIT_SUCCESS
#include <exception>    // std::exception
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <vector>       // std::vector

namespace bench {

/// Our defaults for Google Benchmark come first, so that the user's flags override them.
inline void initialize_benchmark(const std::vector<char*>& user, extent how_much) {
    constexpr const char* repetitions[] = {"5", "5", "7"};
    constexpr const char* seconds[] = {"0.005", "0.02", "0.03"};
    const auto k = static_cast<std::size_t>(how_much);
    std::vector<std::string> words = {user.front(), "--benchmark_enable_random_interleaving=true",
                                      std::string("--benchmark_repetitions=") + repetitions[k],
                                      std::string("--benchmark_min_time=") + seconds[k]};
    words.insert(words.end(), user.begin() + 1, user.end());
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
}

/// What main does: help, options, run(options), and what went wrong. @return the exit code.
/// @param takes_ids  whether the program has a use for --ids
template <class Run>
int run_program(int argc, char** argv, const std::string& name, const char* usage, bool takes_ids, Run&& run) {
    std::vector<char*> arguments(argv, argv + argc);
    for (const std::string_view word : arguments)
        if (word == "--help") {
            std::fputs(usage, stdout);
            std::fputs(usage_of_all, stdout);
            return EXIT_SUCCESS;
        }
    options chosen;
    chosen.out = name + ".json";
    if (!parse(arguments, chosen, takes_ids)) {
        std::fputs(usage, stderr);
        std::fputs(usage_of_all, stderr);
        return 2;
    }
    try {
        initialize_benchmark(arguments, chosen.how_much);
        return run(chosen);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), failure.what());
        return EXIT_FAILURE;
    }
}

}  // namespace bench
