# SPDX-License-Identifier: MIT
# cmake -DCOMPILER=... -DSOURCE=prefetch.cpp -DINCLUDE=... -P prefetch.cmake: the assembly of SOURCE has at least so
# many prefetch instructions for each storage. Compilers drop a prefetch that they take for an effectless call: no result
# shows it.
cmake_minimum_required(VERSION 3.25)
foreach(wanted IN ITEMS "dense_storage<>=1" "flat_storage<>=1" "bitmap_storage<>=2" "paged_storage<>=1"
        "chained_storage<tsubu::mixed>=1" "adaptive_storage<>=3")
    string(REGEX MATCH "^(.*)=([0-9]+)$" matched "${wanted}")
    set(storage ${CMAKE_MATCH_1})
    set(least ${CMAKE_MATCH_2})
    execute_process(
        COMMAND "${COMPILER}" -std=c++20 -O2 -I "${INCLUDE}" "-DSTORAGE=tsubu::${storage}" -S "${SOURCE}" -o -
        OUTPUT_VARIABLE assembly COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "[\t ](prefetch[a-z0-9]*|prfm)[\t ]" found "${assembly}")
    list(LENGTH found count)
    message("${storage}: ${count} prefetch instructions")
    if(count LESS least)
        message(FATAL_ERROR "fewer than ${least}: a prefetch was dropped")
    endif()
endforeach()
