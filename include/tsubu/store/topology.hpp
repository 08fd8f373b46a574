// SPDX-License-Identifier: MIT
/// @file
/// topology: who keeps a term, who writes it, and where its particles are.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/copies.hpp>
#include <tsubu/id/same_id_links.hpp>
#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/term.hpp>

#include <algorithm>    // std::binary_search, std::find
#include <array>        // std::array
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int32_t, std::int64_t, std::uint64_t
#include <limits>       // std::numeric_limits
#include <span>         // std::span
#include <string>       // std::to_string
#include <type_traits>  // std::remove_cv_t
#include <utility>      // std::in_range
#include <vector>       // std::vector

namespace tsubu {

/// Each term is kept once: a bond by its first particle, any other by its second. Forces on its other particles are
/// sent back to their owners.
///
/// Choose it when terms are many and memory or time per term counts. Do not when forces of ghosts are not sent back.
struct newton_on {
    static constexpr bool keeps_once = true;
};
/// Each term is kept by all of its particles, so that each computes its own force.
///
/// Choose it when forces of ghosts are not sent back. Do not when memory or time per term counts: a bond is kept and
/// computed twice, an angle three times, a dihedral or an improper four times.
struct newton_off {
    static constexpr bool keeps_once = false;
};

/// The rules of one kind of term.
///
///     using bonding = tsubu::topology<tsubu::bonds, tsubu::newton_on>;
///     bonding::insert(g, where, {.type = 1, .ids = {7, 9}});
///     bonding::rows(g, [&](std::int64_t type, auto& ids) { ... });   // each term once, over all ranks
///
/// @tparam Field   bonds, angles, dihedrals, impropers, or another field of list_of<term<Order>>.
/// @tparam Newton  newton_on or newton_off.
template <auto Field, class Newton>
struct topology {
    using term_type = typename std::remove_cv_t<decltype(Field)>::value_type::element_type;
    static constexpr std::size_t order = term_type::order;
    using particle_ids = std::array<std::int64_t, order>;

    /// Whether the particle with this id keeps the term.
    [[nodiscard]] static constexpr bool keeps(const term_type& one, std::int64_t particle) noexcept {
        if constexpr (Newton::keeps_once)
            return one.ids[keeper_place] == particle;
        else
            return std::find(one.ids.begin(), one.ids.end(), particle) != one.ids.end();
    }
    /// Whether the particle that keeps it also writes it, so that over all ranks each term is written once (C5 to C10).
    [[nodiscard]] static constexpr bool writes(const term_type& one, std::int64_t particle) noexcept {
        if (one.type == 0) return false;
        if constexpr (Newton::keeps_once) return true;
        if constexpr (order == 2)
            return particle <= other_end(one, particle);  // equal: a bond to itself, where that is allowed
        else
            return one.ids[keeper_place] == particle;
    }

    /// Whether the particle at place k of the term keeps it; of one that is in it twice, its first place does.
    [[nodiscard]] static constexpr bool keeps_at(const term_type& one, std::size_t k) noexcept {
        for (std::size_t j = 0; j < k; ++j)
            if (one.ids[j] == one.ids[k]) return false;
        return keeps(one, one.ids[k]);
    }

