// SPDX-License-Identifier: MIT
/// @file
/// What scenes of spheres cost, and how exact they are: work against precision, errors past the limit of stability, the
/// price of each model, and LAMMPS beside it.
///
/// Rows:
///
///     dem/impact/LAW/INTEGRATOR/NUMBER       rms error of the restitution of two spheres, over 16 phases of a step
///     dem/past/LAW/INTEGRATOR/NUMBER         the same past the limit
///     dem/cost/LAW/INTEGRATOR/NUMBER         ns per particle-step of the same simulation, of a row of spheres
///     dem/oblique/CASE/INTEGRATOR/NUMBER     rms error of velocity and spin after a floor was hit at 45 degrees
///     dem/oblique_cost/all/INTEGRATOR/NUMBER ns per particle-step of the same simulation
///     dem/gas/hooke/INTEGRATOR/NUMBER        relative drift of the energy of an elastic gas
///     dem/gas_cost/hooke/INTEGRATOR/NUMBER   ns per particle-step of it
///     dem/walls/ZETA/INTEGRATOR/double       error of a sphere between two walls, over dt, up to and past the limit
///     dem/settle/bed/velocity_verlet/double  what a bed becomes that settles with a long step
///     dem/ladder/RUNG/BASE/NUMBER            ns per particle-step and bytes per particle in a dense bed; BASE is the
///                                            rung without the last model
///     dem/lists/bed/half | full/double       ns per particle of building a list of neighbours
///     dem/hand/TASK/WHO/double               loops by hand beside the library's
///     dem/beside/SCENE/tsubu | lammps/double the same scene, on the same core, in turns
///     dem/ranks/SCENE/RANKS/double           ns per particle-step on 1 and 2 ranks
///     dem/missing/WHAT/WHY/-                 what could not be measured

#include "dem/plan.hpp"
#include "support/command_line.hpp"

namespace bench {
namespace {

constexpr const char* usage =
    "bench_dem [--quick | --full] [--only TEXT] [--benchmark_out=FILE.json]\n"
    "  --quick     less than a minute, and less than one for LAMMPS\n"
    "  (neither)   less than 4 minutes, and 2 for LAMMPS\n"
    "  --full      longer sweeps and more repetitions\n"
    "  --only TEXT only groups whose name contains it, such as dem/impact or dem/ladder\n";

int run(const options& chosen) {
    std::vector<group> groups;
    add_impacts(groups, chosen.how_much);
    add_limits(groups, chosen.how_much);
#if defined(TSUBU_BENCH_WITHOUT_PRICES)
    groups.push_back({"dem/missing", 0.01, [](row_reporter& report) {
                          report.counted("dem/missing/the price of models, LAMMPS and two ranks/left out by --quick/-",
                                         {});
                      }});
#else
    add_beds(groups, chosen.how_much);
    add_rivals(groups, chosen.how_much);
#endif
    return run_groups("bench_dem", groups, chosen);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) { return bench::run_program(argc, argv, "bench_dem", bench::usage, false, bench::run); }
