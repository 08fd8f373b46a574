// SPDX-License-Identifier: MIT
/// @file
/// Space on the disk for what HDF5 is going to write.
#pragma once

#include <tsubu/io/file_error.hpp>

#include <cerrno>   // EFBIG, EINTR, ENOSPC ...
#include <cstdint>  // std::uint64_t
#include <string>   // std::string

#include <fcntl.h>         // fallocate, open
#include <sys/resource.h>  // getrlimit
#include <sys/stat.h>      // fstat
#include <unistd.h>        // close, unlink

namespace tsubu::detail {

// HDF5 cannot go on, nor be closed, after the disk was full: the file that is there cannot be opened again, and
// HDF5 1.10 crashes when the program ends. So the space is asked for in front, where all can be refused and nothing is
// lost.

/// Asks for this space at the end of a file, whose size stays. Where the file system or the system cannot, nothing is
/// done.
/// @param descriptor  open for writing
/// @throws file_error if there is none.
inline void reserve_disk_space(const char* where, const std::string& path, int descriptor, std::uint64_t end,
                         std::uint64_t bytes) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && end + bytes > limit.rlim_cur)
        raise_file_error(where, "write", path, EFBIG);
#if defined(__linux__)
    while (::fallocate(descriptor, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(end), static_cast<off_t>(bytes)) != 0) {
        const int code = errno;
        if (code == ENOSPC || code == EDQUOT || code == EFBIG) raise_file_error(where, "write", path, code);
        if (code != EINTR) return;
    }
#else
    static_cast<void>(descriptor);
#endif
}
/// Gives back what was reserved beyond the end of a file.
inline void return_disk_space(const std::string& path) noexcept {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    struct stat about {};
    if (::fstat(descriptor, &about) == 0) static_cast<void>(::ftruncate(descriptor, about.st_size) == 0);
    ::close(descriptor);
}
/// Makes an empty file, with space for so much; or looks whether a file that is to be replaced may be, with as much.
/// @throws file_error; nothing is left then, and an old file is as before.
inline void make_with_disk_space(const char* where, const std::string& path, bool replace, std::uint64_t bytes) {
    bool is_fresh = true;
    int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL, 0666);
    if (descriptor < 0 && errno == EEXIST && replace) {
        is_fresh = false;
        descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    }
    if (descriptor < 0) {
        const int code = errno;
        if (code == EEXIST)
            throw file_error("tsubu::" + std::string(where) + ": cannot make " + path +
                                 ": it exists; take another name, or set h5md_options.replace",
                             code);
        raise_file_error(where, "make", path, code);
    }
    try {
        struct stat about {};
        const auto size = ::fstat(descriptor, &about) == 0 ? static_cast<std::uint64_t>(about.st_size) : 0;
        reserve_disk_space(where, path, descriptor, size, bytes);
    } catch (...) {
        ::close(descriptor);
        if (is_fresh)
            ::unlink(path.c_str());
        else
            return_disk_space(path);
        throw;
    }
    ::close(descriptor);
}

}  // namespace tsubu::detail
