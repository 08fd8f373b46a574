# SPDX-License-Identifier: MIT
# What tests and benches need beside the library; nothing is downloaded. tests/run and bench/run install it on Debian.
find_package(Threads REQUIRED)

# Catch2 3 or 2: tests/support/catch.hpp hides the difference.
if(TSUBU_BUILD_TESTS)
    find_package(Catch2 QUIET)
    if(NOT Catch2_FOUND)
        message(FATAL_ERROR "The tests need Catch2, version 2.13 or 3: install it (Debian: catch2), give its place in "
            "CMAKE_PREFIX_PATH, or set TSUBU_BUILD_TESTS=OFF")
    endif()
    find_package(Python3 COMPONENTS Interpreter REQUIRED) # cmake/layers.py
endif()

if(TSUBU_BUILD_BENCH)
    find_package(benchmark QUIET)
    if(NOT benchmark_FOUND)
        message(FATAL_ERROR "The benches need Google Benchmark: install it (Debian: libbenchmark-dev), give its place "
            "in CMAKE_PREFIX_PATH, or set TSUBU_BUILD_BENCH=OFF")
    endif()
endif()

# The rivals that bench/rivals wraps as policies: std always, the others where they are found.
add_library(tsubu_rivals INTERFACE)
target_include_directories(tsubu_rivals INTERFACE "${PROJECT_SOURCE_DIR}/bench")
target_link_libraries(tsubu_rivals INTERFACE tsubu::tsubu)
find_package(Boost 1.81 QUIET) # the first with unordered_flat_map
if(Boost_FOUND)
    target_link_libraries(tsubu_rivals INTERFACE Boost::headers)
    target_compile_definitions(tsubu_rivals INTERFACE TSUBU_RIVAL_BOOST=1)
endif()
find_package(absl QUIET)
if(TARGET absl::flat_hash_map)
    target_link_libraries(tsubu_rivals INTERFACE absl::flat_hash_map)
    target_compile_definitions(tsubu_rivals INTERFACE TSUBU_RIVAL_ABSL=1)
endif()
message(STATUS "Rivals: std::unordered_map, Boost ${Boost_VERSION} (${Boost_FOUND}), "
    "Abseil ${absl_VERSION} (${absl_FOUND})")
