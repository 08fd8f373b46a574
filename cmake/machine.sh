# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Sourced by tests/run, bench/run and bench/scene after packages.sh: what all three need, and how they use this machine.

absolute() { # a path as the user gave it, from where the program was started
    case $1 in /*) printf '%s' "$1" ;; *) printf '%s/%s' "$start" "$1" ;; esac
}
compiler_named() { case $1 in */*) absolute "$1" ;; *) printf '%s' "$1" ;; esac; } # a name, or a path
default_compiler() { if have g++ || ! have clang++; then printf g++; else printf clang++; fi; }

need_build_tools() {
    need "CMake 3.25 or later" cmake "https://cmake.org/download, or: pip install cmake" cmake_is_new_enough
    need "Ninja or make" "ninja-build|make" "https://ninja-build.org" eval 'have ninja || have make'
}
need_compiler() { # compiler
    need "$1 with C++20" "$(compiler_package "$1")" "g++ 12 or clang 14, or later" compiles_cxx20 "$1"
}
need_benchmark() { # compiler
    need "Google Benchmark" libbenchmark-dev "https://github.com/google/benchmark" \
        has_header benchmark/benchmark.h "$1"
}
has_mpi() { have mpicxx && have mpiexec; }
ask_for_mpi() { # need or want
    "$1" "an MPI library" libopenmpi-dev "https://www.open-mpi.org, or MPICH" have mpicxx
    "$1" "mpiexec" openmpi-bin "comes with the MPI library" have mpiexec
}
# In the first python in PATH, or in that of the system, where packages put it: whatever imports it looks into both.
has_module() { # module of Python
    python3 -c "import $1" || /usr/bin/python3 -c "import $1"
}
ask_for_matplotlib() { # need or want
    # munkres: without it Debian 12 takes SciPy, whose Boost is in the way of a newer one.
    "$1" "matplotlib for Python 3" python3-munkres+python3-matplotlib "pip install matplotlib" \
        has_module matplotlib
}

# As cmake/mpi_test.cmake has it: only Open MPI's launcher knows these two options, and needs them in containers.
is_open_mpi() { mpiexec --version 2>&1 | grep -qE 'Open MPI|OpenRTE|PRTE'; }
launcher_of_this_machine() {
    printf mpiexec
    ! is_open_mpi || printf ' --allow-run-as-root --oversubscribe'
}
jobs_of_this_machine() { nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || printf 2; }
# The generator may be chosen only when a build directory is new.
generator_for() { [ -e "$1/CMakeCache.txt" ] || ! have ninja || printf -- '-GNinja'; }
