// SPDX-License-Identifier: MIT
/// @file
/// 1e5 spheres that have settled, over ranks: a bed that is periodic along x and y, laid side by side.
///
///     mpiexec -n 2 bench_tiled_bed BED STEPS      prints a line of JSON with the seconds that STEPS took
#include "bed.hpp"

#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/comm/mpi_transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/scenes/settle.hpp>
#include <tsubu/io/lammps_reader.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>

namespace {

constexpr std::uint64_t tiles_along_x = 5;
constexpr std::uint64_t tiles_along_y = 2;

struct tiled_bed {
    using simulation = tsubu::dem::settle_scene<>::simulation;
    const bench::bed_store& bed;

    [[nodiscard]] auto box() const {
        return simulation::box_type(
            {0, 0, -1}, {tiles_along_x * bench::bed_edge, tiles_along_y * bench::bed_edge, bench::bed_height},
            {.periodic = {true, true, false}});
    }
    [[nodiscard]] tsubu::dem::options how() const {
        return {.time_step = 2e-4, .skin = 0.1, .guard = tsubu::dem::no_guards};
    }
    [[nodiscard]] auto models() const { return tsubu::dem::settle_scene<>{}.models(); }
    [[nodiscard]] std::uint64_t count() const { return tiles_along_x * tiles_along_y * bed.owned_count(); }
    template <class Store, class Box>
    void place(Store& store, const Box&, std::uint64_t n) const {
        const auto tile = n / bed.owned_count();
        const auto i = static_cast<std::size_t>(n % bed.owned_count());
        auto x = bed[tsubu::position<3>][i];
        x[0] += bench::bed_edge * static_cast<double>(tile % tiles_along_x);
        x[1] += bench::bed_edge * static_cast<double>(tile / tiles_along_x);
        store.push_back(tsubu::id = static_cast<std::int64_t>(n) + 1, tsubu::position<3> = x,
                        tsubu::velocity<3> = bed[tsubu::velocity<3>][i],
                        tsubu::angular_velocity<3> = bed[tsubu::angular_velocity<3>][i]);
    }
};

}  // namespace

int main(int count, char** words) try {
    tsubu::mpi_environment environment(count, words);
    tsubu::mpi_transport on(MPI_COMM_WORLD);
    if (count != 3) throw tsubu::input_error("bench_tiled_bed: give a bed and a number of steps");
    bench::bed_store bed;
    tsubu::lammps_reader(tsubu::file_source(words[1])).read(bed);
    const auto steps = static_cast<std::size_t>(std::strtoull(words[2], nullptr, 10));
    const auto run = tsubu::dem::stage(tiled_bed{bed}, on);
    run->steps(50);  // contacts find each other again, and memory is touched
    double none = 0;
    const auto together = [&] { on.reduce(std::span<double>(&none, 1), tsubu::reduction::sum); };
    together();
    const auto begin = std::chrono::steady_clock::now();
    run->steps(steps);
    together();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double contacts = tsubu::dem::coordination_number(*run);
    const auto particles = static_cast<unsigned long long>(tsubu::dem::particle_count(*run));
    if (on.rank() == 0)
        std::printf("{\"particles\": %llu, \"ranks\": %zu, \"seconds\": %.6g, \"contacts\": %.4g}\n", particles,
                    on.ranks(), seconds, contacts);
    return EXIT_SUCCESS;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
}
