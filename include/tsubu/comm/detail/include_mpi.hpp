// SPDX-License-Identifier: MIT
/// @file
/// The one place that includes <mpi.h>.
#pragma once

// Without the C++ bindings that MPI 3.0 removed: with them <mpi.h> is 37 000 lines instead of 2 000. The target
// tsubu::mpi says so by its flags as well, for whoever includes <mpi.h> first.
#if !defined(OMPI_SKIP_MPICXX)
#define OMPI_SKIP_MPICXX 1
#endif
#if !defined(MPICH_SKIP_MPICXX)
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#if MPI_VERSION < 3
#error "tsubu::mpi needs MPI 3.0 or later"
#endif
