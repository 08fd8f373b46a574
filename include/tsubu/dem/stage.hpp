// SPDX-License-Identifier: MIT
/// @file
/// stage: puts a scene that is described by its numbers onto ranks.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/dem/options.hpp>
#include <tsubu/dem/run.hpp>

#include <concepts>  // std::same_as
#include <cstddef>   // std::size_t
#include <cstdint>   // std::uint64_t
#include <memory>    // std::make_unique, std::unique_ptr
#include <tuple>     // std::apply

namespace tsubu::dem {

/// A scene with its numbers: what is where at the beginning.
///  1. simulation is its type; box(), how() and models() are a run's arguments;
///  2. place(store, box, n) adds particle n of count(), and nothing else: each is placed by one rank, whichever.
template <class Scene>
concept staged_scene = requires(const Scene& scene, typename Scene::simulation::store_type& store,
                                const typename Scene::simulation::box_type& box) {
    { scene.box() } -> std::same_as<typename Scene::simulation::box_type>;
    { scene.how() } -> std::same_as<options>;
    scene.models();
    { scene.count() } -> std::same_as<std::uint64_t>;
    scene.place(store, box, std::uint64_t{});
};

/// The run of a scene, started: particles are on their ranks, with neighbours and forces.
///
///     tsubu::self_transport on;
///     auto bed = tsubu::dem::stage(tsubu::dem::settle_scene<>{}, on);
///     bed->steps(1000);
///
/// Each rank places an equal share of the particles; start sends them where they belong.
/// Collective: yes, with the same scene on all ranks.
template <staged_scene Scene, transport Transport>
[[nodiscard]] auto stage(const Scene& scene, Transport& on) {
    using run_type = run<typename Scene::simulation, Transport>;
    const auto box = scene.box();
    auto made = std::apply(
        [&](const auto&... models) { return std::make_unique<run_type>(box, scene.how(), on, models...); },
        scene.models());
    const auto all = scene.count();
    const auto share = [&](std::uint64_t rank) { return all / on.ranks() * rank + all % on.ranks() * rank / on.ranks(); };
    const auto mine = static_cast<std::size_t>(share(on.rank() + 1) - share(on.rank()));
    agreement<> all_ranks(on.rank());
    all_ranks.attempt([&] {
        made->particles().reserve(mine + mine / 8);  // ghosts too: growing would double what is held
        for (auto n = share(on.rank()); n < share(on.rank() + 1); ++n) scene.place(made->particles(), box, n);
    });
    on.reduce(all_ranks.words(), reduction::sum);
    all_ranks.settle("dem::stage");
    made->start();
    return made;
}

}  // namespace tsubu::dem
