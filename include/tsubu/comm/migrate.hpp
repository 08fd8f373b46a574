// SPDX-License-Identifier: MIT
/// @file
/// migrate: every particle goes to the rank that owns its position.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/detail/frame.hpp>
#include <tsubu/comm/detail/rows.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/message_memory.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>

#include <algorithm>  // std::is_sorted, std::max, std::min
#include <array>      // std::array
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint64_t
#include <limits>     // std::numeric_limits
#include <new>        // std::bad_alloc, placement
#include <span>       // std::span
#include <string>     // std::string
#include <type_traits>  // std::is_same_v
#include <vector>     // std::vector

namespace tsubu {

/// For migrate: a particle that has left the box through a face that is not periodic is an error.
struct refuse_lost {};
/// For migrate: it is moved to the nearest point of the box.
struct clamp_lost {};
/// For migrate: it is moved to another store of this rank, which outlives the call, with all fields that it has too.
template <class Store>
struct collect_lost {
    explicit collect_lost(Store& store) noexcept : into(store) {}
    Store& into;
};
/// What becomes of particles that have left the box: refuse_lost, clamp_lost, collect_lost.
template <class OnLost>
concept lost_policy = std::is_same_v<OnLost, refuse_lost> || std::is_same_v<OnLost, clamp_lost> ||
                      requires(OnLost how) { how.into.add_owned(std::size_t{}); };

/// What a migration has done on one rank.
struct migration {
    std::size_t sent = 0;      ///< particles that went to other ranks
    std::size_t received = 0;  ///< particles that came
    std::size_t lost = 0;      ///< particles that had left the box, and were collected or clamped
};

namespace detail {

template <lost_policy OnLost>
inline constexpr bool collects_lost = !std::is_same_v<OnLost, refuse_lost> && !std::is_same_v<OnLost, clamp_lost>;

/// Who has to go, and where.
struct leaver {
    rank_t to;
    index_t index;
};

/// By rank; those of one rank stay in their order. O(n) for each byte of a rank number, none if they are in order.
inline void sort_by_rank(message_memory::array<leaver>& all, std::size_t ranks, message_memory& memory) {
    const auto by_rank = [](const leaver& a, const leaver& b) { return a.to < b.to; };
    if (std::is_sorted(all.begin(), all.end(), by_rank)) return;
    auto sorted = memory.take<leaver>(all.size());
    for (unsigned bits = 0; (static_cast<std::uint64_t>(ranks - 1) >> bits) != 0; bits += 8) {
        std::array<std::size_t, 257> begins{};  // of the leavers with each byte
        for (const auto& one : all) ++begins[((one.to >> bits) & 255U) + 1];
        for (std::size_t k = 1; k < begins.size(); ++k) begins[k] += begins[k - 1];
        for (const auto& one : all) sorted[begins[(one.to >> bits) & 255U]++] = one;
        all.swap(sorted);
    }
}

template <class Store, class Parts, class Carried>
class migrator {
    using frame_type = frame<Store, typename Parts::box_type>;
    using position_type = typename Parts::position_type;
    using points_type = points<Parts::dimension, const typename Parts::scalar_type>;

public:
    migrator(Store& store, const Parts& parts, rank_t rank, message_memory& memory)
        : store_(store), parts_(parts), rank_(rank), memory_(memory) {}

