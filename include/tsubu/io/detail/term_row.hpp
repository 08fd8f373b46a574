// SPDX-License-Identifier: MIT
/// @file
/// A row of Bonds, Angles, Dihedrals or Impropers, and the terms of all of them.
#pragma once

#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/io/detail/row.hpp>
#include <tsubu/store/term.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::int32_t, std::int64_t, std::uint32_t
#include <string>   // std::to_string
#include <vector>   // std::vector

namespace tsubu::detail {

/// `k type id1 id2 ...`; the number k has no meaning.
template <std::size_t Order, class Row>
[[nodiscard]] term<Order> read_term(Row& from, std::int32_t types, bool allows_repeats) {
    term<Order> one;
    static_cast<void>(from.template next<std::int64_t>("the row number"));
    one.type = from.template next_from<std::int32_t>(1, "the type");
    if (one.type > types) [[unlikely]]
        from.fail("type " + std::to_string(one.type) + ", but the header has " + std::to_string(types) +
                      " of this kind",
                  "correct one of them");
    for (auto& particle : one.ids) particle = from.template next_from<std::int64_t>(1, "the id");
    from.expect_end();
    for (std::size_t k = 1; k < Order && !allows_repeats; ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (one.ids[j] == one.ids[k]) [[unlikely]]
                from.fail("the id " + std::to_string(one.ids[k]) + " twice in a term",
                          "a term joins different particles; set lammps_read_options.allows_repeats if that is meant");
    return one;
}

/// The terms of a section, each with a particle that keeps it. They are given to the lists at its end: each list then
/// gets its memory once, in the order of the particles.
template <std::size_t Order>
class kept_terms {
public:
    void add(index_t keeper, const term<Order>& one) {
        keepers_.push_back(keeper);
        terms_.push_back(one);
    }
    /// @param lists  a column of list_of<term<Order>>
    template <class Lists>
    void give(const Lists& lists) const {
        std::vector<std::uint32_t> counts(lists.size(), 0);
        for (const auto i : keepers_) ++counts[static_cast<std::size_t>(i)];
        for (std::size_t i = 0; i < counts.size(); ++i)
            if (counts[i] != 0) lists[i].reserve(lists[i].size() + counts[i]);
        constexpr std::size_t ahead = 16;  // lists lie anywhere: asked for some time before they are written
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            if (t + ahead < terms_.size())
                prefetch<true>(lists[static_cast<std::size_t>(keepers_[t + ahead])].end());
            lists[static_cast<std::size_t>(keepers_[t])].push_back(terms_[t]);
        }
    }

private:
    std::vector<index_t> keepers_;
    std::vector<term<Order>> terms_;
};

}  // namespace tsubu::detail
