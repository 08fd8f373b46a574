// SPDX-License-Identifier: MIT
/// @file
/// The one place that includes <mpi.h>.
#pragma once

// That the C++ bindings stay out is decided by the flags of the target tsubu::mpi; a macro here would be too late
// for whoever includes <mpi.h> first.
#include <mpi.h>

#if MPI_VERSION < 3
#error "tsubu::mpi needs MPI 3.0 or later"
#endif
