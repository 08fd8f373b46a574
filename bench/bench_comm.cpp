// SPDX-License-Identifier: MIT
/// @file
/// What particles cost that go to other ranks, and ghosts that follow theirs, beside MPI_Sendrecv of the same bytes.
/// Run by mpiexec; the figures are of 2 ranks where nothing else is said.
///
/// Rows; a time is that of the slowest rank, from a barrier on:
///
///     comm/sync/none/reduction/ranks:2           one empty reduction
///     comm/migrate/PERCENT/tsubu/ranks:2         migrate; so many of the particles of each rank leave: 0, 1, 10, 50
///     comm/migrate/PERCENT/hand/ranks:2          loops, lists and MPI_Sendrecv, for this row and these fields alone
///     comm/migrate/PERCENT/raw/ranks:2           MPI_Sendrecv of the bytes of the leavers, from and to ready buffers
///     comm/moved/PERCENT/tsubu/ranks:2           bytes that migrate sends to other ranks, and those of the leavers
///     comm/make_halo/SIZE/direct | staged/ranks:2
///     comm/forward/SIZE/direct | staged/ranks:2  halo::forward of positions; SIZE: ghosts on all ranks
///     comm/forward/SIZE/hand/ranks:2             lists, MPI_Irecv, MPI_Isend, MPI_Waitall and loops, for this alone
///     comm/forward/SIZE/raw/ranks:2              MPI_Sendrecv of the same bytes, from and to ready buffers
///     comm/reverse/SIZE/...                      the same for forces that are added to the owners
///     comm/model/forward/direct | staged/ranks:64    messages and bytes that a rank sends, the mean over the ranks
///     comm/model/migrate/tsubu/ranks:64
///
/// A rank has 5e4 particles, with 64 bytes each where they migrate, in a cube; the cubes stand in a row, which is
/// periodic. Half the leavers go to the next cube, half to the one before: with two ranks that is the same, and half of
/// them are wrapped.
///
/// The model counts on simulated ranks, threads of rank 0, on cubes in a grid that is periodic along all axes.

#include "rivals/hand_ranks.hpp"
#include "support/command_line.hpp"
#include "support/counting_transport.hpp"
#include "support/groups.hpp"
#include "support/rank_turns.hpp"
#include "support/row_reporter.hpp"

#include <tsubu/comm/halo.hpp>
#include <tsubu/comm/local_transport.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/mpi_environment.hpp>
#include <tsubu/comm/mpi_transport.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <algorithm>   // std::fill, std::sort
#include <array>       // std::array
#include <cmath>       // std::abs
#include <cstddef>     // std::ptrdiff_t, std::size_t
#include <cstdint>     // std::int64_t, std::uint64_t
#include <cstdio>      // std::fprintf
#include <cstdlib>     // EXIT_FAILURE
#include <functional>  // std::function
#include <memory>      // std::make_shared
#include <span>        // std::span
#include <stdexcept>   // std::runtime_error
#include <string>      // std::string
#include <utility>     // std::pair, std::swap
#include <vector>      // std::vector

namespace bench {
namespace {

using tsubu::vec;
using bricks_type = tsubu::brick_decomposition<3>;
using moving_fields = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::mass>;
using moving_store = tsubu::particle_store<moving_fields>;
static_assert(moving_store::bytes_per_particle == 64);
using pushed_fields = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::velocity<3>, tsubu::force<3>>;
using pushed_store = tsubu::particle_store<pushed_fields>;

constexpr std::size_t particles_of_rank = 50'000;

[[nodiscard]] constexpr double real(std::uint64_t n) { return static_cast<double>(n); }

void expect(bool holds, const std::string& law) {
    if (!holds) throw std::runtime_error("bench_comm: " + law + "; figures would be worthless");
}

/// Unit cubes in a grid.
bricks_type cubes(const std::array<std::size_t, 3>& grid, const std::array<bool, 3>& periodic) {
    return {tsubu::domain<3>({0, 0, 0}, {real(grid[0]), real(grid[1]), real(grid[2])}, {.periodic = periodic}), grid};
}
/// At random places of this rank's cube.
template <class Store>
Store filled(const bricks_type& bricks, tsubu::rank_t rank, std::size_t count) {
    Store g;
    tsubu::random_stream random(40 + rank);
    const auto mine = bricks.subdomain(rank);
    for (std::size_t k = 0; k < count; ++k) {
        vec<3> x{};
        for (std::size_t d = 0; d < 3; ++d) x[d] = mine.lo()[d] + random.unit() * (1 - 1e-9);
        g.push_back(tsubu::id = static_cast<std::int64_t>(rank * count + k), tsubu::position<3> = x,
                    tsubu::velocity<3> = vec<3>{x[1], x[2], x[0]});
    }
    return g;
}

// ---------------------------------------------------------------------------------------------------------------
// All that the groups use

struct world {
    tsubu::mpi_transport on{MPI_COMM_WORLD};
    row_reporter* report = nullptr;  // that of rank 0 writes
    std::size_t rounds = 0;
    double seconds = 0;
    bricks_type row = cubes({on.ranks(), 1, 1}, {true, false, false});

