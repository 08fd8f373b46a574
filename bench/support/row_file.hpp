// SPDX-License-Identifier: MIT
/// @file
/// A file of JSON that is whole after every row, and from which a run that was stopped goes on.
///
///     {
///     "context": {
///       "date": "2026-11-22T09:40:31Z",
///       "compiler": "g++ 12.2.0"
///     },
///     "benchmarks": [
///       {"name": "dem/walls/0/pefrl/double", "omega_dt": 0.05, "error": 1e-6},
///       {"name": "dem/walls", "group_seconds": 1.2}        what was above it is all of the group dem/walls
///     ]
///     }
#pragma once

#include <algorithm>    // std::find
#include <cstdio>       // std::rename, std::snprintf
#include <fstream>      // std::fstream, std::ifstream, std::ofstream
#include <ios>          // std::ios
#include <stdexcept>    // std::runtime_error
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::pair
#include <vector>       // std::vector

namespace bench {

using run_conditions = std::vector<std::pair<std::string, std::string>>;

/// As an element of JSON.
[[nodiscard]] inline std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}
[[nodiscard]] inline std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c == '\n' || c == '\t' ? ' ' : c;
    }
    return result + '"';
}

class row_file {
public:
    /// On ranks that write nothing.
    row_file() = default;

    /// @param goes_on  keeps the groups that a run under the same conditions has finished in this file
    /// @throws std::runtime_error if the file cannot be written, or holds figures of other conditions.
    row_file(const std::string& path, run_conditions conditions, bool goes_on) : path_(path) {
        std::string rows;
        if (goes_on) {
            rows = finished_rows(conditions);
            if (!finished_.empty()) {
                conditions.emplace_back("resumed", conditions.front().second);  // the date
                conditions.front().second = begun_;
            }
        }
        // A new file takes the place of the old one only when it is whole.
        const std::string text = head(conditions) + rows;
        const std::string fresh = path + ".new";
        std::ofstream made(fresh, std::ios::binary);
        if (!made) throw unwritable();
        made << text << foot;
        made.close();
        if (!made) throw torn();
        if (std::rename(fresh.c_str(), path.c_str()) != 0) throw unwritable();
        file_.open(path, std::ios::in | std::ios::out | std::ios::binary);
        if (!file_) throw unwritable();
        end_ = static_cast<std::streamoff>(text.size());
        is_first_ = rows.empty();
    }

    [[nodiscard]] bool has_finished(const std::string& group) const {
        return std::find(finished_.begin(), finished_.end(), group) != finished_.end();
    }
    /// One write, which begins where the foot began: whoever reads the file finds it whole.
    void add(const std::string& row) {
        if (path_.empty()) return;
        const std::string line = (is_first_ ? "\n  {" : ",\n  {") + row + "}";
        file_.seekp(end_);
        file_ << line + foot << std::flush;
        if (!file_) throw torn();
        end_ += static_cast<std::streamoff>(line.size());
        is_first_ = false;
    }
    void finish(const std::string& group, double seconds) {
        add("\"name\": " + quoted(group) + ", " + end_of_group + number(seconds));
        finished_.push_back(group);
    }

private:
    static constexpr const char* foot = "\n]\n}\n";
    static constexpr const char* end_of_group = "\"group_seconds\": ";

    [[nodiscard]] std::runtime_error unwritable() const {
        return std::runtime_error(path_ + ": cannot be written; name a file in a folder that exists");
    }
    [[nodiscard]] std::runtime_error torn() const {
        return std::runtime_error(path_ + ": could not be written to its end; is the disk full?");
    }
    [[nodiscard]] static std::string head(const run_conditions& conditions) {
        std::string text = "{\n\"context\": {";
        const char* separator = "\n  ";
        for (const auto& [key, value] : conditions) {
            text += separator + quoted(key) + ": " + quoted(value);
            separator = ",\n  ";
        }
        return text + "\n},\n\"benchmarks\": [";
    }
    /// When it was measured, and beside what, may differ.
    [[nodiscard]] static bool may_differ(std::string_view key) {
        return key == "date" || key == "load" || key == "resumed";
    }

    /// The lines up to the end of the last finished group; those of a group that was interrupted are measured again.
    [[nodiscard]] std::string finished_rows(const run_conditions& conditions) {
        std::ifstream old(path_, std::ios::binary);
        std::string line, kept, unfinished;
        std::string others;  // conditions that are not those of the file
        bool in_rows = false;
        while (std::getline(old, line) && !old.eof()) {  // a line without an end was torn
            if (!in_rows) {
                in_rows = line == "\"benchmarks\": [";
                note_difference(line, conditions, others);
                continue;
            }
            if (!line.ends_with('}') && !line.ends_with("},")) break;
            if (line.ends_with(',')) line.pop_back();
            if (line == "}" || !line.starts_with("  {")) break;
            unfinished += (kept.empty() && unfinished.empty() ? "\n" : ",\n") + line;
            const auto mark = line.find(end_of_group);
            if (mark == std::string::npos) continue;
            kept += unfinished;
            unfinished.clear();
            const auto begin = line.find("\"name\": \"") + 9;
            finished_.push_back(line.substr(begin, line.find('"', begin) - begin));
        }
        for (const auto& [key, value] : conditions)
            if (std::find(seen_.begin(), seen_.end(), key) == seen_.end() && (!may_differ(key) || key == "date"))
                others += (others.empty() ? "" : ", ") + key + " is missing";
        if (begun_.empty()) others += (others.empty() ? "" : ", ") + std::string("the date cannot be read");
        if (!finished_.empty() && !others.empty())
            throw std::runtime_error(path_ + ": cannot go on, since this is not the run that was stopped: " + others +
                                     "; begin anew without --resume");
        return kept;
    }
    void note_difference(const std::string& line, const run_conditions& conditions, std::string& others) {
        for (const auto& [key, value] : conditions) {
            const auto begin = "  " + quoted(key) + ": ";
            if (!line.starts_with(begin)) continue;
            auto was = line.substr(begin.size());
            if (was.ends_with(',')) was.pop_back();
            if (key == "date" && was.size() > 2) begun_ = was.substr(1, was.size() - 2);
            seen_.push_back(key);
            if (may_differ(key) || was == quoted(value)) continue;
            others += (others.empty() ? "" : ", ") + key + " was " + was + " and is " + quoted(value);
        }
    }

    std::string path_;
    std::fstream file_;
    std::streamoff end_ = 0;
    bool is_first_ = true;
    std::string begun_;
    std::vector<std::string> finished_;
    std::vector<std::string> seen_;  // conditions that the file has
};

}  // namespace bench
