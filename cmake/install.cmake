# SPDX-License-Identifier: MIT
# Install rules: the headers of all targets, one export set for each, so that MPI and HDF5 are searched for only when
# asked.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/tsubu") # headers only: the same for every architecture
install(TARGETS tsubu EXPORT tsubu-core FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT tsubu-core NAMESPACE tsubu:: DESTINATION "${package_dir}")
if(TSUBU_WITH_MPI)
    install(TARGETS tsubu_mpi EXPORT tsubu-mpi FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT tsubu-mpi NAMESPACE tsubu:: DESTINATION "${package_dir}")
endif()
if(TSUBU_WITH_HDF5)
    install(TARGETS tsubu_hdf5 EXPORT tsubu-hdf5 FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT tsubu-hdf5 NAMESPACE tsubu:: DESTINATION "${package_dir}")
endif()

configure_package_config_file(cmake/tsubu-config.cmake.in tsubu-config.cmake INSTALL_DESTINATION "${package_dir}"
    NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface, so 0.1 does not satisfy a request for 0.2, nor the reverse.
write_basic_package_version_file(tsubu-config-version.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/tsubu-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/tsubu-config-version.cmake"
    DESTINATION "${package_dir}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/tsubu")

# pkg-config --cflags tsubu, for builds without CMake. With MPI or HDF5 add the flags of theirs.
set(pc_dir "${CMAKE_INSTALL_DATADIR}/pkgconfig")
file(RELATIVE_PATH pc_prefix "/${pc_dir}" "/")
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
configure_file(cmake/tsubu.pc.in tsubu.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/tsubu.pc" DESTINATION "${pc_dir}")
