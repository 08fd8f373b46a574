// SPDX-License-Identifier: MIT
/// @file
/// A program whose last rank throws while the others wait for it: it must end, and as a failure. The argument says
/// where the others wait, and a second one whether main catches what is thrown.
#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/comm/mpi_transport.hpp>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

void run(int argc, char** argv) {
    const tsubu::mpi_environment mpi(argc, argv);
    tsubu::mpi_transport on(MPI_COMM_WORLD);
    const std::string where = argc > 1 ? argv[1] : "exchange";
    const auto last = static_cast<tsubu::rank_t>(on.ranks() - 1);
    std::vector<tsubu::lane> from_last;
    std::vector<tsubu::lane> to_all;
    if (on.rank() != last) from_last.push_back({last, 3});
    for (tsubu::rank_t rank = 0; on.rank() == last && rank < last; ++rank) to_all.push_back({rank, 3});
    tsubu::mpi_transport::channel way(on, on.next_tag(), to_all, from_last);
    std::uint64_t sums[] = {1};
    on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
    if (on.rank() == last) throw std::runtime_error("this rank has failed");
    if (where == "reduce") {
        on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
    } else if (where == "channel") {
        way.start();
        way.finish();
    } else {
        static_cast<void>(on.exchange({}, sums));
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2 && std::string(argv[2]) == "uncaught") {
        run(argc, argv);
        return 0;
    }
    try {
        run(argc, argv);
    } catch (const std::exception& thrown) {
        std::fprintf(stderr, "%s\n", thrown.what());
        return 1;
    }
    return 0;
}
