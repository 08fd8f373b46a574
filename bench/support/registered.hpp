// SPDX-License-Identifier: MIT
/// @file
/// Runs what a group has registered with Google Benchmark.
#pragma once

#include "row_reporter.hpp"

#include <benchmark/benchmark.h>

#include <string>  // std::string
#include <vector>  // std::vector

namespace bench {

/// Several runs of Google Benchmark become one list of rows.
class benchmark_rows final : public benchmark::BenchmarkReporter {
public:
    explicit benchmark_rows(row_reporter& report) : report_(&report) {}

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const auto& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            std::string text = "\"name\": " + quoted(run.run_name.function_name) + ", \"run_type\": \"iteration\"" +
                               ", \"repetition_index\": " + std::to_string(run.repetition_index) +
                               ", \"iterations\": " + std::to_string(run.iterations) +
                               ", \"real_time\": " + number(run.GetAdjustedRealTime()) +
                               ", \"cpu_time\": " + number(run.GetAdjustedCPUTime()) + ", \"time_unit\": \"ns\"";
            for (const auto& [name, counter] : run.counters) text += ", " + quoted(name) + ": " + number(counter.value);
            report_->row(text);
        }
    }

private:
    row_reporter* report_;
};

inline void run_registered(row_reporter& report) {
    benchmark_rows rows(report);
    benchmark::RunSpecifiedBenchmarks(&rows);
    benchmark::ClearRegisteredBenchmarks();
}

}  // namespace bench