    [[nodiscard]] std::string named(const std::string& task, const std::string& what, const std::string& who) const {
        return "comm/" + task + "/" + what + "/" + who + "/ranks:" + std::to_string(on.ranks());
    }
    void measure(const std::vector<collective_contender>& all,
                 const std::vector<std::pair<std::string, double>>& fields) {
        rank_turns(on, *report, rounds, seconds).measure(all, fields);
    }
    [[nodiscard]] int next() const { return static_cast<int>((on.rank() + 1) % on.ranks()); }
    [[nodiscard]] int before() const { return static_cast<int>((on.rank() + on.ranks() - 1) % on.ranks()); }
    [[nodiscard]] row_place here() const {
        const auto mine = row.subdomain(on.rank());
        return {static_cast<int>(on.rank()), next(), before(), mine.lo()[0], mine.hi()[0], real(on.ranks())};
    }
};

/// Bytes to the next rank and the one before, as MPI_Sendrecv from and to buffers that are there already.
class raw_exchange {
public:
    /// Doubles that go up and down, and that come from below and above.
    raw_exchange(const world& w, std::size_t up, std::size_t down, std::size_t from_below, std::size_t from_above)
        : on_(MPI_COMM_WORLD), next_(w.next()), before_(w.before()) {
        const bool is_one = next_ == before_;  // a message of all
        out_[0].assign(is_one ? up + down : up, 1);
        in_[0].assign(is_one ? from_below + from_above : from_below, 0);
        out_[1].assign(is_one ? 0 : down, 1);
        in_[1].assign(is_one ? 0 : from_above, 0);
    }
    void operator()() {
        swap_with(next_, before_, 0);
        if (next_ != before_) swap_with(before_, next_, 1);
    }

private:
    void swap_with(int to, int from, std::size_t k) {
        MPI_Sendrecv(out_[k].data(), static_cast<int>(out_[k].size()), MPI_DOUBLE, to, 1, in_[k].data(),
                     static_cast<int>(in_[k].size()), MPI_DOUBLE, from, 1, on_, MPI_STATUS_IGNORE);
    }
    MPI_Comm on_;
    int next_, before_;
    std::array<std::vector<double>, 2> out_, in_;
};

// ---------------------------------------------------------------------------------------------------------------
// Migration

/// Which particles leave: as many on each rank, others each time.
class departures {
public:
    departures(const world& w, std::size_t leavers) : leavers_(leavers), random_(3 + w.on.rank()) {
        for (std::size_t k = 0; k < particles_of_rank; ++k) order_.push_back(k);
    }
    void operator()(std::span<vec<3>> x) {
        for (std::size_t k = 0; k < leavers_; ++k) {
            std::swap(order_[k], order_[k + random_.below(order_.size() - k)]);
            x[order_[k]][0] += k % 2 == 0 ? 1 : -1;
        }
    }

private:
    std::size_t leavers_;
    tsubu::random_stream random_;
    std::vector<std::size_t> order_;
};

/// What no migration changes, over all ranks; and that all is where it belongs.
std::array<std::uint64_t, 3> sums_of(std::span<const std::int64_t> ids, std::span<const vec<3>> x,
                                     std::span<const vec<3>> v, world& w) {
    std::array<std::uint64_t, 3> sums{};
    const auto mine = w.row.subdomain(w.on.rank());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto name = static_cast<std::uint64_t>(ids[i]);
        sums[0] += name;
        sums[1] += name * name;
        sums[2] += mine.owns(x[i]) && v[i][0] == x[i][1];
    }
    w.on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
    return sums;
}

std::array<std::uint64_t, 3> sums_of(const moving_store& g, world& w) {
    return sums_of(g[tsubu::id].span(), g[tsubu::position<3>].span(), g[tsubu::velocity<3>].span(), w);
}

void run_migrate(world& w, std::size_t percent) {
    const auto leavers = particles_of_rank * percent / 100;
    const auto g = std::make_shared<moving_store>(
        filled<moving_store>(w.row, w.on.rank(), particles_of_rank));
    const auto leave = std::make_shared<departures>(w, leavers);
    const auto what = std::to_string(percent);

    counting_transport counted(w.on);
    const auto sums = sums_of(*g, w);
    expect(sums[2] == particles_of_rank * w.on.ranks(), "particles begin on wrong ranks");
    (*leave)((*g)[tsubu::position<3>].span());
    const auto done = tsubu::migrate(*g, w.row, counted);
    expect(done.sent == (w.on.ranks() == 1 ? 0 : leavers) && g->size() == particles_of_rank,
           "migrate has sent another number of particles");
    expect(sums_of(*g, w) == sums, "migrate has changed, lost or misplaced particles");
    if (leavers != 0)
        w.report->counted(w.named("moved", what, "tsubu"), {{"bytes", real(counted.sent().bytes)},
                                                            {"leaver_bytes", real(64 * leavers)},
                                                            {"messages", real(counted.sent().messages)}});

    const auto by_hand = std::make_shared<hand_migration>(w.here(), *g);
    const auto leave_by_hand = std::make_shared<departures>(w, leavers);
    (*leave_by_hand)(by_hand->positions());
    (*by_hand)();
    expect(sums_of(by_hand->ids(), by_hand->positions(), by_hand->velocities(), w) == sums,
           "the migration by hand has changed, lost or misplaced particles");

    std::vector<collective_contender> all;
    all.push_back({w.named("migrate", what, "tsubu"), [=] { (*leave)((*g)[tsubu::position<3>].span()); },
                   [=, &w] { tsubu::migrate(*g, w.row, w.on); }});
    all.push_back({w.named("migrate", what, "hand"), [=] { (*leave_by_hand)(by_hand->positions()); },
                   [=] { (*by_hand)(); }});
    if (leavers == 0) {
        all.push_back({w.named("sync", "none", "reduction"), {}, [&w] {
                           std::uint64_t nothing[1] = {0};
                           w.on.reduce(std::span<std::uint64_t>(nothing), tsubu::reduction::sum);
                       }});
    } else {
        const auto words = leavers / 2 * 8;
        const auto raw = std::make_shared<raw_exchange>(w, words, words, words, words);
        all.push_back({w.named("migrate", what, "raw"), {}, [=] { (*raw)(); }});
    }
    w.measure(all, {{"leavers", real(leavers)}, {"particles", real(particles_of_rank * w.on.ranks())}});
}

// ---------------------------------------------------------------------------------------------------------------
// Ghosts

/// A store, and its ghosts by one pattern.
template <class Pattern>
struct ghosted {
    ghosted(world& w, double cutoff)
        : g(filled<pushed_store>(w.row, w.on.rank(), particles_of_rank)),
          halo(tsubu::make_halo(g, w.row, cutoff, w.on, Pattern{})) {}
    pushed_store g;
    tsubu::halo<bricks_type, tsubu::mpi_transport> halo;
};

std::vector<vec<3>> sorted(std::span<const vec<3>> values) {
    std::vector<vec<3>> all(values.begin(), values.end());
    std::sort(all.begin(), all.end());
    return all;
}
/// Ghosts follow their owners as by hand, and their forces come back as by hand.
template <class Pattern>
void check(world& w, ghosted<Pattern>& one, hand_halo& by_hand) {
    auto& g = one.g;
    const auto owned = g.owned_count();
    for (std::size_t i = owned; i < g.size(); ++i) g[tsubu::position<3>][i] = {};
    one.halo.forward(g, tsubu::position<3>);
    by_hand.forward();
    const auto& x = by_hand.positions();
    bool is_right = g.size() == x.size() && sorted(g[tsubu::position<3>].span().subspan(owned)) ==
                                                sorted(std::span(x).subspan(owned));
    auto& forces = by_hand.forces();
    const auto force = g[tsubu::force<3>];
    const auto of = [](const vec<3>& at) { return vec<3>{1, 0.25 + at[1], at[2]}; };
    for (std::size_t i = 0; is_right && i < x.size(); ++i) {
        forces[i] = i < owned ? vec<3>{} : of(x[i]);
        force[i] = i < owned ? vec<3>{} : of(g[tsubu::position<3>][i]);
    }
    by_hand.reverse();
    one.halo.reverse(g, tsubu::force<3>);
    for (std::size_t i = 0; is_right && i < owned; ++i)
        for (std::size_t d = 0; d < 3; ++d) is_right = std::abs(force[i][d] - forces[i][d]) < 1e-12;
    std::uint64_t wrong[1] = {is_right ? 0U : 1U};
    w.on.reduce(std::span<std::uint64_t>(wrong), tsubu::reduction::sum);
    expect(wrong[0] == 0, "ghosts, or what they add, are not those of the exchange by hand");
    // Forces that are added up again and again stay what they are.
    std::fill(forces.begin(), forces.end(), vec<3>{});
    for (auto& f : force) f = {};
}

void run_halo(world& w, double cutoff, const std::string& size) {
    const auto direct = std::make_shared<ghosted<tsubu::direct_pattern>>(w, cutoff);
    const auto staged = std::make_shared<ghosted<tsubu::staged_pattern>>(w, cutoff);
    const auto by_hand = std::make_shared<hand_halo>(w.here(), direct->g, cutoff);
    check(w, *direct, *by_hand);
    check(w, *staged, *by_hand);
    const auto [up, down, below, above] = by_hand->counts();
    const auto raw = std::make_shared<raw_exchange>(w, 3 * up, 3 * down, 3 * below, 3 * above);
    const auto raw_back = std::make_shared<raw_exchange>(w, 3 * above, 3 * below, 3 * down, 3 * up);

    std::uint64_t ghosts[1] = {direct->halo.ghost_count()};
    w.on.reduce(std::span<std::uint64_t>(ghosts), tsubu::reduction::sum);
    const std::vector<std::pair<std::string, double>> fields = {
        {"ghosts", real(ghosts[0])}, {"particles", real(particles_of_rank * w.on.ranks())}};
    constexpr auto x = tsubu::position<3>;
    constexpr auto f = tsubu::force<3>;
    w.measure({{w.named("forward", size, "direct"), {}, [=] { direct->halo.forward(direct->g, x); }},
               {w.named("forward", size, "staged"), {}, [=] { staged->halo.forward(staged->g, x); }},
               {w.named("forward", size, "hand"), {}, [=] { by_hand->forward(); }},
               {w.named("forward", size, "raw"), {}, [=] { (*raw)(); }}},
              fields);
    // As a program writes them between two calls; what no core has written since the last exchange travels faster.
    const auto forget = [](std::span<vec<3>> forces, std::size_t owned) {
        std::fill(forces.begin() + static_cast<std::ptrdiff_t>(owned), forces.end(), vec<3>{});
    };
    const auto forget_of = [=](auto& one) { forget(one.g[f].span(), one.g.owned_count()); };
    w.measure({{w.named("reverse", size, "direct"), [=] { forget_of(*direct); },
                [=] { direct->halo.reverse(direct->g, f); }},
               {w.named("reverse", size, "staged"), [=] { forget_of(*staged); },
                [=] { staged->halo.reverse(staged->g, f); }},
               {w.named("reverse", size, "hand"), [=] { forget(by_hand->forces(), direct->g.owned_count()); },
                [=] { by_hand->reverse(); }},
               {w.named("reverse", size, "raw"), {}, [=] { (*raw_back)(); }}},
              fields);
    const auto make = [&w, cutoff](auto& one, auto pattern) {
        one.halo = tsubu::make_halo(one.g, w.row, cutoff, w.on, pattern);
    };
    w.measure({{w.named("make_halo", size, "direct"), {}, [=] { make(*direct, tsubu::direct_pattern{}); }},
               {w.named("make_halo", size, "staged"), {}, [=] { make(*staged, tsubu::staged_pattern{}); }}},
              fields);
}

// ---------------------------------------------------------------------------------------------------------------
// What many ranks would send

constexpr std::size_t model_particles = 4096;  // of each rank: 16 along an edge
constexpr double model_cutoff = 0.15;          // 2.4 times their distance
constexpr double model_step = 0.02;            // a third of it: how far a particle goes along an axis, at most
constexpr std::size_t model_steps = 10;

traffic& operator+=(traffic& sum, const traffic& more) {
    sum.messages += more.messages, sum.bytes += more.bytes, sum.reductions += more.reductions;
    return sum;
}
/// What all simulated ranks have sent by the end of body(transport); what counts not, it clears.
template <class Body>
traffic traffic_of(std::size_t ranks, Body&& body) {
    std::vector<traffic> all(ranks);
    tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) {
        counting_transport counted(on);
        body(counted);
        all[on.rank()] = counted.sent();
    });
    traffic sum;
    for (const auto& one : all) sum += one;
    return sum;
}
template <class Pattern>
traffic forward_traffic(const bricks_type& bricks) {
    return traffic_of(bricks.ranks(), [&](auto& on) {
        auto g = filled<pushed_store>(bricks, on.rank(), model_particles);
        auto halo = tsubu::make_halo(g, bricks, model_cutoff, on, Pattern{});
        on.clear();
        halo.forward(g, tsubu::position<3>);
    });
}
traffic migrate_traffic(const bricks_type& bricks) {
    return traffic_of(bricks.ranks(), [&](auto& on) {
        auto g = filled<moving_store>(bricks, on.rank(), model_particles);
        tsubu::random_stream random(7 + on.rank());
        for (std::size_t step = 0; step < model_steps; ++step) {
            for (auto& x : g[tsubu::position<3>])
                for (auto& along : x) along += model_step * (2 * random.unit() - 1);
            tsubu::migrate(g, bricks, on);
        }
    });
}
void run_model(world& w, const std::array<std::size_t, 3>& grid) {
    if (w.on.rank() == 0) {
        const auto bricks = cubes(grid, {true, true, true});
        const auto add = [&](const std::string& what, const traffic& sum, std::size_t steps) {
            const auto share = 1.0 / real(bricks.ranks() * steps);
            w.report->counted("comm/model/" + what + "/ranks:" + std::to_string(bricks.ranks()),
                              {{"messages", real(sum.messages) * share}, {"bytes", real(sum.bytes) * share},
                               {"reductions", real(sum.reductions) * share}, {"grid_x", real(grid[0])},
                               {"grid_y", real(grid[1])}, {"grid_z", real(grid[2])},
                               {"particles", real(model_particles)}, {"cutoff", model_cutoff}, {"step", model_step}});
        };
        add("forward/direct", forward_traffic<tsubu::direct_pattern>(bricks), 1);
        add("forward/staged", forward_traffic<tsubu::staged_pattern>(bricks), 1);
        add("migrate/tsubu", migrate_traffic(bricks), model_steps);
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

// ---------------------------------------------------------------------------------------------------------------
// The plan

std::vector<group> plan(world& w) {
    std::vector<group> groups;
    const auto add = [&](const std::string& name, double seconds, std::function<void()> body) {
        groups.push_back({"comm/" + name, seconds, [&w, body = std::move(body)](row_reporter& report) {
                              w.report = &report;
                              body();
                          }});
    };
    const double turns = static_cast<double>(w.rounds) * w.seconds;
    for (const std::size_t percent : {0U, 1U, 10U, 50U})
        add("migrate/" + std::to_string(percent), 0.3 + 2 * turns, [&w, percent] { run_migrate(w, percent); });
    const auto halos = [&](double cutoff, const std::string& size) {
        add("halo/" + size, 1 + 8 * turns, [&w, cutoff, size] { run_halo(w, cutoff, size); });
    };
    halos(0.25, "50000");
    halos(0.002, "400");
    std::array<std::size_t, 3> grid{1, 1, 1};
    for (std::size_t ranks = 1, axis = 0; ranks <= 64; ranks *= 2, axis = (axis + 1) % 3) {
        add("model/ranks:" + std::to_string(ranks), 0.02 * real(ranks), [&w, grid] { run_model(w, grid); });
        grid[axis] *= 2;
    }
    return groups;
}

constexpr const char* usage =
    "mpiexec -n 2 bench_comm [--quick | --full] [--only TEXT] [--benchmark_out=FILE.json]\n"
    "  --quick     9 short rounds: some seconds\n"
    "  (neither)   15 rounds: about a minute\n"
    "  --full      31 rounds\n"
    "  --only TEXT only groups whose name contains it, such as comm/migrate or comm/model\n";

std::string mpi_version() {
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(text, &length);
    const std::string all(text, static_cast<std::size_t>(length));
    return all.substr(0, all.find_first_of(",\n"));
}

int run(const options& chosen) {
    world w;
    constexpr std::size_t rounds[] = {9, 15, 31};
    constexpr double seconds[] = {0.01, 0.05, 0.1};
    w.rounds = rounds[static_cast<int>(chosen.how_much)];
    w.seconds = seconds[static_cast<int>(chosen.how_much)];
    const team ranks = {w.on.rank() == 0, [](std::vector<char>& is_done) {
                            MPI_Bcast(is_done.data(), static_cast<int>(is_done.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
                        }};
    return run_groups("bench_comm", plan(w), chosen,
                      {{"mpi", mpi_version()}, {"ranks", std::to_string(w.on.ranks())},
                       {"load", line_of("/proc/loadavg")}}, ranks);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    const tsubu::mpi_environment mpi(argc, argv);
    const int result = bench::run_program(argc, argv, "bench_comm", bench::usage, false, bench::run);
    // After an error the others may wait for this rank for ever.
    if (result == EXIT_FAILURE) MPI_Abort(MPI_COMM_WORLD, result);
    return result;
}
