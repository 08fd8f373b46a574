// SPDX-License-Identifier: MIT
/// @file
/// The groups of a program of the suite, and how they are run.
#pragma once

#include "options.hpp"
#include "progress.hpp"
#include "row_reporter.hpp"
#include "run_context.hpp"

#include <cstddef>     // std::size_t
#include <cstdio>      // std::fprintf, std::printf
#include <cstdlib>     // EXIT_SUCCESS
#include <functional>  // std::function
#include <string>      // std::string
#include <vector>      // std::vector

namespace bench {

struct group {
    std::string name;
    double seconds;  ///< roughly: shares of the time that is left
    std::function<void(row_reporter&)> run;
};

/// One process, or the ranks of an MPI program, of which one writes and tells the others what is done already.
struct team {
    bool writes = true;
    std::function<void(std::vector<char>&)> agree = [](std::vector<char>&) {};
};

/// Runs those groups that were chosen and are not in the file yet. @return the exit code; 2 if none was chosen.
inline int run_groups(const char* program, std::vector<group> groups, const options& chosen,
                      const run_conditions& particular = {}, const team& everyone = {}) {
    std::erase_if(groups, [&](const group& g) { return g.name.find(chosen.only) == std::string::npos; });
    if (groups.empty()) {
        if (everyone.writes)
            std::fprintf(stderr, "%s: no group has \"%s\" in its name\n", program, chosen.only.c_str());
        return 2;
    }
    auto conditions = run_context();
    conditions.emplace_back("extent", extent_names[static_cast<int>(chosen.how_much)]);
    conditions.insert(conditions.end(), particular.begin(), particular.end());
    const bool needs_file = everyone.writes && (!chosen.only_plans || chosen.goes_on);
    row_file file = needs_file ? row_file(chosen.out, conditions, chosen.goes_on) : row_file();
    row_reporter report = needs_file ? row_reporter(file) : row_reporter();

    std::vector<char> is_done;
    for (const auto& g : groups) is_done.push_back(file.has_finished(g.name) ? 1 : 0);
    everyone.agree(is_done);
    double planned = 0;
    for (std::size_t k = 0; k < groups.size(); ++k)
        if (is_done[k] == 0) planned += groups[k].seconds;
    if (chosen.only_plans) {
        if (everyone.writes) std::printf("%.0f\n", planned);
        return EXIT_SUCCESS;
    }

    progress shown(planned, chosen.whole);
    for (std::size_t k = 0; k < groups.size(); ++k) {
        if (is_done[k] != 0) continue;
        if (everyone.writes) shown.begin(k + 1, groups.size(), groups[k].name);
        groups[k].run(report);
        const double seconds = shown.end(groups[k].seconds);
        if (everyone.writes) file.finish(groups[k].name, seconds);
    }
    if (everyone.writes) shown.close(chosen.out.c_str());
    return EXIT_SUCCESS;
}

}  // namespace bench
