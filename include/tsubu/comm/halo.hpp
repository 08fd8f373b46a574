// SPDX-License-Identifier: MIT
/// @file
/// halo: copies of the particles that other ranks own nearby.
#pragma once

#include <tsubu/comm/agreement.hpp>
#include <tsubu/comm/detail/agreed_exchange.hpp>
#include <tsubu/comm/detail/halo_round.hpp>
#include <tsubu/comm/detail/rank_checks.hpp>
#include <tsubu/comm/halo_pattern.hpp>
#include <tsubu/comm/mailbox.hpp>
#include <tsubu/comm/message_memory.hpp>
#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/expects.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/particle_store.hpp>

#include <bit>      // std::bit_cast
#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <limits>   // std::numeric_limits
#include <memory>   // std::unique_ptr
#include <span>     // std::span
#include <string>   // std::to_string
#include <utility>  // std::move
#include <vector>   // std::vector

namespace tsubu {

/// The ghosts of a rank, and how their values are kept up to date: made by make_halo.
///
///     auto halo = tsubu::make_halo(grains, bricks, cutoff, on);
///     halo.forward(grains, tsubu::position<3>);    // every step: owners to ghosts
///     halo.reverse(grains, tsubu::force<3>);       // what ghosts have collected is added to their owners
///
/// Ghosts follow the owned particles of the store, by step of the pattern and by rank of the sender. Positions arrive
/// moved, and vectors turned, into the image.
///
/// A halo holds while no particle comes, goes or changes places; after migrate and permute a new one is made. For
/// several steps with one halo, its cutoff is the range of the forces and a skin that no two particles cross together.
/// A pair over a border is seen from both sides. It refers to the transport, which must outlive it.
///
/// Collective:  forward and reverse, with the same fields on all ranks: one message in each step of the pattern to each
///              rank that has ghosts of this one, and from each of which this has some; nothing else, and no memory is
///              taken after the first call for fields of one size.
/// Threads:     one at a time.
template <decomposition Parts, transport Transport>
class halo {
    using box_type = typename Parts::box_type;
    using round_type = detail::halo_round<Parts, Transport>;

public:
    using shift_type = image_shift<Parts::dimension>;

    /// Of no particles: something for make_halo to be assigned to.
    halo() = default;

    /// How many particles were owned when the halo was made; the ghosts lie behind them.
    [[nodiscard]] std::size_t owned_count() const noexcept { return owned_; }
    [[nodiscard]] std::size_t ghost_count() const noexcept { return shifts_.size(); }
    /// By how many periods ghost k, which is particle owned_count() + k, has been moved from its owner's position.
    [[nodiscard]] const shift_type& shift(std::size_t k) const noexcept {
        TSUBU_EXPECTS(k < shifts_.size(), "there is no such ghost; ghosts go from 0 to ghost_count() - 1");
        return shifts_[k];
    }
    /// Of all ghosts [ghost_count()].
    [[nodiscard]] std::span<const shift_type> shifts() const noexcept { return {shifts_.data(), shifts_.size()}; }
    /// How many particles this rank sends with each forward.
    [[nodiscard]] std::size_t sent_count() const noexcept {
        return sum([](const round_type& one) { return one.sent(); });
    }
    /// How many messages this rank sends, and gets, with each forward; with reverse as many the other way.
    [[nodiscard]] std::size_t sent_messages() const noexcept {
        return sum([](const round_type& one) { return one.receivers(); });
    }
    /// Messages that this rank gets at each forward.
    [[nodiscard]] std::size_t received_messages() const noexcept {
        return sum([](const round_type& one) { return one.senders(); });
    }

    /// The ghosts get these fields of their owners.
    /// @param store  the one that the halo was made for, or a copy
    /// @throws input_error if particles have come, gone or been permuted since the halo was made, or a forward is under
    ///         way; std::bad_alloc in the first call for fields of one size; what the transport throws. Each rank for
    ///         itself: particles come and go by migrate, which all ranks call.
    template <class Store, particle_field... Field>
    void forward(Store& store, Field... which) {
        start_forward(store, which...);
        finish_forward(store, which...);
    }
    /// The first half: values are packed and on their way. Until the second half other work may be done; what owned
    /// particles are changed to in between goes to ghosts only if the pattern has several steps.
    template <class Store, particle_field... Field>
    void start_forward(const Store& store, Field...) {
        check<Store, Field...>(store, "halo::start_forward");
        begin(forward_under_way_, key_of<Field...>(), "halo::start_forward");
        if (!rounds_.empty()) rounds_.front().start_forward(store, fields<Field{}...>{});
    }
    /// The second half, for the same fields. @throws input_error if they are not under way.
    template <class Store, particle_field... Field>
    void finish_forward(Store& store, Field...) {
        check<Store, Field...>(store, "halo::finish_forward");
        end(forward_under_way_, key_of<Field...>(), "halo::finish_forward");
        constexpr fields<Field{}...> set{};
        for (std::size_t k = 0; k < rounds_.size(); ++k) {
            if (k != 0) rounds_[k].start_forward(store, set);
            rounds_[k].finish_forward(store, set);
        }
    }

