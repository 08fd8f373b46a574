// SPDX-License-Identifier: MIT
/// @file
/// Does LAMMPS read what tsubu writes, and tsubu what LAMMPS writes? lammps.cmake runs LAMMPS between the two halves:
///
///     lammps_client write FOLDER      writes SCENE.lmp and SCENE.in, a script that reads it and writes SCENE.out
///     lammps_client compare FOLDER    compares SCENE.out with what was written
#include <tsubu/core/random.hpp>
#include <tsubu/io/lammps_data_file.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using molecules =
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>, tsubu::mass,
                                        tsubu::image<3>, tsubu::molecule, tsubu::charge, tsubu::bonds, tsubu::angles,
                                        tsubu::dihedrals, tsubu::impropers>>;
using grains =
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>,
                                        tsubu::angular_velocity<3>, tsubu::radius, tsubu::density, tsubu::image<3>>>;

constexpr std::int64_t count = 120;
const tsubu::lammps_header cube{.title = "written by tsubu", .lo = {-1, 0, 2}, .hi = {9, 10, 12.5}};

/// Ids 3, 6, 9, ... in no order.
std::vector<std::int64_t> shuffled_names() {
    std::vector<std::int64_t> names;
    for (std::int64_t k = 1; k <= count; ++k) names.push_back(3 * k);
    tsubu::random_stream random(11);
    for (auto k = names.size(); k-- > 1;) std::swap(names[k], names[random.below(k + 1)]);
    return names;
}

template <class Newton>
molecules make_molecules() {
    molecules g;
    tsubu::random_stream random(12);
    const auto u = [&] { return random.unit(); };
    const auto names = shuffled_names();
    tsubu::id_map<> where;
    where.rebuild(names);
    for (const auto name : names) {
        const auto type = static_cast<std::int32_t>(1 + name / 3 % 2);
        g.push_back(tsubu::id = name, tsubu::species = type, tsubu::mass = 1.0 / (2 + type), tsubu::charge = u() - 0.5,
                    tsubu::molecule = name / 12, tsubu::position<3> = {10 * u() - 1, 10 * u(), 2 + 10.5 * u()},
                    tsubu::velocity<3> = {u() - 0.5, (u() - 0.5) * 1e-9, (u() - 0.5) * 1e9},
                    tsubu::image<3> = {name % 3 - 1, name % 5 - 2, 0});
    }
    for (std::int64_t k = 3; k + 9 <= 3 * count; k += 3) {  // chains with side chains; a few bonds of a second type
        const auto two = static_cast<std::int32_t>(1 + k / 3 % 2);
        tsubu::topology<tsubu::bonds, Newton>::insert(g, where, {.type = two, .ids = {k + 3, k}});
        tsubu::topology<tsubu::angles, Newton>::insert(g, where, {.type = two, .ids = {k, k + 3, k + 6}});
        if (k % 2 == 0) tsubu::topology<tsubu::dihedrals, Newton>::insert(g, where, {1, {k, k + 3, k + 6, k + 9}});
        if (k % 4 == 0) tsubu::topology<tsubu::impropers, Newton>::insert(g, where, {1, {k + 9, k + 3, k, k + 6}});
    }
    return g;
}

grains make_grains() {
    grains g;
    tsubu::random_stream random(13);
    const auto u = [&] { return random.unit(); };
    for (const auto name : shuffled_names()) {
        const double y = u();
        g.push_back(tsubu::id = name, tsubu::species = 1, tsubu::radius = 0.1 + u(), tsubu::density = 2000 + u(),
                    tsubu::position<3> = {-1 + 10 * u() + 2.5 * y, 10 * y, 2 + 10.5 * u()},
                    tsubu::velocity<3> = {u(), u(), u()}, tsubu::angular_velocity<3> = {u(), -u(), u()});
    }
    return g;
}

void write_script(const std::string& folder, const std::string& scene, const std::string& setup,
                  const std::string& coefficients) {
    tsubu::atomic_file script(folder + "/" + scene + ".in");
    script.append("units lj\nboundary p p p\n" + setup + "read_data " + scene +
                  ".lmp\npair_style zero 1.0 nocoeff\npair_coeff * *\n" + coefficients + "write_data " + scene +
                  ".out nocoeff\n");
    script.commit();
}

