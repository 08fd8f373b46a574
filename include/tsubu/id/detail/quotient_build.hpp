// SPDX-License-Identifier: MIT
/// @file
/// Filling quotient lines with many ids: block by block, or part by part of the table for large ones and for threads.
///
/// Ids are inserted from the last to the first, so that the lowest index of an id overwrites the others, and what it
/// overwrites is its same-id link. Every way of filling keeps that order for equal ids, so all give the same answers.
///
/// Large tables do not fit the second-level cache: each insertion would wait for a line of memory. So the ids are first
/// dealt out, as (place, slot) items, into the parts of the table that they belong to, in one sequential pass through a
/// line-sized buffer per part; then each part is cleared and filled inside the cache:
///
///     ids  N-1 .. 0   -> locate -> | items of part 0 | items of part 1 | ...     one thread: its share of the ids
///                                        v                 v
///     table                        | lines 0..4095   | lines 4096..8191 | ...    one thread: its share of the parts
///
/// What the last lines of a part spill into the next one is inserted at the end, when all parts are filled.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/executor.hpp>
#include <tsubu/id/detail/quotient_find.hpp>
#include <tsubu/id/detail/quotient_kernels.hpp>
#include <tsubu/id/detail/quotient_lines.hpp>

#include <algorithm>    // std::fill_n, std::min
#include <bit>          // std::countr_zero
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <cstring>      // std::memcpy, std::memset
#include <memory>       // std::allocator_traits
#include <span>         // std::span
#include <type_traits>  // std::conditional_t, std::true_type
#include <vector>       // std::vector

namespace tsubu::detail {

/// A list of spilled ids that never takes memory after its construction: filling a table must not throw.
template <class Allocator>
class spill_list {
    using entry_allocator = typename std::allocator_traits<Allocator>::template rebind_alloc<spilled_id>;

public:
    spill_list() = default;
    explicit spill_list(const Allocator& allocator) : entries_(entry_allocator(allocator)) {}
    void reserve(std::size_t count) { entries_.reserve(count); }
    /// @return false if there is no room left.
    bool push(const spilled_id& entry) noexcept {
        if (entries_.size() == entries_.capacity()) return false;
        entries_.push_back(entry);
        return true;
    }
    void clear() noexcept { entries_.clear(); }
    [[nodiscard]] std::span<spilled_id> entries() noexcept { return entries_; }
    [[nodiscard]] std::span<const spilled_id> entries() const noexcept { return entries_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return entries_.capacity() * sizeof(spilled_id); }
    [[nodiscard]] std::size_t capacity() const noexcept { return entries_.capacity(); }

private:
    std::vector<spilled_id, entry_allocator> entries_;
};

/// Inserts ids into the lines up to end_line; one per thread.
template <class Layout>
class line_filler {
    using Slot = typename Layout::slot_type;

public:
    line_filler(const line_table& table, std::uint64_t end_line, index_t* links) noexcept
        : table_(table), end_line_(end_line), links_(links) {}

