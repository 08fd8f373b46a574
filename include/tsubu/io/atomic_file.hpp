// SPDX-License-Identifier: MIT
/// @file
/// atomic_file: a file that is there whole, or not at all.
#pragma once

#include <tsubu/core/expects.hpp>
#include <tsubu/io/file_error.hpp>

#include <algorithm>    // std::min
#include <atomic>       // std::atomic
#include <cerrno>       // errno
#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::uint64_t
#include <cstdio>       // rename
#include <span>         // std::span
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::exchange, std::move, std::swap

#include <fcntl.h>     // open
#include <sys/stat.h>  // fstat
#include <unistd.h>    // close, fsync, getpid, pwrite, unlink

namespace tsubu {

/// A file that exists, to be written at any place by any number of writers.
///
/// Not copyable; the file is closed with the object. Threads: several may write different places.
class file_writer {
public:
    /// @throws file_error if it does not exist or may not be written.
    explicit file_writer(const std::string& path) : file_writer(path, path, 0, "open") {}
    file_writer(const file_writer&) = delete;
    file_writer(file_writer&& other) noexcept
        : path_(std::move(other.path_)),
          name_(std::move(other.name_)),
          descriptor_(std::exchange(other.descriptor_, -1)) {}
    file_writer& operator=(file_writer&& other) noexcept {
        std::swap(path_, other.path_);
        std::swap(name_, other.name_);
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~file_writer() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// Writes these bytes from this place on. @throws file_error if the disk is full, or fails.
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
        TSUBU_EXPECTS(descriptor_ >= 0, "this file is closed; write before commit()");
        constexpr std::size_t most = std::size_t{1} << 30;  // Linux writes fewer than 2^31 bytes in one call
        while (!bytes.empty()) {
            const auto written =
                ::pwrite(descriptor_, bytes.data(), (std::min)(bytes.size(), most), static_cast<off_t>(offset));
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) detail::raise_file_error("file_writer", "write", name_, written < 0 ? errno : ENOSPC);
            bytes = bytes.subspan(static_cast<std::size_t>(written));
            offset += static_cast<std::uint64_t>(written);
        }
    }
    /// How long the file is, whoever wrote it [bytes].
    [[nodiscard]] std::uint64_t size() const {
        struct stat about {};
        if (::fstat(descriptor_, &about) != 0) detail::raise_file_error("file_writer", "ask the size of", name_, errno);
        return static_cast<std::uint64_t>(about.st_size);
    }
    /// Waits until the disk has what was written, and closes the file.
    void close() {
        if (descriptor_ < 0) return;
        const bool synced = ::fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOTSUP;  // not all devices can
        const int code = errno;
        const bool closed = ::close(std::exchange(descriptor_, -1)) == 0;
        if (!synced || !closed) detail::raise_file_error("file_writer", "write", name_, synced ? errno : code);
    }

private:
    friend class atomic_file;
    file_writer(std::string path, std::string name, int flags, const char* doing)
        : path_(std::move(path)),
          name_(std::move(name)),
          descriptor_(::open(path_.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666)) {
        if (descriptor_ < 0 && errno != EEXIST) detail::raise_file_error("file_writer", doing, name_, errno);
    }

    std::string path_;
    std::string name_;  // what messages call it: of a temporary file the name that it is to have
    int descriptor_;
};

/// Writes a file under another name beside it, which becomes its own when it is whole. Readers see the old file or the
/// new one; if anything is thrown before commit(), the old one stays and nothing else is left.
///
///     tsubu::atomic_file file("run.restart");
///     file.append(std::as_bytes(std::span(words)));
///     file.commit();
///
/// A process that is killed leaves run.restart.<process>-<number>.partial behind. A link is replaced, not followed.
///
/// Threads: one.
class atomic_file {
public:
    /// @throws file_error if the folder does not exist or may not be written.
    explicit atomic_file(std::string path) : path_(std::move(path)), writer_(fresh(path_)) {}
    atomic_file(const atomic_file&) = delete;
    atomic_file& operator=(const atomic_file&) = delete;
    ~atomic_file() {
        if (!committed_) ::unlink(writer_.path().c_str());
    }

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// The name until commit(): what other ranks open as file_writer to write their parts.
    [[nodiscard]] const std::string& temporary_path() const noexcept { return writer_.path(); }
    [[nodiscard]] file_writer& writer() noexcept { return writer_; }
    /// Writes after what was appended before. @throws file_error
    void append(std::span<const std::byte> bytes) {
        writer_.write_at(appended_, bytes);
        appended_ += bytes.size();
    }
    void append(std::string_view text) { append(std::as_bytes(std::span(text.data(), text.size()))); }
    /// How much was appended [bytes].
    [[nodiscard]] std::uint64_t appended() const noexcept { return appended_; }
    /// The file gets its name, and replaces what had it, once the disk has all of it. @throws file_error; the old file
    /// is as before then.
    void commit() {
        writer_.close();
        if (::rename(writer_.path().c_str(), path_.c_str()) != 0)
            detail::raise_file_error("atomic_file", "give its name to", path_, errno);
        committed_ = true;
        sync_folder();
    }

private:
    [[noreturn]] static void raise_unless_file(const std::string& path, bool is_folder) {
        if (is_folder) detail::raise_file_error("atomic_file", "write", path, EISDIR);
        detail::raise<input_error>("atomic_file", path + " is a pipe or a device, and would be replaced by a file",
                                   "give the name of a file");
    }
    [[nodiscard]] static file_writer fresh(const std::string& path) {
        struct stat about {};
        if (::lstat(path.c_str(), &about) == 0 && !S_ISREG(about.st_mode) && !S_ISLNK(about.st_mode))
            raise_unless_file(path, S_ISDIR(about.st_mode));
        static std::atomic<unsigned> last = 0;
        constexpr int tries = 1000;  // each is a file of a process of the same number, on another machine or long ago
        for (int k = 0; k < tries; ++k) {
            file_writer writer(path + "." + std::to_string(::getpid()) + "-" + std::to_string(++last) + ".partial",
                               path, O_CREAT | O_EXCL, "make");
            if (writer.descriptor_ >= 0) return writer;
        }
        detail::raise_file_error("atomic_file", "make a temporary file beside", path, EEXIST);
    }
    /// So that the new name outlives a failure of power; where folders cannot be synced, it is as good as it gets.
    void sync_folder() const noexcept {
        const auto slash = path_.rfind('/');
        const auto folder = slash == std::string::npos ? std::string(".") : path_.substr(0, slash + 1);
        const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) return;
        static_cast<void>(::fsync(descriptor));
        ::close(descriptor);
    }

    std::string path_;
    file_writer writer_;
    std::uint64_t appended_ = 0;
    bool committed_ = false;
};

}  // namespace tsubu
