// SPDX-License-Identifier: MIT
/// @file
/// A communicator of our own: the caller's messages, error handler and attributes are never touched.
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/comm/mpi_error.hpp>
#include <tsubu/core/error.hpp>

#include <exception>  // std::uncaught_exceptions

namespace tsubu::detail {

/// A duplicate of a communicator that returns errors instead of aborting, freed with the object.
/// Collective: construction and destruction, over the communicator.
class own_communicator {
public:
    /// @throws input_error before any message if MPI is not running, or `of` is null or an intercommunicator.
    explicit own_communicator(MPI_Comm of, const char* where) {
        int running = 0;
        int ended = 0;
        MPI_Initialized(&running);
        MPI_Finalized(&ended);
        if (running == 0 || ended != 0)
            raise<input_error>(where, "MPI is not running",
                               "make a tsubu::mpi_environment first, or call it between MPI_Init and MPI_Finalize");
        if (of == MPI_COMM_NULL) raise<input_error>(where, "the communicator is null", "pass one of this rank's own");
        int inter = 0;
        check_mpi(MPI_Comm_test_inter(of, &inter), "MPI_Comm_test_inter");
        if (inter != 0)
            raise<input_error>(where, "the communicator is an intercommunicator", "merge it with MPI_Intercomm_merge");
        check_mpi(MPI_Comm_dup(of, &own_), "MPI_Comm_dup");
        MPI_Comm_set_errhandler(own_, MPI_ERRORS_RETURN);
        MPI_Comm_size(own_, &size_);
        MPI_Comm_rank(own_, &rank_);
    }
    own_communicator(const own_communicator&) = delete;
    own_communicator& operator=(const own_communicator&) = delete;
    /// Where the block is left by an exception other ranks may never come to free theirs: then it stays.
    ~own_communicator() {
        if (std::uncaught_exceptions() == exceptions_) MPI_Comm_free(&own_);
    }

    [[nodiscard]] MPI_Comm get() const noexcept { return own_; }
    [[nodiscard]] int size() const noexcept { return size_; }
    [[nodiscard]] int rank() const noexcept { return rank_; }

private:
    MPI_Comm own_ = MPI_COMM_NULL;
    int size_ = 0;
    int rank_ = 0;
    int exceptions_ = std::uncaught_exceptions();
};

}  // namespace tsubu::detail
