// SPDX-License-Identifier: MIT
/// @file
/// All of tsubu, with MPI: for whoever links tsubu::mpi; inside the library nobody includes this header.
#pragma once

#include <tsubu/tsubu.hpp>

#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/comm/mpi_error.hpp>
#include <tsubu/comm/mpi_transport.hpp>
