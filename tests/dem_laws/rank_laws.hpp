// SPDX-License-Identifier: MIT
/// @file
/// A scene does not depend on the ranks it runs on: laws for any transport, against the same scene in one process.
#pragma once

#include <tsubu/comm/shared_restart.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/scenes/chain.hpp>
#include <tsubu/dem/scenes/gas.hpp>
#include <tsubu/dem/scenes/pair.hpp>
#include <tsubu/dem/scenes/settle.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace dem_laws {

/// Positions and velocities of all particles in the order of their ids, on each rank. Collective.
template <class Run>
[[nodiscard]] std::vector<double> all_states(Run& of, std::int64_t first_id, std::size_t count) {
    constexpr auto D = Run::simulation_type::dimension;
    std::vector<double> all(count * 2 * D, 0.0);
    for (std::size_t i = 0; i < of.particles().owned_count(); ++i) {
        const auto x = of.position(static_cast<tsubu::index_t>(i));
        const auto v = of.particles()[Run::simulation_type::quantities_type::velocity][i];
        const auto row = static_cast<std::size_t>(of.particles()[tsubu::id][i] - first_id) * 2 * D;
        for (std::size_t k = 0; k < D; ++k) {
            all[row + k] += x[k];
            all[row + D + k] += static_cast<double>(v[k]);
        }
    }
    of.on().reduce(std::span<double>(all), tsubu::reduction::sum);  // of one number and zeros: exact
    return all;
}
/// The greatest difference of any coordinate, the shorter way round a box that may be periodic.
template <class Box>
[[nodiscard]] double farthest(const std::vector<double>& a, const std::vector<double>& b, const Box& box,
                              std::size_t dimension) {
    double most = a.size() == b.size() ? 0 : INFINITY;
    for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
        double apart = std::abs(a[n] - b[n]);
        const auto k = n % (2 * dimension);
        if (k < dimension) apart = std::min(apart, std::abs(apart - static_cast<double>(box.along(k).length())));
        most = std::max(most, apart);
    }
    return most;
}
/// How far a number may be off for having been summed in another order.
[[nodiscard]] inline bool is_near(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// After so many steps a scene is where it is on one rank, to within `tolerance`; 0: bit for bit.
///
/// on_one_rank(on, body) calls body with a transport of the type of `on` that has one rank: each scene is compiled
/// once.
/// @param change  done to each particle before the start
template <class Scene, tsubu::transport Transport, class Check, class Change>
void scene_does_not_depend_on_ranks(const Scene& scene, std::size_t steps, double tolerance, Transport& on,
                                    Check&& check, Change&& change) {
    constexpr auto D = Scene::simulation::dimension;
    const auto count = static_cast<std::size_t>(scene.count());
    const auto first_id = [&] {
        if constexpr (requires { scene.first_id; })
            return scene.first_id;
        else if constexpr (requires { scene.masses; })
            return std::int64_t{0};
        else
            return std::int64_t{1};
    }();
    struct figures {
        std::vector<double> states;
        double kinetic, rotational, elastic, contacts;
    };
    const auto measured = [&](auto& of) {
        return figures{all_states(of, first_id, count), kinetic_energy(of), rotational_energy(of), elastic_energy(of),
                       coordination_number(of)};
    };
    figures expected{};
    on_one_rank(on, [&](Transport& alone) {
        const auto one = tsubu::dem::stage(scene, alone);
        change(*one);
        one->steps(steps);
        expected = measured(*one);
    });
    const auto found = tsubu::dem::stage(scene, on);
    change(*found);
    const auto momentum = tsubu::dem::momentum(*found);
    found->steps(steps);
    const auto now = measured(*found);
    check(tsubu::dem::particle_count(*found) == scene.count(), "ranks: no particle is lost or doubled");
    const double off = farthest(expected.states, now.states, found->box(), D);
    check(off <= tolerance, "positions and velocities: off by " + std::to_string(off));
    const double slack = std::max(tolerance, 1e-12);  // the energy is a sum of many
    check(is_near(now.kinetic, expected.kinetic, slack), "kinetic energy: differs");
    check(is_near(now.rotational, expected.rotational, 100 * slack), "rotational energy: differs");
    check(is_near(now.elastic, expected.elastic, 100 * slack), "elastic energy: differs");
    check(is_near(now.contacts, expected.contacts, 1e-12), "contacts: differ");
    if constexpr (!Scene::simulation::has_walls && !Scene::simulation::has_springs) {
        const auto after = tsubu::dem::momentum(*found);
        for (std::size_t k = 0; k < D; ++k)
            check(std::abs(after[k] - momentum[k]) < 1e-12 * static_cast<double>(count), "momentum: not conserved");
    }
}
template <class Scene, tsubu::transport Transport, class Check>
void scene_does_not_depend_on_ranks(const Scene& scene, std::size_t steps, double tolerance, Transport& on,
                                    Check&& check) {
    scene_does_not_depend_on_ranks(scene, steps, tolerance, on, check, [](auto&) {});
}

/// A bed that also moves sideways, so that contacts that remember go from rank to rank.
[[nodiscard]] inline tsubu::dem::settle_scene<> small_bed() { return {.cells = {5, 4, 6}}; }
template <class Run>
void push_sideways(Run& bed) {
    for (auto& v : bed.particles().owned()[tsubu::velocity<3>]) {
        v[0] += 6;
        v[1] += 4;
    }
    bed.start();
}

template <tsubu::transport Transport, class Check>
void pair_does_not_depend_on_ranks(Transport& on, Check&& check) {
    const tsubu::dem::pair_scene<> scene{.law = tsubu::dem::hooke<>{{2e5}}, .time_step = 1e-4};
    scene_does_not_depend_on_ranks(scene, 100, 0, on, check);
}
template <tsubu::transport Transport, class Check>
void chain_does_not_depend_on_ranks(Transport& on, Check&& check) {
    // Of each mass two forces are summed, whose order does not matter.
    const tsubu::dem::chain_scene<> scene{.time_step = .5, .masses = 30, .amplitude = .3};
    scene_does_not_depend_on_ranks(scene, 400, 0, on, check);
}
template <tsubu::transport Transport, class Check>
void gas_does_not_depend_on_ranks(Transport& on, Check&& check) {
    const tsubu::dem::gas_scene<> scene{.law = tsubu::dem::hooke<>{{2e4}},
                                        .time_step = 1e-3,
                                        .per_edge = 5,
                                        .fraction = .1};
    scene_does_not_depend_on_ranks(scene, 1000, 1e-9, on, check);
}
template <tsubu::transport Transport, class Check>
void bed_does_not_depend_on_ranks(Transport& on, Check&& check) {
    scene_does_not_depend_on_ranks(small_bed(), 1000, 1e-9, on, check, [](auto& bed) { push_sideways(bed); });
}
/// Where a bed is so many steps after it was read from a file.
/// @param reads_alone  the last rank reads all of it
/// @param forgets      what contacts remember is thrown away
template <class Scene, tsubu::transport Transport>
[[nodiscard]] std::vector<double> states_after_file(const Scene& scene, const std::string& path, std::size_t steps,
                                                    Transport& on, bool reads_alone = false, bool forgets = false) {
    using simulation = typename Scene::simulation;
    const auto other = std::apply(
        [&](const auto&... models) {
            return std::make_unique<tsubu::dem::run<simulation, Transport>>(scene.box(), scene.how(), on, models...);
        },
        scene.models());
    auto& particles = other->particles();
    if (!reads_alone)
        tsubu::read_restart(on, path, particles, typename simulation::restart_fields{},
                            typename simulation::decomposition_type(scene.box(), on.ranks()));
    else if (on.rank() + 1 == on.ranks())
        tsubu::read_restart(path, particles, typename simulation::restart_fields{});
    if (forgets)
        for (std::size_t i = 0; i < particles.size(); ++i)
            particles[simulation::quantities_type::template contacts<simulation::history_size>][i].clear();
    other->resume();
    other->steps(steps);
    return all_states(*other, 1, static_cast<std::size_t>(scene.count()));
}
/// A bed goes on from a file as it would have gone on, whatever reads it; without what its contacts remember it does
/// not.
/// @param path  of a file that all ranks see
template <tsubu::transport Transport, class Check>
void bed_goes_on_from_a_file(Transport& on, const std::string& path, Check&& check) {
    const auto scene = small_bed();
    const auto first = tsubu::dem::stage(scene, on);
    push_sideways(*first);
    first->steps(1000);
    first->keep_history();
    tsubu::write_restart(on, path, first->particles(), tsubu::dem::settle_scene<>::simulation::restart_fields{});
    first->steps(100);
    const auto expected = all_states(*first, 1, static_cast<std::size_t>(scene.count()));
    const auto off_after = [&](bool reads_alone, bool forgets) {
        return farthest(states_after_file(scene, path, 100, on, reads_alone, forgets), expected, first->box(), 3);
    };
    const double shared = off_after(false, false);
    check(shared < 1e-10, "restart: off by " + std::to_string(shared));
    const double alone = off_after(true, false);
    check(alone < 1e-10, "restart that one rank reads: off by " + std::to_string(alone));
    const double without = off_after(false, true);
    check(without > 1e-7, "restart without memory: off by only " + std::to_string(without));
}

}  // namespace dem_laws
