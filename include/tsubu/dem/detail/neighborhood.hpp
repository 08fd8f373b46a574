// SPDX-License-Identifier: MIT
/// @file
/// Who is near whom: particles on their ranks, ghosts, lists of pairs, and what contacts remember.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/halo.hpp>
#include <tsubu/comm/migrate.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/detail/contact_history.hpp>
#include <tsubu/dem/options.hpp>
#include <tsubu/dem/springs.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/id/same_id_links.hpp>
#include <tsubu/neighbor/pair_list.hpp>
#include <tsubu/neighbor/reach.hpp>
#include <tsubu/neighbor/skin_watch.hpp>
#include <tsubu/store/curve.hpp>
#include <tsubu/store/topology.hpp>

#include <algorithm>  // std::max
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu::dem::detail {

/// A spring of an owned particle.
struct placed_spring {
    index_t i;
    index_t j;
    index_t kind;
};

/// Finds who is near whom, and keeps that up to date.
template <class Simulation, class Transport>
class neighborhood {
    static constexpr auto D = Simulation::dimension;
    using store_type = typename Simulation::store_type;
    using parts_type = typename Simulation::decomposition_type;
    using box_type = typename Simulation::box_type;
    using bodies_type = typename Simulation::bodies_type;

public:
    neighborhood(const box_type& box, const options& how, Transport& on, const bodies_type& bodies,
                 std::vector<wall_plane<D>> walls, std::size_t spring_kinds)
        : parts_(box, on.ranks()),
          on_(&on),
          how_(how),
          bodies_(bodies),
          walls_(std::move(walls)),
          spring_kinds_(spring_kinds),
          watch_(how.skin, how.check_every) {}

    [[nodiscard]] const box_type& box() const noexcept { return parts_.whole(); }
    [[nodiscard]] std::span<const index_pair> pairs() const noexcept { return pairs_.pairs(); }
    [[nodiscard]] std::span<const index_pair> near_walls() const noexcept {
        return {near_walls_.data(), near_walls_.size()};
    }
    [[nodiscard]] std::span<const wall_plane<D>> walls() const noexcept { return {walls_.data(), walls_.size()}; }
    [[nodiscard]] std::span<const placed_spring> springs() const noexcept { return {springs_.data(), springs_.size()}; }
    [[nodiscard]] contact_history<Simulation>& history() noexcept { return history_; }
    [[nodiscard]] std::uint64_t renewals() const noexcept { return renewals_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return pairs_.memory_bytes() + near_walls_.capacity() * sizeof(index_pair) +
               springs_.capacity() * sizeof(placed_spring) + history_.memory_bytes();
    }

    /// No particle goes farther than this until the next call [m].
    void travel(double distance) noexcept { watch_.travel(distance); }
    /// Ghosts begin to follow their owners, or neighbours are found anew if that is due. @return whether they were.
    /// Collective, and finish after it if they were not.
    bool follow(store_type& store) {
        if (watch_.is_due(*on_)) {
            keep_history(store);
            renew(store, typename Simulation::migration_fields{}, partners::may_be_gone);
            return true;
        }
        start_forward(store, typename Simulation::forward_fields{});
        return false;
    }
    /// The values of ghosts are there when this returns. Collective.
    void finish(store_type& store) { finish_forward(store, typename Simulation::forward_fields{}); }
    /// Of pairs(), how many, the first ones, have no ghost.
    [[nodiscard]] std::size_t inner_pairs() const noexcept { return pairs_.inner_count(); }
    /// Between two looks: whether lists have been used too long. Collective.
    void check_uses() {
        if (how_.check_every > 1) watch_.check(*on_);
    }
    /// The particles take what contacts remember; before they change places, or are written. The lists hold on.
    void keep_history(store_type& store) { history_.keep(store, pairs(), near_walls()); }
    void drop_kept_history(store_type& store) { history_.drop_kept(store); }
    /// Particles go to their ranks, with these fields; ghosts and neighbours are found anew. Collective.
    template <class Carried>
    void renew(store_type& store, Carried carried, partners which) {
        pairs_ = {};  // they end with the places of particles, whatever fails below
        near_walls_.clear();
        springs_.clear();
        migrate(store, parts_, *on_, refuse_lost{}, carried);
        if (how_.sort_every != 0 && renewals_ % how_.sort_every == 0)
            store.permute(order_along(hilbert_curve{}, box(), store.owned()[Simulation::quantities_type::position]));
        halo_ =
            make_halo(store, parts_, static_cast<typename box_type::real_type>(cutoff(store) + widest_cell()), *on_);
        agreement<> all(on_->rank());
        all.attempt([&] {
            if constexpr (Simulation::has_contacts) {
                find_pairs(store);
                if constexpr (Simulation::has_walls) find_walls(store);
                history_.recall(store, pairs(), near_walls(), which);
            }
            if constexpr (Simulation::has_springs) find_springs(store);
        });
        on_->reduce(all.words(), reduction::sum);
        all.settle("dem::run", "particles are on their ranks, and have no neighbours");
        watch_.restart();
        ++renewals_;
    }
    /// Ghosts get these fields of their owners. Collective.
    template <auto... F>
    void forward(store_type& store, fields<F...>) {
        if constexpr (sizeof...(F) != 0) halo_.forward(store, F...);
    }

private:
    template <auto... F>
    void start_forward(const store_type& store, fields<F...>) {
        if constexpr (sizeof...(F) != 0) halo_.start_forward(store, F...);
    }
    template <auto... F>
    void finish_forward(store_type& store, fields<F...>) {
        if constexpr (sizeof...(F) != 0) halo_.finish_forward(store, F...);
    }
    /// How far ghosts are needed [m]: as far as particles touch, and the skin. Collective.
    [[nodiscard]] double cutoff(const store_type& store) {
        double touching = 0;
        if constexpr (Simulation::has_contacts) {
            if constexpr (bodies_type::are_equal) {
                touching = 2 * bodies_.radius;
            } else {
                for (const auto r : store.owned()[tsubu::radius]) touching = (std::max)(touching, 2 * r);
                on_->reduce(std::span<double>(&touching, 1), reduction::greatest);
            }
        }
        const double needed = touching + how_.skin;
        if constexpr (Simulation::has_history || is_lattice<typename Simulation::coordinate>)
            for (std::size_t k = 0; k < D; ++k)
                if (const auto& along = box().real_axis(k); along.is_periodic() && !(along.length() > 2 * needed))
                    tsubu::detail::raise<input_error>(
                        "dem::run",
                        "a periodic box of " + tsubu::detail::shown(along.length()) + " m along axis " +
                            std::to_string(k) + ", and neighbours up to " + tsubu::detail::shown(needed) + " m",
                        "take a box of more than twice that: it would not be known which image of a particle is "
                        "meant");
        if (how_.cutoff == 0) return needed;
        if (!(how_.cutoff >= needed))
            tsubu::detail::raise<input_error>(
                "dem::run",
                "a cutoff of " + tsubu::detail::shown(how_.cutoff) + " m, but the two largest particles touch at " +
                    tsubu::detail::shown(touching) + " m, and the skin is " + tsubu::detail::shown(how_.skin) + " m",
                "give a cutoff of at least their sum, or 0 for just that");
        return how_.cutoff;
    }
    /// By how much a particle may be nearer than the middle of its cell, twice [m].
    [[nodiscard]] double widest_cell() const noexcept {
        double width = 0;
        if constexpr (Simulation::quantities_type::has_offsets)
            for (std::size_t k = 0; k < D; ++k) width = (std::max)(width, box().along(k).length_of(1.0));
        return width * static_cast<double>(D);
    }
    void find_pairs(store_type& store) {
        if (store.size() == 0) return;  // then nothing tells a reach
        const auto build = [&](const auto& x) {
            if constexpr (bodies_type::are_equal)
                pairs_.build(x, store.owned_count(), same_reach{2 * bodies_.radius + how_.skin});
            else
                pairs_.build(x, store.owned_count(), radii_reach<>{store[tsubu::radius].span(), how_.skin});
        };
        if constexpr (is_lattice<typename Simulation::coordinate>) {
            // On the lattice a ghost lies where its owner does: real positions tell them apart.
            const columns<Simulation> of(store, box(), bodies_);
            std::vector<vec<D, double>> x(store.size());
            for (std::size_t i = 0; i < store.size(); ++i) {
                x[i] = of.real_position(static_cast<index_t>(i));
                if (i < store.owned_count()) continue;
                const auto& shift = halo_.shift(i - store.owned_count());
                for (std::size_t k = 0; k < D; ++k) x[i][k] += static_cast<double>(shift[k]) * box().along(k).length();
            }
            build(x);
        } else {
            build(store[Simulation::quantities_type::position]);
        }
    }
    void find_walls(store_type& store) {
        const columns<Simulation> of(store, box(), bodies_);
        for (std::size_t i = 0; i < store.owned_count(); ++i) {
            const auto at = static_cast<index_t>(i);
            for (std::size_t w = 0; w < walls_.size(); ++w)
                if (walls_[w].distance(of.real_position(at)) < static_cast<double>(of.radius_at(at)) + how_.skin)
                    near_walls_.push_back({at, static_cast<index_t>(w)});
        }
    }
    void find_springs(store_type& store) {
        same_id_links same;
        where_.rebuild(store[tsubu::id].span(), same);
        const columns<Simulation> of(store, box(), bodies_);
        const auto found = topology<tsubu::bonds, newton_off>::resolve(store, where_, same, [&](index_t i, index_t j) {
            double square = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const auto d = static_cast<double>(of.apart(k, i, j));
                square += d * d;
            }
            return square;
        });
        if (found.incomplete != 0)
            tsubu::detail::raise<input_error>("dem::springs",
                                              std::to_string(found.incomplete) +
                                                  " springs end at a particle that is not near this rank",
                                              "give a cutoff (options::cutoff) of more than the longest spring");
        const auto bonds = store.owned()[tsubu::bonds];
        std::size_t term = 0;
        for (std::size_t i = 0; i < store.owned_count(); ++i)
            for (const auto& one : bonds[i]) {
                if (one.type == 0) continue;
                const auto& places = found.places[term++];
                if (one.type < 0) continue;  // switched off
                if (static_cast<std::uint64_t>(one.type) > spring_kinds_)
                    tsubu::detail::raise<input_error>("dem::springs",
                                                      "a bond of type " + std::to_string(one.type) + ", of " +
                                                          std::to_string(spring_kinds_) + " kinds of springs",
                                                      "give a spring for each type of bond");
                const auto here = static_cast<index_t>(i);
                const auto self = store[tsubu::id][i];
                if ((one.ids[0] == self) == (one.ids[1] == self))
                    tsubu::detail::raise<input_error>(
                        "dem::springs",
                        "particle " + std::to_string(self) + " has a bond between " + std::to_string(one.ids[0]) + " and " +
                            std::to_string(one.ids[1]),
                        "give each particle the bonds between itself and another, and each of the two has it");
                springs_.push_back(
                    {here, places[0] == here ? places[1] : places[0], static_cast<index_t>(one.type - 1)});
            }
    }

    parts_type parts_;
    Transport* on_;
    options how_;
    bodies_type bodies_;
    std::vector<wall_plane<D>> walls_;
    std::size_t spring_kinds_;
    skin_watch watch_;
    halo<parts_type, Transport> halo_;
    pair_list pairs_;
    std::vector<index_pair> near_walls_;
    std::vector<placed_spring> springs_;
    contact_history<Simulation> history_;
    id_map<> where_;
    std::uint64_t renewals_ = 0;
};

}  // namespace tsubu::dem::detail
