// SPDX-License-Identifier: MIT
/// @file
/// id_directory: who owns the particle with this id, over all ranks?
#pragma once

#include <tsubu/comm/detail/agreed_exchange.hpp>
#include <tsubu/comm/detail/home_calls.hpp>
#include <tsubu/comm/detail/id_list.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/adaptive_storage.hpp>
#include <tsubu/id/id_map.hpp>

#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <limits>       // std::numeric_limits
#include <span>         // std::span
#include <string>       // std::to_string
#include <utility>      // std::move
#include <vector>       // std::vector

namespace tsubu {

/// The rank of nobody: what a directory answers for an id that no rank owns.
inline constexpr rank_t no_rank = (std::numeric_limits<rank_t>::max)();

/// Who owns the particle with this id? Each id has a home, a rank that follows from its number alone, and there its
/// owner is written down; so no rank holds more than its share, about N_total / P entries.
///
///     tsubu::id_directory<> owners;
///     owners.rebuild(on, grains.owned()[tsubu::id].span());
///     auto ranks = owners.find(on, partner_ids);              // tsubu::no_rank where nobody owns it
///
/// It is true until a particle changes its rank; then rebuild. For partners beyond the ghosts, for what has been lost,
/// for messages to the owner of an id.
template <particle_id Id = std::int64_t>
class id_directory {
    using map_type = id_map<adaptive_storage<std::uint64_t>>;

public:
    /// @throws on all ranks or none: input_error if an id is negative, or owned twice (duplicate_ids tells by whom);
    ///         limit_error or std::bad_alloc. The directory is as before then.
    /// Collective: yes; 8 bytes per id, a message to each rank that is a home, two reductions.
    template <transport Transport>
    void rebuild(Transport& on, std::span<const Id> owned) {
        std::vector<rank_t> ranks;
        map_type where;
        detail::home_calls calls;
        detail::agreed_exchange(
            on, "id_directory::rebuild",
            [&](std::vector<parcel>& parcels) {
                detail::check_ids("id_directory::rebuild", owned);
                calls = calls_for(owned, on.ranks());
                calls.add_parcels(parcels);
            },
            [&](const mailbox& came) {
                std::vector<std::uint64_t> ids;
                ids.reserve(came.words());
                ranks.reserve(came.words());
                for (const auto& [from, words] : came)
                    for (const auto t : words) {
                        ids.push_back(t);
                        ranks.push_back(from);
                    }
                where.rebuild(ids);
                if (where.size() != ids.size()) refuse_duplicate(ids, ranks, where);
            });
        ranks_ = std::move(ranks);
        where_ = std::move(where);
    }
    /// The owners of these ids [ids.size()]; any value is a legal question.
    /// Collective: yes, each rank with questions of its own; 8 bytes per id there and back, four reductions.
    template <transport Transport>
    [[nodiscard]] std::vector<rank_t> find(Transport& on, std::span<const Id> ids) const {
        std::vector<rank_t> owners;
        detail::home_calls calls;
        detail::home_answers answers;
        detail::agreed_exchange(
            on, "id_directory::find",
            [&](std::vector<parcel>& parcels) {
                calls = calls_for(ids, on.ranks());
                calls.add_parcels(parcels);
            },
            [&](const mailbox& asked) {
                answers = detail::home_answers(asked, [&](std::uint64_t t) -> std::uint64_t {
                    const auto i = where_.find(t);
                    return i == absent ? no_rank : ranks_[static_cast<std::size_t>(i)];
                });
            });
        detail::agreed_exchange(
            on, "id_directory::find", [&](std::vector<parcel>& parcels) { answers.add_parcels(parcels); },
            [&](const mailbox& came) {
                const auto found = calls.answers(came);
                owners.resize(found.size());
                for (std::size_t k = 0; k < owners.size(); ++k) owners[k] = static_cast<rank_t>(found[k]);
            });
        return owners;
    }
    /// Ids whose home this rank is.
    [[nodiscard]] std::size_t size() const noexcept { return ranks_.size(); }

private:
    [[nodiscard]] static detail::home_calls calls_for(std::span<const Id> ids, std::size_t ranks) {
        return {ids, ranks, [ranks](Id t) { return detail::home_of(t, ranks); }};
    }
    [[noreturn]] static void refuse_duplicate(const std::vector<std::uint64_t>& ids, const std::vector<rank_t>& ranks,
                                              const map_type& where) {
        for (std::size_t k = 0;; ++k) {
            const auto first = static_cast<std::size_t>(where.find(ids[k]));
            if (first != k)
                detail::raise<input_error>("id_directory::rebuild",
                                           "id " + std::to_string(ids[k]) + " is owned by rank " +
                                               std::to_string(ranks[first]) + " and by rank " +
                                               std::to_string(ranks[k]),
                                           "each id is owned once; ask duplicate_ids for all of them");
        }
    }

    std::vector<rank_t> ranks_;
    map_type where_;
};

}  // namespace tsubu
