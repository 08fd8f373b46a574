// SPDX-License-Identifier: MIT
/// @file
/// What the programs of the suite have in common on their command lines.
#pragma once

#include "progress.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>      // std::size_t
#include <cstdio>       // std::fprintf, std::fputs, std::sscanf
#include <cstdlib>      // EXIT_FAILURE, EXIT_SUCCESS
#include <exception>    // std::exception
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <vector>       // std::vector

namespace bench {

enum class extent { quick, standard, full };
inline constexpr const char* extent_names[] = {"quick", "standard", "full"};

struct options {
    extent how_much = extent::standard;
    std::string out;
    std::string only;
    std::string ids_file;
    bool goes_on = false;     ///< keeps the groups that are in the file
    bool only_plans = false;  ///< says how many seconds the groups take, roughly, and measures nothing
    whole_run whole;
};

/// What all programs take, for their help.
inline constexpr const char* usage_of_all =
    "  --resume    keep the groups that a run under the same conditions has finished in this file\n"
    "  --plan      print the seconds that the groups take, roughly, and measure nothing\n"
    "  --whole-run DONE,TOOK,LATER\n"
    "              seconds planned for the programs before this one, taken by them, and planned for those after\n";

/// Takes our options out of the arguments; those of Google Benchmark stay. @return false if one is not understood.
/// @param takes_ids  whether the program has a use for --ids
[[nodiscard]] inline bool parse(std::vector<char*>& arguments, options& chosen, bool takes_ids = false) {
    std::vector<char*> rest{arguments.front()};
    for (std::size_t k = 1; k < arguments.size(); ++k) {
        const std::string_view word = arguments[k];
        if (word == "--quick")
            chosen.how_much = extent::quick;
        else if (word == "--full")
            chosen.how_much = extent::full;
        else if (word == "--only" && k + 1 < arguments.size())
            chosen.only = arguments[++k];
        else if (word == "--ids" && takes_ids && k + 1 < arguments.size())
            chosen.ids_file = arguments[++k];
        else if (word == "--resume")
            chosen.goes_on = true;
        else if (word == "--plan")
            chosen.only_plans = true;
        else if (word == "--whole-run" && k + 1 < arguments.size()) {
            auto& [done, took, later] = chosen.whole;
            if (std::sscanf(arguments[++k], "%lf,%lf,%lf", &done, &took, &later) != 3) return false;
        } else if (word.starts_with("--benchmark_out="))
            chosen.out = word.substr(word.find('=') + 1);
        else if (word.starts_with("--benchmark_"))
            rest.push_back(arguments[k]);
        else
            return false;
    }
    arguments = rest;
    return true;
}

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
