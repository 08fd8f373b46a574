// SPDX-License-Identifier: MIT
/// @file
/// file_sink: a file that is there whole, or not at all.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/io/text_sink.hpp>

#include <cerrno>       // errno
#include <cstdio>       // std::fopen, std::remove, std::rename
#include <cstring>      // std::strerror
#include <string>       // std::string
#include <string_view>  // std::string_view
#include <utility>      // std::exchange, std::move

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>  // fsync
#endif

namespace tsubu {

/// Writes to `path`.part, and renames it to `path` at commit(): who reads `path` never sees half a file, and what was
/// there before stays if anything fails.
///
///     tsubu::file_sink out("grains.lmp");
///     out("LAMMPS ...");
///     out.commit();
///
/// Concept: text_sink. Choose it for files that others read. Do not when the file is written by many ranks at once.
class file_sink {
public:
    /// @throws input_error if the file cannot be made; the message says why. So do all members.
    explicit file_sink(std::string path) : path_(std::move(path)), part_(path_ + ".part") {
        file_ = std::fopen(part_.c_str(), "wb");
        if (file_ == nullptr) fail("cannot be made");
        std::setvbuf(file_, nullptr, _IONBF, 0);  // chunks are large: a second buffer would only copy
    }
    file_sink(const file_sink&) = delete;
    file_sink& operator=(const file_sink&) = delete;
    /// Without commit() nothing is left of the file.
    ~file_sink() {
        if (file_ == nullptr) return;
        static_cast<void>(std::fclose(file_));
        static_cast<void>(std::remove(part_.c_str()));
    }

    void operator()(std::string_view text) {
        if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot be written");
    }
    /// Waits until the system has the file on its medium, then gives it its name.
    void commit() {
#if defined(__unix__) || defined(__APPLE__)
        if (::fsync(::fileno(file_)) != 0 && errno != EINVAL && errno != ENOTSUP) fail("cannot be written");
#endif
        if (std::fclose(std::exchange(file_, nullptr)) != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) {
            const auto reason = errno;
            static_cast<void>(std::remove(part_.c_str()));
            errno = reason;
            fail("cannot be written");
        }
    }

private:
    [[noreturn]] void fail(const char* what) const {
        detail::raise<input_error>("file_sink", path_ + " " + what + ": " + std::strerror(errno),
                                   "choose a place with room that can be written");
    }

    std::string path_;
    std::string part_;
    std::FILE* file_ = nullptr;
};

}  // namespace tsubu
