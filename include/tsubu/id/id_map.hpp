// SPDX-License-Identifier: MIT
/// @file
/// id_map: from a particle's global id to its local index.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/executor.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/adaptive_storage.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/detail/range_kernels.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/same_id_links.hpp>

#include <algorithm>  // std::min
#include <cstddef>    // std::size_t
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu {

/// Where on this rank is the particle with this id?
///
///     tsubu::id_map<> where;
///     where.rebuild(ids);                                     // all N ids, owned first
///     if (auto i = where.find(901'417); i != tsubu::absent) radius[i] *= 1.01;
///     where.find(partner_ids, partner_indices);               // many at once: several times faster
///
/// The table is a policy; this class adds the vocabulary and the checks.
///
/// @tparam Storage  models id_storage; the shipped ones and when to choose which: id/concepts.hpp.
///
/// Invariant:    after rebuild(ids), find(t) is the lowest i with ids[i] == t, absent if there is none; an owned
///               copy therefore comes before every ghost, whichever is nearer (see closest_image).
/// Complexity:   that of Storage.
/// Invalidates:  nothing is handed out by reference, so nothing can dangle.
/// Threads:      many readers or one writer, as std::vector.
/// Source:       A1, A4.
template <id_storage Storage = adaptive_storage<>>
class id_map {
public:
    using storage_type = Storage;
    using id_type = typename Storage::id_type;

    id_map() = default;
    /// Adopts a storage that was configured outside: memory limit, allocator.
    explicit id_map(Storage storage) : storage_(std::move(storage)) {}

    /// Index of the lowest copy of `id`, or absent. Any value may be asked for, negative ones as well.
    [[nodiscard]] index_t find(id_type t) const noexcept { return storage_.find(t); }
    [[nodiscard]] bool contains(id_type t) const noexcept { return find(t) != absent; }

    /// indices[k] = find(ids[k]) for all k: independent look-ups in flight together.
    /// @throws input_error if the spans differ in length; nothing is written then.
    void find(std::span<const id_type> ids, std::span<index_t> indices) const {
        if (ids.size() != indices.size())
            detail::raise<input_error>("id_map::find",
                                       std::to_string(ids.size()) + " ids, but room for " +
                                           std::to_string(indices.size()) + " indices",
                                       "pass spans of equal length");
        if constexpr (batched_lookup<Storage>) {
            storage_.find(ids, indices);
        } else {
            for (std::size_t k = 0; k < ids.size(); ++k) indices[k] = storage_.find(ids[k]);
        }
    }

    /// Says that find(id) will be called soon: a few dozen other look-ups later, it no longer waits for memory.
    void prefetch(id_type t) const noexcept {
        if constexpr (prefetchable<Storage>) storage_.prefetch(t);
    }

    /// Index of the lowest copy of `id`. @throws input_error if absent; the message names the id.
    [[nodiscard]] index_t at(id_type t) const {
        const auto index = find(t);
        if (index == absent) [[unlikely]]
            detail::raise<input_error>("id_map::at",
                                       "id " + std::to_string(t) + " is not among the " + std::to_string(size()) +
                                           " ids of this rank",
                                       "use find() where absence is normal");
        return index;
    }

    /// Makes this the map of exactly these ids, whatever it held; the calling thread does it.
    void rebuild(std::span<const id_type> ids) { rebuild(ids, this_thread{}); }
    void rebuild(std::span<const id_type> ids, same_id_links& same) { rebuild(ids, same, this_thread{}); }
    template <executor Executor>
    void rebuild(std::span<const id_type> ids, const Executor& on) {
        rebuild_storage(ids, {}, on);
    }
    /// Makes this the map of exactly these ids, whatever it held, and links the copies of each.
    ///
    /// @param ids   ids of all particles of the rank, owned first, N < 2^31; ids[i] belongs to index i
    /// @param same  receives the links between copies of one id; its memory is reused
    /// @param on    who does the work; the result does not depend on it. A policy without the ability
    ///              parallel_rebuild builds on the calling thread.
    /// @throws input_error  for a negative id: names its index and value
    /// @throws limit_error  for N >= 2^31, or a table past the memory limit of the policy
    /// Strong guarantee (for the one far corner of it: flat_storage).
    /// Source: A4, A12, A13.
    template <executor Executor>
    void rebuild(std::span<const id_type> ids, same_id_links& same, const Executor& on) {
        check_count("id_map::rebuild", ids.size());
        const auto former = same.links_.size();
        if (ids.size() > former) same.links_.resize(ids.size());
        try {
            rebuild_storage(ids, {same.links_.data(), ids.size()}, on);
        } catch (...) {
            same.links_.resize(former);
            throw;
        }
        same.links_.resize(ids.size());
    }

    /// The same result as rebuild(after, same), cheaper where few entries changed: pays below about 1 %.
    ///
    /// Where more than one in sixteen changed, it rebuilds.
    /// @param before  the ids that map and links were last built from
    /// @param after   the ids now
    /// @throws input_error if `same` is not as long as `before`, or for a negative id; limit_error as rebuild.
    /// Strong guarantee: on an exception map and links are those of `before` again.
    /// Precondition: the last rebuild or update of map and links was with `before`.
    /// Complexity: one pass over both spans, and the chain of images of each changed entry.
    void update(std::span<const id_type> before, std::span<const id_type> after, same_id_links& same);

    /// Inserts the id or overwrites its index; links are not touched. Strong guarantee.
    /// @throws input_error for a negative id or index; limit_error for index 2^31 - 1; what the policy throws when it
    ///         grows.
    void assign(id_type t, index_t index) {
        if (detail::is_negative(t)) [[unlikely]]
            detail::raise<input_error>("id_map::assign", "id " + std::to_string(t) + " is negative",
                                       "number particles from 0 or 1");
        if (index < 0) [[unlikely]]
            detail::raise<input_error>("id_map::assign",
                                       "index " + std::to_string(index) + " of id " + std::to_string(t) +
                                           " is negative",
                                       "erase(id) forgets an id");
        if (static_cast<std::size_t>(index) >= max_index_count) [[unlikely]]
            detail::raise<limit_error>("id_map::assign",
                                       "index " + std::to_string(index) + " of id " + std::to_string(t) +
                                           " is past the last, " + std::to_string(max_index_count - 1),
                                       "spread the particles over more ranks");
        storage_.assign(t, index);
    }
    /// Forgets the id; links are not touched. @return whether it was there.
    bool erase(id_type t) noexcept { return storage_.erase(t); }

    /// Makes room for `count` ids, so that a rebuild of that many needs no memory as long as their range allows.
    /// @throws limit_error for count >= 2^31.
    void reserve(std::size_t count) {
        check_count("id_map::reserve", count);
        storage_.reserve(count);
    }
    /// Forgets every id; links are not touched.
    void clear() noexcept { storage_.clear(); }
    /// Number of different ids.
    [[nodiscard]] std::size_t size() const noexcept { return storage_.size(); }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    /// What the tables hold, used or not. [bytes]
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return storage_.memory_bytes(); }

    /// The policy, read only: what it alone can tell, without breaking our invariant.
    [[nodiscard]] const Storage& storage() const noexcept { return storage_; }

private:
    static void check_count(const char* where, std::size_t count) {
        if (count > max_index_count)
            detail::raise<limit_error>(where,
                                       std::to_string(count) + " ids, but an index has 31 bits: at most " +
                                           std::to_string(max_index_count),
                                       "spread the particles over more ranks");
    }
    // Only when the lowest id is negative: which one is it?
    [[noreturn, gnu::cold, gnu::noinline]] static void refuse_negative(const char* where,
                                                                       std::span<const id_type> ids) {
        std::size_t i = 0;
        while (!detail::is_negative(ids[i])) ++i;
        detail::raise<input_error>(where, "ids[" + std::to_string(i) + "] = " + std::to_string(ids[i]) + " is negative",
                                   "number particles from 0 or 1");
    }
    template <executor Executor>
    void rebuild_storage(std::span<const id_type> ids, std::span<index_t> links, const Executor& on) {
        check_count("id_map::rebuild", ids.size());
        const auto range = detail::vector_range_of(ids);
        if (!range.empty() && detail::is_negative(range.lowest)) refuse_negative("id_map::rebuild", ids);
        if constexpr (parallel_rebuild<Storage>) {
            storage_.rebuild(ids, range, links, on);
        } else {
            storage_.rebuild(ids, range, links);
        }
    }
    [[nodiscard]] static bool holds(std::span<const id_type> ids, index_t at, id_type t) noexcept {
        return static_cast<std::size_t>(at) < ids.size() && ids[static_cast<std::size_t>(at)] == t;
    }
    // Take one copy out of the chain of its id, and put one in at its place.
    void unlink(id_type t, index_t index, std::span<index_t> links);
    void link(std::span<const id_type> after, index_t index, std::span<index_t> links);

    Storage storage_{};
};

