// SPDX-License-Identifier: MIT
/// @file
/// The oracle: a table of 8 bytes per id whose places are known, so that only the memory is left to pay for;
/// and the plain array that a dense map is measured against.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint32_t
#include <span>     // std::span

namespace bench {

/// No map of 8 bytes per id can be faster on random ids, unless it overlaps its accesses better: no hash, no
/// compare, no collision. Places come as a stream, as the ids do for a map.
///
/// @tparam Entry  what is kept per id
/// @tparam Place  what the stream of questions consists of; the place is question - origin
template <class Entry, class Place>
class perfect_table {
public:
    perfect_table(std::size_t size, Place origin) : entries_(size, {}), origin_(origin) {}

    /// Clears, then inserts in reverse; links as of a map's rebuild. links may be empty.
    void rebuild(std::span<const Place> places, std::span<tsubu::index_t> links) noexcept {
        for (auto& entry : entries_) entry = Entry{tsubu::absent};
        if (links.empty()) {
            for (std::size_t i = places.size(); i-- > 0;)
                entries_[position(places[i])] = Entry{static_cast<tsubu::index_t>(i)};
            return;
        }
        for (std::size_t i = places.size(); i-- > 0;) {
            auto& entry = entries_[position(places[i])];
            links[i] = entry.index;
            entry = Entry{static_cast<tsubu::index_t>(i)};
        }
    }
    [[nodiscard]] tsubu::index_t at(Place place) const noexcept { return entries_[position(place)].index; }
    void at(std::span<const Place> places, std::span<tsubu::index_t> out) const noexcept {
        for (std::size_t k = 0; k < places.size(); ++k) out[k] = at(places[k]);
    }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return entries_.memory_bytes(); }

private:
    [[nodiscard]] std::size_t position(Place place) const noexcept { return static_cast<std::size_t>(place - origin_); }

    tsubu::buffer<Entry> entries_;
    Place origin_;
};

/// 8 bytes: what an index and the rest of a key take.
struct oracle_entry {
    tsubu::index_t index;
    std::uint32_t rest = 0;
};
static_assert(sizeof(oracle_entry) == 8);

/// 4 bytes: what a dense table takes.
struct plain_entry {
    tsubu::index_t index;
};
static_assert(sizeof(plain_entry) == 4);

using oracle = perfect_table<oracle_entry, std::uint32_t>;
/// For ids that fill their range: an array indexed by id - lowest, no more.
using plain_array = perfect_table<plain_entry, std::int64_t>;

}  // namespace bench