    /// Finds who leaves; wraps those that are outside, and settles those that no wrap brings inside. What throws leaves
    /// the store as it was.
    template <class OnLost>
    void find() {
        const auto mine = parts_.subdomain(rank_);
        const auto position = store_.owned()[frame_type::position];
        auto outside = memory_.take<index_t>(store_.owned_count());
        outside.shrink(positions_outside(mine, position, outside));
        const auto count = outside.size();
        if (count == 0) return;
        auto at = memory_.take<position_type>(count);  // side by side, for the batched predicates
        for (std::size_t k = 0; k < count; ++k) at[k] = position[static_cast<std::size_t>(outside[k])];
        const auto points_at = points_type(std::span<const position_type>(at.data(), count));
        auto is_inside = memory_.take<unsigned char>(count);
        see_inside(points_at, is_inside.first(count));
        const auto moved = wrapped_ones<OnLost>(outside, at, is_inside);
        if constexpr (std::is_same_v<OnLost, refuse_lost>) refuse_if_lost(position);
        auto owners = memory_.take<rank_t>(count);
        parts_.owner(points_at, owners.first(count));
        list_leavers(outside, owners, is_inside);
        for (const auto& one : moved) frame_type::settle(store_, parts_.whole(), one.index, one.to);
    }
    /// Undoes what clamping has done: those particles are beyond the face again, to be found by the next call.
    void put_back_clamped() {
        for (std::size_t k = 0; k < clamped_from_.size(); ++k)
            store_[frame_type::position][static_cast<std::size_t>(lost_[k])] = clamped_from_[k];
    }
    /// Packs the leavers of each rank: their number, then they.
    void pack_leavers() {
        constexpr Carried set{};
        indices_ = memory_.take<index_t>(leavers_.size());
        for (std::size_t k = 0; k < leavers_.size(); ++k) indices_[k] = leavers_[k].index;
        std::size_t words = 0;
        each_destination([&](rank_t, std::span<const index_t> chosen) {
            words += 1 + packed_words(store_, set, chosen);
        });
        words_ = memory_.take<std::uint64_t>(words);
        std::size_t at = 0;
        each_destination([&](rank_t to, std::span<const index_t> chosen) {
            words_[at] = chosen.size();
            const auto room = std::span(words_.data() + at, words - at);
            const auto used = 1 + pack(store_, set, chosen, room.subspan(1));
            parcels_.push_back({to, room.first(used)});
            at += used;
        });
    }
    [[nodiscard]] std::span<const parcel> parcels() const noexcept { return {parcels_.data(), parcels_.size()}; }
    [[nodiscard]] std::size_t sent() const noexcept { return leavers_.size(); }
    [[nodiscard]] std::size_t received() const noexcept { return received_; }
    [[nodiscard]] std::span<const index_t> lost() const noexcept { return {lost_.data(), lost_.size()}; }

    void unpack_arrivals(const mailbox& came) {
        constexpr Carried set{};
        std::size_t count = 0;
        for (const auto& [from, words] : came) count += static_cast<std::size_t>(words[0]);
        auto first = store_.add_owned(count, set);
        received_ = count;
        for (const auto& [from, words] : came) {
            const auto here = static_cast<std::size_t>(words[0]);
            unpack(store_, set, first, here, words.subspan(1));
            first += here;
        }
    }
    /// Undoes unpack_arrivals.
    void drop_arrivals() { drop_rows(store_, before_); }
    /// Those that have gone leave their places to the last ones.
    void remove_gone() { store_.remove(gone_.first(gone_.size())); }

private:
    using wrapped_type = wrapped<Parts::dimension, typename Parts::scalar_type>;
    struct moved_particle {
        index_t index;
        wrapped_type to;
    };

    template <class Value>
    using array = message_memory::array<Value>;

