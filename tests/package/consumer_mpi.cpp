// SPDX-License-Identifier: MIT
/// @file
/// A user's program with MPI: without a launcher it is a world of one rank.
#include <tsubu/mpi.hpp>

#include <mpi.h>

#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    bool good = false;
    {
        const std::vector<std::int64_t> ids{4, 9, 4};
        tsubu::mpi_transport on(MPI_COMM_WORLD);
        good = tsubu::duplicate_ids(on, std::span(ids)).total == 1;
    }
    MPI_Finalize();
    std::puts(good ? "found" : "wrong");
    return good ? 0 : 1;
}
