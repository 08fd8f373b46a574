# SPDX-License-Identifier: MIT
# cmake -DCOMPILER=... -DSOURCE=needed.cpp -DINCLUDE=... -P needed.cmake: what a scene does not need is not computed. Read
# off the assembly: a frictionless contact has one root and one quotient for each place where its shape is computed, and
# no more; a plane has less arithmetic than space, and each part of a law adds to it.
cmake_minimum_required(VERSION 3.25)
function(count_arithmetic name dimension law)
    execute_process(
        COMMAND "${COMPILER}" -std=c++20 -O2 -DNDEBUG -I "${INCLUDE}" "-DDIMENSION=${dimension}" "-DLAW=${law}" -S
            "${SOURCE}" -o -
        OUTPUT_VARIABLE assembly COMMAND_ERROR_IS_FATAL ANY)
    foreach(kind IN ITEMS sqrt div mul)
        string(REGEX MATCHALL "[\t ]v?${kind}[ps][ds][\t ]" found "${assembly}")
        list(LENGTH found count)
        set(${name}_${kind} ${count} PARENT_SCOPE)
        string(APPEND counts " ${count} ${kind}")
    endforeach()
    message("${dimension}-D ${law}:${counts}")
endfunction()
function(expect condition)
    string(REPLACE " " ";" parts "${condition}")
    if(NOT (${parts}))
        message(FATAL_ERROR "not so: ${condition}")
    endif()
endfunction()

count_arithmetic(space 3 "hooke<>")
count_arithmetic(plane 2 "hooke<>")
count_arithmetic(line 1 "hooke<>")
count_arithmetic(damped 3 "hooke_dashpot<>")
count_arithmetic(coulomb 3 "hooke_dashpot<dem::coulomb>")
count_arithmetic(history 3 "hooke_dashpot<dem::linear_history>")
count_arithmetic(rolling 3 "hooke_dashpot<dem::linear_history, dem::rolling_resistance>")
count_arithmetic(hertz 3 "hertz<>")

# The shape is computed for whole groups, and for the last contacts.
foreach(scene IN ITEMS space plane line damped)
    expect("${${scene}_sqrt} EQUAL 2")
    expect("${${scene}_div} EQUAL 2")
endforeach()
expect("${line_mul} LESS ${plane_mul}")
expect("${plane_mul} LESS ${space_mul}")
expect("${space_mul} LESS ${damped_mul}")
expect("${damped_mul} LESS ${coulomb_mul}")
expect("${coulomb_mul} LESS ${history_mul}")
expect("${history_mul} LESS ${rolling_mul}")
expect("${hertz_sqrt} EQUAL 4")
expect("${hertz_div} EQUAL 2")
