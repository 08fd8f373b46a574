// SPDX-License-Identifier: MIT
/// @file
/// An array that is written at its end, several values at a time, before their number is known.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>

#include <algorithm>  // std::copy_n, std::min
#include <cstddef>    // std::size_t
#include <string>     // std::to_string
#include <utility>    // std::move

namespace tsubu::detail {

template <class Value>
class growing {
public:
    /// @param limit  how many there may be
    /// @param where, what  for the message if they are more
    growing(std::size_t guess, std::size_t limit, const char* where, const char* what)
        : values_((std::min)(guess, limit), {}), limit_(limit), where_(where), what_(what) {}

    /// Where to write up to `most` values. @throws limit_error if there may be more than the limit then.
    [[nodiscard, gnu::always_inline]] Value* room(std::size_t most) {
        if (values_.size() - count_ < most) grow(most);
        return values_.data() + count_;
    }
    /// All before `end` are written.
    [[gnu::always_inline]] void up_to(const Value* end) noexcept {
        count_ = static_cast<std::size_t>(end - values_.data());
    }
    [[nodiscard]] Value* data() noexcept { return values_.data(); }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    /// The values, and room for an eighth more at most: a copy that saved less would cost more than it gives.
    [[nodiscard]] buffer<Value> take() {
        if (values_.size() - count_ <= count_ / 8) return std::move(values_);
        buffer<Value> exact(count_, {});
        if (count_ != 0) std::copy_n(values_.data(), count_, exact.data());
        values_ = {};
        return exact;
    }

private:
    [[gnu::noinline]] void grow(std::size_t most) {
        if (limit_ - count_ < most)
            raise<limit_error>(where_, "more than " + std::to_string(limit_) + " " + what_ + " on one rank",
                               "take more ranks, or a shorter cutoff or skin");
        buffer<Value> larger((std::min)(values_.size() + values_.size() / 2 + most, limit_), {});
        if (count_ != 0) std::copy_n(values_.data(), count_, larger.data());
        values_ = std::move(larger);
    }

    buffer<Value> values_;
    std::size_t count_ = 0;
    std::size_t limit_;
    const char* where_;
    const char* what_;
};

/// How much room to begin with, where `last` values were found the time before.
[[nodiscard]] constexpr std::size_t room_after(std::size_t last) noexcept { return last + last / 16 + 64; }

}  // namespace tsubu::detail
