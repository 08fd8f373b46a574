// SPDX-License-Identifier: MIT
/// @file
/// A line per group on stderr, with the time that is left.
#pragma once

#include <chrono>   // std::chrono::steady_clock
#include <cstddef>  // std::size_t
#include <cstdio>   // std::fprintf, std::snprintf
#include <string>   // std::string

namespace bench {

class progress {
public:
    /// The sum of the weights of all groups.
    explicit progress(double all) : all_(all) {}
    void begin(std::size_t number, std::size_t count, const std::string& name) const {
        std::fprintf(stderr, "[%zu/%zu] %-40s %s\n", number, count, name.c_str(), left().c_str());
    }
    void end(double weight) { done_ += weight; }
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    [[nodiscard]] std::string left() const {
        if (done_ <= 0) return "";
        const int seconds_left = static_cast<int>(seconds() * (all_ - done_) / done_);
        char text[48];
        std::snprintf(text, sizeof text, "about %d min %02d s left", seconds_left / 60, seconds_left % 60);
        return text;
    }
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double all_;
    double done_ = 0;
};

}  // namespace bench
