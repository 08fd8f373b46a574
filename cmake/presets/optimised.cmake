# SPDX-License-Identifier: MIT
# cmake -C cmake/presets/optimised.cmake -S . -B build/optimised: the sanitizers over optimised code. Such code has
# other faults than that of Debug: a compiler once lost half of a vector mask in it, and nowhere else.
include(${CMAKE_CURRENT_LIST_DIR}/sanitize.cmake)
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g" CACHE STRING "")
