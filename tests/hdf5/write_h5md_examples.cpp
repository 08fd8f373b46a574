// SPDX-License-Identifier: MIT
/// @file
/// write_h5md_examples FOLDER: H5MD files for check_h5md.py, which knows what must be in them.
#include <tsubu/hdf5.hpp>

#include "h5md_examples.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace {

/// Frames of 3, 0 and 5 particles. Particle i of frame k has the id 10 i + k, and numbers that follow from it.
template <std::size_t D, class Box>
void write_file(const std::string& path, const Box& first, const Box& second) {
    using set = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<D>, tsubu::velocity<D, float>, tsubu::image<D>,
                              tsubu::mass, tsubu::angular_velocity<D>, frozen, phase_of, stress, acceleration>;
    tsubu::h5md_writer<set> file(path, first,
                                 {.author = "Zo\xc3\xab",
                                  .email = "zoe@example.org",
                                  .creator = "example",
                                  .creator_version = "1.2",
                                  .group = "grains"});
    const int counts[] = {3, 0, 5};
    for (int k = 0; k < 3; ++k) {
        tsubu::particle_store<set> g;
        for (int i = 0; i < counts[k]; ++i) {
            const int number = 10 * i + k;
            auto p = g[g.push_back(tsubu::id = number)];
            p[tsubu::species] = -number;
            for (std::size_t j = 0; j < D; ++j) {
                p[tsubu::position<D>][j] = number + 0.125 * static_cast<double>(j);
                p[tsubu::velocity<D, float>][j] = static_cast<float>(number) / 4;
                p[tsubu::image<D>][j] = number - 1;
            }
            p[tsubu::mass] = 0.1 * number;
            p[tsubu::angular_velocity<D>][0] = number;
            p[frozen] = i % 2 == 0;
            p[phase_of] = phase::liquid;
            p[stress][1][2] = number;
        }
        file.append(100 * (k + 1), 0.5 * k, g, k < 2 ? first : second);
    }
    file.close();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("write_h5md_examples FOLDER\n", stderr);
        return 2;
    }
    const std::string folder = argv[1];
    try {
        write_file<3>(folder + "/straight.h5",
                      tsubu::domain<3>({-1, -2, -3}, {1, 2, 3}, {.periodic = {true, false, true}}),
                      tsubu::domain<3>({-1, -2, -3}, {1, 2, 5}, {.periodic = {true, false, true}}));
        write_file<2>(folder + "/flat.h5", tsubu::domain<2>({0, 0}, {2, 4}), tsubu::domain<2>({0, 0}, {2, 8}));
        write_file<3>(folder + "/tilted.h5",
                      tsubu::triclinic_box<3>({0, 0, 0}, {2, 4, 6}, {0.5, 0.25, 0.125}, {true, true, true}),
                      tsubu::triclinic_box<3>({0, 0, 0}, {2, 4, 8}, {0.5, 0.25, 0.125}, {true, true, true}));
    } catch (const tsubu::error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
