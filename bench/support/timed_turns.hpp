// SPDX-License-Identifier: MIT
/// @file
/// Contenders that time themselves and take turns, in a random order each round.
#pragma once

#include "row_reporter.hpp"

#include <tsubu/core/random.hpp>

#include <algorithm>   // std::nth_element
#include <chrono>      // std::chrono::steady_clock
#include <cstddef>     // std::ptrdiff_t, std::size_t
#include <functional>  // std::function
#include <string>      // std::string
#include <utility>     // std::pair, std::swap
#include <vector>      // std::vector

namespace bench {

using row_fields = std::vector<std::pair<std::string, double>>;

/// A turn is timed by the contender itself, so that it may prepare what does not count.
struct timed_contender {
    std::string name;
    double units;                            ///< of work in a turn: particle-steps
    std::function<double(row_fields&)> turn;  ///< @return seconds; may add fields to the row
};

/// The seconds that body() takes.
template <class Body>
[[nodiscard]] double seconds_of(Body&& body) {
    const auto begin = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The lower quartile of so many calls, times their number [s]: other programs that take the core away only add to a
/// time, and much to a short one.
template <class Body>
[[nodiscard]] double undisturbed_seconds(std::size_t calls, Body&& body) {
    std::vector<double> times(calls);
    for (auto& time : times) time = seconds_of(body);
    const auto quartile = times.begin() + static_cast<std::ptrdiff_t>(calls / 4);
    std::nth_element(times.begin(), quartile, times.end());
    return *quartile * static_cast<double>(calls);
}

/// A row for each turn, with nanoseconds per unit.
/// @param warm_up  a turn of each before the first that counts
inline void take_turns(row_reporter& report, const std::vector<timed_contender>& all, std::size_t rounds,
                       bool warm_up = true) {
    tsubu::random_stream random(17);
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < all.size(); ++k) {
        row_fields ignored;
        if (warm_up) all[k].turn(ignored);
        order.push_back(k);
    }
    for (std::size_t round = 0; round < rounds; ++round) {
        for (auto n = order.size(); n > 1; --n) std::swap(order[n - 1], order[random.below(n)]);
        for (const auto k : order) {
            row_fields fields = {{"repetition_index", static_cast<double>(round)}};
            const double seconds = all[k].turn(fields);
            fields.emplace_back("real_time", 1e9 * seconds / all[k].units);
            report.counted(all[k].name, fields);
        }
    }
}

}  // namespace bench
