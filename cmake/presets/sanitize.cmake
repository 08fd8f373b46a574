# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/sanitize.cmake -S . -B build/sanitize: preconditions, address and undefined sanitizers on.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(TSUBU_SANITIZE "address,undefined" CACHE STRING "")
set(TSUBU_WITH_MPI ON CACHE BOOL "")
set(TSUBU_BUILD_TESTS ON CACHE BOOL "")
