// SPDX-License-Identifier: MIT
/// @file
/// What contacts remember: their history, from one neighbour list to the next: by the ids of the partners.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/contact_kernel.hpp>
#include <tsubu/dem/quantities.hpp>
#include <tsubu/id/id_map.hpp>
#include <tsubu/neighbor/pair_list.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <algorithm>  // std::fill, std::lower_bound
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t, std::uint32_t
#include <span>       // std::span
#include <string>     // std::to_string
#include <vector>     // std::vector

namespace tsubu::dem::detail {

// While a list of neighbours holds, histories lie beside it, a row for each pair. Before particles move to other places
// or ranks, each particle takes the histories of its contacts with it, with the ids of the partners; afterwards the ids
// are looked up, and the histories laid beside the new list:
//
//     pairs    (0, 4) (0, 7) (2, 4) ...        particle 0: [id of 4 | history] [id of 7 | history]
//     history    *      .      *               particle 4: [id of 0 | -history] [id of 2 | -history]
//
// Both particles of a contact keep it, each from its side, since either may go to another rank.

/// The histories of the pairs of one list, and whether each pair touched.
template <std::size_t Size, class Real>
struct history_table {
    buffer<touch_state> touches;        // [pairs]
    buffer<vec<Size, Real>> history;  // [pairs]; of a pair that did not touch without meaning

    explicit history_table(std::size_t pairs = 0) : touches(pairs, {}), history(pairs, {}) {
        std::fill(touches.begin(), touches.end(), touch_state{0});
    }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return touches.memory_bytes() + history.memory_bytes(); }
};

/// Where the partners of remembered contacts are.
enum class partners {
    are_here,     ///< each is near: one that is missing is an error
    may_be_gone,  ///< they have parted, or were removed: their contact ends
};