    // Those outside of the box, as a wrap or a clamp leaves them; is_inside stays 0 for the lost ones.
    template <class OnLost>
    [[nodiscard]] array<moved_particle> wrapped_ones(const array<index_t>& outside, array<position_type>& at,
                                                     array<unsigned char>& is_inside) {
        auto beyond = memory_.take<index_t>(at.size());
        std::size_t count = 0;
        for (std::size_t k = 0; k < at.size(); ++k) {  // branch-free: the outcome is unpredictable
            beyond[count] = static_cast<index_t>(k);
            count += is_inside[k] == 0 ? 1U : 0U;
        }
        beyond.shrink(count);
        auto moved = memory_.take<moved_particle>(count);
        count = 0;
        for (const auto one : beyond) {
            const auto k = static_cast<std::size_t>(one);
            if constexpr (collects_lost<OnLost>)
                if (is_too_far(at[k])) {
                    lost_.push_back(outside[k]);
                    continue;
                }
            // Made where it is to stay: to copy what was just written, number by number, in wider pieces would stall.
            auto& fresh = (::new (static_cast<void*>(&moved[count]))
                               moved_particle{outside[k], wrap(outside[k], at[k])})->to;
            is_inside[k] = 1;
            if (!parts_.whole().contains(fresh.position)) {
                lost_.push_back(outside[k]);
                if constexpr (std::is_same_v<OnLost, clamp_lost>) {
                    clamped_from_.push_back(fresh.position);
                    fresh.position = clamped(fresh.position);
                } else {
                    is_inside[k] = 0;
                    continue;
                }
            }
            at[k] = fresh.position;
            ++count;
        }
        moved.shrink(count);
        return moved;
    }
    void list_leavers(const array<index_t>& outside, const array<rank_t>& owners,
                      const array<unsigned char>& is_inside) {
        leavers_ = memory_.take<leaver>(outside.size());
        gone_ = memory_.take<index_t>(outside.size());
        std::size_t leaving = 0;
        std::size_t going = 0;
        for (std::size_t k = 0; k < outside.size(); ++k) {
            const bool is_lost = is_inside[k] == 0;
            const bool is_mine = owners[k] == rank_;
            leavers_[leaving] = {owners[k], outside[k]};
            gone_[going] = outside[k];
            leaving += is_lost || is_mine ? 0U : 1U;
            going += is_lost || !is_mine ? 1U : 0U;
        }
        leavers_.shrink(leaving);
        gone_.shrink(going);
        sort_by_rank(leavers_, parts_.ranks(), memory_);
    }
    template <class Mine, class Column>
    static std::size_t positions_outside(const Mine& mine, const Column& position, array<index_t>& outside) {
        if constexpr (requires { position.span(); }) {
            return mine.leavers(points_type(position.span()), std::span<index_t>(outside.data(), outside.size()));
        } else {
            std::size_t found = 0;
            for (std::size_t i = 0; i < position.size(); ++i)
                if (!mine.owns(position[i])) outside[found++] = static_cast<index_t>(i);
            return found;
        }
    }
    void see_inside(const points_type& at, std::span<unsigned char> mask) const {
        const auto& box = parts_.whole();
        if constexpr (requires { box.contains(at, mask); })
            box.contains(at, mask);
        else
            for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = box.contains(at[k]) ? 1 : 0;
    }
    // Finite, but so far out that no wrap of this box finds the image: lost as well, for who collects such.
    [[nodiscard]] bool is_too_far(const position_type& x) const {
        try {
            static_cast<void>(parts_.whole().wrap(x));
            return false;
        } catch (const input_error&) {
            bool finite = true;
            if constexpr (!is_lattice<typename Parts::scalar_type>)
                for (const auto& one : x) finite = finite && is_finite(one);
            return finite;
        }
    }
    [[nodiscard]] wrapped_type wrap(index_t i, const position_type& x) const {
        try {
            return parts_.whole().wrap(x);
        } catch (const input_error& why) {
            throw input_error("tsubu::migrate: particle " + named(i) + ": " + why.what());
        }
    }
    [[nodiscard]] position_type clamped(const position_type& x) const {
        const auto& box = parts_.whole();
        auto at = box.to_cell(x);
        for (std::size_t k = 0; k < Parts::dimension; ++k) {
            const auto inside = box.cell().along(k).inside();
            at[k] = at[k] < inside.first ? inside.first : inside.last < at[k] ? inside.last : at[k];
        }
        auto nearest = box.from_cell(at);
        // from_cell may round to beyond the face again: inwards by a step of the scalar, or two, or four.
        if constexpr (!is_lattice<typename Parts::scalar_type>) {
            constexpr auto epsilon = std::numeric_limits<typename Parts::scalar_type>::epsilon();
            for (auto step = epsilon; !box.contains(nearest) && step < 1; step *= 2) {
                auto inner = at;
                for (std::size_t k = 0; k < Parts::dimension; ++k) {
                    const auto& along = box.cell().along(k);
                    const auto margin = step * along.length();
                    inner[k] = (std::min)((std::max)(at[k], along.lo() + margin), along.hi() - margin);
                }
                nearest = box.from_cell(inner);
            }
        }
        return nearest;
    }
    [[nodiscard]] std::string named(index_t i) const {
        if constexpr (Store::template has<decltype(tsubu::id)>)
            return std::to_string(store_[tsubu::id][static_cast<std::size_t>(i)]);
        else
            return "at index " + std::to_string(i);
    }
    template <class Column>
    void refuse_if_lost(const Column& position) const {
        if (lost_.empty()) return;
        constexpr std::size_t most_named = 8;
        std::string which;
        for (std::size_t k = 0; k < lost_.size() && k < most_named; ++k)
            which += (k == 0 ? "" : ", ") + named(lost_[k]) + " at " +
                     shown(position[static_cast<std::size_t>(lost_[k])]);
        if (lost_.size() > most_named) which += ", ...";
        raise<input_error>("migrate",
                           "rank " + std::to_string(rank_) + ": " + std::to_string(lost_.size()) +
                               " particles have left the box: " + which,
                           "collect or clamp them, enlarge the box, or take a smaller time step");
    }
    template <class Body>
    void each_destination(Body&& body) const {
        for (std::size_t first = 0, end = 0; first < leavers_.size(); first = end) {
            while (end < leavers_.size() && leavers_[end].to == leavers_[first].to) ++end;
            body(leavers_[first].to, std::span<const index_t>(indices_.data() + first, end - first));
        }
    }

