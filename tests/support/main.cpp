// SPDX-License-Identifier: MIT
/// @file
/// main of the tests without MPI.
#define CATCH_CONFIG_RUNNER  // version 2: this file holds the framework; version 3 links it
#include "catch.hpp"

int main(int argc, char** argv) { return Catch::Session().run(argc, argv); }
