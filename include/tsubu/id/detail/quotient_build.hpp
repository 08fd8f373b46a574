// SPDX-License-Identifier: MIT
/// @file
/// Filling quotient lines with many ids, block by block; with several threads, each in its own part of the lines.
///
/// Ids are inserted from the last to the first, so that the lowest index of an id overwrites the others, and what it
/// overwrites is its same-id link. Every number of threads keeps that order for equal ids, so all give the same
/// answers.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/executor.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/detail/quotient_find.hpp>
#include <tsubu/id/detail/quotient_kernels.hpp>
#include <tsubu/id/detail/quotient_lines.hpp>

#include <algorithm>    // std::fill_n, std::min
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <memory>       // std::allocator_traits
#include <span>         // std::span
#include <type_traits>  // std::false_type, std::true_type
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
    // By address and size: to check that a vector is a range takes a compiler ten times as long.
    [[nodiscard]] std::span<spilled_id> entries() noexcept { return {entries_.data(), entries_.size()}; }
    [[nodiscard]] std::span<const spilled_id> entries() const noexcept { return {entries_.data(), entries_.size()}; }
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
        repeated +=
            put_in_home_line<Layout, 16 / Layout::slots>(table_, links_, place, tag, index_plus_1, same, vacant);
        return true;
    }
    /// The same once the home line is known to be full.
    [[gnu::noinline]] bool insert_beyond(std::uint64_t place, Slot tag, std::uint32_t index_plus_1) noexcept {
        ++spilled;
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
        ++repeated;
    }

    std::size_t repeated = 0;  // ids that were in the table already
    std::size_t spilled = 0;   // ids that met a full home line

private:
    const line_table& table_;
    std::uint64_t end_line_;
    index_t* links_;
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

/// Below, the table stays in the caches of one thread, which is then as fast as several.
inline constexpr std::size_t threading_threshold = std::size_t{1} << 18;

/// So many blocks before they are hashed, ids are asked for.
inline constexpr std::size_t ids_ahead = 4;

/// The two steps of insert_all over a block, by the best kernels of this machine. Shared: see there.
template <class Layout, bool Shared, class Id>
struct fill_steps {
    void (*locate)(const line_table&, const Id*, id_block<Layout>&) noexcept = nullptr;
    std::uint32_t (*insert)(const line_table&, const id_block<Layout>&, std::uint32_t, index_t*, std::uint32_t*,
                            std::uint32_t, std::size_t&) noexcept = nullptr;

    fill_steps() noexcept {
        with_kernels([this]<class Kernels>(Kernels) {
            locate = &Kernels::template locate<Layout, Id>;
            insert = &Kernels::template insert<Layout, Shared>;
        });
    }
};

