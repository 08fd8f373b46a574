// SPDX-License-Identifier: MIT
/// @file
/// byte_source: bytes that can be read at any place: a file, or memory.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/io/file_error.hpp>

#include <algorithm>    // std::min
#include <cerrno>       // errno
#include <concepts>     // std::convertible_to, std::same_as
#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::exchange, std::move

#include <fcntl.h>     // open
#include <sys/stat.h>  // fstat
#include <unistd.h>    // close, pread

namespace tsubu {

/// What a reader reads.
///  1. read(offset, to) fills `to`, or throws;
///  2. name() is what messages call it.
template <class Source>
concept byte_source = requires(const Source& source, std::uint64_t offset, std::span<std::byte> to) {
    { source.name() } -> std::convertible_to<std::string_view>;
    { source.size() } -> std::same_as<std::uint64_t>;
    source.read(offset, to);
};

/// A file that is read where it lies.
///
/// Concept: byte_source. Cost of a read: a call of the system. Deterministic: yes, while nobody writes the file.
/// Choose it when what is to be read is a file. Do not when it is in memory: memory_source.
/// Threads: any number may read.
class file_source {
public:
    /// @throws file_error if it cannot be opened; input_error if it is not a file but a folder or a pipe.
    explicit file_source(std::string path)
        : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        // O_NONBLOCK: a pipe that nobody writes would be waited for; to a file it is nothing.
        if (descriptor_ < 0) detail::raise_file_error("file_source", "open", path_, errno);
        struct stat about {};
        const bool known = ::fstat(descriptor_, &about) == 0;
        if (known && S_ISREG(about.st_mode)) {
            size_ = static_cast<std::uint64_t>(about.st_size);
            return;
        }
        ::close(descriptor_);
        detail::raise<input_error>("file_source", path_ + " is not a file", "give a file, no folder and no pipe");
    }
    file_source(const file_source&) = delete;
    file_source(file_source&& other) noexcept
        : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}
    file_source& operator=(file_source&& other) noexcept {
        std::swap(path_, other.path_);
        std::swap(descriptor_, other.descriptor_);
        std::swap(size_, other.size_);
        return *this;
    }
    ~file_source() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    [[nodiscard]] const std::string& name() const noexcept { return path_; }
    /// When it was opened [bytes].
    [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
    /// @throws file_error if the disk fails; input_error if the file has become shorter.
    void read(std::uint64_t offset, std::span<std::byte> to) const {
        constexpr std::size_t most = std::size_t{1} << 30;  // Linux reads fewer than 2^31 bytes in one call
        while (!to.empty()) {
            const auto got = ::pread(descriptor_, to.data(), (std::min)(to.size(), most), static_cast<off_t>(offset));
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) detail::raise_file_error("file_source", "read", path_, errno);
            if (got == 0)
                detail::raise<input_error>("file_source", path_ + " ends at byte " + std::to_string(offset),
                                           "it became shorter while it was read; do not change files in use");
            to = to.subspan(static_cast<std::size_t>(got));
            offset += static_cast<std::uint64_t>(got);
        }
    }

private:
    std::string path_;
    int descriptor_;
    std::uint64_t size_ = 0;
};
static_assert(byte_source<file_source>);

/// Bytes in memory, which the source does not own: of a message, of a test.
///
/// Concept: byte_source. Cost of a read: a copy. Deterministic: yes.
/// Choose it when what is to be read is in memory. Do not when it is a file: file_source reads no more than is asked for.
class memory_source {
public:
    explicit memory_source(std::span<const std::byte> bytes, std::string name = "memory")
        : bytes_(bytes), name_(std::move(name)) {}
    explicit memory_source(std::string_view text, std::string name = "memory")
        : memory_source(std::as_bytes(std::span(text)), std::move(name)) {}
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] std::uint64_t size() const noexcept { return bytes_.size(); }
    /// @throws input_error beyond the end.
    void read(std::uint64_t offset, std::span<std::byte> to) const {
        if (offset > bytes_.size() || to.size() > bytes_.size() - offset)
            detail::raise<input_error>("memory_source",
                                       name_ + " has " + std::to_string(bytes_.size()) + " bytes; asked for " +
                                           std::to_string(to.size()) + " from " + std::to_string(offset) + " on",
                                       "ask size() first");
        if (!to.empty()) std::memcpy(to.data(), bytes_.data() + offset, to.size());
    }

private:
    std::span<const std::byte> bytes_;
    std::string name_;
};
static_assert(byte_source<memory_source>);

}  // namespace tsubu
