// SPDX-License-Identifier: MIT
/// @file
/// What an id storage must answer, by sorting: the oracle of the conformance suite.
#pragma once

#include <tsubu/core/types.hpp>

#include <algorithm>  // std::sort, std::lower_bound
#include <cstddef>    // std::ptrdiff_t, std::size_t
#include <span>       // std::span
#include <vector>     // std::vector

namespace tsubu::testing {

/// The map id -> index as a sorted array: slow to write, plainly right.
///
/// It shares no idea with any storage: no scan from the back, no hash, no table.
/// Complexity: rebuild O(N log N), find O(log N), assign and erase O(N).
/// Source: A1, A13.
template <particle_id Id>
class id_model {
public:
    /// An id, and where it is.
    struct entry {
        Id id;
        index_t index;
    };

    /// A1. @return the links of A13
    std::vector<index_t> rebuild(std::span<const Id> ids) {
        std::vector<index_t> links(ids.size(), absent);
        std::vector<entry> all;
        all.reserve(ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) all.push_back({ids[i], static_cast<index_t>(i)});
        std::sort(all.begin(), all.end(),
                  [](const entry& a, const entry& b) { return a.id != b.id ? a.id < b.id : a.index < b.index; });
        entries_.clear();
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (k == 0 || all[k - 1].id != all[k].id)
                entries_.push_back(all[k]);
            else
                links[static_cast<std::size_t>(all[k - 1].index)] = all[k].index;
        }
        return links;
    }
    void assign(Id t, index_t index) {
        const auto at = place(t);
        if (at != entries_.size() && entries_[at].id == t)
            entries_[at].index = index;
        else
            entries_.insert(entries_.begin() + static_cast<std::ptrdiff_t>(at), entry{t, index});
    }
    bool erase(Id t) {
        const auto at = place(t);
        if (at == entries_.size() || entries_[at].id != t) return false;
        entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(at));
        return true;
    }
    void clear() noexcept { entries_.clear(); }

    [[nodiscard]] index_t find(Id t) const noexcept {
        const auto at = place(t);
        return at != entries_.size() && entries_[at].id == t ? entries_[at].index : absent;
    }
    [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
    /// In increasing id.
    [[nodiscard]] std::span<const entry> entries() const noexcept { return entries_; }

private:
    [[nodiscard]] std::size_t place(Id t) const noexcept {
        const auto at = std::lower_bound(entries_.begin(), entries_.end(), t,
                                         [](const entry& a, Id value) { return a.id < value; });
        return static_cast<std::size_t>(at - entries_.begin());
    }

    std::vector<entry> entries_;
};

}  // namespace tsubu::testing