    /// What ghosts hold of these fields is added to their owners: as each field says, by sum, least or greatest. In the
    /// order of steps, ranks and shifts: the same on every run. A sum begins with what is there: clear the field of all
    /// particles first, ghosts too, `for (auto& f : g[tsubu::force<3>]) f = {};`. What ghosts hold afterwards is theirs
    /// with one step, and unspecified with several, where ghosts pass on what others have added to them.
    /// @throws as forward.
    template <class Store, particle_field... Field>
    void reverse(Store& store, Field... which) {
        start_reverse(store, which...);
        finish_reverse(store, which...);
    }
    /// The first half; a forward may be under way too.
    template <class Store, particle_field... Field>
    void start_reverse(const Store& store, Field...) {
        check<Store, Field...>(store, "halo::start_reverse");
        begin(reverse_under_way_, key_of<Field...>(), "halo::start_reverse");
        if (!rounds_.empty()) rounds_.back().start_reverse(store, fields<Field{}...>{});
    }
    /// The second half, for the same fields. @throws input_error if they are not under way.
    template <class Store, particle_field... Field>
    void finish_reverse(Store& store, Field...) {
        check<Store, Field...>(store, "halo::finish_reverse");
        end(reverse_under_way_, key_of<Field...>(), "halo::finish_reverse");
        constexpr fields<Field{}...> set{};
        for (auto k = rounds_.size(); k-- > 0;) {
            if (k + 1 != rounds_.size()) rounds_[k].start_reverse(store, set);
            rounds_[k].finish_reverse(store, set);
        }
    }

private:
    template <class Store, decomposition P, transport T, class Pattern>
        requires halo_pattern<Pattern, P>
    friend halo<P, T> make_halo(Store& store, const P& parts, typename P::real_type cutoff, T& on,
                                const Pattern& pattern);

    template <class Store, class... Field>
    void check(const Store& store, const char* where) const {
        static_assert(sizeof...(Field) > 0, "name the fields that travel");
        static_assert((Store::template has<Field> && ...), "the store lacks a field that is to travel");
        static_assert((!detail::stored<typename Field::value_type>::is_list && ...) &&
                          (!detail::stored<typename Field::value_type>::is_bonus && ...),
                      "lists and bonus values go to ghosts when these are made, not every step: let them travel "
                      "on_creation");
        if (store.owned_count() != owned_ || store.ghost_count() != shifts_.size())
            detail::raise<input_error>(where,
                                       std::to_string(store.owned_count()) + " owned particles and " +
                                           std::to_string(store.ghost_count()) + " ghosts; this halo was made for " +
                                           std::to_string(owned_) + " and " + std::to_string(shifts_.size()),
                                       "make it anew after particles have come or gone");
        if (store.revision() != revision_)
            detail::raise<input_error>(where, "particles have come, gone or been permuted since this halo was made",
                                       "make it anew, for this store");
    }
    // Which fields are under way: the address of something that each set of them has for itself.
    template <class... Field>
    [[nodiscard]] static const void* key_of() noexcept {
        static char key = 0;
        return &key;
    }
    static void begin(const void*& under_way, const void* key, const char* where) {
        if (under_way != nullptr)
            detail::raise<input_error>(where, "another one is under way", "finish it first; halos can be several");
        under_way = key;
    }
    static void end(const void*& under_way, const void* key, const char* where) {
        if (under_way != key)
            detail::raise<input_error>(where,
                                       under_way == nullptr ? "nothing was started" : "other fields were started",
                                       "finish the fields that were started, in the same order");
        under_way = nullptr;
    }
    template <class Of>
    [[nodiscard]] std::size_t sum(Of&& of) const noexcept {
        std::size_t all = 0;
        for (const auto& one : rounds_) all += of(one);
        return all;
    }
    // One step of the pattern. Collective. The guarantee is that of make_halo.
    template <class Store>
    void make_step(Store& store, const Parts& parts, Transport& on, const halo_step<Parts>& step,
                   const std::vector<std::size_t>& begins) {
        round_type next(*box_, on);
        message_memory::array<std::uint64_t> words;
        try {
            detail::agreed_exchange(
                on, "make_halo",
                [&](std::vector<parcel>& parcels) {
                    next.choose(store, parts, step.askers, begins[step.from], begins[step.to]);
                    next.pack_new(store, owned_, shifts_, words, parcels);
                },
                [&](const mailbox& came) {
                    next.unpack_new(store, came, shifts_);
                    rounds_.push_back(std::move(next));
                },
                "there are no ghosts");
        } catch (...) {
            store.clear_ghosts();
            throw;
        }
    }

