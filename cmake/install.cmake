# SPDX-License-Identifier: MIT
# Install rules: the headers of all targets, and one export set for each, so that find_package searches for MPI and HDF5
# only when asked.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Headers only: the same for every architecture. STRING, not PATH: a relative path is to stay relative.
set(TSUBU_INSTALL_CMAKEDIR "${CMAKE_INSTALL_DATADIR}/cmake/tsubu" CACHE STRING "Where the CMake package goes")
mark_as_advanced(TSUBU_INSTALL_CMAKEDIR)
# CMake takes an absolute place of a FILE_SET for one below the prefix.
set(include_dir "${CMAKE_INSTALL_INCLUDEDIR}")
if(IS_ABSOLUTE "${include_dir}")
    cmake_path(RELATIVE_PATH include_dir BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}")
endif()
foreach(part IN ITEMS core mpi hdf5)
    set(target tsubu_${part})
    if(part STREQUAL "core")
        set(target tsubu)
    endif()
    install(TARGETS ${target} EXPORT tsubu-${part} FILE_SET HEADERS DESTINATION "${include_dir}")
    install(EXPORT tsubu-${part} NAMESPACE tsubu:: DESTINATION "${TSUBU_INSTALL_CMAKEDIR}")
endforeach()

configure_package_config_file(cmake/tsubu-config.cmake.in tsubu-config.cmake
    INSTALL_DESTINATION "${TSUBU_INSTALL_CMAKEDIR}" NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface, so 0.1 does not satisfy a request for 0.2, nor the reverse.
write_basic_package_version_file(tsubu-config-version.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/tsubu-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/tsubu-config-version.cmake"
    DESTINATION "${TSUBU_INSTALL_CMAKEDIR}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/tsubu")

# For builds without CMake. There is none for MPI or HDF5: mpicxx, and the hdf5.pc of that library, give their flags.
set(pc_dir "${CMAKE_INSTALL_DATADIR}/pkgconfig")
if(IS_ABSOLUTE "${pc_dir}")
    set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
    file(RELATIVE_PATH pc_prefix "/${pc_dir}" "/")
    string(REGEX REPLACE "/$" "" pc_prefix "\${pcfiledir}/${pc_prefix}") # the place of the file: all of it may be moved
endif()
configure_file(cmake/tsubu.pc.in tsubu.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/tsubu.pc" DESTINATION "${pc_dir}")