    /// @return false if the id found no place up to end_line: it is the caller's then.
    [[gnu::always_inline]] bool insert(std::uint64_t place, Slot tag, std::uint32_t index_plus_1) noexcept {
        const auto* const line = table_.slots<Layout>() + (place & ~std::uint64_t{Layout::slots - 1});
        const auto same = matches<Layout>(line, tag, static_cast<Slot>(table_.tag_mask));
        const auto vacant = matches<Layout>(line, 0, static_cast<Slot>(~Slot{0}));
        if ((same | vacant) == 0) [[unlikely]]
            return insert_beyond(place, tag, index_plus_1);
        repeated_ +=
            put_in_home_line<Layout, 16 / Layout::slots>(table_, links_, place, tag, index_plus_1, same, vacant);
        return true;
    }
    /// The same once the home line is known to be full.
    [[gnu::noinline]] bool insert_beyond(std::uint64_t place, Slot tag, std::uint32_t index_plus_1) noexcept {
        const auto home = place / Layout::slots;
        const auto end = walk<Layout>(table_, place, tag, end_line_);
        table_.overflow[home / 64] |= std::uint64_t{1} << (home % 64);
        if (end.what == search_end::outcome::boundary) return false;
        if (end.what == search_end::outcome::match) link(index_plus_1, index_at<Layout>(table_, end.place));
        write_slot<Layout>(table_, end.place, static_cast<Slot>(tag + static_cast<Slot>(end.probe * table_.tag_step)),
                           index_plus_1);
        return true;
    }
    /// Links `index_plus_1` to the copy that it replaces.
    void link(std::uint32_t index_plus_1, std::uint32_t former_plus_1) noexcept {
        if (links_ != nullptr) links_[index_plus_1 - 1] = static_cast<index_t>(former_plus_1) - 1;
        ++repeated_;
    }
    [[nodiscard]] std::size_t repeated() const noexcept { return repeated_; }

private:
    const line_table& table_;
    std::uint64_t end_line_;
    index_t* links_;
    std::size_t repeated_ = 0;  // ids that were in the table already
};

/// Inserts into the stash what found no place in the lines. @return false if the stash is full.
template <class Filler, class Spills>
bool insert_into_stash(Filler& filler, Spills& stash, const spilled_id& entry) noexcept {
    for (auto& other : stash.entries())
        if (other.place == entry.place && other.tag == entry.tag) {
            filler.link(entry.index_plus_1, other.index_plus_1);
            other.index_plus_1 = entry.index_plus_1;
            return true;
        }
    return stash.push(entry);
}

inline constexpr std::uint64_t no_fit = ~std::uint64_t{0};

/// Inserts all ids into cleared lines, last to first. @return how many ids occurred before; no_fit if the stash is
/// full.
template <class Kernels, class Layout, class Id, class Spills>
std::uint64_t fill_lines(const line_table& table, Spills& stash, std::span<const Id> ids, std::span<index_t> links,
                         bool prefetch) noexcept {
    using Slot = typename Layout::slot_type;
    line_filler<Layout> filler(table, table.lines + spill_lines, links.data());
    const auto into_stash = [&](std::uint64_t place, Slot tag, std::uint32_t index_plus_1) {
        return insert_into_stash(filler, stash, {tag, static_cast<std::uint32_t>(place), index_plus_1});
    };
    const std::size_t blocks = ids.size() / block_size;
    if (!links.empty()) std::fill_n(links.data() + blocks * block_size, ids.size() % block_size, absent);
    for (std::size_t i = ids.size(); i-- > blocks * block_size;) {
        const auto at = table.locate<Layout>(static_cast<std::uint64_t>(ids[i]) - table.base);
        const auto index_plus_1 = static_cast<std::uint32_t>(i + 1);
        if (!filler.insert(at.place, at.tag, index_plus_1) && !into_stash(at.place, at.tag, index_plus_1))
            return no_fit;
    }

    // Three blocks at once, as in a batched look-up. An empty preferred slot takes the id without a branch. The others
    // wait in the queue, until the stores of their block no longer stall the vector loads of their lines. Two copies
    // of one id meet the same slot: so the second waits behind the first, and they are linked in their order.
    id_block<Layout> ring[3];
    std::uint32_t queue[3][block_size];
    std::uint32_t queued[3];
    std::size_t repeated = 0;
    for (std::size_t step = 0; step < blocks + 2; ++step) {
        if (step < blocks)
            Kernels::template locate<Layout>(table, ids.data() + (blocks - 1 - step) * block_size, ring[step % 3]);
        if (step >= 1 && step - 1 < blocks) {
            const auto& block = ring[(step - 1) % 3];
            auto& waiting = queue[(step - 1) % 3];
            auto& count = queued[(step - 1) % 3];
            const auto first = (blocks - step) * block_size;
            if (!links.empty()) std::fill_n(links.data() + first, block_size, absent);
            const auto store = [&](auto ask_ahead) {
                std::uint32_t met = 0;
                for (std::uint32_t k = block_size; k-- > 0;) {
                    if constexpr (ask_ahead) prefetch_place<Layout, true>(table, ring[step % 3].place[k]);
                    const auto index_plus_1 = static_cast<std::uint32_t>(first + k + 1);
                    const bool taken = taken_before<Layout>(table, block.place[k], block.tag[k], index_plus_1);
                    waiting[met] = k;
                    met += static_cast<std::uint32_t>(taken);
                }
                count = met;
            };
            if (prefetch && step < blocks)
                store(std::true_type{});
            else
                store(std::false_type{});
        }
        if (step >= 2) {
            const auto& block = ring[(step - 2) % 3];
            auto& waiting = queue[(step - 2) % 3];
            const auto first = static_cast<std::uint32_t>((blocks + 1 - step) * block_size + 1);
            const auto kept = Kernels::template insert<Layout>(table, block, first, links.data(), waiting,
                                                               queued[(step - 2) % 3], repeated);
            for (std::uint32_t q = 0; q < kept; ++q) {
                const auto k = waiting[q];
                if (!filler.insert_beyond(block.place[k], block.tag[k], first + k) &&
                    !into_stash(block.place[k], block.tag[k], first + k))
                    return no_fit;
            }
        }
    }
    return filler.repeated() + repeated;
}

/// What is dealt out to the parts: enough to insert the id without the id.
struct narrow_item {
    std::uint32_t place;
    std::uint32_t slot;
};
struct wide_item {
    std::uint64_t tag;
    std::uint32_t place;
    std::uint32_t index_plus_1;
};
template <class Layout>
using dealt_item = std::conditional_t<Layout::slots == 16, narrow_item, wide_item>;

/// Part: 4096 lines, 256 KiB: with its items it stays in a second-level cache of 512 KiB or more.
inline constexpr std::uint32_t part_lines_log2 = 12;

/// Everything that dealing needs, taken from memory before the table is touched.
template <class Layout, class Allocator>
class dealing {
    using item = dealt_item<Layout>;
    static constexpr std::uint32_t items_per_line = 64 / sizeof(item);
    static constexpr std::uint32_t part_shift =
        part_lines_log2 + static_cast<std::uint32_t>(std::countr_zero(Layout::slots));

public:
    dealing(std::size_t count, std::uint32_t lines, std::size_t team, const Allocator& allocator)
        : parts_((lines >> part_lines_log2) + 1),
          team_(team),
          // Every share of every part begins on a line of its own, so that whole lines can be streamed.
          items_((count + team * parts_ * items_per_line) / items_per_line + 1, allocator),
          staged_(team * parts_, allocator),
          begin_(team * parts_ + 1, allocator),
          cursor_(team * parts_, allocator),
          repeated_(team, allocator) {
        for (std::size_t p = 0; p < parts_; ++p) {
            late_.emplace_back(allocator);
            late_.back().reserve(spill_lines * Layout::slots);
        }
    }

