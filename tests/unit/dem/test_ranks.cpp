// SPDX-License-Identifier: MIT
// Scenes on 1, 2, 3 and 4 ranks inside one process.
#include <tsubu/dem/stage.hpp>

#include <tsubu/comm/local_transport.hpp>

#include "comm_laws/on_ranks.hpp"

namespace dem_laws {

template <class Body>
void on_one_rank(tsubu::local_transport&, Body&& body) {
    tsubu::run_ranks(1, body);
}

}  // namespace dem_laws

#include "dem_laws/rank_laws.hpp"
#include "unit/io/scratch_folder.hpp"

#include <cstddef>

namespace {

constexpr std::size_t rank_counts[] = {1, 2, 3, 4};

}  // namespace

TEST_CASE("a pair on any number of ranks is the same bit for bit", "[dem][ranks]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::pair_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a chain on any number of ranks is the same bit for bit", "[dem][ranks]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::chain_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a gas on any number of ranks is the same to rounding", "[dem][ranks]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::gas_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a bed with friction that remembers is the same on any number of ranks, to rounding",
          "[dem][ranks][history]") {
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks,
                                  [](auto& on, verdict& seen) { dem_laws::bed_does_not_depend_on_ranks(on, seen); });
}
TEST_CASE("a bed goes on from a restart file on any number of ranks", "[dem][ranks][history]") {
    const scratch_folder folder;
    for (const auto ranks : rank_counts)
        comm_laws::check_on_ranks(ranks, [&](auto& on, verdict& seen) {
            dem_laws::bed_goes_on_from_a_file(on, folder / "bed.restart", seen);
        });
}
