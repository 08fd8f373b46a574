// SPDX-License-Identifier: MIT
/// @file
/// file_error: the system refuses what was asked of a file.
#pragma once

#include <tsubu/core/error.hpp>

#include <cerrno>        // ENOENT, ENOSPC ...
#include <string>        // std::string
#include <string_view>   // std::string_view
#include <system_error>  // std::generic_category: its text, which unlike strerror's is not shared by threads

namespace tsubu {

/// A file cannot be opened, read, written or renamed; the message has its name, the system's words and the remedy.
class file_error : public error {
public:
    file_error(const std::string& what, int code) : error(what), code_(code) {}
    /// The errno of the call that failed.
    [[nodiscard]] int code() const noexcept { return code_; }

private:
    int code_;
};

namespace detail {

/// @param makes  whether the call was to make the file
[[nodiscard]] inline const char* file_remedy(int code, bool makes) noexcept {
    switch (code) {
        case ENOENT: return makes ? "check the name, and make the folder first" : "check the name and the folder";
        case ENOTDIR: return "a part of the path is a file where a folder should be; check the name";
        case EISDIR: return "there is a folder with this name; give the name of a file";
        case EACCES:
        case EPERM:
        case EROFS: return "take a folder and a file that you are allowed to use";
        case ENOSPC:
        case EDQUOT: return "free some space, or write to another disk";
        case EFBIG: return "raise the limit of file sizes (ulimit -f), or write to another file system";
        case EMFILE:
        case ENFILE: return "close some files, or raise their limit (ulimit -n)";
        case ENAMETOOLONG: return "give a shorter name";
        default: return "check the disk and the file system";
    }
}

/// @param doing  "open", "write" ...; "make" where the file is not there yet
[[noreturn, gnu::cold]] inline void raise_file_error(const char* where, std::string_view doing,
                                                     const std::string& path, int code) {
    throw file_error("tsubu::" + std::string(where) + ": cannot " + std::string(doing) + " " + path + ": " +
                         std::generic_category().message(code) + "; " + file_remedy(code, doing == "make"),
                     code);
}

}  // namespace detail
}  // namespace tsubu
