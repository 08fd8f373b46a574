// SPDX-License-Identifier: MIT
/// @file
/// One round of messages of a halo: what goes to whom, what comes from whom, and the ways it takes.
#pragma once

#include <tsubu/comm/detail/add_up.hpp>
#include <tsubu/comm/detail/frame.hpp>
#include <tsubu/comm/halo_pattern.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/message_memory.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/pack.hpp>

#include <algorithm>    // std::max
#include <array>        // std::array
#include <bit>          // std::bit_cast
#include <cstddef>      // std::size_t
#include <cstdint>      // std::int64_t, std::uint64_t
#include <cstring>      // std::memcpy
#include <memory>       // std::make_unique, std::unique_ptr
#include <numeric>      // std::iota
#include <span>         // std::span
#include <type_traits>  // std::remove_cv_t
#include <vector>       // std::vector

namespace tsubu::detail {

/// Words of one record of these fields, all of a fixed size.
template <class Field>
inline constexpr std::size_t words_of_field = words_for(sizeof(typename Field::value_type));
template <class... Field>
inline constexpr std::size_t record_words = (std::size_t{0} + ... + words_of_field<Field>);

template <decomposition Parts, transport Transport>
class halo_round {
    using box_type = typename Parts::box_type;
    using real_type = typename Parts::real_type;
    static constexpr auto D = Parts::dimension;
    using shift_type = image_shift<D>;

    // Particles that go to, or came from, one rank as images of one shift.
    struct segment {
        rank_t rank;
        shift_type shift;   // of the ghosts, from where their particles are at the sender
        std::size_t begin;  // in chosen_; or the index of the first ghost
        std::size_t count;
    };
    // For records of one size, one way: to other ranks, and what this rank sends itself.
    struct way {
        std::size_t record;
        typename Transport::channel others;
        std::vector<std::uint64_t> here;
    };
    using ways = std::vector<std::unique_ptr<way>>;  // found where they are while more come

public:
    halo_round(const box_type& where, Transport& on)
        : box_(&where), on_(&on), rank_(on.rank()), forward_tag_(on.next_tag()), reverse_tag_(on.next_tag()) {}

    [[nodiscard]] std::size_t sent() const noexcept { return chosen_.size(); }
    [[nodiscard]] std::size_t receivers() const noexcept { return ranks_in(outgoing_); }
    [[nodiscard]] std::size_t senders() const noexcept { return ranks_in(incoming_); }

    /// Chooses among particles `first` .. `last` - 1 what goes to whom.
    template <class Store>
    void choose(const Store& store, const Parts& parts, const std::vector<halo_asker<Parts>>& askers,
                std::size_t first, std::size_t last) {
        const auto position = store.all()[frame<Store, box_type>::position];
        const auto outer = outer_ones(position, parts, askers, first, last);
        const points<D, const real_type> at(outer.columns());
        auto mask = on_->memory().template take<unsigned char>(outer.count);
        for (const auto& asker : askers) {
            const auto begin = chosen_.size();
            asker.near.surroundings().owns(at, {mask.data(), mask.size()});
            for (std::size_t k = 0; k < mask.size(); ++k) {
                if (mask[k] == 0) continue;
                const auto i = outer.indices[k];
                if (asker.near.has(box_->to_cell(position[static_cast<std::size_t>(i)]))) chosen_.push_back(i);
            }
            if (chosen_.size() != begin)
                outgoing_.push_back({asker.rank, asker.shift, begin, chosen_.size() - begin});
        }
    }
    /// A parcel for each rank: how many segments, the shift and count of each, then the particles; then, if there were
    /// rounds before, the shift that each had here already.
    /// @param shifts  of the ghosts so far
    template <class Store>
    void pack_new(const Store& store, std::size_t owned, const std::vector<shift_type>& shifts,
                  message_memory::array<std::uint64_t>& words, std::vector<parcel>& parcels) const {
        constexpr fields_on_creation<typename Store::fields_type> set{};
        std::size_t size = 0;
        each_receiver([&](std::size_t first, std::size_t last, std::span<const index_t> chosen) {
            size += 1 + (last - first) * (D + 1) + packed_words(store, set, chosen) +
                    (shifts.empty() ? 0 : D * chosen.size());
        });
        words = on_->memory().template take<std::uint64_t>(size);
        auto* to = words.data();
        each_receiver([&](std::size_t first, std::size_t last, std::span<const index_t> chosen) {
            auto* const begin = to;
            *to++ = last - first;
            for (auto k = first; k < last; ++k) {
                put_shift(to, outgoing_[k].shift);
                *to++ = outgoing_[k].count;
            }
            to += pack(store, set, chosen, {to, static_cast<std::size_t>(words.end() - to)});
            if (!shifts.empty())
                for (const auto i : chosen) {
                    const auto index = static_cast<std::size_t>(i);
                    put_shift(to, index < owned ? shift_type{} : shifts[index - owned]);
                }
            parcels.push_back({outgoing_[first].rank, {begin, static_cast<std::size_t>(to - begin)}});
        });
    }
    /// @param[in,out] shifts  of the ghosts, to which those of the new ones are added
    template <class Store>
    void unpack_new(Store& store, const mailbox& came, std::vector<shift_type>& shifts) {
        constexpr std::size_t segment_words = D + 1;
        first_ = store.size();
        for (const auto& [from, words] : came) {
            const auto segments = static_cast<std::size_t>(words[0]);
            auto rest = words.subspan(1 + segments * segment_words);
            const auto first_of_rank = shifts.size();
            for (std::size_t k = 0; k < segments; ++k) {
                const auto told = words.subspan(1 + k * segment_words, segment_words);
                segment one{from, get_shift(told), 0, static_cast<std::size_t>(told[D])};
                one.begin = store.add_ghosts(one.count, fields_on_creation<typename Store::fields_type>{});
                rest = rest.subspan(take(store, one, rest, fields_on_creation<typename Store::fields_type>{}));
                incoming_.push_back(one);
                shifts.insert(shifts.end(), one.count, one.shift);
            }
            for (auto k = first_of_rank; !rest.empty(); ++k, rest = rest.subspan(D))  // the shifts of before
                for (std::size_t d = 0; d < D; ++d) shifts[k][d] += std::bit_cast<std::int64_t>(rest[d]);
        }
        ghost_indices_.resize(store.size() - first_);
        std::iota(ghost_indices_.begin(), ghost_indices_.end(), static_cast<index_t>(first_));
    }

