// SPDX-License-Identifier: MIT
#include <tsubu/tsubu.hpp>

#include <cstdio>

using carried = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<3>, tsubu::velocity<3>, tsubu::bonds>;

int main() {
    const tsubu::domain<3> box{{0, 0, 0}, {1, 1, 2}, {.periodic = {true, true, false}}};
    tsubu::particle_store<carried> g;
    for (int i = 1; i <= 2; ++i)
        g.push_back(tsubu::id = i, tsubu::species = 1, tsubu::position<3> = {0.5, 0.5, 0.9 * i});
    tsubu::id_map<> where;
    where.rebuild(g[tsubu::id].span());
    tsubu::topology<tsubu::bonds, tsubu::newton_on>::insert(g, where, {.type = 1, .ids = {1, 2}});

    tsubu::write_lammps("pair.lmp", g, tsubu::lammps_header::of(box));  // LAMMPS reads it
    tsubu::write_vtp("pair.vtp", g, tsubu::position<3>);             // ParaView opens it
    tsubu::write_restart("pair.restart", g, carried{}, {.step = 1000, .box = tsubu::restart_box(box)});

    tsubu::particle_store<carried> again, resumed;
    const auto top = tsubu::read_lammps("pair.lmp", again);
    const auto state = tsubu::read_restart("pair.restart", resumed, carried{});
    for (const char* name : {"pair.lmp", "pair.vtp", "pair.restart"}) std::remove(name);
    return top.bonds.rows == 1 && again[tsubu::position<3>][1][2] == 1.8 && state.step == 1000 && resumed.size() == 2
               ? 0
               : 1;
}