template <id_storage Storage>
void id_map<Storage>::update(std::span<const id_type> before, std::span<const id_type> after, same_id_links& same) {
    check_count("id_map::update", after.size());
    if (same.size() != before.size())
        detail::raise<input_error>("id_map::update",
                                   std::to_string(same.size()) + " links, but " + std::to_string(before.size()) +
                                       " ids before",
                                   "pass the ids that the links were last built from");
    const auto in_both = (std::min)(before.size(), after.size());
    const auto longer = before.size() + after.size() - in_both;
    std::vector<index_t> changed;
    const auto limit = longer / 16;  // from about 6 % on a rebuild is never slower
    if (longer - in_both > limit) return rebuild(after, same);
    changed.reserve(limit + 1);
    for (std::size_t i = 0; i < in_both; ++i) {
        if (before[i] == after[i]) continue;
        changed.push_back(static_cast<index_t>(i));
        if (changed.size() > limit) return rebuild(after, same);
    }
    for (std::size_t i = in_both; i < longer; ++i) changed.push_back(static_cast<index_t>(i));
    for (const auto i : changed)
        if (static_cast<std::size_t>(i) < after.size() && detail::is_negative(after[static_cast<std::size_t>(i)]))
            refuse_negative("id_map::update", after);

    same.links_.resize(longer);
    try {
        // All that may take memory comes first, and erasing undoes it: no other index is written yet.
        for (const auto i : changed)
            if (const auto k = static_cast<std::size_t>(i); k < after.size() && !contains(after[k]))
                storage_.assign(after[k], i);
        if (!before.empty()) {  // room for the highest index, by writing it once
            if (const auto index = find(before[0]); index != absent) {  // absent: `before` is wrong
                storage_.assign(before[0], static_cast<index_t>(longer - 1));
                storage_.assign(before[0], index);
            }
        }
    } catch (...) {
        for (const auto i : changed)  // no former id was at such an i: before[i] is not after[i]
            if (const auto k = static_cast<std::size_t>(i); k < after.size() && find(after[k]) == i)
                storage_.erase(after[k]);
        same.links_.resize(before.size());
        throw;
    }
    const auto links = std::span(same.links_.data(), same.links_.size());
    for (const auto i : changed)
        if (const auto k = static_cast<std::size_t>(i); k < before.size()) unlink(before[k], i, links);
    for (const auto i : changed)
        if (const auto k = static_cast<std::size_t>(i); k < after.size()) link(after, i, links);
    for (const auto i : changed)
        if (const auto k = static_cast<std::size_t>(i); k < before.size())
            if (const auto at = find(before[k]); at != absent && !holds(after, at, before[k])) erase(before[k]);
    same.links_.resize(after.size());
}

