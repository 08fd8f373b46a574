// SPDX-License-Identifier: MIT
/// @file
/// A user's program with HDF5: writes a frame and reads it again.
#include <tsubu/hdf5.hpp>

#include <cstdio>

int main() {
    using set = tsubu::fields<tsubu::id, tsubu::position<3>>;
    const tsubu::domain<3> box({0, 0, 0}, {1, 1, 1});
    tsubu::particle_store<set> g;
    g.push_back(tsubu::id = 7, tsubu::position<3> = {0.25, 0.5, 0.75});
    tsubu::h5md_writer<set> writer("consumer.h5", box, {.replace = true});
    writer.append(1, 0.5, g, box);
    writer.close();
    tsubu::particle_store<set> again;
    tsubu::h5md_reader("consumer.h5").read(0, again, set{});
    const bool good = again.size() == 1 && again[tsubu::id][0] == 7 && again[tsubu::position<3>][0][2] == 0.75;
    std::puts(good ? "found" : "wrong");
    return good ? 0 : 1;
}
