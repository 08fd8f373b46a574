// SPDX-License-Identifier: MIT
/// @file
/// chained_storage: separate chaining with a pool of nodes, LIGGGHTS' hash scheme; its hash is a policy.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/hash.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>
#include <tsubu/id/prime.hpp>
#include <tsubu/id/sizing.hpp>

#include <algorithm>  // std::fill, std::max, std::min
#include <cstddef>    // std::byte, std::size_t
#include <cstdint>    // std::int64_t, std::uint32_t, std::uint64_t
#include <memory>     // std::allocator
#include <span>       // std::span
#include <string>     // std::string, std::to_string
#include <utility>    // std::exchange, std::move, std::swap

namespace tsubu {

// B heads, M nodes, each node in exactly one list: the chain of its bucket or the free list.
//
//     heads_   [ 2 ][ - ][ 0 ] ...                            B = smallest prime > M
//                |         |
//     nodes_   [ id 4, index 7, next - ][ free, next 3 ][ id 9, index 1, next 4 ][ free, next - ][ id 2, ... ]
//                                         ^ free_
//
// An insertion is one search: a hit rewrites the index, a miss links the head of the free list to the end of the
// chain that was just walked. Nodes are numbered in 32 bits: M <= 2 * (2^31 - 1).

/// Separate chaining with a pool of M nodes and a free list, in B buckets, B the smallest prime > M.
///
///     tsubu::id_map<tsubu::chained_storage<tsubu::mod_prime>> where;   // LIGGGHTS' scheme to the letter
///
/// Capacity: M = max(1000, 2 N) when it is sized, and it is sized anew when N > M; N = M still fits. It never
/// shrinks. The part of the rule that knows of other ranks is the caller's: reserve(ceil(N_total / P)).
///
/// Concept:       id_storage, batched_lookup, prefetchable.
/// Cost:          find and erase O(chain), assign amortised O(chain), rebuild O(M + N * chain). A chain has 1 to 2
///                nodes with mixed; with mod_prime too, unless ids are strided by B: then N, and a rebuild O(N^2).
/// Bytes per id:  40 at M = 2 N with 64-bit ids (32 with 32-bit ids).
/// Growth:        to the capacity rule, by every path that inserts; M at least doubles.
/// Deterministic: yes.
/// Choose it when (mixed) ids come and go one by one between rebuilds, or (mod_prime) to reproduce LIGGGHTS' scheme.
/// Do not when    speed or memory matter: flat_storage looks up 3 times faster in a quarter of the memory.
/// Source:        A6 - A12.
template <bucket_hash Hash = mixed, particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class chained_storage {
public:
    using id_type = Id;
    using hash_type = Hash;
    using allocator_type = Allocator;

    chained_storage() = default;
    explicit chained_storage(memory_limit limit, const Allocator& allocator = {})
        : limit_(limit), heads_(allocator), nodes_(allocator) {}
    explicit chained_storage(const Allocator& allocator) : chained_storage(memory_limit{}, allocator) {}

    chained_storage(const chained_storage&) = default;
    chained_storage(chained_storage&& other) noexcept
        : limit_(other.limit_),
          heads_(std::move(other.heads_)),
          nodes_(std::move(other.nodes_)),
          free_(std::exchange(other.free_, nil)),
          size_(std::exchange(other.size_, 0)) {}
    chained_storage& operator=(chained_storage other) noexcept {
        swap(other);
        return *this;
    }
    ~chained_storage() = default;

    [[nodiscard]] index_t find(Id t) const noexcept {
        return heads_.empty() ? absent : find_in(heads_[bucket_of(t)], t);
    }
    void find(std::span<const Id> ids, std::span<index_t> out) const noexcept {
        if (heads_.empty()) {
            std::fill(out.begin(), out.end(), absent);
            return;
        }
        // Heads first, then chains: the heads of a run are fetched together. 32: more than the loads in flight.
        constexpr std::size_t run = 32;
        std::uint32_t head[run];
        for (std::size_t begin = 0; begin < ids.size(); begin += run) {
            const auto count = (std::min)(run, ids.size() - begin);
            for (std::size_t k = 0; k < count; ++k) head[k] = heads_[bucket_of(ids[begin + k])];
            for (std::size_t k = 0; k < count; ++k) out[begin + k] = find_in(head[k], ids[begin + k]);
        }
    }
    void prefetch(Id t) const noexcept {
        if (!heads_.empty()) detail::prefetch(heads_.data() + bucket_of(t));
    }

    /// @throws limit_error if N > M and the new size passes the memory limit. Strong guarantee.
    void rebuild(std::span<const Id> ids, id_range<Id> /*range*/, std::span<index_t> links) {
        if (ids.size() > nodes_.size()) {
            auto fresh = sized_for("rebuild", ids.size());
            swap(fresh);
        }
        clear();
        for (std::size_t i = ids.size(); i-- > 0;) {
            const auto next = insert(ids[i], static_cast<index_t>(i));
            if (!links.empty()) links[i] = next;
        }
    }

    /// @throws limit_error if all nodes are taken and a larger pool would pass the memory limit. Strong guarantee.
    void assign(Id t, index_t index) {
        if (free_ == nil && find(t) == absent) resize("assign", size_ + 1);
        insert(t, index);
    }
    bool erase(Id t) noexcept {
        if (heads_.empty()) return false;
        for (auto* from = &heads_[bucket_of(t)]; *from != nil; from = &nodes_[*from].next) {
            const auto at = *from;
            if (nodes_[at].id != t) continue;
            *from = std::exchange(nodes_[at].next, free_);
            free_ = at;
            --size_;
            return true;
        }
        return false;
    }

    /// Sizes for `count` ids if M is less. @throws limit_error past the memory limit. Strong guarantee.
    void reserve(std::size_t count) {
        if (count > nodes_.size()) resize("reserve", count);
    }
    void clear() noexcept {
        std::fill(heads_.begin(), heads_.end(), nil);
        const auto count = nodes_.size();
        for (std::size_t k = 0; k < count; ++k)
            nodes_[k].next = k + 1 < count ? static_cast<std::uint32_t>(k + 1) : nil;
        free_ = count != 0 ? 0 : nil;
        size_ = 0;
    }

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return heads_.memory_bytes() + nodes_.memory_bytes(); }
    [[nodiscard]] Allocator get_allocator() const noexcept { return nodes_.get_allocator(); }