// An id whose last copy goes stays in the table with a stale index: it may come back, and that must take no memory.
template <id_storage Storage>
void id_map<Storage>::unlink(id_type t, index_t index, std::span<index_t> links) {
    const auto next = links[static_cast<std::size_t>(index)];
    auto at = storage_.find(t);
    if (at == index) {
        if (next != absent) storage_.assign(t, next);
        return;
    }
    while (at != absent && at < index) {  // at < index: a stale link can end the walk, never prolong it
        auto& following = links[static_cast<std::size_t>(at)];
        if (following == index) {
            following = next;
            return;
        }
        at = following;
    }
}

template <id_storage Storage>
void id_map<Storage>::link(std::span<const id_type> after, index_t index, std::span<index_t> links) {
    const auto t = after[static_cast<std::size_t>(index)];
    auto& own = links[static_cast<std::size_t>(index)];
    auto at = storage_.find(t);
    if (at == index || !holds(after, at, t)) {  // the first copy of an id that was inserted, or had lost all
        own = absent;
        if (at != index) storage_.assign(t, index);
        return;
    }
    if (at > index) {
        own = at;
        storage_.assign(t, index);
        return;
    }
    while (links[static_cast<std::size_t>(at)] != absent && links[static_cast<std::size_t>(at)] < index)
        at = links[static_cast<std::size_t>(at)];
    if (links[static_cast<std::size_t>(at)] == index) return;  // `before` was wrong: a link to itself would be a cycle
    own = links[static_cast<std::size_t>(at)];
    links[static_cast<std::size_t>(at)] = index;
}

}  // namespace tsubu