/// Inserts ids into cleared lines, last to first: all of them, or (Shared) those whose preferred place is one of
/// `places` from first_place on, while other threads insert the rest. Links are written for all, or (Shared) they are
/// all absent already. left_over(place, tag, index + 1) takes what the filler finds no place for. @return false if it
/// refused.
///
/// Three blocks are on their way at once, as in a batched look-up. An empty preferred slot takes the id without a
/// branch. The others wait in the queue, until the stores of their block no longer stall the vector loads of their
/// lines. Two copies of one id meet the same slot: so the second waits behind the first, and they are linked in their
/// order.
template <class Layout, bool Shared, class Id, class LeftOver>
bool insert_all(const line_table& table, line_filler<Layout>& filler, std::span<const Id> ids, index_t* links,
                std::uint32_t first_place, std::uint32_t places, bool beyond_cache, LeftOver&& left_over) noexcept {
    const auto is_mine = [=](std::uint64_t place) {
        return !Shared || static_cast<std::uint32_t>(place) - first_place < places;
    };
    const fill_steps<Layout, Shared, Id> steps;
    const std::size_t blocks = ids.size() / block_size;
    if (!Shared && links != nullptr) std::fill_n(links + blocks * block_size, ids.size() % block_size, absent);
    for (std::size_t i = ids.size(); i-- > blocks * block_size;) {
        const auto at = table.locate<Layout>(static_cast<std::uint64_t>(ids[i]) - table.base);
        const auto index_plus_1 = static_cast<std::uint32_t>(i + 1);
        if (is_mine(at.place) && !filler.insert(at.place, at.tag, index_plus_1) &&
            !left_over(at.place, at.tag, index_plus_1))
            return false;
    }
    id_block<Layout> ring[3];
    std::uint32_t queue[3][block_size];
    std::uint32_t queued[3];
    std::uint32_t mine[3][Shared ? block_size : 1] = {};
    std::uint32_t count[3];
    // The m-th id of its block that is to be inserted. Past the count some number of an earlier block, whose line is
    // only asked for; if the next block has more ids of this part, the last of them are not asked for.
    const auto number = [&](std::size_t step, std::uint32_t m) {
        return Shared ? mine[step % 3][m] : block_size - 1 - m;
    };
    const auto first_of = [&](std::size_t step) { return (blocks - 1 - step) * block_size; };
    for (std::size_t step = 0; step < blocks + 2; ++step) {
        if (step + ids_ahead < blocks)  // processors expect streams to ascend
            for (std::size_t k = 0; k < block_size; k += 64 / sizeof(Id))
                detail::prefetch(ids.data() + first_of(step + ids_ahead) + k);
        if (step < blocks) {
            steps.locate(table, ids.data() + first_of(step), ring[step % 3]);
            if constexpr (Shared) {  // no branch: whose id it is cannot be predicted
                count[step % 3] = 0;
                for (std::uint32_t k = block_size; k-- > 0;) {
                    mine[step % 3][count[step % 3]] = k;
                    count[step % 3] += static_cast<std::uint32_t>(is_mine(ring[step % 3].place[k]));
                }
            }
        }
        if (step >= 1 && step - 1 < blocks) {
            const auto& block = ring[(step - 1) % 3];
            auto& waiting = queue[(step - 1) % 3];
            const auto first = first_of(step - 1);
            if (!Shared && links != nullptr) std::fill_n(links + first, block_size, absent);
            const auto store = [&](auto ask_ahead) {
                const auto& next = ring[step % 3];
                const auto most = Shared ? count[(step - 1) % 3] : block_size;
                std::uint32_t met = 0;
                for (std::uint32_t m = 0; m < most; ++m) {
                    if constexpr (ask_ahead) prefetch_place<Layout, true>(table, next.place[number(step, m)]);
                    const auto k = number(step - 1, m);
                    const auto index_plus_1 = static_cast<std::uint32_t>(first + k + 1);
                    const bool stored = store_if_free<Layout>(table, block.place[k], block.tag[k], index_plus_1);
                    waiting[met] = k;
                    met += static_cast<std::uint32_t>(!stored);
                }
                return met;
            };
            queued[(step - 1) % 3] = beyond_cache && step < blocks ? store(std::true_type{}) : store(std::false_type{});
        }
        if (step >= 2) {
            const auto& block = ring[(step - 2) % 3];
            auto& waiting = queue[(step - 2) % 3];
            const auto first = static_cast<std::uint32_t>(first_of(step - 2) + 1);
            const auto kept =
                steps.insert(table, block, first, links, waiting, queued[(step - 2) % 3], filler.repeated);
            for (std::uint32_t q = 0; q < kept; ++q) {
                const auto k = waiting[q];
                if (!filler.insert_beyond(block.place[k], block.tag[k], first + k) &&
                    !left_over(block.place[k], block.tag[k], first + k))
                    return false;
            }
        }
    }
    return true;
}