    /// Adds the term to those of its particles that keep it and are owned here. @return how many.
    ///
    /// @param where           an id_map of the particles of this rank
    /// @param allows_repeats  whether a particle may be in the term twice
    /// @throws input_error if the type is 0, or a particle is in it twice and may not. Strong guarantee.
    template <class Store, class Map>
    static std::size_t insert(Store& store, const Map& where, const term_type& one, bool allows_repeats = false) {
        check(one, allows_repeats);
        const auto added = one;  // it may lie in this store, in a list that grows
        std::array<std::size_t, order> keepers{};
        std::size_t kept = 0;
        for (std::size_t k = 0; k < order; ++k) {
            if (!keeps_at(added, k)) continue;
            if (!std::in_range<typename Map::id_type>(added.ids[k])) continue;  // the map cannot have it
            const auto i = where.find(static_cast<typename Map::id_type>(added.ids[k]));
            if (i == absent || static_cast<std::size_t>(i) >= store.owned_count()) continue;
            keepers[kept++] = static_cast<std::size_t>(i);
        }
        const auto lists = store[Field];
        for (std::size_t n = 0; n < kept; ++n) lists[keepers[n]].reserve(lists[keepers[n]].size() + 1);
        for (std::size_t n = 0; n < kept; ++n) lists[keepers[n]].push_back(added);  // there is room: all or none
        return kept;
    }
    /// How many rows() writes (C6 to C9). Summed over all ranks: the number of terms.
    template <class Store>
    [[nodiscard]] static std::uint64_t count(const Store& store) {
        std::uint64_t sum = 0;
        rows(store, [&](std::int64_t, const particle_ids&) { ++sum; });
        return sum;
    }
    /// Calls row(type, ids) for each term that an owned particle writes, by particle and by place in its list; the type
    /// without its sign. A bond begins with the particle that writes it (C5).
    template <class Store, class Row>
    static void rows(const Store& store, Row&& row) {
        const auto particles = store.owned()[tsubu::id];
        const auto lists = store.owned()[Field];
        for (std::size_t i = 0; i < particles.size(); ++i)
            for (const auto& one : lists[i]) {
                if (!writes(one, particles[i])) continue;
                auto ids = one.ids;
                if constexpr (order == 2) ids = {particles[i], other_end(one, particles[i])};
                row(one.type < 0 ? -one.type : one.type, ids);
            }
    }
    /// The terms of the owned particles, and where their particles are.
    struct resolved {
        std::vector<index_t> keepers;                    ///< [terms]
        std::vector<std::array<index_t, order>> places;  ///< [terms] indices; absent where a particle is not here
        std::size_t incomplete = 0;                      ///< terms with a particle that is not here
    };
    /// One batched look-up of all particles of all terms; of several copies of a particle the one closest to
    /// the keeper.
    ///
    /// @param same      the links that `where` was built with
    /// @param distance  distance(i, j) between two indices, any measure
    template <class Store, class Map, class Links, class Distance>
    [[nodiscard]] static resolved resolve(const Store& store, const Map& where, const Links& same,
                                          Distance&& distance) {
        using id_type = typename Map::id_type;
        constexpr auto nobody = static_cast<id_type>(-1);  // no particle has it: in no map
        resolved found;
        std::vector<id_type> wanted;
        const auto lists = store.owned()[Field];
        for (std::size_t i = 0; i < lists.size(); ++i)
            for (const auto& one : lists[i]) {
                if (one.type == 0) continue;
                found.keepers.push_back(static_cast<index_t>(i));
                for (const auto particle : one.ids)
                    wanted.push_back(std::in_range<id_type>(particle) ? static_cast<id_type>(particle) : nobody);
            }
        std::vector<index_t> first(wanted.size());
        where.find(std::span<const id_type>(wanted), std::span<index_t>(first));
        found.places.resize(found.keepers.size());
        for (std::size_t t = 0; t < found.keepers.size(); ++t) {
            bool is_whole = true;
            for (std::size_t k = 0; k < order; ++k) {
                const auto at = first[t * order + k];
                is_whole = is_whole && at != absent;
                found.places[t][k] =
                    at == absent ? absent
                                 : closest_image(same, at, [&](index_t j) { return distance(found.keepers[t], j); });
            }
            found.incomplete += is_whole ? 0U : 1U;
        }
        return found;
    }
    /// Removes from all owned particles the terms that name one of these particles, which leave the simulation.
    /// @param gone  their ids, sorted.
    /// @return how many terms were removed.
    template <class Store>
    static std::size_t remove_terms_of(Store& store, std::span<const std::int64_t> gone) {
        std::size_t removed = 0;
        const auto lists = store.owned()[Field];
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const auto list = lists[i];
            for (std::size_t k = list.size(); k-- > 0;) {
                bool names_one = false;
                for (const auto particle : list[k].ids)
                    names_one = names_one || std::binary_search(gone.begin(), gone.end(), particle);
                if (!names_one) continue;
                list.swap_remove(k);
                ++removed;
            }
        }
        return removed;
    }

private:
    static constexpr std::int64_t most_types = (std::numeric_limits<std::int32_t>::max)();  // as files have them
    // A bond is its first particle's, an angle, a dihedral, an improper its second's.
    static constexpr std::size_t keeper_place = order == 2 ? 0 : 1;

    [[nodiscard]] static constexpr std::int64_t other_end(const term_type& one, std::int64_t particle) noexcept {
        return one.ids[0] == particle ? one.ids[1] : one.ids[0];
    }
    static void check(const term_type& one, bool allows_repeats) {
        if (one.type == 0)
            detail::raise<input_error>("topology::insert", "a term of type 0" + shown(one),
                                       "type 0 is no term; leave it out");
        if (one.type > most_types || one.type < -most_types)
            detail::raise<input_error>("topology::insert", "type " + std::to_string(one.type) + shown(one),
                                       "types go up to 2^31 - 1");
        for (const auto particle : one.ids)
            if (particle < 0)
                detail::raise<input_error>("topology::insert", "particle " + std::to_string(particle) + shown(one),
                                           "ids of particles are 0 or greater");
        for (std::size_t k = 0; k < order && !allows_repeats; ++k)
            for (std::size_t j = 0; j < k; ++j)
                if (one.ids[j] == one.ids[k])
                    detail::raise<input_error>("topology::insert",
                                               "particle " + std::to_string(one.ids[k]) + " twice" + shown(one),
                                               "a term joins different particles; allow repeats if that is meant");
    }
    [[nodiscard]] static std::string shown(const term_type& one) {
        std::string text = " in " + std::string(std::remove_cv_t<decltype(Field)>::name) + " {";
        for (std::size_t k = 0; k < order; ++k) text += (k == 0 ? "" : ", ") + std::to_string(one.ids[k]);
        return text + "}";
    }
};

}  // namespace tsubu
