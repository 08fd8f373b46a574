// SPDX-License-Identifier: MIT
#include <tsubu/hdf5.hpp>

int main() {
    using set = tsubu::fields<tsubu::id, tsubu::position<3>, tsubu::radius>;
    const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1}, {.periodic = {true, true, false}});
    tsubu::particle_store<set> g;
    tsubu::h5md_writer<set> file("run.h5", box, {.author = "A. Author", .replace = true});
    for (int step = 0; step < 100; step += 10) {
        g.push_back(tsubu::id = step, tsubu::position<3> = {0.5, 0.5, 0.01 * step}, tsubu::radius = 0.1);
        file.append(step, 1e-3 * step, g, box);
    }
    tsubu::h5md_reader reader("run.h5");
    tsubu::particle_store<set> again;
    reader.read_step(50, again, set{});
    return again.size() == 6 && reader.box(5).as<tsubu::domain<3>>().along(2).hi() == 1 ? 0 : 1;
}
