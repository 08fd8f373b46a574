# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/bench.cmake -S . -B build/bench: the flags that the published figures are measured with.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "") # plain -O2: what the crowd compiles with; no -march
set(TSUBU_BUILD_TESTS OFF CACHE BOOL "")
set(TSUBU_BUILD_BENCH ON CACHE BOOL "")
# bench_comm needs MPI; the other programs do without.
find_program(TSUBU_BENCH_MPICXX mpicxx)
find_program(TSUBU_BENCH_MPIEXEC mpiexec)
if(TSUBU_BENCH_MPICXX AND TSUBU_BENCH_MPIEXEC)
    set(TSUBU_WITH_MPI ON CACHE BOOL "" FORCE) # MPI may have come since this folder was first configured
endif()
