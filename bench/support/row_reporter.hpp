// SPDX-License-Identifier: MIT
/// @file
/// What a group reports: a line per repetition.
#pragma once

#include "row_file.hpp"

#include <string>   // std::string
#include <utility>  // std::pair
#include <vector>   // std::vector

namespace bench {

/// The fields are those of Google Benchmark's own JSON, so that its tools read it. A line that stands for no
/// measurement has "refused" (the policy's message) or "degenerate" (nodes visited per look-up) in place of times; one
/// of something other than time has its own fields.
class row_reporter {
public:
    /// On ranks that write nothing.
    row_reporter() = default;
    explicit row_reporter(row_file& file) : file_(&file) {}

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

    /// The elements of a line, as they are.
    void row(const std::string& text) {
        if (file_ != nullptr) file_->add(text);
    }

private:
    row_file* file_ = nullptr;
};

}  // namespace bench
