// SPDX-License-Identifier: MIT
/// @file
/// line_places: on which line was the particle with this index?
#pragma once

#include <algorithm>  // std::upper_bound
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <vector>     // std::vector

namespace tsubu::detail {

/// Remembers only where a run of lines begins: one entry where nothing is left out.
class line_places {
public:
    /// The next particle was on this line.
    void push_back(std::uint64_t line) {
        if (runs_.empty() || line - runs_.back().line != count_ - runs_.back().first) runs_.push_back({count_, line});
        ++count_;
    }
    [[nodiscard]] std::uint64_t operator[](std::size_t i) const noexcept {
        const auto after = std::upper_bound(runs_.begin(), runs_.end(), i,
                                            [](std::size_t at, const run& one) { return at < one.first; });
        const auto& of = *(after - 1);
        return of.line + (i - of.first);
    }

private:
    struct run {
        std::size_t first;
        std::uint64_t line;
    };
    std::vector<run> runs_;
    std::size_t count_ = 0;
};

}  // namespace tsubu::detail