/// Of a law that remembers nothing: nothing.
template <class Simulation, bool HasHistory = Simulation::has_history>
class contact_history {
public:
    void keep(typename Simulation::store_type&, std::span<const index_pair>, std::span<const index_pair>) {}
    void recall(typename Simulation::store_type&, std::span<const index_pair>, std::span<const index_pair>, partners) {}
    void drop_kept(typename Simulation::store_type&) {}
    [[nodiscard]] touch_state* pair_touches() noexcept { return nullptr; }
    [[nodiscard]] touch_state* wall_touches() noexcept { return nullptr; }
    [[nodiscard]] vec<0, typename Simulation::real>* pair_history() noexcept { return nullptr; }
    [[nodiscard]] vec<0, typename Simulation::real>* wall_history() noexcept { return nullptr; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return 0; }
};
template <class Simulation>
class contact_history<Simulation, true> {
    using real = typename Simulation::real;
    static constexpr auto history_size = Simulation::history_size;
    static constexpr auto contacts = Simulation::quantities_type::template contacts<history_size>;
    using store_type = typename Simulation::store_type;

public:
    [[nodiscard]] touch_state* pair_touches() noexcept { return pairs_.touches.data(); }
    [[nodiscard]] touch_state* wall_touches() noexcept { return walls_.touches.data(); }
    [[nodiscard]] vec<history_size, real>* pair_history() noexcept { return pairs_.history.data(); }
    [[nodiscard]] vec<history_size, real>* wall_history() noexcept { return walls_.history.data(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return pairs_.memory_bytes() + walls_.memory_bytes(); }

    /// Each owned particle takes what its contacts remember. Replaces what it held.
    void keep(store_type& store, std::span<const index_pair> pairs, std::span<const index_pair> at_walls) {
        is_kept_ = true;
        const auto held = store[contacts];
        const auto ids = store[tsubu::id];
        for (std::size_t i = 0; i < store.owned_count(); ++i) held[i].clear();
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            if ((pairs_.touches[p] & 1U) == 0) continue;
            const auto [i, j] = pairs[p];
            held[i].push_back({ids[j], pairs_.history[p]});
            if (static_cast<std::size_t>(j) >= store.owned_count()) continue;
            auto opposite = pairs_.history[p];
            for (auto& one : opposite) one = -one;
            held[j].push_back({ids[i], opposite});
        }
        for (std::size_t p = 0; p < at_walls.size(); ++p)
            if ((walls_.touches[p] & 1U) != 0)
                held[at_walls[p].i].push_back({id_of_wall(at_walls[p].j), walls_.history[p]});
    }
    /// What particles have taken is of the past when they move on.
    void drop_kept(store_type& store) {
        if (!is_kept_) return;
        is_kept_ = false;
        const auto held = store[contacts];
        for (std::size_t i = 0; i < store.owned_count(); ++i) held[i].clear();
        store.compact();
    }
    /// Lays the histories beside new lists, and takes them from the particles. @throws input_error if a partner that
    /// should be here is not.
    void recall(store_type& store, std::span<const index_pair> pairs, std::span<const index_pair> at_walls,
                partners which) {
        is_kept_ = false;
        pairs_ = history_table<history_size, real>(pairs.size());
        walls_ = history_table<history_size, real>(at_walls.size());
        const auto held = store[contacts];
        std::vector<std::int64_t> wanted;
        for (std::size_t i = 0; i < store.owned_count(); ++i)
            for (const auto& one : held[i]) wanted.push_back(one.partner);
        if (wanted.empty()) return;

        const auto ids = store[tsubu::id];
        where_.rebuild(ids.span());
        std::vector<index_t> found(wanted.size());
        where_.find(wanted, found);
        const rows by_first(pairs, store.owned_count());
        std::size_t at = 0;
        for (std::size_t i = 0; i < store.owned_count(); ++i) {
            for (const auto& one : held[i]) {
                const auto partner = found[at++];
                if (one.partner < 0)
                    lay_beside_wall(at_walls, static_cast<index_t>(i), one);
                else if (partner == absent && which == partners::are_here)
                    lose(ids[i], one.partner);
                else if (partner != absent)
                    for (const auto p : by_first.of(i)) {
                        const auto j = pairs[p].j;
                        // A ghost may be another image than the one that was found.
                        if (j != partner &&
                            (static_cast<std::size_t>(j) < store.owned_count() || ids[j] != one.partner))
                            continue;
                        pairs_.touches[p] = 1;
                        pairs_.history[p] = one.history;
                    }
            }
            held[i].clear();
        }
        store.compact();
    }

private:
    // Pair numbers by first particle.
    class rows {
    public:
        rows(std::span<const index_pair> pairs, std::size_t owned) : begin_(owned + 2, {}), numbers_(pairs.size(), {}) {
            std::fill(begin_.begin(), begin_.end(), 0U);
            for (const auto& pair : pairs) ++begin_[static_cast<std::size_t>(pair.i) + 2];
            for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
            for (std::uint32_t p = 0; p < pairs.size(); ++p)
                numbers_[begin_[static_cast<std::size_t>(pairs[p].i) + 1]++] = p;
        }
        [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const noexcept {
            return {numbers_.data() + begin_[i], begin_[i + 1] - begin_[i]};
        }

    private:
        buffer<std::uint32_t> begin_;
        buffer<std::uint32_t> numbers_;
    };
    [[nodiscard]] static std::int64_t id_of_wall(index_t wall) noexcept { return -1 - std::int64_t{wall}; }
    template <class Remembered>
    void lay_beside_wall(std::span<const index_pair> at_walls, index_t i, const Remembered& one) {
        const auto first = std::lower_bound(at_walls.begin(), at_walls.end(), i,
                                            [](const index_pair& a, index_t b) { return a.i < b; });
        for (auto p = first; p != at_walls.end() && p->i == i; ++p)
            if (id_of_wall(p->j) == one.partner) {
                const auto k = static_cast<std::size_t>(p - at_walls.begin());
                walls_.touches[k] = 1;
                walls_.history[k] = one.history;
            }
    }
    [[noreturn]] static void lose(std::int64_t id, std::int64_t partner) {
        tsubu::detail::raise<input_error>("dem::run::start",
                                          "particle " + std::to_string(id) + " remembers a contact with " +
                                              std::to_string(partner) + ", which is not near it on this rank",
                                          "insert both of them, or clear the field `contacts`");
    }

    history_table<history_size, real> pairs_;
    history_table<history_size, real> walls_;
    id_map<> where_;
    bool is_kept_ = false;  // particles have a copy
};

}  // namespace tsubu::dem::detail
