// SPDX-License-Identifier: MIT
/// @file
/// text_source: where the characters of a file come from, a chunk at a time.
#pragma once

#include <tsubu/core/error.hpp>

#include <algorithm>    // std::min
#include <cerrno>       // errno
#include <concepts>     // std::convertible_to, std::same_as
#include <cstddef>      // std::size_t
#include <cstdio>       // std::fopen
#include <cstring>      // std::memcpy, std::strerror
#include <memory>       // std::unique_ptr
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::move

namespace tsubu {

/// Gives characters in order, each once.
///  1. read(into) writes the next characters to the front of `into`, and returns how many; 0 only at the end;
///  2. name() is what errors call it;
///  3. if there is a size(), no more than so many characters come: memory is taken for no more than they can tell.
template <class Source>
concept text_source = requires(Source& source, const Source& read_only, std::span<char> into) {
    { source.read(into) } -> std::same_as<std::size_t>;
    { read_only.name() } -> std::convertible_to<std::string_view>;
};

/// Characters in memory, which must outlive it.
///
/// Concept: text_source. Choose it for tests, and for texts that came by message.
class memory_source {
public:
    explicit memory_source(std::string_view text, std::string name = "(memory)") : rest_(text), name_(std::move(name)) {}

    [[nodiscard]] std::size_t read(std::span<char> into) noexcept {
        const auto count = (std::min)(into.size(), rest_.size());
        if (count != 0) std::memcpy(into.data(), rest_.data(), count);
        rest_.remove_prefix(count);
        return count;
    }
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::size_t size() const noexcept { return rest_.size(); }

private:
    std::string_view rest_;
    std::string name_;
};
static_assert(text_source<memory_source>);

/// A file, from its beginning; no more of it is held than the system does.
///
/// Concept: text_source. Choose it for files of any size.
class file_source {
public:
    /// @throws input_error if it cannot be opened; the message says why.
    explicit file_source(std::string path) : name_(std::move(path)), file_(std::fopen(name_.c_str(), "rb")) {
        if (file_ == nullptr)
            detail::raise<input_error>("file_source", name_ + ": " + std::strerror(errno), "give a file that can be read");
        std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // chunks are large: a second buffer would only copy
        if (std::fseek(file_.get(), 0, SEEK_END) == 0) {  // a pipe has no end to go to, and no size
            const auto end = std::ftell(file_.get());
            size_ = end > 0 ? static_cast<std::size_t>(end) : 0;
            std::rewind(file_.get());
        }
        std::clearerr(file_.get());
    }
    /// @throws input_error if the system cannot read on.
    [[nodiscard]] std::size_t read(std::span<char> into) {
        const auto count = std::fread(into.data(), 1, into.size(), file_.get());
        if (count == 0 && std::ferror(file_.get()) != 0)
            detail::raise<input_error>("file_source", name_ + ": " + std::strerror(errno), "give a file that can be read");
        return count;
    }
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// When it was opened; 0 if it has none.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

private:
    struct closer {
        void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
    };

    std::string name_;
    std::unique_ptr<std::FILE, closer> file_;
    std::size_t size_ = 0;
};
static_assert(text_source<file_source>);

}  // namespace tsubu