    template <class Kernels, class Id, class Spills, executor Executor>
    std::uint64_t fill(const line_table& table, const std::uint64_t* overflow_end, Spills& stash,
                       std::span<const Id> ids, std::span<index_t> links, const Executor& on) noexcept {
        const auto share = (ids.size() / team_ + block_size) / block_size * block_size;
        const auto ids_of = [&](std::size_t t) {  // member 0 has the last ids: its items come first
            const auto end = ids.size() - (std::min)(ids.size(), t * share);
            return ids.subspan(end - (std::min)(end, share), (std::min)(end, share));
        };
        on.run([&](std::size_t t) { this->template count<Kernels>(table, ids_of(t), t); });
        std::uint64_t next = 0;
        for (std::size_t p = 0; p < parts_; ++p)
            for (std::size_t t = 0; t < team_; ++t) {
                begin_[p * team_ + t] = next;
                next += (cursor_[t * parts_ + p] + items_per_line - 1) / items_per_line * items_per_line;
            }
        begin_[parts_ * team_] = next;
        on.run([&](std::size_t t) {
            const auto mine = ids_of(t);
            const auto first = static_cast<std::size_t>(mine.data() - ids.data());
            if (!links.empty()) std::fill_n(links.data() + first, mine.size(), absent);
            this->template deal<Kernels>(table, mine, static_cast<std::uint32_t>(first + 1), t);
        });
        on.run([&](std::size_t t) {
            repeated_[t] = 0;
            for (std::size_t p = parts_ * t / team_; p < parts_ * (t + 1) / team_; ++p)
                repeated_[t] += fill_part(table, overflow_end, p, links.data());
        });
        bool fits = true;
        std::uint64_t repeated = 0;
        for (std::size_t t = 0; t < team_; ++t) repeated += repeated_[t];
        line_filler<Layout> filler(table, table.lines + spill_lines, links.data());
        for (auto& part : late_) {
            fits = fits && part.entries().size() < part.capacity();
            for (const auto& entry : part.entries())
                fits = fits && (filler.insert(entry.place, static_cast<typename Layout::slot_type>(entry.tag),
                                              entry.index_plus_1) ||
                                insert_into_stash(filler, stash, entry));
        }
        return fits ? repeated + filler.repeated() : no_fit;
    }

private:
    using Slot = typename Layout::slot_type;

