// SPDX-License-Identifier: MIT
/// @file
/// A hash map of another library as a storage policy of tsubu::id_map.
#pragma once

#include "../support/counting_allocator.hpp"

#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/id_range.hpp>

#include <cstddef>  // std::size_t
#include <memory>   // std::unique_ptr
#include <span>     // std::span
#include <utility>  // std::swap, std::pair

namespace bench {

/// Wraps any map with the interface of std::unordered_map and a counting_allocator.
///
/// The map's own hash, load factor and growth stay as its authors set them. rebuild = clear, reserve, insert in
/// reverse, links from the value that was there: what a user of that map would write. Batches are a plain loop in
/// id_map, since none of these maps has a batched look-up.
///
/// Guarantee: basic (a map that runs out of memory in the middle of a rebuild keeps what it has by then).
template <class Map>
class map_storage {
public:
    using id_type = typename Map::key_type;

    map_storage() = default;
    map_storage(const map_storage& other) : map_storage() { map_.insert(other.map_.begin(), other.map_.end()); }
    map_storage(map_storage&& other) : map_storage() { swap(other); }
    map_storage& operator=(map_storage other) noexcept {
        swap(other);
        return *this;
    }
    ~map_storage() = default;

    void swap(map_storage& other) noexcept {
        std::swap(bytes_, other.bytes_);
        map_.swap(other.map_);
    }

    [[nodiscard]] tsubu::index_t find(id_type id) const noexcept {
        const auto found = map_.find(id);
        return found == map_.end() ? tsubu::absent : found->second;
    }
    void assign(id_type id, tsubu::index_t index) { map_.insert_or_assign(id, index); }
    bool erase(id_type id) noexcept { return map_.erase(id) != 0; }

    void rebuild(std::span<const id_type> ids, tsubu::id_range<id_type>, std::span<tsubu::index_t> links) {
        map_.clear();
        map_.reserve(ids.size());
        if (links.empty()) {
            for (std::size_t i = ids.size(); i-- > 0;)
                map_.try_emplace(ids[i]).first->second = static_cast<tsubu::index_t>(i);
            return;
        }
        for (std::size_t i = ids.size(); i-- > 0;) {
            const auto [entry, inserted] = map_.try_emplace(ids[i], tsubu::absent);
            links[i] = entry->second;  // absent if this is the highest copy
            entry->second = static_cast<tsubu::index_t>(i);
        }
    }
    void reserve(std::size_t count) { map_.reserve(count); }
    void clear() noexcept { map_.clear(); }
    [[nodiscard]] std::size_t size() const noexcept { return map_.size(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return *bytes_; }

protected:
    [[nodiscard]] const Map& map() const noexcept { return map_; }

private:
    std::unique_ptr<std::size_t> bytes_ = std::make_unique<std::size_t>(0);
    Map map_{typename Map::allocator_type(bytes_.get())};
};

template <class Id>
using counted_entries = counting_allocator<std::pair<const Id, tsubu::index_t>>;

}  // namespace bench