    template <class Store, auto... F>
    void start_forward(const Store& store, fields<F...> set) {
        auto& to = forward_way(set);
        put(store, set, {chosen_.data(), chosen_.size()}, 0, outgoing_, to);
        to.others.start();
    }
    template <class Store, auto... F>
    void finish_forward(Store& store, fields<F...> set) {
        auto& from = forward_way(set);
        from.others.finish();
        auto from_others = from.others.in();
        std::span<const std::uint64_t> from_here(from.here.data(), from.here.size());
        for (const auto& one : incoming_) {
            auto& words = one.rank == rank_ ? from_here : from_others;
            words = words.subspan(take(store, one, words, set));
        }
    }
    template <class Store, auto... F>
    void start_reverse(const Store& store, fields<F...> set) {
        auto& to = reverse_way(set);
        put(store, set, {ghost_indices_.data(), ghost_indices_.size()}, first_, incoming_, to);
        to.others.start();
    }
    template <class Store, auto... F>
    void finish_reverse(Store& store, fields<F...> set) {
        constexpr auto record = record_words<std::remove_cv_t<decltype(F)>...>;
        auto& from = reverse_way(set);
        from.others.finish();
        const std::uint64_t* from_others = from.others.in().data();
        const std::uint64_t* from_here = from.here.data();
        for (const auto& one : outgoing_) {
            auto& words = one.rank == rank_ ? from_here : from_others;
            std::size_t at = 0;
            ((add_to_owners<std::remove_cv_t<decltype(F)>>(store, one, words + at, record),
              at += words_of_field<std::remove_cv_t<decltype(F)>>),
             ...);
            words += one.count * record;
        }
    }

private:
    // Particles that any asker may want, and where they are in the cell, a column per axis.
    struct candidates {
        message_memory::array<index_t> indices;
        std::array<message_memory::array<real_type>, D> x;
        std::size_t count = 0;
        [[nodiscard]] typename points<D, const real_type>::columns columns() const noexcept {
            typename points<D, const real_type>::columns all{};
            for (std::size_t k = 0; k < D; ++k) all[k] = x[k].first(count);
            return all;
        }
    };
    // All but those that are farther from each face of this subdomain than any asker reaches: askers lie outside.
    template <class Position>
    [[nodiscard]] candidates outer_ones(const Position& position, const Parts& parts,
                                        const std::vector<halo_asker<Parts>>& askers, std::size_t first,
                                        std::size_t last) const {
        const auto here = parts.subdomain(rank_);
        vec<D, real_type> lo{};
        vec<D, real_type> hi{};
        for (std::size_t k = 0; k < D; ++k) {
            real_type reach = 0;
            real_type slack = 0;
            for (const auto& asker : askers) {
                reach = (std::max)(reach, asker.near.reach()[k]);
                slack = (std::max)(slack, asker.near.slack(k));
            }
            lo[k] = here.lo()[k] + reach + slack;
            hi[k] = here.hi()[k] - reach - slack;
        }
        candidates found;
        found.indices = on_->memory().template take<index_t>(last - first);
        for (auto& along : found.x) along = on_->memory().template take<real_type>(last - first);
        for (auto i = first; i < last; ++i) {
            const auto in_cell = box_->to_cell(position[i]);
            vec<D, real_type> at{};
            bool is_inner = true;
            for (std::size_t k = 0; k < D; ++k) {
                at[k] = box_->cell().along(k).to_real(in_cell[k]);
                is_inner = is_inner && at[k] > lo[k] && at[k] < hi[k];
            }
            found.indices[found.count] = static_cast<index_t>(i);
            for (std::size_t k = 0; k < D; ++k) found.x[k][found.count] = at[k];
            found.count += is_inner ? 0U : 1U;
        }
        return found;
    }
    /// body(first, last, chosen): the segments first .. last - 1 go to one rank, and are of these particles.
    template <class Body>
    void each_receiver(Body&& body) const {
        for (std::size_t first = 0, last = 0; first < outgoing_.size(); first = last) {
            while (last < outgoing_.size() && outgoing_[last].rank == outgoing_[first].rank) ++last;
            const auto begin = outgoing_[first].begin;
            const auto count = outgoing_[last - 1].begin + outgoing_[last - 1].count - begin;
            body(first, last, std::span<const index_t>(chosen_.data() + begin, count));
        }
    }
    static void put_shift(std::uint64_t*& to, const shift_type& shift) noexcept {
        for (const auto periods : shift) *to++ = std::bit_cast<std::uint64_t>(periods);
    }
    [[nodiscard]] static shift_type get_shift(std::span<const std::uint64_t> words) noexcept {
        shift_type shift{};
        for (std::size_t d = 0; d < D; ++d) shift[d] = std::bit_cast<std::int64_t>(words[d]);
        return shift;
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
    template <auto... F>
    [[nodiscard]] way& forward_way(fields<F...>) {
        return way_in(forward_, forward_tag_, outgoing_, incoming_, record_words<std::remove_cv_t<decltype(F)>...>);
    }
    template <auto... F>
    [[nodiscard]] way& reverse_way(fields<F...>) {
        return way_in(reverse_, reverse_tag_, incoming_, outgoing_, record_words<std::remove_cv_t<decltype(F)>...>);
    }
    [[nodiscard]] way& way_in(ways& all, int tag, const std::vector<segment>& out, const std::vector<segment>& in,
                              std::size_t record) const {
        for (const auto& one : all)
            if (one->record == record) return *one;
        std::size_t here = 0;
        for (const auto& one : out) here += one.rank == rank_ ? one.count * record : 0;
        return *all.emplace_back(std::make_unique<way>(
            way{record, typename Transport::channel(*on_, tag, lanes_of(out, record), lanes_of(in, record)),
                std::vector<std::uint64_t>(here)}));
    }
    /// @param indices  of the particles of the segments, which begin in them at `begin - first`
    template <class Store, auto... F>
    void put(const Store& store, fields<F...> set, std::span<const index_t> indices, std::size_t first,
             const std::vector<segment>& segments, way& to) const {
        auto to_others = to.others.out();
        std::span<std::uint64_t> to_here(to.here.data(), to.here.size());
        for (const auto& one : segments) {
            auto& words = one.rank == rank_ ? to_here : to_others;
            words = words.subspan(pack(store, set, indices.subspan(one.begin - first, one.count), words));
        }
    }
    template <class Store, auto... F>
    std::size_t take(Store& store, const segment& one, std::span<const std::uint64_t> words, fields<F...> set) const {
        constexpr bool changes = (changes_in_image<std::remove_cv_t<decltype(F)>, box_type> || ...);
        if constexpr (changes)
            if (one.shift != shift_type{})
                return unpack(store, set, one.begin, one.count, words, [&]<class Field>(Field, auto& value) {
                    if constexpr (changes_in_image<Field, box_type>)
                        value = value_in_image<Field>(*box_, value, one.shift);
                });
        return unpack(store, set, one.begin, one.count, words);
    }
    template <class Field, class Store>
    void add_to_owners(Store& store, const segment& one, const std::uint64_t* words, std::size_t record) const {
        constexpr auto how = Field::traits.reverse;
        static_assert(how != ghosts_add::nothing, "this field says that ghosts add nothing to it");
        static_assert(Field::traits.image != under_image::translates, "positions are not added up");
        const auto column = store[Field{}];
        const auto back = opposite(one.shift);
        typename Field::value_type value;
        for (std::size_t k = 0; k < one.count; ++k) {
            std::memcpy(static_cast<void*>(&value), words + k * record, sizeof(value));
            if constexpr (changes_in_image<Field, box_type>) value = value_in_image<Field>(*box_, value, back);
            add_up<how>(column[static_cast<std::size_t>(chosen_[one.begin + k])], value);
        }
    }

    const box_type* box_;
    Transport* on_;
    rank_t rank_;
    int forward_tag_;
    int reverse_tag_;
    std::size_t first_ = 0;               // of the ghosts of this round
    std::vector<index_t> chosen_;         // what goes out, segment after segment
    std::vector<index_t> ghost_indices_;  // first_, first_ + 1, ...
    std::vector<segment> outgoing_;
    std::vector<segment> incoming_;
    ways forward_;
    ways reverse_;
};

}  // namespace tsubu::detail
