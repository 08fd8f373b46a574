// SPDX-License-Identifier: MIT
/// @file
/// text_sink: where the characters of a file go, a chunk at a time; and a buffer that numbers are written into.
#pragma once

#include <tsubu/core/error.hpp>

#include <algorithm>    // std::max
#include <charconv>     // std::to_chars
#include <cstddef>      // std::size_t
#include <cstring>      // std::memcpy
#include <string_view>  // std::string_view
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu {

/// Takes characters in order: sink(text). A function, an object that appends to a string, a message to rank 0.
template <class Sink>
concept text_sink = requires(Sink& sink, std::string_view text) { sink(text); };

namespace detail {

/// Collects text, and gives it to the sink in chunks.
template <text_sink Sink>
class text_buffer {
public:
    text_buffer(Sink sink, std::size_t chunk)
        : sink_(std::move(sink)), buffer_((std::max)(chunk, 2 * longest_number)) {}

    void put(char c) {
        make_room(1);
        buffer_[used_++] = c;
    }
    void put(std::string_view text) {
        if (text.size() > buffer_.size() - used_) flush();
        if (text.size() > buffer_.size()) {
            sink_(text);
            return;
        }
        if (!text.empty()) std::memcpy(buffer_.data() + used_, text.data(), text.size());
        used_ += text.size();
    }
    /// The shortest text that reads back as the same number. Precondition: the number is finite.
    template <class Number>
        requires requires(char* at, Number x) { std::to_chars(at, at, x); }
    void put_number(Number x) {
        make_room(longest_number);
        auto* const at = buffer_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(at, at + longest_number, x).ptr - at);
    }
    /// Several numbers, and a blank before each but the first.
    template <class... Numbers>
    void put_numbers(Numbers... x) {
        bool is_first = true;
        ((is_first ? void() : put(' '), is_first = false, put_number(x)), ...);
    }
    void flush() {
        if (used_ == 0) return;
        sink_(std::string_view(buffer_.data(), used_));
        used_ = 0;
    }
    [[nodiscard]] Sink& sink() noexcept { return sink_; }

private:
    static constexpr std::size_t longest_number = 512;  // more than a double needs in any form

    void make_room(std::size_t count) {
        if (buffer_.size() - used_ < count) flush();
    }

    Sink sink_;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
};

}  // namespace detail
}  // namespace tsubu
