// SPDX-License-Identifier: MIT
/// @file
/// Storages that break one law each, as real tables do: the conformance suite must catch every one.
#pragma once

#include "reference_storage.hpp"

#include <tsubu/core/error.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace tsubu::testing::broken {

using id_t = std::int64_t;
using ids_t = std::span<const id_t>;
using links_t = std::span<index_t>;
using range_t = id_range<id_t>;

/// What the twins share: everything right, no ability.
class sound {
public:
    using id_type = id_t;
    [[nodiscard]] index_t find(id_t id) const noexcept { return table_.find(id); }
    [[nodiscard]] std::size_t size() const noexcept { return table_.size(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return table_.memory_bytes(); }
    void assign(id_t id, index_t index) { table_.assign(id, index); }
    bool erase(id_t id) noexcept { return table_.erase(id); }
    void rebuild(ids_t ids, range_t range, links_t links) { table_.rebuild(ids, range, links); }
    void reserve(std::size_t count) { table_.reserve(count); }
    void clear() noexcept { table_.clear(); }

protected:
    reference_storage<id_t> table_;
};

// --- law 1 ----------------------------------------------------------------------------------------------------------

/// Scans upwards and overwrites.
struct highest_index_wins : sound {
    static constexpr const char* breaks = "law 1";
    void rebuild(ids_t ids, range_t range, links_t links) {
        sound::rebuild(ids, range, links);
        for (std::size_t i = 0; i < ids.size(); ++i) assign(ids[i], static_cast<index_t>(i));
    }
};
/// Forgets to empty the table first.
struct stale_after_rebuild : sound {
    static constexpr const char* breaks = "law 1";
    void rebuild(ids_t ids, range_t range, links_t links) {
        auto former = table_;
        sound::rebuild(ids, range, links);
        for (const auto id : known_)
            if (find(id) == absent && former.find(id) != absent) assign(id, former.find(id));
        known_.assign(ids.begin(), ids.end());
    }
    std::vector<id_t> known_;
};
/// Takes 1000 ids, as the scheme's first table holds, and drops the rest.
struct full_at_capacity : sound {
    static constexpr const char* breaks = "law 1";
    void rebuild(ids_t ids, range_t range, links_t links) {
        sound::rebuild(ids, range, links);
        for (std::size_t i = 1000; i < ids.size(); ++i)
            if (find(ids[i]) == static_cast<index_t>(i)) erase(ids[i]);
    }
};
/// Refuses whatever it is given.
struct refuses_all : sound {
    static constexpr const char* breaks = "law 1";
    void rebuild(ids_t ids, range_t, links_t) {
        if (!ids.empty()) throw limit_error("no");
    }
};

// --- law 2 ----------------------------------------------------------------------------------------------------------

/// Writes only the links that lead somewhere.
struct unique_links_unwritten : sound {
    static constexpr const char* breaks = "law 2";
    void rebuild(ids_t ids, range_t range, links_t links) {
        std::vector<index_t> right(links.size());
        sound::rebuild(ids, range, right);
        for (std::size_t i = 0; i < links.size(); ++i)
            if (right[i] != absent) links[i] = right[i];
    }
};
/// Follows the text of the description instead of its scan: j < i.
struct links_point_downward : sound {
    static constexpr const char* breaks = "law 2";
    void rebuild(ids_t ids, range_t range, links_t links) {
        sound::rebuild(ids, range, links);
        std::vector<index_t> right(links.begin(), links.end());
        for (auto& link : links) link = absent;
        for (std::size_t i = 0; i < right.size(); ++i)
            if (right[i] != absent) links[static_cast<std::size_t>(right[i])] = static_cast<index_t>(i);
    }
};
/// Trusts a link that looks right already.
struct links_read_before : sound {
    static constexpr const char* breaks = "law 2";
    void rebuild(ids_t ids, range_t range, links_t links) {
        std::vector<index_t> right(links.size());
        sound::rebuild(ids, range, right);
        for (std::size_t i = 0; i < links.size(); ++i)
            if (links[i] <= static_cast<index_t>(i) || links[i] >= static_cast<index_t>(ids.size()))
                links[i] = right[i];
    }
};
/// Clears whole vectors of links.
struct links_past_the_end : sound {
    static constexpr const char* breaks = "law 2";
    void rebuild(ids_t ids, range_t range, links_t links) {
        if (!links.empty()) links.data()[links.size()] = absent;  // inside the suite's own margin
        sound::rebuild(ids, range, links);
    }
};

// --- law 3 ----------------------------------------------------------------------------------------------------------

/// Reserves one value of the id for its empty slots.
struct finds_minus_one : sound {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] index_t find(id_t id) const noexcept { return id == -1 ? 0 : sound::find(id); }
};
/// Keeps half of the key.
struct compares_low_half : sound {
    static constexpr const char* breaks = "law 3";
    [[nodiscard]] index_t find(id_t id) const noexcept {
        const auto exact = sound::find(id);
        return exact != absent ? exact : sound::find(static_cast<id_t>(static_cast<std::uint32_t>(id)));
    }
};

