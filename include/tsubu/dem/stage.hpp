// SPDX-License-Identifier: MIT
/// @file
/// stage: puts a scene that is described by its numbers onto ranks.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/options.hpp>
#include <tsubu/dem/quantities.hpp>
#include <tsubu/dem/run.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>     // std::array
#include <concepts>  // std::same_as
#include <cstddef>   // std::size_t
#include <cstdint>   // std::int64_t, std::uint64_t
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

/// The box of a scene from lo to hi [m], whatever the scene counts in. On a lattice, and in cells, it is periodic along
/// all axes, since such boxes are: nothing may come near to faces that are not to be seen.
template <class Simulation>
[[nodiscard]] auto scene_box(const vec<Simulation::dimension>& lo, const vec<Simulation::dimension>& hi,
                             const std::array<bool, Simulation::dimension>& periodic = {}) {
    using box_type = typename Simulation::box_type;
    typename box_type::real_position_type from{};
    typename box_type::real_position_type to{};
    typename box_type::options with{};
    for (std::size_t k = 0; k < Simulation::dimension; ++k) {
        from[k] = static_cast<typename box_type::real_type>(lo[k]);
        to[k] = static_cast<typename box_type::real_type>(hi[k]);
        with.periodic[k] = periodic[k] || is_lattice<typename Simulation::coordinate>;
    }
    return box_type(from, to, with);
}
/// One particle more, at x [m] with velocity v [m/s], whatever the scene counts in. @return its index
/// @throws input_error if x is not finite.
template <class Simulation, class Box>
index_t add_particle(typename Simulation::store_type& store, const Box& box, std::int64_t id,
                     const vec<Simulation::dimension>& x, const vec<Simulation::dimension>& v = {}) {
    using quantities = typename Simulation::quantities_type;
    typename Box::real_position_type at{};
    vec<Simulation::dimension, typename quantities::real> velocity{};
    for (std::size_t k = 0; k < Simulation::dimension; ++k) {
        at[k] = static_cast<typename Box::real_type>(x[k]);
        velocity[k] = static_cast<typename quantities::real>(v[k]);
    }
    const auto i = store.push_back(tsubu::id = id, quantities::velocity = velocity);
    put<quantities>(store, static_cast<std::size_t>(i), box, at);
    return i;
}

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
    auto made =
        std::apply([&](const auto&... models) { return std::make_unique<run_type>(box, scene.how(), on, models...); },
                   scene.models());
    const auto all = scene.count();
    const auto share = [&](std::uint64_t rank) {
        return all / on.ranks() * rank + all % on.ranks() * rank / on.ranks();
    };
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
