// SPDX-License-Identifier: MIT
/// @file
/// All of tsubu, with HDF5: for whoever links tsubu::hdf5; inside the library nobody includes this header.
#pragma once

#include <tsubu/tsubu.hpp>

#include <tsubu/io/h5md_options.hpp>
#include <tsubu/io/h5md_reader.hpp>
#include <tsubu/io/h5md_writer.hpp>
