// SPDX-License-Identifier: MIT
/// @file
/// The one place that includes <hdf5.h>; its objects, closed when they go, and its errors as exceptions.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/io/file_error.hpp>

#include <cerrno>   // EAGAIN
#include <cstdlib>  // std::atoi
#include <string>   // std::string
#include <utility>  // std::exchange, std::move, std::swap

#include <hdf5.h>

#if H5_VERSION_LE(1, 10, 1)
#error "tsubu::hdf5 needs HDF5 1.10.2 or later"
#endif

namespace tsubu::detail {

/// HDF5 prints nothing of its own while one of these is there: what fails is thrown.
class quiet_hdf5 {
public:
    quiet_hdf5() noexcept : known_(H5Eget_auto2(H5E_DEFAULT, &print_, &printed_) >= 0) {
        if (known_) H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    quiet_hdf5(const quiet_hdf5&) = delete;
    quiet_hdf5& operator=(const quiet_hdf5&) = delete;
    ~quiet_hdf5() {
        if (known_) H5Eset_auto2(H5E_DEFAULT, print_, printed_);
    }

private:
    H5E_auto2_t print_ = nullptr;
    void* printed_ = nullptr;
    bool known_;
};

/// An object of HDF5, whatever its kind; it is closed with this one.
class hdf5_object {
public:
    hdf5_object() = default;
    explicit hdf5_object(hid_t number) noexcept : number_(number) {}
    hdf5_object(hdf5_object&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    hdf5_object& operator=(hdf5_object other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~hdf5_object() {
        if (number_ < 0) return;
        const quiet_hdf5 quiet;
        H5Idec_ref(number_);
    }

    [[nodiscard]] hid_t get() const noexcept { return number_; }
    [[nodiscard]] explicit operator bool() const noexcept { return number_ >= 0; }
    [[nodiscard]] hid_t release() noexcept { return std::exchange(number_, -1); }

private:
    hid_t number_ = -1;
};

/// What HDF5 says of its last failure: the words of its innermost function, and the errno in them.
struct hdf5_reason {
    std::string words;
    int code = 0;
};
[[nodiscard]] inline hdf5_reason last_hdf5_reason() {
    hdf5_reason reason;
    const auto visit = [](unsigned, const H5E_error2_t* at, void* to) -> herr_t {
        auto& found = *static_cast<hdf5_reason*>(to);
        if (at->desc == nullptr) return 0;
        try {  // nothing may be thrown through C
            found.words = at->desc;
        } catch (...) {
            return -1;
        }
        const auto at_code = found.words.find("errno = ");
        if (at_code != std::string::npos) found.code = std::atoi(found.words.c_str() + at_code + 8);
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, visit, &reason);
    H5Eclear2(H5E_DEFAULT);
    return reason;
}

/// Of the file, or of an object in it.
/// @param doing  "open", "write" ...
[[noreturn, gnu::cold]] inline void raise_hdf5(const char* where, const char* doing, const std::string& path,
                                               const std::string& object = {}) {
    const auto [words, code] = last_hdf5_reason();
    const auto what = object.empty() ? path : path + ": " + object;
    if (code == EAGAIN)
        throw file_error("tsubu::" + std::string(where) + ": cannot " + doing + " " + what +
                             ": another program has it open; wait until it closes the file",
                         code);
    if (code != 0) raise_file_error(where, doing, what, code);
    raise<input_error>(where, "cannot " + std::string(doing) + " " + what + ": HDF5 says: " + words,
                       "check that the file is whole");
}

/// A file of HDF5, with what its errors say.
class hdf5_file {
public:
    hdf5_file(const char* where, std::string path) : where_(where), path_(std::move(path)) {}

    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    [[nodiscard]] hid_t get() const noexcept { return file_.get(); }
    [[nodiscard]] bool is_open() const noexcept { return static_cast<bool>(file_); }
    void take(hid_t number, const char* doing) { file_ = object(number, doing, {}); }
    [[nodiscard]] hid_t release() noexcept { return file_.release(); }

    /// Throws if the call of HDF5 has failed. @return what it has returned.
    template <class Result>
    Result checked(Result result, const char* doing, const std::string& object) const {
        if (result < 0) raise_hdf5(where_, doing, path_, object);
        return result;
    }
    [[nodiscard]] hdf5_object object(hid_t number, const char* doing, const std::string& name) const {
        return hdf5_object(checked(number, doing, name));
    }
    [[noreturn]] void refuse(const std::string& object, const std::string& what, const char* remedy) const {
        raise<input_error>(where_, path_ + ": " + (object.empty() ? "" : object + ": ") + what, remedy);
    }

private:
    const char* where_;
    std::string path_;
    hdf5_object file_;
};

}  // namespace tsubu::detail
