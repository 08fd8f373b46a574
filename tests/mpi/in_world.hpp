// SPDX-License-Identifier: MIT
/// @file
/// Laws over MPI: a rank that throws ends the program, for the others may wait for it.
#pragma once

#include <tsubu/comm/mpi_transport.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <cstddef>
#include <cstdio>
#include <exception>
#include <functional>

namespace comm_laws {

inline constexpr std::size_t ordinary_words = std::size_t{1} << 27;

/// CHECKs that all laws that body(on, check) examines are kept, and that some are examined.
inline void check_in(MPI_Comm over, std::size_t most_words,
                     const std::function<void(tsubu::mpi_transport&, verdict&)>& body) {
    verdict seen;
    try {
        tsubu::mpi_transport on(over, most_words);
        body(on, seen);
    } catch (const std::exception& thrown) {
        std::fprintf(stderr, "a rank threw: %s\n", thrown.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    INFO(seen.first);
    CHECK(seen.broken.empty());
    CHECK(seen.checked > 0);
}
inline void check_in_world(const std::function<void(tsubu::mpi_transport&, verdict&)>& body) {
    check_in(MPI_COMM_WORLD, ordinary_words, body);
}
[[nodiscard]] inline std::size_t world_size() {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return static_cast<std::size_t>(size);
}

}  // namespace comm_laws
