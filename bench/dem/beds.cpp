// SPDX-License-Identifier: MIT
/// @file
/// The dense bed: what each model costs in it, and loops by hand beside those that the compiler derives.

#include "../rivals/hand_contacts.hpp"
#include "bed.hpp"
#include "plan.hpp"

#include <tsubu/dem/laws/dmt_cohesion.hpp>
#include <tsubu/dem/laws/rolling_resistance.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/dem/scenes/settle.hpp>
#include <tsubu/io/byte_source.hpp>
#include <tsubu/io/lammps_reader.hpp>
#include <tsubu/io/lammps_writer.hpp>
#include <tsubu/neighbor/neighbor_list.hpp>
#include <tsubu/neighbor/pair_list.hpp>
#include <tsubu/neighbor/reach.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>    // std::max
#include <cmath>        // std::abs, std::nextafter
#include <cstdio>       // std::fprintf, std::rename
#include <filesystem>   // std::filesystem::exists
#include <fstream>      // std::ofstream
#include <stdexcept>    // std::runtime_error
#include <string_view>  // std::string_view

#ifndef TSUBU_BENCH_BUILD
#define TSUBU_BENCH_BUILD "."
#endif

namespace bench {

const std::string& bed_file() {
    static const std::string path = TSUBU_BENCH_BUILD "/settled_bed_10000.data";
    return path;
}

namespace {

using namespace tsubu::dem;
using tsubu::lattice;

/// With a step of half the limit, long enough for the last bounces to end.
void settle_into(const std::string& path) {
    std::fprintf(stderr, "settling a bed of 10000 spheres, once, for %s\n", path.c_str());
    settle_scene<> scene{.time_step = 1e-3, .is_watched = false};
    auto run = stage(scene, alone());
    run->steps(16000);
    bed_store bed;
    // LAMMPS multiplies from left to right; so that it computes a mass of exactly 1
    double density = 6 / pi;
    const auto mass = [&] { return 4.0 * pi / 3.0 * 0.5 * 0.5 * 0.5 * density; };
    if (mass() != 1) density = std::nextafter(density, 2.0);
    if (mass() != 1) density = std::nextafter(6 / pi, 1.0);
    const auto& g = run->particles();
    for (std::size_t i = 0; i < g.owned_count(); ++i) {
        auto x = g[tsubu::position<3>][i];
        x = run->box().wrap(x).position;
        bed.push_back(tsubu::id = g[tsubu::id][i], tsubu::species = 1, tsubu::position<3> = x,
                      tsubu::velocity<3> = g[tsubu::velocity<3>][i],
                      tsubu::angular_velocity<3> = g[tsubu::angular_velocity<3>][i], tsubu::radius = 0.5,
                      tsubu::density = density);
    }
    const auto part = path + ".part";
    {
        std::ofstream file(part);
        tsubu::lammps_writer out([&](std::string_view text) { file << text; });
        out.write(bed, {.title = "a bed that has settled", .hi = {bed_edge, bed_edge, bed_height}});
        file.close();
        if (!file) throw std::runtime_error(part + ": cannot be written");
    }
    if (std::rename(part.c_str(), path.c_str()) != 0) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

const bed_store& settled_bed() {
    static const bed_store bed = [] {
        if (!std::filesystem::exists(bed_file())) settle_into(bed_file());
        bed_store read;
        tsubu::lammps_reader file{tsubu::file_source(bed_file())};
        file.read(read);
        return read;
    }();
    return bed;
}

namespace {

// ---------------------------------------------------------------------------------------------------------------
// The ladder

/// So short that nothing moves: without friction the bed would flow, and have fewer contacts than with it.
constexpr double no_time = 1e-9;  // s

/// Steps of a scene.
template <class Scene>
timed_contender rung(const std::string& name, const std::string& base, const Scene& scene,
                     const std::string& number = "double") {
    using run_type = typename decltype(stage(scene, alone()))::element_type;
    std::shared_ptr<run_type> made = stage(scene, alone());
    constexpr std::size_t steps = 25;
    constexpr std::size_t calls = 6;
    return {"dem/ladder/" + name + "/" + base + "/" + number, static_cast<double>(calls * steps * scene.count()),
            [made](row_fields& fields) {
                const auto lists = made->renewals();
                const double seconds = undisturbed_seconds(calls, [&] { made->steps(steps); });
                const auto n = static_cast<double>(made->particles().owned_count());
                std::size_t touching = 0;
                made->each_contact([&](const auto& pair) { touching += pair.is_wall ? 0 : 1; });
                fields.emplace_back("bytes", static_cast<double>(made->memory_bytes()) / n);
                fields.emplace_back("carried", static_cast<double>(run_type::simulation_type::bytes_per_particle));
                fields.emplace_back("neighbors", static_cast<double>(made->pairs().size()) / n);
                fields.emplace_back("contacts", static_cast<double>(touching) / n);
                fields.emplace_back("renewals", static_cast<double>(made->renewals() - lists));
                return seconds;
            }};
}
template <class Law, class Integrator = velocity_verlet, class Number = double, class Bodies = equal_spheres>
timed_contender bed_rung(const std::string& name, const std::string& base, const Law& law) {
    return rung(name, base, bed_scene<Law, Integrator, Number, Bodies>{.law = law, .time_step = no_time},
                number_name<Number>);
}
template <class... Numbers>
void add_numbers(std::vector<timed_contender>& rungs, const hooke_dashpot<linear_history>& law) {
    (rungs.push_back(bed_rung<hooke_dashpot<linear_history>, velocity_verlet, Numbers>("history", "history", law)),
     ...);
}

void ladder(row_reporter& report, extent how_much) {
    constexpr double k = bed_stiffness;
    constexpr double mu = 0.5;
    const hooke_dashpot<linear_history> history{{k, 50}, {k * 2 / 7, mu}};
    const mindlin_history mindlin{bed_shear_modulus, mu};
    const hertz_tsuji_normal tsuji{bed_modulus, bed_tsuji};
    std::vector<timed_contender> rungs;
    rungs.push_back(rung("motion", "-", falling_scene<velocity_verlet>{}));
    rungs.push_back(bed_rung("hooke", "motion", hooke<>{{k}}));
    rungs.push_back(bed_rung("dashpot", "hooke", hooke_dashpot<>{{k, 50}}));
    rungs.push_back(bed_rung("coulomb", "dashpot", hooke_dashpot<coulomb>{{k, 50}, {mu, 1000}}));
    rungs.push_back(bed_rung("history", "coulomb", history));
    rungs.push_back(bed_rung("hertz", "hooke", hertz<>{{bed_modulus}}));
    rungs.push_back(bed_rung("hertz_dashpot", "hertz", hertz_dashpot<>{{bed_modulus, 3000}}));
    rungs.push_back(
        bed_rung("mindlin", "hertz_dashpot", hertz_dashpot<mindlin_history>{{bed_modulus, 3000}, mindlin}));
    rungs.push_back(bed_rung("tsuji", "mindlin", hertz_tsuji<mindlin_history>{tsuji, mindlin}));
    rungs.push_back(bed_rung("rolling", "tsuji",
                             hertz_tsuji<mindlin_history, rolling_resistance>{tsuji, mindlin, {.mu_r = 0.1}}));
    rungs.push_back(bed_rung("dmt", "tsuji", hertz_tsuji<mindlin_history, dmt_cohesion>{tsuji, mindlin, {0.01}}));
    rungs.push_back(bed_rung<hooke_dashpot<linear_history>, velocity_verlet, double, spheres>("own_sizes", "history",
                                                                                             history));
    rungs.push_back(
        bed_rung<hooke_dashpot<>, implicit_velocity_verlet>("implicit", "dashpot", hooke_dashpot<>{{k, 50}}));
    add_numbers<float, mixed_precision<double, float>, in_cells<float>, lattice<std::int64_t>, lattice<std::int32_t>,
                mixed_precision<lattice<std::int64_t>, float>>(rungs, history);
    take_turns(report, rungs, rounds_of(how_much));
}

// ---------------------------------------------------------------------------------------------------------------
// By hand

using free_scene = bed_scene<hooke_dashpot<>, velocity_verlet, double, equal_spheres, bed_place::free>;

/// All contenders go on from the same state, which the library's run is in.
void by_hand(row_reporter& report, extent how_much) {
    free_scene scene{.law = hooke_dashpot<>{{bed_stiffness, 50}}};
    auto run = stage(scene, alone());
    run->steps(20);
    hand_bed hand;
    hand.k = bed_stiffness;
    hand.gamma = 50;
    const auto copy = [&] {
        auto& g = run->particles();
        const auto take = [](auto& to, auto from) { to.assign(from.begin(), from.end()); };
        take(hand.x, g[tsubu::position<3>].span());
        take(hand.v, g[tsubu::velocity<3>].span());
        take(hand.f, g[tsubu::force<3>].span());
        take(hand.pairs, run->pairs());
    };
    // They must do the same, or figures are worthless: a step by each.
    const double h = scene.time_step;
    const auto step = [&](auto forces) {
        copy();
        static_cast<void>(hand.kick_and_drift(h / 2, h));
        (hand.*forces)();
        return hand;
    };
    const auto plain = step(&hand_bed::forces_plain);
    const auto lanes = step(&hand_bed::forces_in_lanes);
    run->steps(1);
    double most = 0;
    for (std::size_t i = 0; i < plain.x.size(); ++i)
        for (std::size_t a = 0; a < 3; ++a)
            for (const auto* one : {&plain, &lanes})
                most = (std::max)(most, std::abs(run->particles()[tsubu::force<3>][i][a] - one->f[i][a]));
    if (!(most < 1e-6)) throw std::runtime_error("bench_dem: forces by hand are not those of the library");

    copy();
    const auto n = static_cast<double>(run->particles().owned_count());
    constexpr std::size_t passes = 10;
    constexpr std::size_t calls = 12;
    const double units = static_cast<double>(calls * passes) * n;
    // Forces of particles that stand still, and the motion under them, so that lists remain right.
    const auto passes_of = [](auto body) {
        return [body](row_fields&) {
            return undisturbed_seconds(calls, [&] {
                for (std::size_t p = 0; p < passes; ++p) body();
            });
        };
    };
    std::vector<timed_contender> all;
    all.push_back({"dem/hand/forces/tsubu/double", units, passes_of([&] { run->evaluate_forces(); })});
    all.push_back({"dem/hand/forces/plain/double", units, passes_of([&] { hand.forces_plain(); })});
    all.push_back({"dem/hand/forces/lanes/double", units, passes_of([&] { hand.forces_in_lanes(); })});
    // A step of no length moves nothing, and takes as long.
    all.push_back({"dem/hand/motion/tsubu/double", units, passes_of([&] { run->kick_and_drift<true>(0, 0); })});
    double sum = 0;
    all.push_back({"dem/hand/motion/plain/double", units, passes_of([&] { sum += hand.kick_and_drift(0, 0); })});
    take_turns(report, all, 2 * rounds_of(how_much));
    for (const auto& f : hand.f) sum += f[0];
    benchmark::DoNotOptimize(sum);
}

/// Lists of the settled bed, built anew: each pair once, or from both sides.
void lists(row_reporter& report, extent how_much) {
    const auto& bed = settled_bed();
    const auto x = bed[tsubu::position<3>];
    const tsubu::same_reach reach{1.1};
    constexpr std::size_t builds = 20;
    const double units = static_cast<double>(builds * bed.owned_count());
    tsubu::pair_list half;
    tsubu::neighbor_list full;
    const auto times = [](auto build) {
        return [build](row_fields&) {
            return undisturbed_seconds(builds, build);
        };
    };
    take_turns(report,
               {{"dem/lists/bed/half/double", units, times([&] { half.build(x, bed.owned_count(), reach); })},
                {"dem/lists/bed/full/double", units, times([&] { full.build(x, bed.owned_count(), reach); })}},
               2 * rounds_of(how_much));
    if (2 * half.size() != full.total()) throw std::runtime_error("bench_dem: the two lists differ");
}

}  // namespace

void add_beds(std::vector<group>& groups, extent how_much) {
    groups.push_back({"dem/ladder", 10, [how_much](row_reporter& report) { ladder(report, how_much); }});
    groups.push_back({"dem/lists", 1, [how_much](row_reporter& report) { lists(report, how_much); }});
    groups.push_back({"dem/hand", 4, [how_much](row_reporter& report) { by_hand(report, how_much); }});
}

}  // namespace bench
