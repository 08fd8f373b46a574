// SPDX-License-Identifier: MIT
/// @file
/// A program of bench/ that measures nothing: groups of rows that come slowly, so that a test can stop it in their
/// midst.
///
///     stoppable_run [--resume] [--only TEXT] [--quick] --benchmark_out=FILE.json

#include "../../bench/support/groups.hpp"

#include <chrono>     // std::chrono::milliseconds
#include <cstdio>     // std::fprintf
#include <cstdlib>    // EXIT_FAILURE
#include <exception>  // std::exception
#include <string>     // std::string
#include <thread>     // std::this_thread::sleep_for
#include <vector>     // std::vector

namespace {

void slow_rows(bench::row_reporter& report, const std::string& group) {
    for (int repetition = 0; repetition < 8; ++repetition) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        report.counted(group + "/row:" + std::to_string(repetition), {{"value", repetition + 0.5}});
    }
    report.refused(group + "/row:last", "a \"quoted\" sentence, with\na new line");
}

}  // namespace

int main(int count, char** words) try {
    std::vector<char*> arguments(words, words + count);
    bench::options chosen;
    if (!bench::parse(arguments, chosen)) return 2;
    std::vector<bench::group> groups;
    for (const std::string name : {"dem/first", "dem/second", "dem/third", "dem/fourth"})
        groups.push_back({name, 10, [name](bench::row_reporter& report) { slow_rows(report, name); }});
    return bench::run_groups("stoppable_run", groups, chosen);
} catch (const std::exception& failure) {
    std::fprintf(stderr, "stoppable_run: %s\n", failure.what());
    return EXIT_FAILURE;
}
