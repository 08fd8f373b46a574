// SPDX-License-Identifier: MIT
/// @file
/// Memory for links whose former content leads astray.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span
#include <vector>   // std::vector

namespace tsubu::detail {

/// Memory for links that rebuild must overwrite: what it holds before would lead astray anyone who read it, and
/// what lies beside it must stay.
class poisoned_links {
public:
    poisoned_links(std::size_t count, random_stream& random)
        : memory_(count + 2 * margin), begin_(margin - random.below(4)), count_(count) {
        const auto kind = random.below(4);
        for (std::size_t k = 0; k < memory_.size(); ++k) memory_[k] = poison(kind, k, random);
        before_ = memory_;
    }
    // The offset varies, so that no alignment beyond that of index_t can be relied on.
    [[nodiscard]] std::span<index_t> span() noexcept { return {memory_.data() + begin_, count_}; }
    [[nodiscard]] bool untouched() const noexcept { return memory_ == before_; }
    [[nodiscard]] bool untouched_outside() const noexcept {
        const auto last = begin_ + count_;
        for (std::size_t k = 0; k < memory_.size(); ++k)
            if ((k < begin_ || k >= last) && memory_[k] != before_[k]) return false;
        return true;
    }

private:
    static constexpr std::size_t margin = 32;  // more than the longest vector store

    [[nodiscard]] index_t poison(std::uint64_t kind, std::size_t k, random_stream& random) const noexcept {
        if (kind == 0) return absent;
        if (kind == 1) return 0x7f7f7f7f;                                          // far outside
        if (kind == 2) return static_cast<index_t>(random.below(memory_.size()));  // cycles, plausible links
        return static_cast<index_t>(k % 2 == 0 ? -2 - static_cast<std::int64_t>(k) : static_cast<std::int64_t>(k));
    }

    std::vector<index_t> memory_;
    std::vector<index_t> before_;
    std::size_t begin_;
    std::size_t count_;
};

}  // namespace tsubu::detail
