# SPDX-License-Identifier: MIT
# Every rank must find the same owners, also if it was compiled otherwise: SOURCE is built with COMPILER with and without
# fused multiply-add, optimised and not, and each program must print what EXPECTED holds, whatever the compiler.
cmake_minimum_required(VERSION 3.25)
set(variants "-O0 -ffp-contract=off" "-O2")
execute_process(COMMAND "${COMPILER}" -mfma -E -x c++ /dev/null RESULT_VARIABLE no_fma OUTPUT_QUIET ERROR_QUIET)
file(READ /proc/cpuinfo cpu)
if(no_fma EQUAL 0 AND cpu MATCHES " fma")
    list(APPEND variants "-O1 -mfma -ffp-contract=off" "-O2 -mfma -ffp-contract=fast")
endif()
file(READ "${EXPECTED}" expected)
foreach(variant IN LISTS variants)
    separate_arguments(flags UNIX_COMMAND "${variant}")
    execute_process(COMMAND "${COMPILER}" -std=c++20 ${flags} -I "${INCLUDE}" "${SOURCE}" -o "${PROGRAM}"
        COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND "${PROGRAM}" OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
    if(NOT printed STREQUAL expected)
        message("${printed}")
        message(FATAL_ERROR "with ${variant} some points have other owners than ${EXPECTED} says")
    endif()
    message("${variant}: as expected")
endforeach()
