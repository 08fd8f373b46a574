// SPDX-License-Identifier: MIT
/// @file
/// flat_storage: the general id table, 8 to 20 bytes per id, whatever the ids.
/// How a line holds 16 ids in 64 bytes: detail/quotient_lines.hpp.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/executor.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/detail/quotient_build.hpp>
#include <tsubu/id/detail/quotient_find.hpp>
#include <tsubu/id/detail/quotient_plan.hpp>
#include <tsubu/id/flat_lines.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>

#include <algorithm>  // std::find, std::max, std::min
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <memory>     // std::allocator
#include <span>       // std::span
#include <utility>    // std::forward, std::swap
#include <vector>     // std::vector

namespace tsubu {

/// The general table: open addressing in cache lines, ids told apart by what their place does not already say.
///
///     tsubu::id_map<tsubu::flat_storage<>> where;
///
/// Concept:       id_storage, batched_lookup (AVX2, AVX-512), prefetchable, parallel_rebuild.
/// Cost:          find one cache line (two in keyed lines), and no branch that depends on where in it the id is, or
///                whether, unless that line is full; rebuild O(N) for every pattern of ids, each of several threads
///                hashing all and inserting its share; assign O(1) amortised; erase O(1).
/// Bytes per id:  8 | 16 | 20 (narrow | wide | keyed lines).
/// Growth:        by assign, to twice the ids; a rebuild that needs less than a quarter gives memory back. The slot
///                of an erased id is taken by the same id again, or freed at the next rebuild or growth.
/// Deterministic: answers and links are, on any number of threads and with any instruction set.
/// Choose it when ids are sparse, strided, clustered, or unknown.
/// Do not when    ids fill their range: dense_storage is two to five times faster there.
/// Source:        design note in detail/quotient_lines.hpp.
///
/// The strong guarantee has one far corner: the old table is given up before the ids are known to fit into the new one.
/// Should the hash multiplier map them badly, the rebuild is done again with another; if memory is refused then, or if
/// none of 64 fits, the map is left empty.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class flat_storage {
public:
    using id_type = Id;
    using allocator_type = Allocator;

    flat_storage() = default;
    explicit flat_storage(const Allocator& allocator) : memory_(allocator), stash_(allocator) {}
    explicit flat_storage(memory_limit limit, const Allocator& allocator = {})
        : memory_(allocator), stash_(allocator), limit_(limit) {}

    flat_storage(const flat_storage& other)
        : memory_(other.memory_),
          stash_(other.stash_),
          table_(other.table_),
          lines_(other.lines_),
          find_(other.find_),
          size_(other.size_),
          used_(other.used_),
          room_(other.room_),
          reserved_(other.reserved_),
          multiplier_(other.multiplier_),
          limit_(other.limit_) {
        stash_.reserve(other.stash_.capacity());
        if (!memory_.empty()) detail::attach(table_, memory_.data());
    }
    flat_storage(flat_storage&& other) noexcept : flat_storage(other.memory_.get_allocator()) { swap(other); }
    flat_storage& operator=(flat_storage other) noexcept {
        swap(other);
        return *this;
    }
    ~flat_storage() = default;

    [[nodiscard, gnu::always_inline]] index_t find(Id t) const noexcept {
        return find_(table_, stash_, static_cast<std::uint64_t>(t));
    }
    void find(std::span<const Id> ids, std::span<index_t> indices) const noexcept {
        const auto blocks = ids.size() / detail::block_size;
        if (blocks != 0)
            with_lines([&]<class Layout>(Layout) {
                detail::with_kernels([&]<class Kernels>(Kernels) {
                    detail::find_blocks<Kernels, Layout>(table_, stash_.entries(), ids.data(), blocks, indices.data(),
                                                         exceeds_cache());
                });
            });
        for (std::size_t k = blocks * detail::block_size; k < ids.size(); ++k) indices[k] = find(ids[k]);
    }
    void prefetch(Id t) const noexcept {
        with_lines([&]<class Layout>(Layout) {
            const auto x = static_cast<std::uint64_t>(t) - table_.base;
            if (table_.may_hold<Layout>(x))
                detail::prefetch_place<Layout, false>(table_,
                                                      static_cast<std::uint32_t>(table_.locate<Layout>(x).place));
        });
    }

