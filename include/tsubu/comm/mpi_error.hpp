// SPDX-License-Identifier: MIT
/// @file
/// What tsubu throws when MPI reports an error.
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/core/error.hpp>

#include <cstddef>  // std::size_t
#include <string>   // std::string
#include <utility>  // std::move

namespace tsubu {

/// An MPI function returned an error: which function, the class of the error, and MPI's own words.
///
/// The other ranks may not have seen it, and may wait inside the same collective: after this exception a program can
/// save what it holds and call MPI_Abort, no more.
class mpi_error : public error {
public:
    mpi_error(std::string call, int error_class, std::string text)
        : error("tsubu::mpi_error: " + call + ": " + text + "; end the program, this communicator is beyond use"),
          call_(std::move(call)),
          text_(std::move(text)),
          error_class_(error_class) {}

    /// The MPI function, e.g. "MPI_Alltoallv".
    [[nodiscard]] const std::string& call() const noexcept { return call_; }
    /// MPI_ERR_COMM, MPI_ERR_TRUNCATE, ...
    [[nodiscard]] int error_class() const noexcept { return error_class_; }
    /// MPI_Error_string of the code that was returned.
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    std::string call_;
    std::string text_;
    int error_class_;
};

namespace detail {

/// Throws mpi_error unless code is MPI_SUCCESS. Only useful where the communicator returns errors (own_communicator).
inline void check_mpi(int code, const char* call) {
    if (code == MPI_SUCCESS) [[likely]]
        return;
    int error_class = MPI_ERR_UNKNOWN;
    MPI_Error_class(code, &error_class);
    std::string text(MPI_MAX_ERROR_STRING, '\0');
    int length = 0;
    MPI_Error_string(code, text.data(), &length);
    text.resize(static_cast<std::size_t>(length));
    throw mpi_error(call, error_class, std::move(text));
}

}  // namespace detail
}  // namespace tsubu
