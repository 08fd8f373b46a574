// SPDX-License-Identifier: MIT
/// @file
/// Scenes over MPI, from the same source as on the ranks of one process.
#include <tsubu/comm/mpi_transport.hpp>
#include <tsubu/dem/stage.hpp>

namespace dem_laws {

template <class Body>
void on_one_rank(tsubu::mpi_transport&, Body&& body) {
    tsubu::mpi_transport alone(MPI_COMM_SELF);
    body(alone);
}

}  // namespace dem_laws

#include "dem_laws/rank_laws.hpp"
#include "in_world.hpp"


namespace {

using comm_laws::check_in_world;

}  // namespace

TEST_CASE("a scene over MPI is what it is in one process", "[dem][mpi][ranks]") {
    check_in_world([](auto& on, verdict& seen) {
        dem_laws::chain_does_not_depend_on_ranks(on, seen);
        dem_laws::bed_does_not_depend_on_ranks(on, seen);
    });
}