    /// M, the nodes in the pool; 0 until the first id.
    [[nodiscard]] std::size_t capacity() const noexcept { return nodes_.size(); }
    /// B, the smallest prime > M; 0 until the first id.
    [[nodiscard]] std::size_t bucket_count() const noexcept { return heads_.size(); }
    /// Nodes in the fullest bucket: about 5 for ids that suit the hash, up to size() for ids that do not.
    /// Complexity: O(B + N).
    [[nodiscard]] std::size_t longest_chain() const noexcept {
        std::size_t longest = 0;
        for (auto at : heads_) {
            std::size_t length = 0;
            for (; at != nil; at = nodes_[at].next) ++length;
            longest = (std::max)(longest, length);
        }
        return longest;
    }

private:
    struct node {
        Id id;
        index_t index;
        std::uint32_t next;  // in the chain or in the free list
    };
    static_assert(sizeof(node) == sizeof(Id) + 8, "chained_bytes_per_id counts 16 bytes for 64-bit ids");
    static constexpr std::uint32_t nil = ~std::uint32_t{0};

    [[nodiscard]] std::size_t bucket_of(Id t) const noexcept {
        const std::uint64_t value = static_cast<detail::unsigned_id<Id>>(t);
        return static_cast<std::size_t>(Hash::bucket(value, heads_.size()));
    }
    [[nodiscard]] index_t find_in(std::uint32_t at, Id t) const noexcept {
        for (; at != nil; at = nodes_[at].next)
            if (nodes_[at].id == t) return nodes_[at].index;
        return absent;
    }
    // The old index, absent if the id is new. Precondition: id is present, or a node is free.
    index_t insert(Id t, index_t index) noexcept {
        auto* end = &heads_[bucket_of(t)];
        for (; *end != nil; end = &nodes_[*end].next)
            if (nodes_[*end].id == t) return std::exchange(nodes_[*end].index, index);
        const auto at = free_;
        free_ = nodes_[at].next;
        nodes_[at] = {t, index, nil};
        *end = at;
        ++size_;
        return absent;
    }

    // An empty table for `count` ids, with our limit and allocator.
    [[nodiscard]] chained_storage sized_for(const char* member, std::size_t count) const {
        const auto nodes = chained_capacity(count);
        const auto buckets = next_prime(nodes);
        const auto bytes = nodes * sizeof(node) + buckets * sizeof(std::uint32_t);
        if (!limit_.admits(bytes, count))
            detail::raise<limit_error>((std::string("chained_storage::") + member).c_str(),
                                       std::to_string(count) + " ids need a table of " + std::to_string(bytes) +
                                           " bytes, the limit is " + std::to_string(limit_.bytes(count)),
                                       "use flat_storage, which needs 8 to 20 bytes per id, or raise the limit");
        chained_storage fresh(limit_, get_allocator());
        fresh.heads_ = buffer<std::uint32_t, Allocator>(static_cast<std::size_t>(buckets), get_allocator());
        fresh.nodes_ = buffer<node, Allocator>(static_cast<std::size_t>(nodes), get_allocator());
        return fresh;
    }
    [[gnu::noinline]] void resize(const char* member, std::size_t count) {
        auto fresh = sized_for(member, count);
        fresh.clear();
        // All ids are different, so each goes to the head of its chain unsearched: O(N) whatever the ids.
        for (auto at : heads_)
            for (; at != nil; at = nodes_[at].next) {
                const auto taken = std::exchange(fresh.free_, fresh.nodes_[fresh.free_].next);
                auto& head = fresh.heads_[fresh.bucket_of(nodes_[at].id)];
                fresh.nodes_[taken] = {nodes_[at].id, nodes_[at].index, std::exchange(head, taken)};
            }
        fresh.size_ = size_;
        swap(fresh);
    }

    void swap(chained_storage& other) noexcept {
        std::swap(limit_, other.limit_);
        heads_.swap(other.heads_);
        nodes_.swap(other.nodes_);
        std::swap(free_, other.free_);
        std::swap(size_, other.size_);
    }

    memory_limit limit_{};
    buffer<std::uint32_t, Allocator> heads_{};
    buffer<node, Allocator> nodes_{};
    std::uint32_t free_ = nil;
    std::size_t size_ = 0;
};

static_assert(id_storage<chained_storage<mixed>> && batched_lookup<chained_storage<mixed>> &&
              prefetchable<chained_storage<mixed>>);
static_assert(id_storage<chained_storage<mod_prime>> && batched_lookup<chained_storage<mod_prime>> &&
              prefetchable<chained_storage<mod_prime>>);

}  // namespace tsubu
