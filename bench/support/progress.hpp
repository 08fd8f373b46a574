// SPDX-License-Identifier: MIT
/// @file
/// How far the run is, on stderr, with the time that is left of all of it, not only of this program's share.
#pragma once

#include <unistd.h>  // isatty

#include <chrono>   // std::chrono::steady_clock
#include <cstddef>  // std::size_t
#include <cstdio>   // std::fflush, std::fprintf, std::snprintf
#include <string>   // std::string

namespace bench {

/// Of the programs before and after this one, as bench/run tells it [s].
struct whole_run {
    double done = 0;   ///< what was planned for the programs before
    double took = 0;   ///< what they took
    double later = 0;  ///< what is planned for the programs after
};

/// What is left is what was planned, by how the time taken so far compares with the plan, of which a minute is believed
/// from the beginning: the first groups are short, and tell little of the others.
[[nodiscard]] inline double seconds_left(const whole_run& whole, double planned, double done, double took) noexcept {
    const double believed = 60;
    const double pace = (believed + whole.took + took) / (believed + whole.done + done);
    return pace * (planned - done + whole.later);
}

class progress {
public:
    /// @param planned  the seconds of all groups of this program, roughly
    progress(double planned, const whole_run& whole) : planned_(planned), whole_(whole) {}

    /// A line for each group; on a terminal one line, written anew.
    void begin(std::size_t number, std::size_t count, const std::string& name) {
        const double left = seconds_left(whole_, planned_, done_, seconds());
        char time[48];
        const int whole = static_cast<int>(left);
        if (left < 60)
            std::snprintf(time, sizeof time, "about %d s left", whole);
        else if (left < 600)
            std::snprintf(time, sizeof time, "about %d min %02d s left", whole / 60, whole % 60);
        else
            std::snprintf(time, sizeof time, "about %d min left", whole / 60);
        std::fprintf(stderr, "%s[%zu/%zu] %-40s %s%s", is_terminal_ ? "\r\033[2K" : "", number, count, name.c_str(),
                     time, is_terminal_ ? "" : "\n");
        std::fflush(stderr);
        began_ = seconds();
    }
    /// @return the seconds that the group took
    double end(double planned) {
        done_ += planned;
        return seconds() - began_;
    }
    void close(const char* file) const {
        std::fprintf(stderr, "%s%s: written after %.0f s\n", is_terminal_ ? "\r\033[2K" : "", file, seconds());
    }
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double planned_;
    whole_run whole_;
    double done_ = 0;
    double began_ = 0;
    bool is_terminal_ = isatty(2) != 0;
};

}  // namespace bench
