# SPDX-License-Identifier: MIT
# add_compile_fail_test(FILE CASE WORDS [FLAG ...]): FILE with -DCASE=<n> must not compile, and the compiler must print
# WORDS (a regular expression that occurs neither in the path nor in the source). FILE without CASE is the control:
# it must compile without a warning. The compiler is called directly: no target, no lock, only -fsyntax-only.
if(CMAKE_SCRIPT_MODE_FILE)
    cmake_minimum_required(VERSION 3.25)
    separate_arguments(command UNIX_COMMAND "${COMMAND}")
    execute_process(COMMAND ${command} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    message("${output}")
    if(NOT WORDS)
        if(NOT result EQUAL 0)
            message(FATAL_ERROR "the control does not compile")
        endif()
    elseif(result EQUAL 0)
        message(FATAL_ERROR "it compiles, but must not")
    elseif(NOT output MATCHES "${WORDS}")
        message(FATAL_ERROR "the compiler refuses it, but does not print: ${WORDS}")
    endif()
    return()
endif()

set(compile_fail_script "${CMAKE_CURRENT_LIST_FILE}")

function(add_compile_fail_command name words)
    set(command "${CMAKE_CXX_COMPILER} -std=c++20 -fsyntax-only ${TSUBU_STRICT_FLAGS}")
    string(APPEND command " -I \"${PROJECT_SOURCE_DIR}/include\" ${ARGN}")
    add_test(NAME "${name}" COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=${command}" "-DWORDS=${words}"
        -P "${compile_fail_script}")
    set_tests_properties("${name}" PROPERTIES LABELS compile_fail TIMEOUT 120)
endfunction()

function(add_compile_fail_test file case words)
    cmake_path(ABSOLUTE_PATH file OUTPUT_VARIABLE source)
    cmake_path(GET file STEM stem)
    add_compile_fail_command("compile_fail.${stem}.${case}" "${words}" "${ARGN} -DCASE=${case} \"${source}\"")
    if(NOT TEST "compile_fail.${stem}.control")
        add_compile_fail_command("compile_fail.${stem}.control" "" "\"${source}\"")
    endif()
endfunction()
