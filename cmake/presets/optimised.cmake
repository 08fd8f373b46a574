# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/optimised.cmake -S . -B build/optimised: the sanitizers over optimised code, which has faults
# that Debug has not: GCC 12 spills a vector mask as 16 bits and reads 32 (core/mask_number.hpp).
include(${CMAKE_CURRENT_LIST_DIR}/sanitize.cmake)
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g" CACHE STRING "")
