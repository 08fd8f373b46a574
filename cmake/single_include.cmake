# SPDX-License-Identifier: MIT
# The target tsubu_single_include makes <build>/single_include/tsubu/tsubu.hpp: all of tsubu but MPI and HDF5 in one
# file, for a program that takes one file and no more. Not installed: beside the headers that it repeats it would be a
# trap, since a program that included both would see everything twice.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_FOUND)
    set(single_header "${PROJECT_BINARY_DIR}/single_include/tsubu/tsubu.hpp")
    add_custom_command(OUTPUT "${single_header}"
        COMMAND "${Python3_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/cmake/single_include.py" "${PROJECT_SOURCE_DIR}/include"
        tsubu/tsubu.hpp "${single_header}"
        DEPENDS "${PROJECT_SOURCE_DIR}/cmake/single_include.py" "${PROJECT_SOURCE_DIR}/LICENSE" ${tsubu_headers}
        COMMENT "Making single_include/tsubu/tsubu.hpp" VERBATIM)
    add_custom_target(tsubu_single_include DEPENDS "${single_header}")
endif()
