// SPDX-License-Identifier: MIT
/// @file
/// Particles of one store, added to another.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/store/field.hpp>
#include <tsubu/store/pack.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span
#include <vector>   // std::vector

namespace tsubu::detail {

/// Takes away the last owned particles again. Precondition: there are no ghosts, if there are any to be taken away.
template <class Store>
void drop_rows(Store& store, std::size_t down_to) noexcept {
    while (store.owned_count() > down_to) store.swap_remove(store.owned_count() - 1);
}
/// Adds these particles of another store, with the fields that both have. Strong guarantee.
template <class Into, class From>
void append_rows(Into& into, const From& from, std::span<const index_t> chosen) {
    using set = intersection_of<typename Into::fields_type, typename From::fields_type>;
    static_assert(set::count != 0, "the stores have no field in common: nothing would be left of the particles");
    std::vector<std::uint64_t> words(packed_words(from, set{}, chosen));
    pack(from, set{}, chosen, words);
    const auto before = into.owned_count();
    const auto first = into.add_owned(chosen.size());
    try {
        unpack(into, set{}, first, chosen.size(), words);
    } catch (...) {
        drop_rows(into, before);
        throw;
    }
}

}  // namespace tsubu::detail
