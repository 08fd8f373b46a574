// SPDX-License-Identifier: MIT
/// @file
/// dense_storage: one array entry per id of the range.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/executor.hpp>
#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/detail/fill_absent.hpp>
#include <tsubu/id/detail/gather.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>

#include <algorithm>  // std::min, std::max
#include <atomic>     // std::atomic
#include <cstddef>    // std::byte, std::size_t
#include <cstdint>    // std::int64_t, std::uint64_t
#include <cstring>    // std::memset
#include <limits>     // std::numeric_limits
#include <memory>     // std::allocator
#include <span>       // std::span
#include <string>     // std::string
#include <utility>    // std::exchange, std::move, std::swap

namespace tsubu {

// The table covers the ids lowest_ .. lowest_ + table_.size() - 1. Beside it stands one byte per block of 1024
// entries: whether any of them may be other than absent. A rebuild clears only those blocks. Where ids fill their
// range, that is all of them, as a plain fill; where they come in blocks far apart, it is what undoing each old id
// would cost, without keeping the old ids.
//
//     ids 5000..5999, 9000..9499       lowest_ = 5000
//     table_    [ 1000 indices | absent ................. | 500 indices ]      4500 entries
//     touched_  [ 1            | 0    | 0                 | 1    | 1    ]      one per 1024 entries

/// One array entry per id of the range, absent where there is none.
///
///     tsubu::id_map<tsubu::dense_storage<>> where;
///     where.rebuild(ids);
///
/// The array starts at the lowest id, so a rank that owns a slice of the ids pays for the slice only; with lowest
/// id 0 it is the array of T_max + 1 entries that the equations speak of, T_max over owned and ghost ids.
///
/// Concept:       id_storage, batched_lookup (AVX2, AVX-512), prefetchable, parallel_rebuild.
/// Cost:          find one compare and one load; rebuild O(N + T), O(N + blocks touched) when the old memory is
///                reused; assign O(1), outside the range amortised O(T); erase O(1).
/// Bytes per id:  4 T / N, T = highest - lowest.
/// Growth:        by assign at least doubling, within the memory limit; a rebuild that needs less than a quarter
///                gives memory back.
/// Deterministic: yes, with any executor.
/// Choose it when the ids fill their range: T / N up to 5, or 24 while the table is below 8 MiB (choose_table in
///                adaptive_storage.hpp).
/// Do not when    ids are random in a wide range: beyond those ratios flat_storage is faster and smaller.
/// Source:        A2, A3, A5.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class dense_storage {
    using unsigned_type = detail::unsigned_id<Id>;

public:
    using id_type = Id;
    using allocator_type = Allocator;

    dense_storage() = default;
    explicit dense_storage(memory_limit limit, const Allocator& allocator = {})
        : limit_(limit), table_(allocator), touched_(allocator) {}
    explicit dense_storage(const Allocator& allocator) : dense_storage(memory_limit{}, allocator) {}

    dense_storage(const dense_storage&) = default;
    dense_storage(dense_storage&& other) noexcept
        : limit_(other.limit_),
          table_(std::move(other.table_)),
          touched_(std::move(other.touched_)),
          lowest_(other.lowest_),
          size_(std::exchange(other.size_, 0)),
          reserved_(std::exchange(other.reserved_, 0)) {}
    dense_storage& operator=(dense_storage other) noexcept {
        swap(other);
        return *this;
    }
    ~dense_storage() = default;

    [[nodiscard]] index_t find(Id t) const noexcept {
        const std::uint64_t offset = offset_of(t);
        return offset < table_.size() ? table_[static_cast<std::size_t>(offset)] : absent;
    }
    void find(std::span<const Id> ids, std::span<index_t> out) const noexcept {
        detail::gather(best_instruction_set(), detail::flat_window<Id>{table_.data(), table_.size(), lowest_},
                       ids.data(), out.data(), ids.size());
    }
    void prefetch(Id t) const noexcept {
        if (const std::uint64_t offset = offset_of(t); offset < table_.size())
            detail::prefetch(table_.data() + offset);
    }

