// SPDX-License-Identifier: MIT
/// @file
/// LAMMPS beside us: the same scene from the same doubles, on the same core, in turns. And ranks.

#include "bed.hpp"
#include "plan.hpp"

#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/scenes/gas.hpp>
#include <tsubu/dem/scenes/settle.hpp>

#include <malloc.h>  // malloc_trim
#include <sched.h>   // cpu_set_t, sched_getaffinity, sched_setaffinity
#include <unistd.h>  // sysconf

#include <cmath>      // std::abs
#include <cstdio>     // popen, std::fgets
#include <cstdlib>    // std::getenv, std::strtod, std::system
#include <fstream>    // std::ifstream
#include <memory>     // std::shared_ptr
#include <stdexcept>  // std::runtime_error

#ifndef TSUBU_BENCH_SOURCE
#define TSUBU_BENCH_SOURCE "bench"
#endif
#ifndef TSUBU_BENCH_SCENE
#define TSUBU_BENCH_SCENE ""
#endif
#ifndef TSUBU_BENCH_TILED_BED
#define TSUBU_BENCH_TILED_BED ""
#endif

namespace bench {
namespace {

using namespace tsubu::dem;

/// The line of JSON that another program prints. @throws std::runtime_error if it fails.
std::string answer_of(const std::string& command) {
    std::FILE* const pipe = popen((command + " </dev/null").c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    std::string all;
    char text[512];
    while (std::fgets(text, sizeof text, pipe) != nullptr) all += text;
    if (pclose(pipe) != 0 || all.find('{') == std::string::npos)
        throw std::runtime_error("failed: " + command + "\n" + all);
    return all;
}
double number_in(const std::string& json, const std::string& key) {
    const auto at = json.find("\"" + key + "\": ");
    if (at == std::string::npos) throw std::runtime_error("no " + key + " in " + json);
    return std::strtod(json.c_str() + at + key.size() + 4, nullptr);
}

/// On core 0 as long as it lives, as measure.py pins LAMMPS.
class pinned {
public:
    pinned() {
        sched_getaffinity(0, sizeof before_, &before_);
        cpu_set_t first;
        CPU_ZERO(&first);
        CPU_SET(0, &first);
        sched_setaffinity(0, sizeof first, &first);  // where that is not allowed, both run wherever they do
    }
    pinned(const pinned&) = delete;
    pinned& operator=(const pinned&) = delete;
    ~pinned() { sched_setaffinity(0, sizeof before_, &before_); }

private:
    cpu_set_t before_;
};

/// What this program holds in memory [bytes]; what it has freed is given back first.
double resident_bytes() {
    malloc_trim(0);
    std::ifstream state("/proc/self/statm");
    double pages = 0;
    state >> pages >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// A scene from its beginning, after some steps that do not count: each turn does the same.
template <class Scene>
void beside(row_reporter& report, const std::string& name, const Scene& scene, const std::string& rival_scene,
            std::size_t warmup, std::size_t steps, std::size_t rounds) {
    const double units = static_cast<double>(steps * scene.count());
    const auto energies = std::make_shared<std::pair<double, double>>();
    const timed_contender ours = {"dem/beside/" + name + "/tsubu/double", units, [=](row_fields& fields) {
                                      const pinned here;
                                      const double before = resident_bytes();
                                      auto run = stage(scene, alone());
                                      run->steps(warmup);
                                      const auto lists = run->renewals();
                                      const double seconds = seconds_of([&] { run->steps(steps); });
                                      const auto n = static_cast<double>(scene.count());
                                      energies->first = kinetic_energy(*run);
                                      fields.emplace_back("bytes", static_cast<double>(run->memory_bytes()) / n);
                                      fields.emplace_back("resident", (resident_bytes() - before) / n);
                                      fields.emplace_back("builds", static_cast<double>(run->renewals() - lists));
                                      fields.emplace_back("kinetic", energies->first);
                                      fields.emplace_back("particles", n);
                                      return seconds;
                                  }};
    const timed_contender theirs = {
        "dem/beside/" + name + "/lammps/double", units, [=](row_fields& fields) {
            const auto said = answer_of("python3 '" TSUBU_BENCH_SOURCE "/rivals/lammps/measure.py' " + rival_scene +
                                        " --warmup " + std::to_string(warmup) + " --steps " + std::to_string(steps));
            energies->second = number_in(said, "ke");
            fields.emplace_back("bytes", number_in(said, "bytes_per_particle"));
            fields.emplace_back("resident", number_in(said, "resident_bytes_per_particle"));
            fields.emplace_back("builds", number_in(said, "builds"));
            fields.emplace_back("kinetic", energies->second);
            fields.emplace_back("particles", number_in(said, "particles"));
            return number_in(said, "seconds");
        }};
    take_turns(report, {ours, theirs}, rounds, false);
    report.counted("dem/same/" + name + "/kinetic/double",
                   {{"difference", std::abs(energies->first / energies->second - 1)}});
}

struct rival_scene {
    std::string name;
    double seconds;  // of a turn of both
    std::function<void(row_reporter&, const std::string&, std::size_t rounds)> run;
};
template <class Law>
auto in_bed(const Law& law, const char* rival, std::size_t warmup, std::size_t steps) {
    return [=](row_reporter& report, const std::string& name, std::size_t rounds) {
        static_cast<void>(settled_bed());  // so that its file is there
        beside(report, name, bed_scene<Law, velocity_verlet>{.law = law}, std::string(rival) + " --data '" + bed_file() + "'",
               warmup, steps, rounds);
    };
}

std::vector<rival_scene> rival_scenes() {
    const mindlin_history mindlin{bed_shear_modulus, 0.5};
    std::vector<rival_scene> all;
    all.push_back({"gas", 1, [](row_reporter& report, const std::string& name, std::size_t rounds) {
                       beside(report, name, gas_scene<hooke<>>{.law = hooke<>{{2e5}}, .time_step = 2e-4}, "gas", 0,
                              2000, rounds);
                   }});
    all.push_back({"bed_frictionless", 2,
                   in_bed(hooke_dashpot<>{{bed_stiffness, 50}}, "bed_frictionless", 100, 1000)});
    all.push_back({"settle_1e4", 7, [](row_reporter& report, const std::string& name, std::size_t rounds) {
                       beside(report, name, settle_scene<>{.is_watched = false}, "settle", 0, 5000, rounds);
                   }});
    all.push_back({"settle_bed_1e4", 4,
                   in_bed(hooke_dashpot<linear_history>{{bed_stiffness, 50}, {bed_stiffness * 2 / 7, 0.5}}, "settle",
                          300, 1500)});
    all.push_back({"settle_1e5", 12, [](row_reporter& report, const std::string& name, std::size_t rounds) {
                       beside(report, name, settle_scene<>{.cells = {50, 50, 40}, .is_watched = false},
                              "settle --cells 50 50 40", 0, 800, rounds);
                   }});
    all.push_back({"bed_hertz", 4,
                   in_bed(hertz_dashpot<mindlin_history>{{bed_modulus, 3000}, mindlin}, "bed_hertz", 300, 1000)});
    all.push_back({"bed_hertz_mindlin", 5,
                   in_bed(hertz_tsuji<mindlin_history>{{bed_modulus, bed_tsuji}, mindlin}, "bed_hertz_mindlin", 300,
                          1000)});
    return all;
}

/// Other programs say how long their steps took; bench/run says how ranks are started.
void ranks(row_reporter& report, const std::string& launcher, std::size_t rounds) {
    static_cast<void>(settled_bed());  // so that its file is there
    std::vector<timed_contender> all;
    const auto add = [&](const char* scene, double steps, const std::string& program) {
        for (const char* const count : {"1", "2"})
            all.push_back({std::string("dem/ranks/") + scene + "/" + count + "/double", 1e5 * steps, [=](row_fields&) {
                               return number_in(answer_of(launcher + " -n " + count + " " + program), "seconds");
                           }});
    };
    add("settle_1e5", 800, "'" TSUBU_BENCH_SCENE "' settle --size 100000 --steps 800 --timing");
    add("bed_1e5", 200, "'" TSUBU_BENCH_TILED_BED "' '" + bed_file() + "' 200");
    take_turns(report, all, rounds, false);
}

}  // namespace

void add_rivals(std::vector<group>& groups, extent how_much) {
    constexpr std::size_t rounds_of_extent[] = {1, 5, 5};  // of fewer than five the spread says little
    const auto rounds = rounds_of_extent[static_cast<int>(how_much)];
    const bool has_lammps = std::system("(command -v lmp && command -v python3) >/dev/null 2>&1") == 0;
    if (has_lammps)
        for (const auto& one : rival_scenes())
            groups.push_back({"dem/beside/" + one.name, one.seconds * static_cast<double>(rounds),
                              [one, rounds](row_reporter& report) { one.run(report, one.name, rounds); }});
    const char* const launcher = std::getenv("TSUBU_BENCH_LAUNCHER");
    if (launcher != nullptr && *launcher != '\0')
        groups.push_back(
            {"dem/ranks", 14 * static_cast<double>(rounds),
             [text = std::string(launcher), rounds](row_reporter& report) { ranks(report, text, rounds); }});
    groups.push_back({"dem/missing", 0.01, [=](row_reporter& report) {
                          if (!has_lammps)
                              report.counted("dem/missing/LAMMPS/no lmp on this machine (Debian: lammps)/-", {});
                          if (launcher == nullptr)
                              report.counted("dem/missing/two ranks/no MPI library, or started by hand/-", {});
                      }});
}

}  // namespace bench
