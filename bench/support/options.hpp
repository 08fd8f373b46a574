// SPDX-License-Identifier: MIT
/// @file
/// What the programs of the suite are told to measure, and how they go on.
#pragma once

#include "progress.hpp"

#include <cstddef>      // std::size_t
#include <cstdio>       // std::sscanf
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
    bool only_plans = false;  ///< says how many seconds are left, roughly, and measures nothing
    whole_run whole;
};

/// What all programs take, for their help.
inline constexpr const char* usage_of_all =
    "  --resume    keep the groups that a run under the same conditions has finished in this file\n"
    "  --plan      print the seconds that the groups take which are left, roughly, and measure nothing\n"
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

}  // namespace bench
