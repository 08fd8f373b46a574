// SPDX-License-Identifier: MIT
/// @file
/// A storage that is plainly right and has every ability: what the broken twins are made from.
#pragma once

#include <tsubu/core/executor.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/id_range.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tsubu::testing {

/// A sorted array with binary search.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class reference_storage {
public:
    using id_type = Id;

    reference_storage() = default;
    explicit reference_storage(const Allocator& allocator) : entries_(entry_allocator(allocator)) {}

    [[nodiscard]] index_t find(Id id) const noexcept {
        const auto at = place(id);
        return at != entries_.end() && at->id == id ? at->index : absent;
    }
    void find(std::span<const Id> ids, std::span<index_t> indices) const noexcept {
        for (std::size_t k = 0; k < ids.size(); ++k) indices[k] = find(ids[k]);
    }
    static void prefetch(Id /*id*/) noexcept {}
    [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return entries_.capacity() * sizeof(entry); }

    void assign(Id id, index_t index) {
        const auto at = entries_.begin() + (place(id) - entries_.cbegin());
        if (at != entries_.end() && at->id == id)
            at->index = index;
        else
            entries_.insert(at, entry{id, index});
    }
    bool erase(Id id) noexcept {
        const auto at = place(id);
        if (at == entries_.end() || at->id != id) return false;
        entries_.erase(at);
        return true;
    }
    void rebuild(std::span<const Id> ids, id_range<Id> /*range*/, std::span<index_t> links) {
        std::vector<entry, entry_allocator> fresh(entries_.get_allocator());
        fresh.reserve(ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) fresh.push_back({ids[i], static_cast<index_t>(i)});
        std::sort(fresh.begin(), fresh.end(),
                  [](const entry& a, const entry& b) { return a.id != b.id ? a.id < b.id : a.index < b.index; });
        if (!links.empty())
            for (std::size_t k = 0; k < fresh.size(); ++k)
                links[static_cast<std::size_t>(fresh[k].index)] =
                    k + 1 < fresh.size() && fresh[k + 1].id == fresh[k].id ? fresh[k + 1].index : absent;
        fresh.erase(std::unique(fresh.begin(), fresh.end(),
                                [](const entry& a, const entry& b) { return a.id == b.id; }),
                    fresh.end());
        entries_.swap(fresh);
    }
    template <executor Executor>
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links, const Executor& /*on*/) {
        rebuild(ids, range, links);
    }
    void reserve(std::size_t count) { entries_.reserve(count); }
    void clear() noexcept { entries_.clear(); }

private:
    struct entry {
        Id id;
        index_t index;
    };
    using entry_allocator = typename std::allocator_traits<Allocator>::template rebind_alloc<entry>;

    [[nodiscard]] auto place(Id id) const noexcept {
        return std::lower_bound(entries_.begin(), entries_.end(), id,
                                [](const entry& a, Id value) { return a.id < value; });
    }

    std::vector<entry, entry_allocator> entries_;
};
static_assert(batched_lookup<reference_storage<>> && prefetchable<reference_storage<>> &&
              parallel_rebuild<reference_storage<>>);

}  // namespace tsubu::testing