    Store& store_;
    const Parts& parts_;
    rank_t rank_;
    message_memory& memory_;
    std::size_t before_ = store_.owned_count();
    array<leaver> leavers_;
    array<index_t> indices_;  // of the leavers
    array<index_t> gone_;     // these and the lost ones, as they lie in the store
    std::vector<index_t> lost_;
    std::vector<position_type> clamped_from_;  // of these, if they are clamped
    array<std::uint64_t> words_;
    std::vector<parcel> parcels_;
    std::size_t received_ = 0;
};

}  // namespace detail

/// Sends every particle to the rank that owns its position, however far it has gone; ghosts are cleared.
///
///     tsubu::migrate(grains, bricks, on);
///     tsubu::migrate(grains, bricks, on, tsubu::collect_lost(outside));
///
/// A position beyond a periodic face is wrapped; a field `image` counts the periods, and fields that turn with images
/// are turned. Those that stay are not touched; those that come are added by rank of their sender, and the last ones
/// take the places of those that have gone. What goes is all fields of the store, or those that are named; the others are
/// zeros where a particle comes.
///
/// @param on_lost  what becomes of particles beyond faces that are not periodic: refuse_lost, clamp_lost, collect_lost
/// @tparam Carried  the fields<...> that go along: without those that are computed anew before they are read
/// @return what this rank has sent and received
/// @throws on all ranks or none: input_error if a position is not finite, or has left the box and may not (the message
///         names ids and positions), or the ranks are not those of the decomposition; limit_error, or std::bad_alloc on
///         the rank itself, where memory is short. Every particle is on the rank where it was then, ghosts are cleared;
///         those that had left may be wrapped.
/// Complexity: O(n) to see who leaves, all else by the leavers. 8 bytes to each rank that gets any, and their fields.
/// Collective: yes; the same decomposition and fields on all ranks. One reduction, another if a particle leaves; one message to
///             each rank that gets any.
template <class Store, decomposition Parts, transport Transport, lost_policy OnLost = refuse_lost,
          class Carried = typename Store::fields_type>
migration migrate(Store& store, const Parts& parts, Transport& on, OnLost on_lost = {}, Carried = {}) {
    static_assert(difference_of<Carried, typename Store::fields_type>::count == 0,
                  "migrate is to carry a field that the store has not");
    static_assert(Carried::template has<typename detail::frame<Store, typename Parts::box_type>::position_field>,
                  "migrate carries the position, which says where a particle belongs");
    store.clear_ghosts();
    detail::migrator<Store, Parts, Carried> work(store, parts, on.rank(), on.memory());
    constexpr bool collects = detail::collects_lost<OnLost>;
    enum : std::size_t { sent, lost };
    agreement<2> before(on.rank());
    before.attempt([&] {
        detail::check_ranks("migrate", parts.ranks(), on.ranks());
        if constexpr (collects)
            if (static_cast<const void*>(&on_lost.into) == static_cast<const void*>(&store))
                detail::raise<input_error>("migrate", "lost particles are to be collected in the store itself",
                                           "give another store");
        work.template find<OnLost>();
        work.pack_leavers();
    });
    if (!before.has_failed_here()) {
        before[sent] = work.sent();
        before[lost] = work.lost().size();
    }
    mailbox came;
    agreement<1> after(on.rank());
    try {
        came = on.exchange(before.has_failed_here() ? std::span<const parcel>() : work.parcels(), before.words());
    } catch (const std::bad_alloc&) {  // of what came; the exchange is over
        after.attempt([] { throw; });
    }
    constexpr auto left = "every particle is on the rank where it was, ghosts are cleared";
    if (before.has_failed()) work.put_back_clamped();
    before.settle("migrate", left);
    if (before[sent] == 0 && before[lost] == 0) return {};

    [[maybe_unused]] std::size_t collected_before = 0;
    if constexpr (collects) collected_before = on_lost.into.owned_count();
    after.attempt([&] { work.unpack_arrivals(came); });
    if constexpr (collects) after.attempt([&] { detail::append_rows(on_lost.into, store, work.lost()); });
    after[0] = work.received();
    on.reduce(after.words(), reduction::sum);
    if (after.has_failed() || after[0] != before[sent]) {
        work.drop_arrivals();
        work.put_back_clamped();
        if constexpr (collects) detail::drop_rows(on_lost.into, collected_before);
        after.settle("migrate", left);
        detail::raise<limit_error>("migrate",
                                   std::to_string(before[sent]) + " particles were sent, " + std::to_string(after[0]) +
                                       " have come",
                                   "the transport loses messages; every particle is on the rank where it was");
    }
    work.remove_gone();
    return {work.sent(), work.received(), work.lost().size()};
}

}  // namespace tsubu
