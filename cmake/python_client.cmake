# SPDX-License-Identifier: MIT
# add_python_client(FORMAT MODULE LIBRARY): the test clients.FORMAT, in which check_FORMAT.py reads by MODULE what
# write_FORMAT_examples.cpp writes with LIBRARY; nothing where no python has the module.
function(add_python_client format module library)
    # The python of the system, where packages put modules, or the first in PATH.
    foreach(candidate IN ITEMS /usr/bin/python3 python3)
        execute_process(COMMAND "${candidate}" -c "import ${module}" RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
        if(result EQUAL 0)
            add_executable(${format}_client write_${format}_examples.cpp)
            target_link_libraries(${format}_client PRIVATE ${library} tsubu_strict)
            add_test(NAME clients.${format} COMMAND "${candidate}" "${CMAKE_CURRENT_SOURCE_DIR}/check_${format}.py"
                "$<TARGET_FILE:${format}_client>")
            set_tests_properties(clients.${format} PROPERTIES LABELS clients TIMEOUT 300)
            return()
        endif()
    endforeach()
endfunction()
