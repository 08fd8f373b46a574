# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/ci.cmake -S . -B build/ci: what users compile, and every test.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "") # -O3 takes a third longer to compile
set(TSUBU_WITH_MPI ON CACHE BOOL "")
set(TSUBU_BUILD_TESTS ON CACHE BOOL "")
