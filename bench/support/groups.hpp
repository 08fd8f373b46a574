// SPDX-License-Identifier: MIT
/// @file
/// The groups of a program of the suite, and how they are run.
#pragma once

#include "command_line.hpp"
#include "progress.hpp"
#include "row_reporter.hpp"
#include "run_context.hpp"

#include <cstddef>     // std::size_t
#include <cstdio>      // std::fprintf
#include <cstdlib>     // EXIT_SUCCESS
#include <functional>  // std::function
#include <string>      // std::string
#include <vector>      // std::vector

namespace bench {

struct group {
    std::string name;
    double weight;  ///< seconds, roughly: shares of the time that is left
    std::function<void(row_reporter&)> run;
};

/// Runs those groups that were chosen, and writes the file. @return the exit code; 2 if none was chosen.
inline int run_groups(const char* program, std::vector<group> groups, const options& chosen) {
    std::erase_if(groups, [&](const group& g) { return g.name.find(chosen.only) == std::string::npos; });
    double all = 0;
    for (const auto& g : groups) all += g.weight;
    if (groups.empty()) {
        std::fprintf(stderr, "%s: no group has \"%s\" in its name\n", program, chosen.only.c_str());
        return 2;
    }
    auto context = run_context();
    context.emplace_back("extent", extent_names[static_cast<int>(chosen.how_much)]);
    row_reporter report(chosen.out, context);
    progress shown(all);
    for (std::size_t k = 0; k < groups.size(); ++k) {
        shown.begin(k + 1, groups.size(), groups[k].name);
        groups[k].run(report);
        shown.end(groups[k].weight);
    }
    report.close();
    std::fprintf(stderr, "%s: written after %.0f s\n", chosen.out.c_str(), shown.seconds());
    return EXIT_SUCCESS;
}

}  // namespace bench
