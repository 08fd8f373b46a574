// SPDX-License-Identifier: MIT
/// @file
/// main of the MPI tests: each rank runs all test cases; the program fails if one rank does.
#define CATCH_CONFIG_RUNNER
#include "catch.hpp"

#include <tsubu/comm/detail/include_mpi.hpp>

#include <algorithm>  // std::find
#include <cstdio>     // std::printf
#include <string>
#include <vector>

int main(int argc, char** argv) {
    // Questions about the tests are answered without MPI, so that they work where no launcher does.
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    for (const auto* question : {"--list-tests", "--list-tags", "--help"})
        if (std::find(arguments.begin(), arguments.end(), question) != arguments.end())
            return Catch::Session().run(argc, argv);

    MPI_Init(&argc, &argv);
    int rank = 0;
    int rank_count = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
    const int mine = Catch::Session().run(argc, argv);
    if (mine != 0) std::printf("rank %d of %d failed\n", rank, rank_count);
    std::fflush(stdout);
    int worst = 0;
    MPI_Allreduce(&mine, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    MPI_Finalize();
    return worst == 0 ? 0 : 1;
}
