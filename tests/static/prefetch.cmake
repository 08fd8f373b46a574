# SPDX-License-Identifier: MIT
# cmake -DCOMPILER=... -DSOURCE=prefetch.cpp -DINCLUDE=... -DPREFETCHES=n -P prefetch.cmake: the assembly of SOURCE has
# at least n prefetch instructions. Compilers drop a prefetch that they take for an effectless call: no result shows it.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND "${COMPILER}" -std=c++20 -O2 -I "${INCLUDE}" -S "${SOURCE}" -o - OUTPUT_VARIABLE assembly
    COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[\t ](prefetch[a-z0-9]*|prfm)[\t ]" found "${assembly}")
list(LENGTH found count)
message("${count} prefetch instructions")
if(count LESS PREFETCHES)
    message(FATAL_ERROR "fewer than ${PREFETCHES}: a prefetch was dropped")
endif()
