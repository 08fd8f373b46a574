# SPDX-License-Identifier: MIT
# The target tsubu_reference: the pages of every public type and function, in <build>/reference/html.
find_package(Doxygen QUIET)
find_package(Python3 QUIET COMPONENTS Interpreter)
if(DOXYGEN_FOUND AND Python3_FOUND)
    set(reference_dir "${PROJECT_BINARY_DIR}/reference")
    configure_file("${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in" "${reference_dir}/Doxyfile" @ONLY)
    set(tsubu_make_reference "${Python3_EXECUTABLE}" "${CMAKE_CURRENT_LIST_DIR}/reference.py"
        "${PROJECT_SOURCE_DIR}/include" "${reference_dir}" "${DOXYGEN_EXECUTABLE}")
    add_custom_target(tsubu_reference COMMAND ${tsubu_make_reference} VERBATIM
        COMMENT "Making reference/html/index.html")
endif()