    std::unique_ptr<const box_type> box_;  // where the rounds find it, wherever the halo is moved
    std::size_t owned_ = 0;
    std::uint64_t revision_ = 0;  // of the store
    const void* forward_under_way_ = nullptr;
    const void* reverse_under_way_ = nullptr;
    std::vector<shift_type> shifts_;  // [ghosts]
    std::vector<round_type> rounds_;
};

/// Makes ghosts of all particles of other ranks, and of images, that lie within the cutoff of this rank's subdomain;
/// the store's earlier ghosts are cleared.
///
///     auto halo = tsubu::make_halo(grains, bricks, cutoff, on);
///     auto halo = tsubu::make_halo(grains, bricks, cutoff, on, tsubu::staged_pattern{});
///
/// Any cutoff: over several ranks, and beyond the length of the box, where one particle has several images. In boxes
/// that are not a domain some ghosts are a little farther than the cutoff. A ghost gets the fields that travel
/// on_creation or every_step; the others are zero.
///
/// @param cutoff   [m]
/// @param pattern  a halo_pattern
/// @throws on all ranks or none: input_error if the cutoff is negative, not finite, or not the same on all ranks, or
///         these are not those of the decomposition; limit_error, or std::bad_alloc on the rank itself, where memory is
///         short. There are no ghosts then.
/// Precondition: the particles are on the ranks that own them, as after migrate.
/// Complexity: O(n) comparisons for each neighbour; bytes: the fields of the ghosts, 8 per rank, 8 (D + 1) per rank and
///             image.
/// Collective: yes; the same decomposition, cutoff and pattern on all ranks. Two reductions, for each step of the
///             pattern two, and one message to each rank that gets any.
template <class Store, decomposition Parts, transport Transport, class Pattern = direct_pattern>
    requires halo_pattern<Pattern, Parts>
[[nodiscard]] halo<Parts, Transport> make_halo(Store& store, const Parts& parts, typename Parts::real_type cutoff,
                                               Transport& on, const Pattern& pattern = {}) {
    store.clear_ghosts();
    halo<Parts, Transport> made;
    made.owned_ = store.owned_count();
    agreement<> before(on.rank());
    std::vector<halo_step<Parts>> steps;
    std::vector<std::size_t> begins;  // of the groups
    before.attempt([&] {
        made.box_ = std::make_unique<const typename Parts::box_type>(parts.whole());
        detail::check_ranks("make_halo", parts.ranks(), on.ranks());
        if (!(cutoff >= 0) || !(cutoff <= (std::numeric_limits<typename Parts::real_type>::max)()))
            detail::raise<input_error>("make_halo", "the cutoff " + detail::shown(cutoff),
                                       "give a finite length of at least 0");
        steps = pattern.plan(parts, on.rank(), cutoff);
        begins = {0, made.owned_};
        begins.reserve(begins.size() + steps.size());
    });
    on.reduce(before.words(), reduction::sum);
    before.settle("make_halo", "there are no ghosts");
    const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(cutoff));
    std::uint64_t ends[] = {bits, ~bits, steps.size(), ~std::uint64_t{steps.size()}};
    on.reduce(std::span<std::uint64_t>(ends), reduction::greatest);
    if (ends[0] != ~ends[1] || ends[2] != ~ends[3])
        detail::raise<input_error>("make_halo",
                                   "ranks differ in the cutoff, which is " + detail::shown(cutoff) +
                                       " here, or in the pattern",
                                   "give the same on all ranks, such as the greatest by transport::reduce");
    for (const auto& step : steps) {
        made.make_step(store, parts, on, step, begins);
        begins.push_back(store.size());
    }
    made.revision_ = store.revision();
    return made;
}

}  // namespace tsubu