    template <class Kernels, class Id, class Each>
    static void for_each_located(const line_table& table, std::span<const Id> ids, Each&& each) noexcept {
        const auto blocks = ids.size() / block_size;
        for (std::size_t i = ids.size(); i-- > blocks * block_size;) {
            const auto at = table.locate<Layout>(static_cast<std::uint64_t>(ids[i]) - table.base);
            each(static_cast<std::uint32_t>(at.place), at.tag, static_cast<std::uint32_t>(i));
        }
        id_block<Layout> block;
        for (std::size_t b = blocks; b-- > 0;) {
            Kernels::template locate<Layout>(table, ids.data() + b * block_size, block);
            for (std::uint32_t k = block_size; k-- > 0;)
                each(block.place[k], block.tag[k], static_cast<std::uint32_t>(b * block_size + k));
        }
    }

    template <class Kernels, class Id>
    void count(const line_table& table, std::span<const Id> ids, std::size_t t) noexcept {
        auto* const counts = cursor_.data() + t * parts_;
        std::fill_n(counts, parts_, std::uint64_t{0});
        for_each_located<Kernels>(table, ids,
                                  [&](std::uint32_t place, Slot, std::uint32_t) { ++counts[place >> part_shift]; });
    }

    template <class Kernels, class Id>
    void deal(const line_table& table, std::span<const Id> ids, std::uint32_t first_index_plus_1,
              std::size_t t) noexcept {
        auto* const counts = cursor_.data() + t * parts_;
        auto* const staged = reinterpret_cast<item*>(staged_.data() + t * parts_);
        auto* const items = reinterpret_cast<item*>(items_.data());
        for (std::size_t p = 0; p < parts_; ++p) counts[p] = begin_[p * team_ + t];
        for_each_located<Kernels>(table, ids, [&](std::uint32_t place, Slot tag, std::uint32_t k) {
            const auto part = place >> part_shift;
            const auto at = counts[part]++;
            auto* const line = staged + std::size_t{part} * items_per_line;
            line[at % items_per_line] = make_item(place, tag, first_index_plus_1 + k);
            if (at % items_per_line == items_per_line - 1) stream(items + (at - (items_per_line - 1)), line);
        });
        for (std::size_t p = 0; p < parts_; ++p) {
            const auto at = counts[p];
            const auto begun = at % items_per_line;
            std::memcpy(items + (at - begun), staged + p * items_per_line, begun * sizeof(item));
        }
#if defined(__SSE2__)
        _mm_sfence();  // streamed lines are seen by the other threads before run() returns
#endif
    }

