# SPDX-License-Identifier: MIT
# tsubu_strict: warnings as errors, and sanitizers if asked, for our own tests and benches; no consumer sees it.
set(TSUBU_SANITIZE "" CACHE STRING "Sanitizers for tests and benches, as in -fsanitize=: address,undefined")

# Also of the programs of users that the tests build, and of the controls of what must not compile.
set(TSUBU_STRICT_FLAGS "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wsign-conversion -Werror")

add_library(tsubu_strict INTERFACE)
separate_arguments(strict_flags UNIX_COMMAND "${TSUBU_STRICT_FLAGS}")
target_compile_options(tsubu_strict INTERFACE ${strict_flags})
if(TSUBU_SANITIZE)
    # Without optimisation: g++ compiles the instrumented code 4 times faster than with -O1, and the tests spend less
    # than that. Frame pointers for traces; the assertions see out-of-range operator[] of vector and span.
    target_compile_options(tsubu_strict INTERFACE -fsanitize=${TSUBU_SANITIZE} -fno-sanitize-recover=all
        -fno-omit-frame-pointer)
    target_compile_definitions(tsubu_strict INTERFACE _GLIBCXX_ASSERTIONS)
    # The sanitizers' own code makes g++ see uninitialised values in <regex> and the like; release builds still look.
    target_compile_options(tsubu_strict INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(tsubu_strict INTERFACE -fsanitize=${TSUBU_SANITIZE})
endif()
