// SPDX-License-Identifier: MIT
/// @file
/// mpi_environment: MPI from here to the end of the block.
#pragma once

#include <tsubu/comm/detail/include_mpi.hpp>
#include <tsubu/comm/mpi_error.hpp>

#include <exception>  // std::uncaught_exceptions

namespace tsubu {

/// Starts MPI, unless it is running, and ends what it has started.
///
///     int main(int argc, char** argv) {
///         const tsubu::mpi_environment mpi(argc, argv);
///         tsubu::mpi_transport on(MPI_COMM_WORLD);
///
/// If the block is left by an exception that the program catches further out, all ranks are aborted: they might wait
/// for this one for ever. One that nobody catches ends the process, and so mpirun the others.
class mpi_environment {
public:
    /// @throws mpi_error
    mpi_environment(int& argc, char**& argv) {
        int running = 0;
        detail::check_mpi(MPI_Initialized(&running), "MPI_Initialized");
        if (running != 0) return;
        int provided = 0;
        detail::check_mpi(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
        is_ours_ = true;
    }
    mpi_environment(const mpi_environment&) = delete;
    mpi_environment& operator=(const mpi_environment&) = delete;
    ~mpi_environment() {
        if (!is_ours_) return;
        if (std::uncaught_exceptions() > exceptions_)
            MPI_Abort(MPI_COMM_WORLD, 1);
        else
            MPI_Finalize();
    }

private:
    int exceptions_ = std::uncaught_exceptions();
    bool is_ours_ = false;
};

}  // namespace tsubu
