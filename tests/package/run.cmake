# SPDX-License-Identifier: MIT
# cmake -DWAY=<folder> -D... -P run.cmake: a user's project, tests/package/<folder>, with the first program of the
# README, built by that way of use with strict warnings as errors, and run. The project is copied out of the checkout
# first, so that it can lean on nothing here.
cmake_minimum_required(VERSION 3.25)
set(work "${BUILD}/tests/package/${WAY}${COMPONENT}")
set(mine "${work}/mine")
set(prefix "${BUILD}/tests/package/moved prefix") # where the test package.install puts it
file(REMOVE_RECURSE "${work}")

function(run)
    execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${mine}" COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(configure)
    # Headers of imported targets count as those of the system: without the last option no warning would be seen.
    run("${CMAKE_COMMAND}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${STRICT}"
        "-DCMAKE_PREFIX_PATH=${prefix}" -DCMAKE_NO_SYSTEM_FROM_IMPORTED=ON ${ARGV} -S . -B build)
endfunction()

if(WAY STREQUAL "install")
    # Moved after it was installed, and to a path with a space: nothing in it may remember where it was.
    file(REMOVE_RECURSE "${prefix}")
    file(MAKE_DIRECTORY "${mine}")
    run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${work}/prefix")
    file(RENAME "${work}/prefix" "${prefix}")
    file(GLOB_RECURSE installed RELATIVE "${prefix}/include" "${prefix}/include/*")
    file(GLOB_RECURSE headers RELATIVE "${SOURCE}/include" "${SOURCE}/include/*")
    if(NOT "${installed}" STREQUAL "${headers}")
        message(FATAL_ERROR "installed: ${installed}\nbut the headers are ${headers}")
    endif()
    return()
endif()

if(WAY STREQUAL "places")
    # Where distributions put things: the package and tsubu.pc have to lead to the headers from there.
    file(COPY "${SOURCE}/tests/package/find_package/" DESTINATION "${mine}")
    file(COPY_FILE "${SOURCE}/tests/readme/first.cpp" "${mine}/main.cpp")
    foreach(place IN ITEMS "-DCMAKE_INSTALL_INCLUDEDIR=include/tsubu-1"
        "-DCMAKE_INSTALL_INCLUDEDIR=${work}/other/include" "-DCMAKE_INSTALL_DATADIR=lib64/share"
        "-DCMAKE_INSTALL_DATADIR=${work}/other/share")
        file(REMOVE_RECURSE "${work}/prefix" "${work}/other" "${work}/library" "${mine}/build")
        run("${CMAKE_COMMAND}" "-DCMAKE_CXX_COMPILER=${COMPILER}" -DTSUBU_BUILD_TESTS=OFF "${place}"
            "-DCMAKE_INSTALL_PREFIX=${work}/prefix" -S "${SOURCE}" -B "${work}/library")
        run("${CMAKE_COMMAND}" --install "${work}/library")
        file(GLOB_RECURSE package "${work}/prefix/*/tsubu-config.cmake" "${work}/other/*/tsubu-config.cmake")
        cmake_path(GET package PARENT_PATH folder)
        configure("-Dtsubu_DIR=${folder}") # CMake refuses folders of headers that do not exist
        file(GLOB_RECURSE description "${work}/prefix/*/tsubu.pc" "${work}/other/*/tsubu.pc")
        find_program(TSUBU_PKG_CONFIG pkg-config)
        if(TSUBU_PKG_CONFIG)
            execute_process(COMMAND "${TSUBU_PKG_CONFIG}" --variable=includedir "${description}"
                OUTPUT_VARIABLE headers OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
            if(NOT EXISTS "${headers}/tsubu/version.hpp")
                message(FATAL_ERROR "${place}: tsubu.pc leads to ${headers}, where there are no headers")
            endif()
        endif()
    endforeach()
    return()
elseif(WAY STREQUAL "single_include")
    # In two files of one program, since a function that is not inline is an error only there.
    file(MAKE_DIRECTORY "${mine}")
    run("${CMAKE_COMMAND}" --build "${BUILD}" --target tsubu_single_include)
    file(WRITE "${mine}/other.cpp" "#include <tsubu/tsubu.hpp>\n")
    separate_arguments(flags UNIX_COMMAND "${STRICT}")
    run("${COMPILER}" -std=c++20 ${flags} "-I${BUILD}/single_include" "${SOURCE}/tests/readme/first.cpp" other.cpp
        -o mine)
    run("${mine}/mine")
    return()
endif()

file(COPY "${SOURCE}/tests/package/${WAY}/" DESTINATION "${mine}")
set(program "${SOURCE}/tests/readme/first.cpp")
if(COMPONENT)
    set(program "${SOURCE}/tests/package/consumer_${COMPONENT}.cpp")
endif()
file(COPY_FILE "${program}" "${mine}/main.cpp")
file(CREATE_LINK "${SOURCE}" "${work}/tsubu" SYMBOLIC) # the checkout beside the project, or in it
if(WAY STREQUAL "add_subdirectory")
    file(RENAME "${work}/tsubu" "${mine}/tsubu")
endif()

if(WAY STREQUAL "refusals")
    configure("-DVERSION=${VERSION}")
    return()
elseif(WAY STREQUAL "add_subdirectory")
    configure()
    run("${CMAKE_COMMAND}" --install build --prefix "${work}/prefix")
    file(GLOB_RECURSE installed RELATIVE "${work}/prefix" "${work}/prefix/*")
    if(NOT "${installed}" STREQUAL "CMakeLists.txt")
        message(FATAL_ERROR "the subproject installs into its parent: ${installed}")
    endif()
    return()
elseif(WAY STREQUAL "pkg_config")
    set(ENV{PKG_CONFIG_PATH} "${prefix}/share/pkgconfig")
    execute_process(COMMAND pkg-config --modversion tsubu OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT version STREQUAL VERSION)
        message(FATAL_ERROR "tsubu.pc says version ${version}, version.hpp ${VERSION}")
    endif()
    run(make "CXX=${COMPILER}" "CXXFLAGS=${STRICT} -O0")
    run("${mine}/mine")
elseif(WAY STREQUAL "copy")
    set(ENV{CXX} "${COMPILER} ${STRICT}")
    run(sh -e build.sh)
    run("${mine}/mine")
else()
    configure("-DCOMPONENT=${COMPONENT}")
    run("${CMAKE_COMMAND}" --build build)
    run("${mine}/build/mine")
endif()