template <class Newton>
void write_molecules(const std::string& folder, const std::string& scene, const std::string& newton) {
    tsubu::write_lammps<Newton>(folder + "/" + scene + ".lmp", make_molecules<Newton>(), cube);
    write_script(folder, scene,
                 "newton " + newton +
                     "\natom_style full\nbond_style zero\nangle_style zero\ndihedral_style zero\nimproper_style zero\n"
                     "comm_modify cutoff 4.0\n",
                 "bond_coeff *\nangle_coeff *\ndihedral_coeff *\nimproper_coeff *\n");
}
void write_all(const std::string& folder) {
    write_molecules<tsubu::newton_on>(folder, "newton_on", "on");
    write_molecules<tsubu::newton_off>(folder, "newton_off", "off");
    auto tilted = cube;
    tilted.tilt = tsubu::vec<3>{2.5, 0, 0};
    tsubu::write_lammps(folder + "/grains.lmp", make_grains(), tilted);
    write_script(folder, "grains", "atom_style sphere\n", "");
}

template <class Newton, class Store>
std::string canonical(const Store& store) {
    std::string text;
    tsubu::lammps_writer out([&](std::string_view chunk) { text += chunk; }, {.canonical = true}, Newton{});
    out.write(store, cube);
    return text;
}

template <class Newton>
bool compare_molecules(const std::string& folder, const std::string& scene) {
    molecules came;
    tsubu::read_lammps<Newton>(folder + "/" + scene + ".out", came);
    const auto ours = canonical<Newton>(make_molecules<Newton>());
    const auto theirs = canonical<Newton>(came);
    if (ours == theirs && ours.size() > 10000) return true;
    std::size_t at = 0;
    while (at < ours.size() && at < theirs.size() && ours[at] == theirs[at]) ++at;
    const auto from = ours.rfind('\n', at) + 1;
    std::fprintf(stderr, "%s: tsubu wrote\n%s\nLAMMPS gave back\n%s\n", scene.c_str(), ours.substr(from, 200).c_str(),
                 theirs.substr(from, 200).c_str());
    return false;
}
/// LAMMPS keeps the mass of a grain, and goes to fractions of a tilted box and back: densities and positions are
/// rounded.
bool compare_grains(const std::string& folder) {
    const auto g = make_grains();
    grains came;
    const auto top = tsubu::read_lammps(folder + "/grains.out", came);
    std::vector<std::int64_t> names(came[tsubu::id].begin(), came[tsubu::id].end());
    tsubu::id_map<> where;
    where.rebuild(names);
    bool same =
        came.size() == g.size() && top.tilt == tsubu::vec<3>{2.5, 0, 0} && top.lo == cube.lo && top.hi == cube.hi;
    const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-13 * (1 + std::abs(b)); };
    for (std::size_t i = 0; same && i < g.size(); ++i) {
        const auto j = static_cast<std::size_t>(where.at(g[tsubu::id][i]));
        same = came[tsubu::velocity<3>][j] == g[tsubu::velocity<3>][i] &&
               came[tsubu::angular_velocity<3>][j] == g[tsubu::angular_velocity<3>][i] &&
               came[tsubu::radius][j] == g[tsubu::radius][i] && near(came[tsubu::density][j], g[tsubu::density][i]) &&
               came[tsubu::image<3>][j] == g[tsubu::image<3>][i];
        for (std::size_t k = 0; k < 3; ++k)
            same = same && near(came[tsubu::position<3>][j][k], g[tsubu::position<3>][i][k]);
        if (!same) std::fprintf(stderr, "grains: id %lld differs\n", static_cast<long long>(g[tsubu::id][i]));
    }
    return same;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc == 3 ? argv[1] : "";
    try {
        if (what == "write") {
            write_all(argv[2]);
            return 0;
        }
        if (what == "compare") {
            const bool on = compare_molecules<tsubu::newton_on>(argv[2], "newton_on");
            const bool off = compare_molecules<tsubu::newton_off>(argv[2], "newton_off");
            const bool grains_same = compare_grains(argv[2]);
            return on && off && grains_same ? 0 : 1;
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    std::fputs("usage: lammps_client write|compare FOLDER\n", stderr);
    return 2;
}
