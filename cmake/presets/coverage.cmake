# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/coverage.cmake -S . -B build/coverage: tests/run --coverage. clang's own counters, not gcov's:
# they count each branch that is written, none that an exception makes, and functions that no program calls too.
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
set(CMAKE_BUILD_TYPE Debug CACHE STRING "") # preconditions on
# The relocated counters are a file in memory (%c in LLVM_PROFILE_FILE): what a program that aborts has run counts too.
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -fprofile-instr-generate -fcoverage-mapping -mllvm -runtime-counter-relocation"
    CACHE STRING "")
set(CMAKE_EXE_LINKER_FLAGS_DEBUG "-Wno-unused-command-line-argument" CACHE STRING "") # linking takes no -mllvm
set(TSUBU_WITH_MPI ON CACHE BOOL "")
set(TSUBU_BUILD_TESTS ON CACHE BOOL "")
