// SPDX-License-Identifier: MIT
/// @file
/// Types with exactly the members that a concept asks for, and nothing more: what a front template may rely on.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/domain/border.hpp>
#include <tsubu/domain/cuts.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/id_range.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <map>      // std::map
#include <span>     // std::span
#include <utility>  // std::swap

namespace tsubu::testing {

/// The least that is an id_storage: no ability, no allocator, no constructor but those of a value.
///
/// Instantiating id_map with it shows that the front template asks for no more than its concept. It keeps all nine
/// laws, so it serves as the start of a policy of one's own and as the slowest row of a comparison too.
///
/// Concept:       id_storage.
/// Cost:          find, assign, erase O(log N); rebuild O(N log N).
/// Bytes per id:  48 for 64-bit ids: a node of the tree.
/// Growth:        a node per id; nothing is kept by clear or for reserve.
/// Deterministic: yes.
/// Choose it when you need something that is plainly right.
/// Do not when    speed matters.
/// Source:        A1, A4, A13.
template <particle_id Id = std::int64_t>
class minimal_id_storage {
public:
    using id_type = Id;

    [[nodiscard]] index_t find(Id t) const noexcept {
        const auto at = indices_.find(t);
        return at == indices_.end() ? absent : at->second;
    }
    [[nodiscard]] std::size_t size() const noexcept { return indices_.size(); }
    /// A node of a red-black tree holds three links and a colour beside the pair.
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return size() * (4 * sizeof(void*) + sizeof(typename std::map<Id, index_t>::value_type));
    }

    void assign(Id t, index_t index) { indices_.insert_or_assign(t, index); }
    bool erase(Id t) noexcept { return indices_.erase(t) != 0; }

    void rebuild(std::span<const Id> ids, id_range<Id> /*range*/, std::span<index_t> links) {
        std::map<Id, index_t> fresh;
        for (const auto t : ids) fresh.emplace(t, absent);
        // The scan of A4 and A13 takes no memory, so no link is written before all that can throw is done.
        for (std::size_t i = ids.size(); i-- > 0;) {
            auto& index = fresh.find(ids[i])->second;
            if (!links.empty()) links[i] = index;
            index = static_cast<index_t>(i);
        }
        std::swap(indices_, fresh);
    }
    void reserve(std::size_t /*count*/) {}
    void clear() noexcept { indices_.clear(); }

private:
    std::map<Id, index_t> indices_;
};
static_assert(id_storage<minimal_id_storage<>>);
static_assert(!batched_lookup<minimal_id_storage<>> && !prefetchable<minimal_id_storage<>> &&
              !parallel_rebuild<minimal_id_storage<>>);

/// The least that is a border_policy: a decomposition asks for no more. It owns as exact does.
struct minimal_border {
    template <class Scalar>
    [[nodiscard]] interval<Scalar> owned(const cuts<Scalar>& where, std::size_t part) const {
        return where.owned(part);
    }
    template <class Scalar>
    [[nodiscard]] interval<Scalar> owned_extended(const cuts<Scalar>& where, std::size_t part) const {
        return where.owned_extended(part);
    }
};
static_assert(border_policy<minimal_border, double>);

}  // namespace tsubu::testing
