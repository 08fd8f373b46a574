// SPDX-License-Identifier: MIT
/// @file
/// An array that is written at its end, several values at a time, before their number is known.
#pragma once

#include <tsubu/core/buffer.hpp>

#include <algorithm>  // std::copy_n
#include <cstddef>    // std::size_t
#include <utility>    // std::move

namespace tsubu::detail {

template <class Value>
class growing {
public:
    explicit growing(std::size_t guess) : values_(guess, {}) {}

    /// Where to write up to `most` values.
    [[nodiscard, gnu::always_inline]] Value* room(std::size_t most) {
        if (values_.size() - count_ < most) grow(most);
        return values_.data() + count_;
    }
    /// All before `end` are written.
    [[gnu::always_inline]] void up_to(const Value* end) noexcept {
        count_ = static_cast<std::size_t>(end - values_.data());
    }
    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    /// As many as there are, without room for more.
    [[nodiscard]] buffer<Value> take() {
        if (count_ == values_.size()) return std::move(values_);
        buffer<Value> exact(count_, {});
        if (count_ != 0) std::copy_n(values_.data(), count_, exact.data());
        values_ = {};
        return exact;
    }

private:
    [[gnu::noinline]] void grow(std::size_t most) {
        buffer<Value> larger(values_.size() + values_.size() / 2 + most, {});
        if (count_ != 0) std::copy_n(values_.data(), count_, larger.data());
        values_ = std::move(larger);
    }

    buffer<Value> values_;
    std::size_t count_ = 0;
};

}  // namespace tsubu::detail
