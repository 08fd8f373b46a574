// SPDX-License-Identifier: MIT
/// @file
/// What a storage policy of id_map must offer, and the table of those that are shipped.
///
/// policy                      find       rebuild         bytes per id        choose it when
/// dense_storage               1 load     O(N + T)        4 T/N               ids fill their range: T/N up to 5, or
///                                                                            24 while the table is below 8 MiB
/// bitmap_storage              2 loads    O(N + T/64)     4 + .19 T/N         memory is tight and T/N <= 16
/// paged_storage               2 loads    O(N + pages)    4 per page entry    ids come in blocks
/// flat_storage                1 line     O(N)            8 | 16 | 20         any ids: the general table
/// chained_storage<mixed>      chain      O(N)            40                  many assign and erase between rebuilds
/// chained_storage<mod_prime>  chain      O(N) .. O(N^2)  40                  to reproduce LIGGGHTS' scheme, no more
/// adaptive_storage (default)  as picked  as picked       as picked           you do not know the ids, or they change
///
/// T is the range of the ids, highest - lowest; N their number.
/// What is deliberately not shipped: a sorted array with binary search (look-up 50 to 90 ns at 1e5), a table whose
/// lines keep neighbouring ids together (3x worse on blocks), epochs instead of clearing (look-up 1.3 to 1.6x).
#pragma once

#include <tsubu/core/executor.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/id_range.hpp>

#include <concepts>  // std::same_as, std::semiregular
#include <cstddef>   // std::size_t
#include <span>      // std::span

namespace tsubu {

/// Read side: where is this id, and how much is there.
template <class Storage>
concept id_storage_lookup = particle_id<typename Storage::id_type> &&
                            requires(const Storage& storage, typename Storage::id_type t) {
                                { storage.find(t) } noexcept -> std::same_as<index_t>;
                                { storage.size() } noexcept -> std::same_as<std::size_t>;
                                { storage.memory_bytes() } noexcept -> std::same_as<std::size_t>;
                            };

/// Write side, one id at a time.
template <class Storage>
concept id_storage_update = requires(Storage& storage, typename Storage::id_type t, index_t index) {
    { storage.assign(t, index) } -> std::same_as<void>;
    { storage.erase(t) } noexcept -> std::same_as<bool>;
};

/// Write side, all ids at once.
template <class Storage>
concept id_storage_rebuild =
    requires(Storage& storage, std::span<const typename Storage::id_type> ids,
             id_range<typename Storage::id_type> range, std::span<index_t> links, std::size_t count) {
        { storage.rebuild(ids, range, links) } -> std::same_as<void>;
        { storage.reserve(count) } -> std::same_as<void>;
        { storage.clear() } noexcept -> std::same_as<void>;
    };

/// A storage policy: the memory and the loops behind id_map.
///
/// The front template has checked the arguments: ids are not negative, indices lie in [0, max_index_count),
/// ids.size() <= max_index_count, range == range_of(ids), links is empty or as long as ids.
/// What the compiler cannot check, testing/id_storage_conformance.hpp does:
///  1. after rebuild(ids, range, links): find(t) is the lowest i with ids[i] == t, absent if there is none;
///     size() is the number of different ids; nothing of the former content is left (A1, A4);
///  2. if links is not empty: links[i] is the lowest j > i with ids[j] == ids[i], absent if there is none; every
///     element is written, none is read before (A13);
///  3. find is total: any value of the type, negative, highest, never seen, yields absent (A1);
///  4. after assign(id, index), find(id) == index until the next write for that id; no other answer changes;
///  5. erase(id) says whether id was there; then find(id) is absent; no other answer changes;
///  6. clear() forgets all; size() is the number of ids present; memory_bytes() what the tables hold;
///  7. reserve(n) changes no answer;
///  8. rebuild, assign and reserve have the strong guarantee: if they throw, every answer is the old one and no link
///     has been written; assign to an id that is present takes no memory if index < size of the last rebuild, or no
///     more than an index that was assigned since;
///  9. a copy is independent of its source; a moved-from storage can be assigned to and destroyed.
template <class Storage>
concept id_storage = std::semiregular<Storage> && id_storage_lookup<Storage> && id_storage_update<Storage> &&
                     id_storage_rebuild<Storage>;

/// Ability: look up many ids at once; out[k] == find(ids[k]) for every k, ids.size() == out.size().
template <class Storage>
concept batched_lookup =
    id_storage<Storage> &&
    requires(const Storage& storage, std::span<const typename Storage::id_type> ids, std::span<index_t> out) {
        { storage.find(ids, out) } noexcept -> std::same_as<void>;
    };

/// Ability: fetch the memory that find(id) will read into the cache; no answer changes.
template <class Storage>
concept prefetchable = id_storage<Storage> && requires(const Storage& storage, typename Storage::id_type t) {
    { storage.prefetch(t) } noexcept -> std::same_as<void>;
};

/// Ability: rebuild with any executor; every answer and every link as if built by one thread.
template <class Storage>
concept parallel_rebuild =
    id_storage<Storage> &&
    requires(Storage& storage, std::span<const typename Storage::id_type> ids,
             id_range<typename Storage::id_type> range, std::span<index_t> links, const this_thread& alone,
             const detail::executor_archetype& any) {
        { storage.rebuild(ids, range, links, alone) } -> std::same_as<void>;
        { storage.rebuild(ids, range, links, any) } -> std::same_as<void>;
    };

}  // namespace tsubu