/// One thread. @return how many ids occurred before; no_fit if the stash is full, or more ids than most_spilled met a
/// full home line: then this multiplier maps them badly.
template <class Layout, class Id, class Spills>
std::uint64_t fill_lines(const line_table& table, Spills& stash, std::span<const Id> ids, std::span<index_t> links,
                         bool beyond_cache, std::size_t most_spilled) noexcept {
    line_filler<Layout> filler(table, table.lines + spill_lines, links.data());
    const bool fits = insert_all<Layout, false>(
        table, filler, ids, links.data(), 0, 0, beyond_cache,
        [&](std::uint64_t place, auto tag, std::uint32_t index_plus_1) {
            return insert_into_stash(filler, stash, {tag, static_cast<std::uint32_t>(place), index_plus_1});
        });
    return fits && filler.spilled <= most_spilled ? filler.repeated : no_fit;
}

/// Several threads: each hashes all ids, and inserts those of its own part of the lines. What the last lines of a part
/// spill into the next one is inserted at the end, when all parts are filled.
template <class Layout, class Allocator>
class team_filler {
public:
    /// Takes the memory that filling needs, before the table is touched.
    team_filler(std::size_t team, std::size_t stash_capacity, const Allocator& allocator)
        : repeated_(team, allocator), spilled_(team, allocator) {
        for (std::size_t t = 0; t < team; ++t) {
            late_.emplace_back(allocator);
            late_.back().reserve(spill_lines * Layout::slots + stash_capacity);
        }
    }

    /// Clears the lines as well. @return as fill_lines.
    template <class Id, class Spills, executor Executor>
    std::uint64_t fill(const line_table& table, Spills& stash, std::span<const Id> ids, std::span<index_t> links,
                       bool beyond_cache, std::size_t most_spilled, const Executor& on) noexcept {
        const std::size_t team = late_.size();
        const auto share = [&](std::size_t total, std::size_t t, std::size_t grain) {
            return (std::min)(total, ((total / team) / grain + 1) * grain * t);
        };
        on.run([&](std::size_t t) {
            if (const auto begin = share(links.size(), t, 16); !links.empty())
                std::fill_n(links.data() + begin, share(links.size(), t + 1, 16) - begin, absent);
            wipe_lines<Layout>(table, share(table.lines, t, 64), share(table.lines, t + 1, 64));
        });
        on.run([&](std::size_t t) {
            const auto first = share(table.lines, t, 64);
            const auto end = share(table.lines, t + 1, 64);
            late_[t].clear();
            repeated_[t] = spilled_[t] = 0;
            if (first == end) return;  // more threads than lines
            line_filler<Layout> filler(table, end < table.lines ? end : table.lines + spill_lines, links.data());
            // A refusal shows below: a list that is full may have refused an id.
            insert_all<Layout, true>(
                table, filler, ids, links.data(), static_cast<std::uint32_t>(first * Layout::slots),
                static_cast<std::uint32_t>((end - first) * Layout::slots), beyond_cache,
                [&](std::uint64_t place, auto tag, std::uint32_t index_plus_1) {
                    return late_[t].push({tag, static_cast<std::uint32_t>(place), index_plus_1});
                });
            repeated_[t] = filler.repeated;
            spilled_[t] = filler.spilled;
        });
        line_filler<Layout> filler(table, table.lines + spill_lines, links.data());
        std::size_t spilled = 0;
        bool fits = true;
        for (std::size_t t = 0; t < team; ++t) {
            filler.repeated += repeated_[t];
            spilled += spilled_[t];
            fits = fits && late_[t].entries().size() < late_[t].capacity();
            for (const auto& entry : late_[t].entries())
                fits = fits && (filler.insert(entry.place, static_cast<typename Layout::slot_type>(entry.tag),
                                              entry.index_plus_1) ||
                                insert_into_stash(filler, stash, entry));
        }
        return fits && spilled <= most_spilled ? filler.repeated : no_fit;
    }

private:
    std::vector<spill_list<Allocator>> late_;    // per part
    buffer<std::uint64_t, Allocator> repeated_;  // per part
    buffer<std::uint64_t, Allocator> spilled_;   // per part
};

}  // namespace tsubu::detail
