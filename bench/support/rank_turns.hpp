// SPDX-License-Identifier: MIT
/// @file
/// Measures what all ranks of an MPI program do together: contenders take turns, a time is that of the slowest rank.
#pragma once

#include "row_reporter.hpp"

#include <tsubu/comm/mpi_transport.hpp>
#include <tsubu/core/random.hpp>

#include <algorithm>   // std::clamp, std::nth_element
#include <chrono>      // std::chrono::steady_clock
#include <cstddef>     // std::size_t
#include <cstdint>     // std::uint64_t
#include <functional>  // std::function
#include <span>        // std::span
#include <string>      // std::string
#include <utility>     // std::pair, std::swap
#include <vector>      // std::vector

namespace bench {

/// What is measured; the same on all ranks.
struct collective_contender {
    std::string name;
    std::function<void()> prepare;  ///< before each call, not measured; may be empty
    std::function<void()> call;
};

/// Google Benchmark would choose a number of iterations on each rank by itself, and they would not match.
class rank_turns {
public:
    /// @param report  that of rank 0 writes
    /// @param rounds  how often each contender has its turn
    /// @param seconds of one turn, roughly
    rank_turns(tsubu::mpi_transport& on, row_reporter& report, std::size_t rounds, double seconds)
        : on_(&on), report_(&report), rounds_(rounds), seconds_(seconds) {}

    /// One row for each turn: the lower quartile of its calls, each of which begins after a barrier and lasts as long
    /// as on the slowest rank [ns]; other programs that take a core away only add to a time. The order of each round is
    /// random, and the same on all ranks.
    /// @param fields  go into each row
    void measure(const std::vector<collective_contender>& all,
                 const std::vector<std::pair<std::string, double>>& fields) {
        std::vector<std::size_t> calls, order;
        for (std::size_t k = 0; k < all.size(); ++k) {
            turn(all[k], fewest_calls);  // warms up, and takes the memory that is kept
            const auto once = turn(all[k], fewest_calls);
            calls.push_back(static_cast<std::size_t>(
                std::clamp(seconds_ / once, static_cast<double>(fewest_calls), 5000.0)));
            order.push_back(k);
        }
        for (std::size_t round = 0; round < rounds_; ++round) {
            for (auto n = order.size(); n > 1; --n) std::swap(order[n - 1], order[random_.below(n)]);
            for (const auto k : order) {
                const auto time = turn(all[k], calls[k]);
                std::vector<std::pair<std::string, double>> row = {{"repetition_index", static_cast<double>(round)},
                                                                   {"iterations", static_cast<double>(calls[k])},
                                                                   {"real_time", 1e9 * time}};
                row.insert(row.end(), fields.begin(), fields.end());
                report_->counted(all[k].name, row);
            }
        }
    }

private:
    static constexpr std::size_t fewest_calls = 8;

    double turn(const collective_contender& one, std::size_t calls) {
        std::vector<double> times(calls);
        for (auto& time : times) {
            if (one.prepare) one.prepare();
            MPI_Barrier(MPI_COMM_WORLD);
            const auto begin = std::chrono::steady_clock::now();
            one.call();
            time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        }
        on_->reduce(std::span<double>(times), tsubu::reduction::greatest);
        const auto quartile = times.begin() + static_cast<std::ptrdiff_t>(calls / 4);
        std::nth_element(times.begin(), quartile, times.end());
        return *quartile;
    }

    tsubu::mpi_transport* on_;
    row_reporter* report_;
    std::size_t rounds_;
    double seconds_;
    tsubu::random_stream random_{17};
};

}  // namespace bench
