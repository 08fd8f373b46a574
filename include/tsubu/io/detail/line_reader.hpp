// SPDX-License-Identifier: MIT
/// @file
/// line_reader: the lines of a text, one at a time, from chunks of a fixed size.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/io/byte_source.hpp>

#include <algorithm>    // std::max, std::min
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memchr, std::memmove
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu::detail {

[[nodiscard]] constexpr bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }
[[nodiscard]] constexpr bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
[[nodiscard]] constexpr std::string_view trimmed(std::string_view text) noexcept {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

/// Text of a file as messages show it: at most 80 characters, all of them printable.
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 80;
    std::string shown = "\"";
    for (const char c : text.substr(0, longest)) shown += c == '\t' || (c >= ' ' && c <= '~') ? c : '?';
    return shown += text.size() > longest ? "...\"" : "\"";
}

/// The buffer holds one chunk. A line that its end cuts moves to its front, and what follows is read behind it; a line
/// longer than the buffer makes it grow:
///
///     | (used) ... line \n line \n lin|      ->      |lin|e \n line \n ...
template <byte_source Source>
class line_reader {
public:
    /// @param chunk  characters held at a time; more only where a line is longer
    line_reader(Source source, std::size_t chunk)
        : source_(std::move(source)),
          buffer_((std::max)(chunk, std::size_t{1})),
          most_((std::max)(chunk, longest_line)) {}

    /// Goes to the next line, whatever is in it. @return false at the end.
    [[nodiscard]] bool next() {
        for (;;) {
            const char* const start = buffer_.data() + begin_;
            const auto held = end_ - begin_;
            if (held > scanned_) {
                const auto* const found =
                    static_cast<const char*>(std::memchr(start + scanned_, '\n', held - scanned_));
                if (found != nullptr) {
                    take({start, found});
                    begin_ = static_cast<std::size_t>(found - buffer_.data()) + 1;
                    return true;
                }
            }
            scanned_ = held;
            if (read_ == source_.size()) {
                if (held == 0) return false;
                take({start, start + held});
                begin_ = end_;
                return true;
            }
            refill();
        }
    }
    /// Goes to the next line that is more than blanks and a comment. @return false at the end.
    [[nodiscard]] bool next_content() {
        while (next())
            if (!content_.empty()) return true;
        content_ = comment_ = line_ = {};
        return false;
    }
    /// The line without comment, and without blanks at its ends.
    [[nodiscard]] std::string_view content() const noexcept { return content_; }
    /// What follows the first #, without blanks at its ends.
    [[nodiscard]] std::string_view comment() const noexcept { return trimmed(comment_); }
    /// All of the line, without its end.
    [[nodiscard]] std::string_view line() const noexcept { return line_; }
    /// Characters after the content may be looked at up to here.
    [[nodiscard]] const char* readable_end() const noexcept { return buffer_.data() + end_; }
    /// Counted from 1.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
    [[nodiscard]] std::string_view name() const noexcept { return source_.name(); }
    /// Characters in all.
    [[nodiscard]] std::uint64_t size() const { return source_.size(); }

    /// Tells what is wrong with this line.
    [[noreturn, gnu::cold, gnu::noinline]] void fail(const std::string& reason, const char* remedy) const {
        raise<input_error>("lammps_reader",
                           std::string(name()) + ", line " + std::to_string(number_) + " " + in_quotes(line_) + ": " +
                               reason,
                           remedy);
    }
    /// Tells what is wrong with an earlier line: goes through the text again, to show it. Nothing is read after that.
    [[noreturn, gnu::cold, gnu::noinline]] void fail_at(std::uint64_t number, const std::string& reason,
                                                        const char* remedy) {
        read_ = number_ = 0;
        begin_ = end_ = scanned_ = 0;
        while (number_ != number && next()) {
        }
        fail(reason, remedy);
    }

private:
    // Rows have some dozen characters; what goes on for so many is no data file, and takes no more memory.
    static constexpr std::size_t longest_line = std::size_t{1} << 16;

    void take(std::string_view line) noexcept {
        ++number_;
        scanned_ = 0;
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        line_ = line;
        comment_ = {};
        if (const void* const mark = line.empty() ? nullptr : std::memchr(line.data(), '#', line.size())) {
            const auto length = static_cast<std::size_t>(static_cast<const char*>(mark) - line.data());
            comment_ = line.substr(length + 1);
            line = line.substr(0, length);
        }
        content_ = trimmed(line);
    }
    void refill() {
        if (begin_ != 0) {
            std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
            end_ -= begin_;
            begin_ = 0;
        }
        if (end_ == buffer_.size() && end_ == most_) {
            ++number_;
            line_ = {buffer_.data(), end_};
            fail("a line of more than " + std::to_string(most_) + " characters", "raise lammps_read_options.chunk");
        }
        if (end_ == buffer_.size()) buffer_.resize((std::min)(2 * end_, most_));
        const auto room = std::span(buffer_).subspan(end_);
        const auto count = static_cast<std::size_t>((std::min)(std::uint64_t{room.size()}, source_.size() - read_));
        source_.read(read_, std::as_writable_bytes(room.first(count)));
        read_ += count;
        end_ += count;
    }

    Source source_;
    std::uint64_t read_ = 0;  // of the source
    std::vector<char> buffer_;
    std::size_t most_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::size_t scanned_ = 0;  // of what is held, no end of line is in so many
    std::uint64_t number_ = 0;
    std::string_view line_;
    std::string_view content_;
    std::string_view comment_;
};

}  // namespace tsubu::detail
