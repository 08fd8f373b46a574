# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/ci.cmake -S . -B build/ci: what users compile, and every test.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(TSUBU_WITH_MPI ON CACHE BOOL "")
set(TSUBU_BUILD_TESTS ON CACHE BOOL "")