    /// @throws limit_error if the range needs more than the memory limit. Strong guarantee.
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links) {
        prepare(ids.size(), range);
        clear_blocks(0, touched_.size());
        size_ = ids.empty() ? 0 : insert_reversed(ids, links);
    }

    /// The same with several threads: each fills its own part of the table, so no two write the same entry.
    template <executor Executor>
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links, const Executor& on) {
        if (on.concurrency() < 2 || ids.size() < least_parallel_count) return rebuild(ids, range, links);
        prepare(ids.size(), range);
        try {
            rebuild_in_parts(ids, links, on);
        } catch (...) {
            // The old content is gone: an executor that cannot run may cost time, not the answer.
            clear_blocks(0, touched_.size());
            size_ = insert_reversed(ids, links);
        }
    }

    /// O(1) inside the range, also if the id is new; outside, the table grows.
    /// @throws limit_error if it would pass the memory limit. Strong guarantee.
    void assign(Id t, index_t index) {
        if (offset_of(t) >= table_.size()) grow(t);
        const auto offset = static_cast<std::size_t>(offset_of(t));
        touched_[offset / block_size] = 1;
        if (std::exchange(table_[offset], index) == absent) ++size_;
    }
    bool erase(Id t) noexcept {
        const std::uint64_t offset = offset_of(t);
        if (offset >= table_.size() || std::exchange(table_[static_cast<std::size_t>(offset)], absent) == absent)
            return false;
        --size_;
        return true;
    }

    /// Room for `count` ids without gaps; how much a rebuild needs depends on their range, which is not known yet.
    /// @throws limit_error if that passes the memory limit. Strong guarantee.
    void reserve(std::size_t count) {
        if (count > table_.size()) {
            check("reserve", count - 1, count, count - 1);
            regrow(lowest_fit(lowest_, count), count);
        }
        reserved_ = (std::max)(reserved_, count);
    }
    void clear() noexcept {
        clear_blocks(0, touched_.size());
        size_ = 0;
    }

    /// Calls each(id, index) for every id that is present, in increasing id.
    template <class Each>
    void for_each(Each&& each) const {
        for_touched_runs(0, touched_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                if (table_[k] != absent) each(static_cast<Id>(static_cast<unsigned_type>(lowest_ + k)), table_[k]);
        });
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return table_.memory_bytes() + touched_.memory_bytes(); }
    /// Bounds the tables from here on; what they hold already stays.
    void limit_memory(memory_limit limit) noexcept { limit_ = limit; }
    [[nodiscard]] Allocator get_allocator() const noexcept { return table_.get_allocator(); }