// --- law 4 ----------------------------------------------------------------------------------------------------------

/// Inserts, but never overwrites.
struct assign_keeps_old : sound {
    static constexpr const char* breaks = "law 4";
    void assign(id_t id, index_t index) {
        if (find(id) == absent) sound::assign(id, index);
    }
};
/// Packs the index into as many bits as the last rebuild needed.
struct index_cut_off : sound {
    static constexpr const char* breaks = "law 4";
    void assign(id_t id, index_t index) { sound::assign(id, index & 0xfffff); }
};
/// Puts a new id where another was.
struct assign_evicts : sound {
    static constexpr const char* breaks = "law 4";
    void assign(id_t id, index_t index) {
        if (find(id) == absent) sound::erase(id ^ 1);
        sound::assign(id, index);
    }
};

// --- law 5 ----------------------------------------------------------------------------------------------------------

struct erase_lies : sound {
    static constexpr const char* breaks = "law 5";
    bool erase(id_t id) noexcept {
        sound::erase(id);
        return true;
    }
};
struct erase_does_nothing : sound {
    static constexpr const char* breaks = "law 5";
    bool erase(id_t id) noexcept { return find(id) != absent; }
};
/// Empties the slot, and with it ends the search for those that lie behind it.
struct erase_breaks_the_chain : sound {
    static constexpr const char* breaks = "law 5";
    bool erase(id_t id) noexcept {
        const bool was_there = sound::erase(id);
        if (was_there) sound::erase(id ^ 1);
        return was_there;
    }
};

// --- law 6 ----------------------------------------------------------------------------------------------------------

struct clear_forgets_nothing : sound {
    static constexpr const char* breaks = "law 6";
    void clear() noexcept {}
};
/// Counts entries, not ids.
struct size_counts_copies : sound {
    static constexpr const char* breaks = "law 6";
    [[nodiscard]] std::size_t size() const noexcept { return sound::size() + copies_; }
    void rebuild(ids_t ids, range_t range, links_t links) {
        sound::rebuild(ids, range, links);
        copies_ = ids.size() - sound::size();
    }
    void clear() noexcept {
        sound::clear();
        copies_ = 0;
    }
    std::size_t copies_ = 0;
};
struct denies_its_memory : sound {
    static constexpr const char* breaks = "law 6";
    [[nodiscard]] static std::size_t memory_bytes() noexcept { return 0; }
};

// --- law 7 ----------------------------------------------------------------------------------------------------------

/// Allocates the larger table and leaves it empty.
struct reserve_loses : sound {
    static constexpr const char* breaks = "law 7";
    void reserve(std::size_t count) {
        if (count > size()) clear();
    }
};

// --- law 8 ----------------------------------------------------------------------------------------------------------

/// Empties the table, then sees that the ids are too wide for it.
struct clears_before_refusing : sound {
    static constexpr const char* breaks = "law 8";
    void rebuild(ids_t ids, range_t range, links_t links) {
        clear();
        if (!range.empty() && range.highest > (id_t{1} << 40)) throw limit_error("too wide");
        sound::rebuild(ids, range, links);
    }
};
/// Writes the links, then sees that the ids are too wide.
struct links_before_refusing : sound {
    static constexpr const char* breaks = "law 8";
    void rebuild(ids_t ids, range_t range, links_t links) {
        for (auto& link : links) link = absent;
        if (!range.empty() && range.highest > (id_t{1} << 40)) throw limit_error("too wide");
        sound::rebuild(ids, range, links);
    }
};

// --- law 9 ----------------------------------------------------------------------------------------------------------

