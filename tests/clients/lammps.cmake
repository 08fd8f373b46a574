# SPDX-License-Identifier: MIT
# cmake -DCLIENT=lammps_client -DLMP=lmp -DFOLDER=folder -P lammps.cmake
# tsubu writes, LAMMPS reads and writes, tsubu reads and compares.
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
function(run)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${FOLDER}" RESULT_VARIABLE result OUTPUT_VARIABLE output
        ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\n${output}")
    endif()
endfunction()
run("${CLIENT}" write "${FOLDER}")
foreach(scene newton_on newton_off grains)
    run("${LMP}" -in ${scene}.in -log none)
endforeach()
run("${CLIENT}" compare "${FOLDER}")
