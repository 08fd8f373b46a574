// SPDX-License-Identifier: MIT
/// @file
/// halo: copies of the particles that other ranks own nearby.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/add_up.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/detail/frame.hpp>
#include <tsubu/comm/detail/near_part.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/pack.hpp>
#include <tsubu/store/particle_store.hpp>

#include <algorithm>  // std::max, std::sort, std::stable_sort
#include <bit>        // std::bit_cast
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint64_t
#include <cstring>    // std::memcpy
#include <deque>      // std::deque
#include <new>        // std::bad_alloc
#include <numeric>    // std::iota
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu {

/// The ghosts of a rank, and how their values are kept up to date: made by make_halo.
///
///     auto halo = tsubu::make_halo(grains, bricks, cutoff, on);
///     halo.forward(grains, tsubu::position<3>);    // every step: owners to ghosts
///     halo.reverse(grains, tsubu::force<3>);       // what ghosts have collected is added to their owners
///
/// Ghosts follow the owned particles of the store, by rank of their owner; each has the shift of its image. Positions arrive
/// moved, and vectors turned, into the image.
///
/// A halo holds while no particle comes, goes or changes places; after migrate and permute a new one is made. It refers
/// to the transport, which must outlive it.
///
/// Collective:  forward and reverse, with the same fields on all ranks: one message to and from each rank that has ghosts
///              of this one or of which this has some; nothing else, and no memory is taken after the first call for
///              fields of one size.
/// Threads:     one at a time.
template <decomposition Parts, transport Transport>
class halo {
    using box_type = typename Parts::box_type;
    static constexpr auto D = Parts::dimension;
    using shift_type = image_shift<D>;

    // Particles that go to, or came from, one rank as images of one shift.
    struct segment {
        rank_t rank;
        shift_type shift;   // of the ghosts
        std::size_t begin;  // in chosen_; or the index of the first ghost
        std::size_t count;
    };

public:
    [[nodiscard]] std::size_t owned_count() const noexcept { return owned_; }
    [[nodiscard]] std::size_t ghost_count() const noexcept { return ghosts_; }
    /// By how many periods ghost k, which is particle owned_count() + k, has been moved from its owner's position.
    [[nodiscard]] shift_type shift(std::size_t k) const {
        TSUBU_EXPECTS(k < ghosts_, "there is no such ghost; ghosts go from 0 to ghost_count() - 1");
        const auto after = std::upper_bound(incoming_.begin(), incoming_.end(), owned_ + k,
                                            [](std::size_t at, const segment& one) { return at < one.begin; });
        return std::prev(after)->shift;
    }
    /// Of all ghosts [ghost_count()].
    [[nodiscard]] std::vector<shift_type> shifts() const {
        std::vector<shift_type> all;
        for (const auto& one : incoming_) all.insert(all.end(), one.count, one.shift);
        return all;
    }
    /// How many particles this rank sends with each forward.
    [[nodiscard]] std::size_t sent_count() const noexcept { return chosen_.size(); }
    /// The ranks that it sends to, and those that it receives from, itself left out.
    [[nodiscard]] std::size_t receivers() const noexcept { return ranks_in(outgoing_); }
    [[nodiscard]] std::size_t senders() const noexcept { return ranks_in(incoming_); }

    /// The ghosts get these fields of their owners.
    /// @throws input_error if the store has other particles than when the halo was made; what the transport throws.
    template <class Store, particle_field... Field>
    void forward(Store& store, Field... which) {
        start_forward(store, which...);
        finish_forward(store, which...);
    }
    /// The first half: values are packed and on their way. Owned particles may be read, and changed, until the second.
    template <class Store, particle_field... Field>
    void start_forward(const Store& store, Field...) {
        check<Store, Field...>(store, "halo::forward");
        auto& lanes = ways_for(record_words<Field...>);
        put(store, fields<Field{}...>{}, chosen_, 0, outgoing_, lanes.forward.out(), lanes.here);
        lanes.forward.start();
    }
    template <class Store, particle_field... Field>
    void finish_forward(Store& store, Field...) {
        check<Store, Field...>(store, "halo::forward");
        auto& lanes = ways_for(record_words<Field...>);
        lanes.forward.finish();
        auto from_others = lanes.forward.in();
        std::span<const std::uint64_t> from_here(lanes.here);
        for (const auto& one : incoming_) {
            auto& words = one.rank == rank_ ? from_here : from_others;
            words = words.subspan(unpack(store, fields<Field{}...>{}, one.begin, one.count, words));
            (move_into_image<Field>(store, one), ...);
        }
    }

    /// What ghosts hold of these fields is added to their owners: as each field says, by sum, least or greatest. The
    /// ghosts keep theirs. In the order of ranks and shifts: the same on every run.
    template <class Store, particle_field... Field>
    void reverse(Store& store, Field... which) {
        start_reverse(store, which...);
        finish_reverse(store, which...);
    }
    template <class Store, particle_field... Field>
    void start_reverse(const Store& store, Field...) {
        check<Store, Field...>(store, "halo::reverse");
        auto& lanes = ways_for(record_words<Field...>);
        put(store, fields<Field{}...>{}, ghost_indices_, owned_, incoming_, lanes.reverse.out(), lanes.here);
        lanes.reverse.start();
    }
    template <class Store, particle_field... Field>
    void finish_reverse(Store& store, Field...) {
        check<Store, Field...>(store, "halo::reverse");
        auto& lanes = ways_for(record_words<Field...>);
        lanes.reverse.finish();
        const std::uint64_t* from_others = lanes.reverse.in().data();
        const std::uint64_t* from_here = lanes.here.data();
        for (const auto& one : outgoing_) {
            auto& words = one.rank == rank_ ? from_here : from_others;
            constexpr auto record = record_words<Field...>;
            std::size_t at = 0;
            ((add_to_owners<Field>(store, one, words + at, record), at += words_of_field<Field>), ...);
            words += one.count * record;
        }
    }

private:
    template <class Store, decomposition P, transport T>
    friend halo<P, T> make_halo(Store& store, const P& parts, typename P::real_type cutoff, T& on);

    template <class Field>
    static constexpr std::size_t words_of_field = detail::words_for(sizeof(typename Field::value_type));
    template <class... Field>
    static constexpr std::size_t record_words = (std::size_t{0} + ... + words_of_field<Field>);

    // For records of one size: the ways of messages, and what this rank sends itself.
    struct ways {
        std::size_t record;
        typename Transport::channel forward;
        typename Transport::channel reverse;
        std::vector<std::uint64_t> here;
    };

    halo(const box_type& where, Transport& on) : box_(where), on_(&on), rank_(on.rank()), tag_(on.next_tag()) {}

    template <class Store, class... Field>
    void check(const Store& store, const char* where) const {
        static_assert(sizeof...(Field) > 0, "name the fields that travel");
        static_assert((Store::template has<Field> && ...), "the store lacks a field that is to travel");
        static_assert((!detail::stored<typename Field::value_type>::is_list && ...) &&
                          (!detail::stored<typename Field::value_type>::is_bonus && ...),
                      "lists and bonus values go to ghosts when these are made, not every step: let them travel "
                      "on_creation");
        if (store.owned_count() != owned_ || store.ghost_count() != ghosts_)
            detail::raise<input_error>(where,
                                       std::to_string(store.owned_count()) + " owned particles and " +
                                           std::to_string(store.ghost_count()) + " ghosts; this halo was made for " +
                                           std::to_string(owned_) + " and " + std::to_string(ghosts_),
                                       "make it anew after particles have come or gone");
    }
    [[nodiscard]] std::size_t ranks_in(const std::vector<segment>& segments) const noexcept {
        std::size_t count = 0;
        for (std::size_t k = 0; k < segments.size(); ++k)
            count += segments[k].rank != rank_ && (k == 0 || segments[k - 1].rank != segments[k].rank) ? 1U : 0U;
        return count;
    }
    [[nodiscard]] std::vector<lane> lanes_of(const std::vector<segment>& segments, std::size_t record) const {
        std::vector<lane> lanes;
        for (const auto& one : segments) {
            if (one.rank == rank_) continue;
            if (lanes.empty() || lanes.back().rank != one.rank) lanes.push_back({one.rank, 0});
            lanes.back().words += one.count * record;
        }
        return lanes;
    }
    [[nodiscard]] ways& ways_for(std::size_t record) {
        for (auto& one : ways_)
            if (one.record == record) return one;
        const auto out = lanes_of(outgoing_, record);
        const auto in = lanes_of(incoming_, record);
        std::size_t here = 0;
        for (const auto& one : outgoing_) here += one.rank == rank_ ? one.count * record : 0;
        return ways_.emplace_back(ways{record, typename Transport::channel(*on_, tag_, out, in),
                                       typename Transport::channel(*on_, reverse_tag_, in, out),
                                       std::vector<std::uint64_t>(here)});
    }
    /// @param indices  of the particles of the segments, which begin in them at `begin - first`
    template <class Store, auto... F>
    void put(const Store& store, fields<F...> set, std::span<const index_t> indices, std::size_t first,
             const std::vector<segment>& segments, std::span<std::uint64_t> to_others,
             std::vector<std::uint64_t>& here) const {
        std::span<std::uint64_t> to_here(here);
        for (const auto& one : segments) {
            auto& to = one.rank == rank_ ? to_here : to_others;
            to = to.subspan(pack(store, set, indices.subspan(one.begin - first, one.count), to));
        }
    }
    template <class Field, class Store>
    void move_into_image(Store& store, const segment& one) const {
        if constexpr (detail::changes_in_image<Field, box_type>) {
            if (one.shift == shift_type{}) return;
            const auto column = store[Field{}];
            for (auto i = one.begin; i < one.begin + one.count; ++i)
                column[i] = detail::value_in_image<Field>(box_, column[i], one.shift);
        }
    }
    template <class Field, class Store>
    void add_to_owners(Store& store, const segment& one, const std::uint64_t* words, std::size_t record) const {
        constexpr auto how = Field::traits.reverse;
        static_assert(how != ghosts_add::nothing, "this field says that ghosts add nothing to it");
        static_assert(Field::traits.image != under_image::translates, "positions are not added up");
        const auto column = store[Field{}];
        const auto back = detail::opposite(one.shift);
        typename Field::value_type value;
        for (std::size_t k = 0; k < one.count; ++k) {
            std::memcpy(static_cast<void*>(&value), words + k * record, sizeof(value));
            if constexpr (detail::changes_in_image<Field, box_type>)
                value = detail::value_in_image<Field>(box_, value, back);
            detail::add_up<how>(column[static_cast<std::size_t>(chosen_[one.begin + k])], value);
        }
    }

    // Chooses what goes to whom.
    template <class Store>
    void choose(const Store& store, const Parts& parts, typename Parts::real_type cutoff) {
        using near_type = detail::near_part<Parts>;
        const auto here = parts.subdomain(rank_);
        struct asker {
            rank_t rank;
            shift_type shift;
            near_type near;
        };
        std::vector<asker> askers;
        for (const auto& [rank, shift] : parts.neighbors(rank_, cutoff)) {
            auto there = detail::opposite(shift);  // what is near moved by shift is near me; I am near it moved back
            if constexpr (cyclic_box<box_type>) there = box_.same_image(there);
            askers.push_back({rank, there, near_type(parts, cutoff, here, parts.subdomain(rank), there)});
        }
        std::vector<std::vector<index_t>> asked(askers.size());
        const auto position = store.owned()[detail::frame<Store, box_type>::position];
        for (std::size_t i = 0; i < position.size(); ++i) {
            const auto at = box_.to_cell(position[i]);
            for (std::size_t k = 0; k < askers.size(); ++k)
                if (askers[k].near.has(at)) asked[k].push_back(static_cast<index_t>(i));
        }
        for (std::size_t k = 0; k < askers.size(); ++k) {
            if (asked[k].empty()) continue;
            outgoing_.push_back({askers[k].rank, askers[k].shift, chosen_.size(), asked[k].size()});
            chosen_.insert(chosen_.end(), asked[k].begin(), asked[k].end());
        }
    }
    // A parcel for each rank: how many segments, the shift and count of each, then the particles.
    template <class Store>
    void pack_new(const Store& store, std::vector<std::uint64_t>& words, std::vector<parcel>& parcels) const {
        constexpr fields_on_creation<typename Store::fields_type> set{};
        std::vector<std::size_t> ends;
        for (std::size_t first = 0, last = 0; first < outgoing_.size(); first = last) {
            while (last < outgoing_.size() && outgoing_[last].rank == outgoing_[first].rank) ++last;
            words.push_back(last - first);
            for (auto k = first; k < last; ++k) {
                for (const auto periods : outgoing_[k].shift) words.push_back(std::bit_cast<std::uint64_t>(periods));
                words.push_back(outgoing_[k].count);
            }
            const auto count = outgoing_[last - 1].begin + outgoing_[last - 1].count - outgoing_[first].begin;
            const auto chosen = std::span<const index_t>(chosen_).subspan(outgoing_[first].begin, count);
            const auto at = words.size();
            words.resize(at + packed_words(store, set, chosen));
            pack(store, set, chosen, std::span(words).subspan(at));
            parcels.push_back({outgoing_[first].rank, {}});
            ends.push_back(words.size());
        }
        for (std::size_t k = 0, begin = 0; k < parcels.size(); begin = ends[k++])
            parcels[k].words = std::span<const std::uint64_t>(words).subspan(begin, ends[k] - begin);
    }
    template <class Store>
    void unpack_new(Store& store, const mailbox& came) {
        constexpr std::size_t segment_words = D + 1;
        owned_ = store.owned_count();
        for (const auto& [from, words] : came) {
            const auto segments = static_cast<std::size_t>(words[0]);
            auto records = words.subspan(1 + segments * segment_words);
            for (std::size_t k = 0; k < segments; ++k) {
                const auto told = words.subspan(1 + k * segment_words, segment_words);
                segment one{from, {}, 0, static_cast<std::size_t>(told[D])};
                for (std::size_t d = 0; d < D; ++d) one.shift[d] = std::bit_cast<std::int64_t>(told[d]);
                one.begin = store.add_ghosts(one.count);
                records = records.subspan(take(store, one, records, fields_on_creation<typename Store::fields_type>{}));
                incoming_.push_back(one);
            }
        }
        ghosts_ = store.ghost_count();
        ghost_indices_.resize(ghosts_);
        std::iota(ghost_indices_.begin(), ghost_indices_.end(), static_cast<index_t>(owned_));
    }
    template <class Store, auto... F>
    std::size_t take(Store& store, const segment& one, std::span<const std::uint64_t> words, fields<F...> set) const {
        const auto used = unpack(store, set, one.begin, one.count, words);
        (move_into_image<std::remove_cv_t<decltype(F)>>(store, one), ...);
        return used;
    }

    box_type box_;
    Transport* on_;
    rank_t rank_;
    int tag_;
    int reverse_tag_ = on_->next_tag();
    std::size_t owned_ = 0;
    std::size_t ghosts_ = 0;
    std::vector<index_t> chosen_;         // what goes out, segment after segment
    std::vector<index_t> ghost_indices_;  // owned_, owned_ + 1, ...
    std::vector<segment> outgoing_;
    std::vector<segment> incoming_;
    std::deque<ways> ways_;
};

/// Makes ghosts of all particles of other ranks, and of images, that lie within the cutoff of this rank's subdomain; the
/// store's earlier ghosts are cleared.
///
///     auto halo = tsubu::make_halo(grains, bricks, cutoff, on);
///
/// Any cutoff: over several ranks, and beyond the length of the box, where one particle has several images. In boxes
/// that are not a domain some ghosts are a little farther than the cutoff. A ghost gets the fields that travel
/// on_creation or every_step; the others are zero.
///
/// @param cutoff  [m]
/// @throws on all ranks or none: input_error if the cutoff is negative or not finite, or the ranks are not those of the
///         decomposition; limit_error, or std::bad_alloc on the rank itself, where memory is short. There are no ghosts
///         then.
/// Precondition: the particles are on the ranks that own them, as after migrate.
/// Complexity: O(n) look-ups of neighbours; bytes: the fields of the ghosts, 8 per rank and 8 (D + 1) per rank and image.
/// Collective: yes; the same decomposition and cutoff on all ranks. Two reductions; one message to each rank that gets
///             any.
template <class Store, decomposition Parts, transport Transport>
[[nodiscard]] halo<Parts, Transport> make_halo(Store& store, const Parts& parts, typename Parts::real_type cutoff,
                                               Transport& on) {
    store.clear_ghosts();
    halo<Parts, Transport> made(parts.whole(), on);
    std::vector<std::uint64_t> words;
    std::vector<parcel> parcels;
    agreement<> before(on.rank());
    before.attempt([&] {
        detail::check_ranks("make_halo", parts.ranks(), on.ranks());
        made.choose(store, parts, cutoff);
        made.pack_new(store, words, parcels);
    });
    if (before.has_failed_here()) parcels.clear();
    agreement<> after(on.rank());
    mailbox came;
    try {
        came = on.exchange(parcels, before.words());
    } catch (const std::bad_alloc&) {  // of what came; the exchange is over
        after.attempt([] { throw; });
    }
    before.settle("make_halo");
    after.attempt([&] { made.unpack_new(store, came); });
    on.reduce(after.words(), reduction::sum);
    if (after.has_failed()) store.clear_ghosts();
    after.settle("make_halo");
    return made;
}

}  // namespace tsubu
