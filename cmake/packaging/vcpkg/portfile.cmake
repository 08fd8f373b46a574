# SPDX-License-Identifier: MIT
# An overlay port of the checkout that it lies in:
#     vcpkg install tsubu --overlay-ports=cmake/packaging/vcpkg --editable
# Without --editable vcpkg may take an older package from its cache: of a port it compares only the port's own files.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(VCPKG_BUILD_TYPE release) # headers only
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS -DTSUBU_BUILD_TESTS=OFF "-DTSUBU_INSTALL_CMAKEDIR=share/${PORT}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup()
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/licenses")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
