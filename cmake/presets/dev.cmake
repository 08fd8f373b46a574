# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/dev.cmake -S . -B build/dev: for daily work, with everything that tests and editors need.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_EXPORT_COMPILE_COMMANDS ON CACHE BOOL "")
set(TSUBU_WITH_MPI ON CACHE BOOL "")
set(TSUBU_BUILD_TESTS ON CACHE BOOL "")
