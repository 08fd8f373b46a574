// SPDX-License-Identifier: MIT
/// @file
/// Writes the JSON of several runs of Google Benchmark as one, a line per repetition.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>     // std::snprintf
#include <fstream>    // std::ofstream
#include <stdexcept>  // std::runtime_error
#include <string>     // std::string
#include <utility>    // std::pair
#include <vector>     // std::vector

namespace bench {

/// The fields are those of Google Benchmark's own JSON, so that its tools read it. A line that stands for no
/// measurement has "refused" (the policy's message) or "degenerate" (nodes visited per look-up) in place of times; one
/// of something other than time has its own fields.
class row_reporter final : public benchmark::BenchmarkReporter {
public:
    row_reporter(const std::string& path, const std::vector<std::pair<std::string, std::string>>& context)
        : file_(path) {
        if (!file_) throw std::runtime_error(path + ": cannot be written; name a file in a folder that exists");
        file_ << "{\n\"context\": {";
        const char* separator = "\n  ";
        for (const auto& [key, value] : context) {
            file_ << separator << quoted(key) << ": " << quoted(value);
            separator = ",\n  ";
        }
        file_ << "\n},\n\"benchmarks\": [";
    }

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const auto& run : runs)
            if (run.run_type == Run::RT_Iteration) report(run);
    }

    void refused(const std::string& name, const std::string& message) {
        row("\"name\": " + quoted(name) + ", \"refused\": " + quoted(message));
    }
    /// nanoseconds per particle of one pass; negative if even that would take too long
    void degenerate(const std::string& name, double visits, double nanoseconds) {
        row("\"name\": " + quoted(name) + ", \"degenerate\": " + number(visits) +
            (nanoseconds < 0 ? "" : ", \"nanoseconds\": " + number(nanoseconds)));
    }
    /// Anything but a time: errors, numbers of points.
    void counted(const std::string& name, const std::vector<std::pair<std::string, double>>& fields) {
        std::string text = "\"name\": " + quoted(name);
        for (const auto& [field, value] : fields) text += ", " + quoted(field) + ": " + number(value);
        row(text);
    }
    /// Ends the file. @throws std::runtime_error if not all could be written.
    void close() {
        file_ << "\n]\n}\n";
        file_.close();
        if (!file_) throw std::runtime_error("the JSON could not be written to its end; is the disk full?");
    }

private:
    void report(const Run& run) {
        std::string text = "\"name\": " + quoted(run.run_name.function_name) + ", \"run_type\": \"iteration\"" +
                           ", \"repetition_index\": " + std::to_string(run.repetition_index) +
                           ", \"iterations\": " + std::to_string(run.iterations) +
                           ", \"real_time\": " + number(run.GetAdjustedRealTime()) +
                           ", \"cpu_time\": " + number(run.GetAdjustedCPUTime()) + ", \"time_unit\": \"ns\"";
        for (const auto& [name, counter] : run.counters) text += ", " + quoted(name) + ": " + number(counter.value);
        row(text);
    }
    void row(const std::string& text) {
        file_ << (first_ ? "\n  {" : ",\n  {") << text << "}" << std::flush;
        first_ = false;
    }
    [[nodiscard]] static std::string number(double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.5g", value);
        return text;
    }
    [[nodiscard]] static std::string quoted(const std::string& text) {
        std::string result = "\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') result += '\\';
            result += c == '\n' || c == '\t' ? ' ' : c;
        }
        return result + '"';
    }

    std::ofstream file_;
    bool first_ = true;
};

}  // namespace bench