    std::uint64_t fill_part(const line_table& table, const std::uint64_t* overflow_end, std::size_t p,
                            index_t* links) noexcept {
        const auto first_line = std::uint64_t{p} << part_lines_log2;
        const bool last = p + 1 == parts_;
        const auto all_lines = table.lines + extra_lines;
        const auto end_line = last ? all_lines - 1 : std::uint64_t{p + 1} << part_lines_log2;
        std::memset(table.memory + first_line * 64, 0, ((last ? all_lines : end_line) - first_line) * 64);
        if constexpr (Layout::keyed)
            std::memset(table.indices + first_line * Layout::slots, 0,
                        ((last ? all_lines : end_line) - first_line) * Layout::slots * sizeof(std::uint32_t));
        auto* const bits = table.overflow + first_line / 64;
        std::fill_n(bits, (last ? overflow_end : table.overflow + end_line / 64) - bits, std::uint64_t{0});

        late_[p].clear();
        line_filler<Layout> filler(table, end_line, links);
        const auto* const items = reinterpret_cast<const item*>(items_.data());
        for (std::size_t t = 0; t < team_; ++t) {
            const auto begin = begin_[p * team_ + t];
            const auto end = cursor_[t * parts_ + p];
            // As in fill_lines: what meets an empty preferred slot is stored without a branch, the rest waits its turn.
            std::uint64_t queue[block_size];
            for (auto from = begin; from < end; from += block_size) {
                const auto to = (std::min)(end, from + block_size);
                std::uint32_t queued = 0;
                for (auto i = from; i < to; ++i) {
                    const auto entry = entry_of(table, items[i]);
                    const bool taken =
                        taken_before<Layout>(table, entry.place, static_cast<Slot>(entry.tag), entry.index_plus_1);
                    queue[queued] = i;
                    queued += static_cast<std::uint32_t>(taken);
                }
                for (std::uint32_t q = 0; q < queued; ++q) {
                    const auto entry = entry_of(table, items[queue[q]]);
                    if (!filler.insert(entry.place, static_cast<Slot>(entry.tag), entry.index_plus_1) &&
                        !late_[p].push(entry))
                        return filler.repeated();  // the full list tells fill()
                }
            }
        }
        return filler.repeated();
    }

    static item make_item(std::uint32_t place, Slot tag, std::uint32_t index_plus_1) noexcept {
        if constexpr (Layout::slots == 16)
            return {place, tag | index_plus_1};
        else
            return {tag, place, index_plus_1};
    }
    static spilled_id entry_of(const line_table& table, const item& it) noexcept {
        if constexpr (Layout::slots == 16) {
            const auto mask = static_cast<std::uint32_t>(table.tag_mask);
            return {it.slot & mask, it.place, it.slot & ~mask};
        } else {
            return {it.tag, it.place, it.index_plus_1};
        }
    }
    /// Writes one line past the caches: it is read again only when its part is filled.
    static void stream(item* to, const item* line) noexcept {
#if defined(__SSE2__)
        const auto* from = reinterpret_cast<const __m128i*>(line);
        for (int k = 0; k < 4; ++k) _mm_stream_si128(reinterpret_cast<__m128i*>(to) + k, _mm_load_si128(from + k));
#else
        std::memcpy(to, line, 64);
#endif
    }

    std::size_t parts_;
    std::size_t team_;
    buffer<cache_line, Allocator> items_;
    buffer<cache_line, Allocator> staged_;       // one line per member and part
    buffer<std::uint64_t, Allocator> begin_;     // of the items of part p from member t: [p * team + t]
    buffer<std::uint64_t, Allocator> cursor_;    // counts, then ends: [t * parts + p]
    buffer<std::uint64_t, Allocator> repeated_;  // per member
    std::vector<spill_list<Allocator>> late_;    // per part: what its last lines spill into the next
};

}  // namespace tsubu::detail