/// A handle in disguise.
struct copy_shares : sound {
    static constexpr const char* breaks = "law 9";
    [[nodiscard]] index_t find(id_t id) const noexcept { return shared_->find(id); }
    [[nodiscard]] std::size_t size() const noexcept { return shared_->size(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return shared_->memory_bytes(); }
    void assign(id_t id, index_t index) { shared_->assign(id, index); }
    bool erase(id_t id) noexcept { return shared_->erase(id); }
    void rebuild(ids_t ids, range_t range, links_t links) { shared_->rebuild(ids, range, links); }
    void reserve(std::size_t count) { shared_->reserve(count); }
    void clear() noexcept { shared_->clear(); }
    copy_shares() = default;
    copy_shares(const copy_shares&) = default;  // and no move, which would leave a null pointer behind
    copy_shares& operator=(const copy_shares&) = default;
    std::shared_ptr<reference_storage<id_t>> shared_ = std::make_shared<reference_storage<id_t>>();
};
/// Marks itself as moved from, and stays so.
struct dead_once_moved : sound {
    static constexpr const char* breaks = "law 9";
    dead_once_moved() = default;
    dead_once_moved(const dead_once_moved&) = default;
    dead_once_moved(dead_once_moved&& other) noexcept
        : sound(std::move(other)), dead_(std::exchange(other.dead_, true)) {}
    dead_once_moved& operator=(const dead_once_moved& other) {
        sound::operator=(other);
        return *this;
    }
    dead_once_moved& operator=(dead_once_moved&& other) noexcept {
        sound::operator=(std::move(other));
        other.dead_ = true;
        return *this;
    }
    [[nodiscard]] index_t find(id_t id) const noexcept { return dead_ ? absent : sound::find(id); }
    bool dead_ = false;
};

// --- abilities ------------------------------------------------------------------------------------------------------

/// Two lanes, the second one lost.
struct batch_differs_at_odd : sound {
    static constexpr const char* breaks = "ability batched_lookup";
    using sound::find;
    void find(ids_t ids, links_t out) const noexcept {
        for (std::size_t k = 0; k < ids.size(); ++k) out[k] = k % 2 == 1 && k % 64 == 63 ? absent : find(ids[k]);
    }
};
/// Works in blocks of four and leaves the rest.
struct batch_leaves_the_rest : sound {
    static constexpr const char* breaks = "ability batched_lookup";
    using sound::find;
    void find(ids_t ids, links_t out) const noexcept {
        for (std::size_t k = 0; k + k % 4 < ids.size() / 4 * 4; ++k) out[k] = find(ids[k]);
    }
};
/// Moves to the front what will be asked for, and loses what was there.
struct prefetch_reorders : sound {
    static constexpr const char* breaks = "ability prefetchable";
    [[nodiscard]] index_t find(id_t id) const noexcept { return id == lost_ ? absent : sound::find(id); }
    void prefetch(id_t id) const noexcept {
        if (sound::find(id) != absent) lost_ = id;
    }
    void rebuild(ids_t ids, range_t range, links_t links) {
        lost_ = -1;
        sound::rebuild(ids, range, links);
    }
    mutable id_t lost_ = -1;
};
/// Each thread keeps the lowest index of its own part; the last to write wins.
struct parallel_by_parts : sound {
    static constexpr const char* breaks = "ability parallel_rebuild";
    using sound::rebuild;
    template <executor Executor>
    void rebuild(ids_t ids, range_t range, links_t links, const Executor& on) {
        rebuild(ids, range, links);
        const auto part = ids.size() / on.concurrency();
        if (part == 0 || on.concurrency() == 1) return;
        for (std::size_t i = ids.size(); i-- > part;) assign(ids[i], static_cast<index_t>(i));
    }
};

using twins =
    std::tuple<highest_index_wins, stale_after_rebuild, full_at_capacity, refuses_all, unique_links_unwritten,
               links_point_downward, links_read_before, links_past_the_end, finds_minus_one, compares_low_half,
               assign_keeps_old, index_cut_off, assign_evicts, erase_lies, erase_does_nothing, erase_breaks_the_chain,
               clear_forgets_nothing, size_counts_copies, denies_its_memory, reserve_loses, clears_before_refusing,
               links_before_refusing, copy_shares, dead_once_moved, batch_differs_at_odd, batch_leaves_the_rest,
               prefetch_reorders, parallel_by_parts>;

// --- law 8, where memory ends ---------------------------------------------------------------------------------------

using gated = throwing_allocator<std::byte>;

/// What the twins below share: all memory from the gate.
class sound_gated : public reference_storage<id_t, gated> {
public:
    sound_gated() = default;
    explicit sound_gated(const gated& allocator) : reference_storage(allocator), allocator_(allocator) {}

protected:
    gated allocator_;
};
/// Gives the old table back before it has the new one.
struct frees_before_allocating : sound_gated {
    static constexpr const char* breaks = "law 8";
    using sound_gated::sound_gated;
    void rebuild(ids_t ids, range_t range, links_t links) {
        clear();
        reference_storage::rebuild(ids, range, links);
    }
};
/// Takes memory after the first link is written.
struct links_before_allocating : sound_gated {
    static constexpr const char* breaks = "law 8";
    using sound_gated::sound_gated;
    void rebuild(ids_t ids, range_t range, links_t links) {
        if (!links.empty()) links[0] = absent;
        reference_storage::rebuild(ids, range, links);
    }
};
/// Grows by erasing and inserting.
struct loses_when_growing : sound_gated {
    static constexpr const char* breaks = "law 8";
    using sound_gated::sound_gated;
    void assign(id_t id, index_t index) {
        try {
            reference_storage::assign(id, index);
        } catch (...) {
            clear();
            throw;
        }
    }
};
/// Takes a node from the pool, then looks whether it needs one.
struct assign_always_allocates : sound_gated {
    static constexpr const char* breaks = "law 8";
    using sound_gated::sound_gated;
    void assign(id_t id, index_t index) {
        std::vector<int, throwing_allocator<int>> node(1, 0, throwing_allocator<int>(allocator_));
        reference_storage::assign(id, index + node[0]);
    }
};
/// Reports half of what it holds.
struct counts_half_its_memory : sound_gated {
    static constexpr const char* breaks = "law 6";
    using sound_gated::sound_gated;
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return (sound_gated::memory_bytes() + 1) / 2; }
};

using gated_twins = std::tuple<frees_before_allocating, links_before_allocating, loses_when_growing,
                               assign_always_allocates, counts_half_its_memory>;

}  // namespace tsubu::testing::broken