    /// @throws limit_error if the table needs more than the memory limit.
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links) {
        rebuild(ids, range, links, this_thread{});
    }
    template <executor Executor>
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links, const Executor& on) {
        if (ids.empty()) return clear();
        const auto base_of_keys = [&] {
            return detail::value_beside(static_cast<std::uint64_t>(range.lowest),
                                        static_cast<std::uint64_t>(range.highest), [&](std::uint64_t value) {
                                            return std::find(ids.begin(), ids.end(), static_cast<Id>(value)) !=
                                                   ids.end();
                                        });
        };
        auto plan = detail::plan_lines({.count = ids.size(),
                                        .lowest = static_cast<std::uint64_t>(range.lowest),
                                        .extent = range.extent(),
                                        .greatest_index = ids.size() - 1,
                                        .multiplier = multiplier_},
                                       base_of_keys);
        for (std::uint32_t attempt = 0;; ++attempt) {
            if (attempt > 0) detail::next_attempt(plan, ++multiplier_, attempt);
            if (try_rebuild(plan, attempt < detail::attempts_per_size, ids, links, on)) return;
        }
    }

    /// @throws limit_error if the table must grow past the memory limit. Strong guarantee.
    void assign(Id t, index_t index) {
        const auto key = static_cast<std::uint64_t>(t);
        if (may_hold(key) && detail::index_fits(table_, index) && (used_ < room_ || find(t) != absent) &&
            insert(key, index))
            return;
        grow_with(key, index);
    }
    bool erase(Id t) noexcept {
        return with_lines([&]<class Layout>(Layout) {
            const auto x = static_cast<std::uint64_t>(t) - table_.base;
            if (!table_.may_hold<Layout>(x)) return false;
            const auto at = table_.locate<Layout>(x);
            const auto end = detail::walk<Layout>(table_, at.place, at.tag, table_.lines + detail::spill_lines);
            if (end.what == detail::search_end::outcome::match) {
                const bool was_here = detail::index_at<Layout>(table_, end.place) != 0;
                detail::write_slot<Layout>(table_, end.place,
                                           static_cast<typename Layout::slot_type>(at.tag +
                                                                                   end.probe * table_.tag_step),
                                           0);
                size_ -= was_here ? 1 : 0;
                return was_here;
            }
            if (end.what == detail::search_end::outcome::boundary)
                for (auto& entry : stash_.entries())
                    if (entry.place == at.place && entry.tag == at.tag && entry.index_plus_1 != 0) {
                        entry.index_plus_1 = 0;
                        --size_;
                        return true;
                    }
            return false;
        });
    }

    /// Takes memory for `count` ids in lines of the present kind, or narrow ones if the map is empty.
    void reserve(std::size_t count) {
        if (count > room_) {
            const auto range = size_ == 0 ? id_range<std::uint64_t>{0, count} : range_of_entries();
            grow(count, range.lowest, range.extent(), {range.lowest, 0});
        }
        reserved_ = (std::max)(reserved_, count);
    }
    void clear() noexcept {
        if (!memory_.empty()) detail::wipe(table_, lines_);
        stash_.clear();
        size_ = used_ = 0;
    }
    /// Calls each(id, index) for every id that is present, in no particular order.
    template <class Each>
    void for_each(Each&& each) const {
        with_lines([&]<class Layout>(Layout) {
            detail::for_each_entry<Layout>(table_, stash_.entries(),
                                           [&](std::uint64_t key, std::uint32_t index_plus_1) {
                                               each(static_cast<Id>(key), static_cast<index_t>(index_plus_1) - 1);
                                           });
        });
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Bounds the tables from here on; what they hold already stays.
    void limit_memory(memory_limit limit) noexcept { limit_ = limit; }
    [[nodiscard]] Allocator get_allocator() const noexcept { return memory_.get_allocator(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return memory_.memory_bytes() + stash_.memory_bytes(); }

    /// How the ids of the last rebuild are stored.
    [[nodiscard]] flat_lines lines() const noexcept { return lines_; }
    /// How many hash multipliers have been given up because they mapped some ids badly.
    [[nodiscard]] std::uint32_t discarded_multipliers() const noexcept { return multiplier_; }

private:
    using table_memory = buffer<detail::cache_line, Allocator>;
    using spills = detail::spill_list<Allocator>;
    using find_function = index_t (*)(const detail::line_table&, const spills&, std::uint64_t) noexcept;

    template <class Call>
    [[gnu::always_inline]] static decltype(auto) with_lines(flat_lines lines, Call&& call) {
        if (lines == flat_lines::narrow) return call(detail::narrow_lines{});
        if constexpr (sizeof(Id) == 8) {
            if (lines == flat_lines::keyed) return call(detail::keyed_lines{});
        }
        return call(detail::wide_lines{});
    }
    template <class Call>
    [[gnu::always_inline]] decltype(auto) with_lines(Call&& call) const {
        return with_lines(lines_, std::forward<Call>(call));
    }
    /// The look-up of one id in lines of this kind. A call through a pointer costs less than the vectors that code
    /// compiled for any machine must do without.
    [[nodiscard]] static find_function find_for(flat_lines lines) noexcept {
        find_function chosen = nullptr;
        with_lines(lines, [&]<class Layout>(Layout) {
            detail::with_kernels([&]<class Kernels>(Kernels) { chosen = &Kernels::template find<Layout, spills>; });
        });
        return chosen;
    }
    [[nodiscard]] bool may_hold(std::uint64_t key) const noexcept {
        return with_lines([&]<class Layout>(Layout) { return table_.may_hold<Layout>(key - table_.base); });
    }
    [[nodiscard]] bool exceeds_cache() const noexcept { return memory_.memory_bytes() > detail::prefetch_threshold; }
    void swap(flat_storage& other) noexcept {
        memory_.swap(other.memory_);
        std::swap(stash_, other.stash_);
        std::swap(table_, other.table_);
        std::swap(lines_, other.lines_);
        std::swap(find_, other.find_);
        std::swap(size_, other.size_);
        std::swap(used_, other.used_);
        std::swap(room_, other.room_);
        std::swap(reserved_, other.reserved_);
        std::swap(multiplier_, other.multiplier_);
        std::swap(limit_, other.limit_);
    }

    /// @return false if the ids do not fit under this multiplier, or (strict) if more than one in 16 meets a full home
    ///         line, as one in 40 does at random; the map holds nothing then.
    template <executor Executor>
    bool try_rebuild(const detail::line_plan& plan, bool strict, std::span<const Id> ids, std::span<index_t> links,
                     const Executor& on) {
        if (links.empty()) links = {};  // from here on no links means no address either
        const auto most_spilled = strict ? ids.size() / 16 + 64 : ids.size();  // 64: a handful of ids scatters more
        const auto needed = detail::memory_lines(plan.table, plan.lines);
        // Memory is kept while it is not far too large: 4 times is what a hole in the particle count may leave.
        const bool keep = needed <= memory_.size() && (memory_.size() / 4 <= needed || ids.size() <= reserved_);
        if (!keep)
            limit_.check("flat_storage::rebuild", needed * sizeof(detail::cache_line), ids.size(),
                         plan.demand.lowest + plan.demand.extent,
                         "raise the memory_limit, or spread the ids over more ranks");
        table_memory fresh =
            keep ? table_memory(memory_.get_allocator()) : table_memory(needed, memory_.get_allocator());
        spills fresh_stash(memory_.get_allocator());
        const bool keep_stash = stash_.capacity() >= plan.stash_capacity;
        if (!keep_stash) fresh_stash.reserve(plan.stash_capacity);
        const auto adopt = [&]() noexcept {  // from here on nothing throws
            if (!keep) memory_.swap(fresh);
            if (!keep_stash) std::swap(stash_, fresh_stash);
            lines_ = plan.lines;
            find_ = find_for(lines_);
            table_ = plan.table;
            detail::attach(table_, memory_.data());
            room_ = plan.room;
            stash_.clear();
            size_ = used_ = 0;
        };
        std::uint64_t repeated = detail::no_fit;
        with_lines(plan.lines, [&]<class Layout>(Layout) {
            if constexpr (detail::may_have_threads<Executor>) {
                if (on.concurrency() > 1 && ids.size() >= detail::threading_threshold) {
                    detail::team_filler<Layout, Allocator> team(on.concurrency(), plan.stash_capacity,
                                                               memory_.get_allocator());
                    adopt();
                    repeated = team.fill(table_, stash_, ids, links, exceeds_cache(), most_spilled, on);
                    return;
                }
            }
            adopt();
            detail::wipe(table_, lines_);
            repeated = detail::fill_lines<Layout>(table_, stash_, ids, links, exceeds_cache(), most_spilled);
        });
        if (repeated == detail::no_fit) {
            clear();
            return false;
        }
        size_ = used_ = ids.size() - static_cast<std::size_t>(repeated);
        return true;
    }
    /// @return false if the stash is full; nothing has changed then.
    bool insert(std::uint64_t key, index_t index) noexcept {
        return with_lines([&]<class Layout>(Layout) {
            const auto at = table_.locate<Layout>(key - table_.base);
            const auto index_plus_1 = static_cast<std::uint32_t>(index) + 1;
            const auto former = find_(table_, stash_, key);
            detail::line_filler<Layout> filler(table_, table_.lines + detail::spill_lines, nullptr);
            if (!filler.insert(at.place, at.tag, index_plus_1) &&
                !detail::insert_into_stash(filler, stash_,
                                           {at.tag, static_cast<std::uint32_t>(at.place), index_plus_1}))
                return false;
            if (former == absent) ++size_;
            if (filler.repeated == 0) ++used_;
            return true;
        });
    }
    /// Grows and inserts. Strong guarantee.
    void grow_with(std::uint64_t key, index_t index) {
        const auto present = size_ == 0 ? id_range<std::uint64_t>{} : range_of_entries();
        const auto range = present.with(key);
        // Room below as well: ids may come in descending order.
        const auto lowest = size_ == 0 || key != range.lowest ? range.lowest
                            : range.extent() < range.lowest   ? range.lowest - range.extent()
                                                              : 0;
        grow((std::max)(size_ + 1, size_ * 2), lowest, range.highest - lowest,
             {key, static_cast<std::uint32_t>(index) + 1});
    }
    void grow(std::size_t count, std::uint64_t lowest, std::uint64_t extent, detail::id_entry added) {
        const auto entries = all_entries();
        std::uint64_t greatest = added.index_plus_1;
        for (const auto& entry : entries) greatest = (std::max)(greatest, std::uint64_t{entry.index_plus_1});
        // Twice the greatest index: indices that count upwards do not lay the table out anew each time.
        greatest = (std::min)(2 * greatest + 64, std::uint64_t{max_index_count} - 1);
        auto plan =
            detail::plan_lines({.count = (std::max)({count, reserved_, std::size_t{16}}),
                                .lowest = lowest,
                                .extent = extent,
                                .greatest_index = greatest,
                                .multiplier = multiplier_},
                               [&] {
                                   return detail::value_beside(lowest, lowest + extent, [&](std::uint64_t value) {
                                       return find(static_cast<Id>(value)) != absent || value == added.key;
                                   });
                               });
        for (std::uint32_t attempt = 0;; ++attempt) {
            if (attempt > 0) detail::next_attempt(plan, ++multiplier_, attempt);
            const auto needed = detail::memory_lines(plan.table, plan.lines);
            limit_.check("flat_storage::assign", needed * sizeof(detail::cache_line), count,
                         plan.demand.lowest + plan.demand.extent,
                         "raise the memory_limit, or spread the ids over more ranks");
            flat_storage larger(limit_, memory_.get_allocator());
            larger.memory_ = table_memory(needed, memory_.get_allocator());
            larger.stash_.reserve(plan.stash_capacity);
            larger.lines_ = plan.lines;
            larger.find_ = find_for(plan.lines);
            larger.table_ = plan.table;
            detail::attach(larger.table_, larger.memory_.data());
            detail::wipe(larger.table_, larger.lines_);
            larger.room_ = plan.room;
            larger.multiplier_ = multiplier_;
            larger.reserved_ = reserved_;
            bool fits = true;
            for (const auto& entry : entries)
                fits = fits && larger.insert(entry.key, static_cast<index_t>(entry.index_plus_1) - 1);
            // The new id must fit as well: if its line is what is full, only another multiplier helps.
            fits = fits &&
                   (added.index_plus_1 == 0 || larger.insert(added.key, static_cast<index_t>(added.index_plus_1) - 1));
            if (!fits) continue;
            swap(larger);
            return;
        }
    }
    [[nodiscard]] std::vector<detail::id_entry> all_entries() const {
        std::vector<detail::id_entry> entries;
        entries.reserve(size_);
        with_lines([&]<class Layout>(Layout) {
            detail::for_each_entry<Layout>(table_, stash_.entries(),
                                           [&](std::uint64_t key, std::uint32_t index_plus_1) {
                                               entries.push_back({key, index_plus_1});
                                           });
        });
        return entries;
    }
    [[nodiscard]] id_range<std::uint64_t> range_of_entries() const noexcept {
        id_range<std::uint64_t> range;
        with_lines([&]<class Layout>(Layout) {
            detail::for_each_entry<Layout>(table_, stash_.entries(),
                                           [&](std::uint64_t key, std::uint32_t) { range = range.with(key); });
        });
        return range;
    }

    table_memory memory_;
    spills stash_;
    detail::line_table table_ = detail::no_lines();
    flat_lines lines_ = flat_lines::narrow;
    find_function find_ = &detail::portable_kernels::find<detail::narrow_lines, spills>;
    std::size_t size_ = 0;          // ids present
    std::size_t used_ = 0;          // slots that are not empty: present ids and erased ones
    std::size_t room_ = 0;          // used_ may reach this before the table grows
    std::size_t reserved_ = 0;      // ids that reserve() asked for: memory for them is kept however few come
    std::uint32_t multiplier_ = 0;  // which one of the sequence; it is remembered between rebuilds
    memory_limit limit_{};
};
static_assert(id_storage<flat_storage<>>);
static_assert(batched_lookup<flat_storage<>>);
static_assert(prefetchable<flat_storage<>>);
static_assert(parallel_rebuild<flat_storage<>>);

}  // namespace tsubu