private:
    using table = buffer<index_t, Allocator>;
    using flags = buffer<unsigned char, Allocator>;

    static constexpr std::size_t block_size = 1024;  // entries: a page of memory per byte of touched_
    static constexpr std::size_t least_parallel_count = std::size_t{1} << 16;  // starting threads costs some 1e4 ids
    static constexpr std::uint64_t largest_id = static_cast<std::uint64_t>((std::numeric_limits<Id>::max)());

    // Ids below lowest_ and negative ones wrap to offsets past the end, because the table never reaches past the
    // largest id.
    [[nodiscard]] std::uint64_t offset_of(Id t) const noexcept {
        return static_cast<unsigned_type>(static_cast<unsigned_type>(t) - lowest_);
    }
    [[nodiscard]] static std::size_t blocks_of(std::size_t entries) noexcept {
        return entries / block_size + (entries % block_size != 0 ? 1 : 0);
    }
    // For extent + 1 entries; an extent near 2^64 saturates instead of wrapping.
    [[nodiscard]] static std::uint64_t bytes_of(std::uint64_t extent) noexcept {
        constexpr std::uint64_t most = ~std::uint64_t{0};
        if (extent > most / (2 * sizeof(index_t))) return most;
        return (extent + 1) * sizeof(index_t) + extent / block_size + 1;
    }
    // The start of a table of `entries` that covers `lowest` and does not reach past the largest id.
    [[nodiscard]] static unsigned_type lowest_fit(unsigned_type lowest, std::size_t entries) noexcept {
        return static_cast<unsigned_type>((std::min)(std::uint64_t{lowest}, largest_id - (entries - 1)));
    }
    void check(const char* member, std::uint64_t extent, std::size_t count, std::uint64_t t) const {
        if (limit_.admits(bytes_of(extent), count)) return;
        const auto where = std::string("dense_storage::") + member;
        limit_.check(where.c_str(), bytes_of(extent), count, t,
                     "use flat_storage, whose size does not depend on the range, or raise the limit");
    }

    // Makes the table fit the range; afterwards nothing throws. The old content stays in the buffer until it is
    // cleared, since its blocks are marked.
    void prepare(std::size_t count, id_range<Id> range) {
        if (range.empty()) return;
        const auto extent = range.extent();
        check("rebuild", extent, count, static_cast<std::uint64_t>(range.highest));
        const auto needed = static_cast<std::size_t>(extent) + 1;
        if (needed > table_.size()) {
            replace(needed);
        } else {
            const auto kept = (std::max)({needed, reserved_, block_size});
            if (table_.size() / 4 > kept || !limit_.admits(bytes_of(table_.size() - 1), (std::max)(count, reserved_))) {
                try {
                    replace((std::max)(needed, reserved_));
                } catch (...) {
                    // Giving memory back is no reason to fail: the table that we have is large enough.
                }
            }
        }
        lowest_ = lowest_fit(static_cast<unsigned_type>(range.lowest), table_.size());
    }
    void replace(std::size_t entries) {
        table fresh(entries, table_.get_allocator());
        flags fresh_touched(blocks_of(entries), touched_.get_allocator());
        detail::fill_absent(fresh.data(), entries);
        std::memset(fresh_touched.data(), 0, fresh_touched.size());
        table_ = std::move(fresh);
        touched_ = std::move(fresh_touched);
    }
    // As replace, but the answers stay.
    void regrow(unsigned_type lowest, std::size_t entries) {
        table fresh(entries, table_.get_allocator());
        flags fresh_touched(blocks_of(entries), touched_.get_allocator());
        detail::fill_absent(fresh.data(), entries);
        std::memset(fresh_touched.data(), 0, fresh_touched.size());
        const std::uint64_t shift = static_cast<unsigned_type>(lowest_ - lowest);
        for_touched_runs(0, touched_.size(), [&](std::size_t begin, std::size_t end) {
            const auto to = static_cast<std::size_t>(shift) + begin;
            std::memcpy(fresh.data() + to, table_.data() + begin, (end - begin) * sizeof(index_t));
            std::memset(fresh_touched.data() + to / block_size, 1,
                        (to + (end - begin) - 1) / block_size - to / block_size + 1);
        });
        table_ = std::move(fresh);
        touched_ = std::move(fresh_touched);
        lowest_ = lowest;
    }
    [[gnu::noinline]] void grow(Id t) {
        const auto wanted = static_cast<unsigned_type>(t);
        if (size_ == 0 && !table_.empty()) {  // nothing to keep: the window moves to the id
            lowest_ = lowest_fit(wanted, table_.size());
            return;
        }
        auto low = std::uint64_t{wanted};
        auto high = std::uint64_t{wanted};
        if (size_ != 0) {
            low = (std::min)(low, std::uint64_t{lowest_});
            high = (std::max)(high, std::uint64_t{lowest_} + (table_.size() - 1));
        }
        check("assign", high - low, size_ + 1, wanted);
        // Twice the old size, in whole blocks, the slack on the side where the ids grow, as far as ids and limit go.
        const std::uint64_t doubled = (std::min)(std::uint64_t{table_.size()} * 2, largest_id) | (block_size - 1);
        if (doubled > high - low && limit_.admits(bytes_of(doubled), size_ + 1)) {
            const auto slack = doubled - (high - low);
            if (wanted >= lowest_)
                high += (std::min)(slack, largest_id - high);
            else
                low -= (std::min)(slack, low);
        }
        regrow(static_cast<unsigned_type>(low), static_cast<std::size_t>(high - low) + 1);
    }

    // Calls visit(begin, end) in entries for each run of touched blocks within [first, last).
    template <class Visit>
    void for_touched_runs(std::size_t first, std::size_t last, const Visit& visit) const {
        for (std::size_t block = first; block < last; ++block) {
            if (touched_[block] == 0) continue;
            const auto begin = block;
            while (block < last && touched_[block] != 0) ++block;
            visit(begin * block_size, (std::min)(block * block_size, table_.size()));
        }
    }
    void clear_blocks(std::size_t first, std::size_t last) noexcept {
        for_touched_runs(first, last, [this](std::size_t begin, std::size_t end) {
            detail::fill_absent(table_.data() + begin, end - begin);
        });
        if (last > first) std::memset(touched_.data() + first, 0, last - first);
    }

    // From 16 entries per id on, blocks may be left out; below, random ids reach all of them, and one fill
    // marks them without a store per id.
    [[nodiscard]] bool marks_singly(std::size_t count) const noexcept { return table_.size() / 16 > count; }

    std::size_t insert_reversed(std::span<const Id> ids, std::span<index_t> links) noexcept {
        if (marks_singly(ids.size()))
            return links.empty() ? insert_loop<true, false>(ids, links) : insert_loop<true, true>(ids, links);
        std::memset(touched_.data(), 1, touched_.size());
        return links.empty() ? insert_loop<false, false>(ids, links) : insert_loop<false, true>(ids, links);
    }
    // Everything that the loop reads is a local: what is stored might alias a member.
    template <bool Marks, bool Links>
    std::size_t insert_loop(std::span<const Id> ids, std::span<index_t> links) noexcept {
        const Id* const t = ids.data();
        index_t* const link = links.data();
        index_t* const entry = table_.data();
        unsigned char* const touched = touched_.data();
        const unsigned_type lowest = lowest_;
        std::uint32_t different = 0;
        const auto insert = [=, &different](std::size_t i) {
            const std::size_t offset = static_cast<unsigned_type>(static_cast<unsigned_type>(t[i]) - lowest);
            const index_t next = entry[offset];
            entry[offset] = static_cast<index_t>(i);
            if constexpr (Marks) touched[offset / block_size] = 1;
            if constexpr (Links) link[i] = next;
            different += static_cast<std::uint32_t>(next) >> 31;  // 1 for absent, the only negative entry
        };
        std::size_t i = ids.size();
        while (i % 4 != 0) insert(--i);  // four at a time, since compilers do not unroll at -O2
        for (; i != 0; i -= 4) {
            insert(i - 1);
            insert(i - 2);
            insert(i - 3);
            insert(i - 4);
        }
        return different;
    }

    // Each part owns a run of blocks and scans all ids for those that fall into it. Links are written twice, first
    // all absent and by runs, then only where there is a further copy: two parts seldom meet in one cache line.
    template <class Executor>
    void rebuild_in_parts(std::span<const Id> ids, std::span<index_t> links, const Executor& on) {
        const auto parts = on.concurrency();
        const auto share = [parts](std::size_t total, std::size_t part) {
            return total / parts * part + (std::min)(part, total % parts);
        };
        std::atomic<std::size_t> total{0};
        on.run([&](std::size_t part) {
            clear_blocks(share(touched_.size(), part), share(touched_.size(), part + 1));
            const auto begin = share(links.size(), part);
            if (!links.empty()) detail::fill_absent(links.data() + begin, share(links.size(), part + 1) - begin);
        });
        on.run([&](std::size_t part) {
            const auto first = share(touched_.size(), part);
            const auto last = share(touched_.size(), part + 1);
            total.fetch_add(insert_part(ids, links, first, last), std::memory_order_relaxed);
        });
        size_ = total.load(std::memory_order_relaxed);
    }
    std::size_t insert_part(std::span<const Id> ids, std::span<index_t> links, std::size_t first,
                            std::size_t last) noexcept {
        constexpr std::size_t run = 256;  // ids: the queue stays in the first-level cache
        index_t queue[run];
        const std::uint64_t from = std::uint64_t{first} * block_size;
        const std::uint64_t width = std::uint64_t{last - first} * block_size;
        const bool marks = marks_singly(ids.size());
        if (!marks && last > first) std::memset(touched_.data() + first, 1, last - first);
        std::size_t different = 0;
        for (std::size_t end = ids.size(); end > 0;) {
            const auto begin = end > run ? end - run : 0;
            std::size_t queued = 0;
            for (std::size_t i = end; i-- > begin;) {  // no branch: whose id it is cannot be predicted
                queue[queued] = static_cast<index_t>(i);
                queued += offset_of(ids[i]) - from < width ? 1U : 0U;
            }
            for (std::size_t k = 0; k < queued; ++k) {
                const auto i = static_cast<std::size_t>(queue[k]);
                const auto offset = static_cast<std::size_t>(offset_of(ids[i]));
                const index_t next = std::exchange(table_[offset], queue[k]);
                if (marks) touched_[offset / block_size] = 1;
                if (next == absent)
                    ++different;
                else if (!links.empty())
                    links[i] = next;
            }
            end = begin;
        }
        return different;
    }

    void swap(dense_storage& other) noexcept {
        std::swap(limit_, other.limit_);
        table_.swap(other.table_);
        touched_.swap(other.touched_);
        std::swap(lowest_, other.lowest_);
        std::swap(size_, other.size_);
        std::swap(reserved_, other.reserved_);
    }

    memory_limit limit_{};
    table table_{};
    flags touched_{};
    unsigned_type lowest_ = 0;
    std::size_t size_ = 0;
    std::size_t reserved_ = 0;
};

static_assert(id_storage<dense_storage<>> && batched_lookup<dense_storage<>> && prefetchable<dense_storage<>> &&
              parallel_rebuild<dense_storage<>>);

}  // namespace tsubu
