# SPDX-License-Identifier: MIT
# cmake -DSOURCE=... -DHEADER=... -P commit.cmake: writes the commit into a header, at every build, if it has changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
    set(commit unknown) # an archive without .git
endif()
file(CONFIGURE OUTPUT "${HEADER}" CONTENT "#define TSUBU_BENCH_COMMIT \"@commit@\"\n" @ONLY)
