#include <tsubu/tsubu.hpp>

#include <cstdio>

namespace dem = tsubu::dem;

// A scene is a type. What none of its models needs is neither stored, nor sent, nor computed.
using scene = dem::simulation<3, double, dem::velocity_verlet, dem::hooke_dashpot<dem::linear_history>, dem::walls,
                              dem::gravity>;
static_assert(scene::bytes_per_particle == 8 + 5 * 24 + 16);  // id; x, v, f, spin, torque; contacts
static_assert(!scene::store_type::has<decltype(tsubu::radius)>);  // all are alike: equal_spheres

int main() {
    tsubu::self_transport on;  // over MPI: mpi_transport; one rank adds and prints, all measure, each writes its file
    const scene::box_type box({0, 0, 0}, {6, 6, 12}, {.periodic = {true, true, false}});
    auto bed = dem::make_run<scene>(box, {.time_step = 2e-3, .skin = 0.1}, on,
                                    scene::contact_type{{.k = 1e4, .gamma = 60}, {.k_t = 1e4 * 2 / 7, .mu = 0.5}},
                                    dem::walls{{{.point = {0, 0, 0}, .normal = {0, 0, 1}}}},
                                    dem::gravity{{0, 0, -1}}, dem::equal_spheres{.radius = 0.5, .mass = 1});

    tsubu::random_stream random(7);
    for (int i = 0; i < 125; ++i) {
        const int column = i % 5, row = i / 5 % 5, layer = i / 25;
        const double x = 1.2 * column + 0.1 * random.unit(), y = 1.2 * row + 0.1 * random.unit();
        bed.particles().push_back(tsubu::id = i, tsubu::position<3> = {x, y, 1.2 * layer + 1});
    }
    bed.start();  // each to its rank; neighbours, forces
    for (int n = 0; n < 5; ++n) {
        bed.steps(1500);
        std::printf("%5.1f s  mean height %.3f m  kinetic energy %7.3f J  contacts per grain %.2f\n",
                    2e-3 * static_cast<double>(bed.steps_done()), dem::mean_position(bed)[2], dem::kinetic_energy(bed),
                    dem::coordination_number(bed));
    }
    tsubu::write_vtp("bed.vtp", bed.particles(), tsubu::position<3>);
    return dem::mean_position(bed)[2] < 1.7 && dem::particle_count(bed) == 125 ? 0 : 1;
}
