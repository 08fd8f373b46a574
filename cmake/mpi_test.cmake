# SPDX-License-Identifier: MIT
# add_mpi_test(TARGET RANKS 1 2 3 4): one test per number of ranks, mpi.<target>.<ranks>.

# Only Open MPI's launcher knows these two options, and needs them: for containers, and for more ranks than cores.
set(mpi_launcher_flags "")
execute_process(COMMAND "${MPIEXEC_EXECUTABLE}" --version OUTPUT_VARIABLE mpi_launcher ERROR_VARIABLE mpi_launcher)
if(mpi_launcher MATCHES "Open MPI|OpenRTE|PRTE")
    set(mpi_launcher_flags --allow-run-as-root --oversubscribe)
endif()

function(add_mpi_test target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "RANKS")
    foreach(ranks IN LISTS arg_RANKS)
        set(name "mpi.${target}.${ranks}")
        add_test(NAME ${name} COMMAND "${MPIEXEC_EXECUTABLE}" ${mpi_launcher_flags} ${MPIEXEC_NUMPROC_FLAG} ${ranks}
            ${MPIEXEC_PREFLAGS} $<TARGET_FILE:${target}> --warn NoTests ${MPIEXEC_POSTFLAGS})
        # A deadlock is the usual failure: TIMEOUT. The MPI library itself keeps memory until the end: no leak check.
        set_tests_properties(${name} PROPERTIES LABELS mpi TIMEOUT 120 PROCESSORS ${ranks}
            ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0;OMPI_MCA_btl_vader_single_copy_mechanism=none")
    endforeach()
endfunction()
