// SPDX-License-Identifier: MIT
/// @file
/// adaptive_storage: looks at the ids of each rebuild and keeps them in the table that suits them.
#pragma once

#include <tsubu/core/executor.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/dense_storage.hpp>
#include <tsubu/id/flat_storage.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>
#include <tsubu/id/paged_storage.hpp>

#include <algorithm>  // std::min
#include <concepts>   // std::same_as
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <memory>     // std::allocator
#include <span>       // std::span
#include <string>     // std::string, std::to_string
#include <utility>    // std::in_place_type, std::move
#include <variant>    // std::variant

namespace tsubu {

/// Where adaptive_storage keeps the ids; in the order of its tables.
enum class adaptive_choice { flat, dense, paged };

/// What adaptive_storage looks at.
struct id_distribution {
    std::size_t count = 0;     ///< number of ids, N
    std::uint64_t extent = 0;  ///< highest - lowest
    /// Share of the 1024 values around an id that are taken: 1 in blocks, N / T at random; 0 where no value of it would
    /// change the choice. [1]
    double occupancy = 0;
};

/// From which pattern to which table. The numbers are the crossovers that bench/run draws (look-up and rebuild, on
/// a second-level cache of 1 MiB); a dense table wins as long as it stays in the caches.
[[nodiscard]] constexpr adaptive_choice choose_table(const id_distribution& ids) noexcept {
    constexpr std::uint64_t cached_entries = std::uint64_t{2} << 20;  // 8 MiB of indices
    constexpr std::uint64_t cached_ratio = 24;                        // up to there dense wins at 1e4 and 1e5 ids
    constexpr std::uint64_t dense_ratio = 5;                          // beyond 8 MiB: look-ups miss the caches
    constexpr double block_occupancy = 0.375;    // from there paged takes less memory than flat, and is faster ...
    constexpr std::uint64_t paged_ratio = 2048;  // ... as long as its directory takes at most 8 bytes per id
    const auto within = [&](std::uint64_t ratio) { return ids.extent / ratio < ids.count; };
    if (within(dense_ratio) || (ids.extent < cached_entries && within(cached_ratio))) return adaptive_choice::dense;
    if (ids.occupancy >= block_occupancy && within(paged_ratio)) return adaptive_choice::paged;
    return adaptive_choice::flat;
}

namespace detail {

/// Do the ids come in blocks? Of eight ids, how full are the 1024 values around each, judged by every 17th id at most.
template <particle_id Id>
[[nodiscard]] double sampled_occupancy(std::span<const Id> ids) noexcept {
    constexpr std::size_t probes = 8;
    constexpr std::size_t wished_sample = 512;
    constexpr unsigned page_bits = 10;
    // Odd, so that it does not fall into step with lattices and blocks whose sides are powers of two.
    const std::size_t stride = (std::min)(ids.size() / wished_sample, std::size_t{16}) | 1;
    unsigned_id<Id> page[probes];
    std::uint32_t met[probes] = {};
    for (std::size_t p = 0; p < probes; ++p)
        page[p] = static_cast<unsigned_id<Id>>(ids[ids.size() / probes * p]) >> page_bits;
    for (std::size_t i = 0; i < ids.size(); i += stride)
        for (std::size_t p = 0; p < probes; ++p)
            met[p] += static_cast<std::uint32_t>(static_cast<unsigned_id<Id>>(ids[i]) >> page_bits == page[p]);
    double sum = 0;
    for (const auto count : met) sum += count;
    return sum * static_cast<double>(stride) / (probes << page_bits);
}

}  // namespace detail

/// Looks at number, range and pattern of the ids at each rebuild, picks a table, remembers it, and says why.
///
///     tsubu::id_map<> where;                       // adaptive is the default
///     where.rebuild(ids);
///     std::puts(where.storage().explain().c_str());
///
/// Concept:       id_storage, batched_lookup, prefetchable, parallel_rebuild.
/// Cost:          that of the chosen table and one or two predictable branches per call; a rebuild looks at a sample of
///                the ids (.2 ns per id) where full blocks of them would go to pages.
/// Bytes per id:  8 | 16 | 20 in flat lines; 4 T / N where it picks dense, so up to 96 for small tables (8 MiB) and 20
///                for larger ones; at most 20 in pages. A memory_limit that does not admit the pick leads to flat
///                lines.
/// Growth:        that of the chosen table. An assign that widens the range so far that another table suits moves the
///                ids to flat lines, in O(N); back only at a rebuild.
/// Deterministic: yes: the choice depends on the ids and the limit alone.
/// Choose it when you do not know the ids, or they change during the run. Do not when you know better.
/// Source:        the crossovers measured by bench/run.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class adaptive_storage {
public:
    using id_type = Id;
    using allocator_type = Allocator;

    adaptive_storage() = default;
    explicit adaptive_storage(const Allocator& allocator) : adaptive_storage(memory_limit{}, allocator) {}
    explicit adaptive_storage(memory_limit limit, const Allocator& allocator = {})
        : table_(std::in_place_type<flat>, limit, allocator), limit_(limit) {}

    [[nodiscard, gnu::always_inline]] index_t find(Id t) const noexcept {
        return with_table([&](const auto& table) { return table.find(t); });
    }
    void find(std::span<const Id> ids, std::span<index_t> indices) const noexcept {
        with_table([&](const auto& table) { table.find(ids, indices); });
    }
    void prefetch(Id t) const noexcept {
        with_table([&](const auto& table) { table.prefetch(t); });
    }

    /// @throws limit_error if not even flat lines keep within the memory limit. Strong guarantee, but for
    ///         the corner told at flat_storage.
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links) {
        rebuild(ids, range, links, this_thread{});
    }
    template <executor Executor>
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links, const Executor& on) {
        if (ids.empty()) return clear();
        id_distribution seen{ids.size(), range.extent(), 0};
        auto wanted = choose_table(seen);
        // Full blocks would go to pages: are they full?
        if (choose_table({seen.count, seen.extent, 1}) == adaptive_choice::paged) {
            seen.occupancy = detail::sampled_occupancy(ids);
            wanted = choose_table(seen);
        }
        if (!admits(wanted, seen)) wanted = adaptive_choice::flat;
        switch (wanted) {
            case adaptive_choice::dense: rebuild_as<dense>(ids, range, links, on); break;
            case adaptive_choice::paged: try { rebuild_as<paged>(ids, range, links, on);
                } catch (const limit_error&) {  // more pages than the sample promised
                    rebuild_as<flat>(ids, range, links, on);
                }
                break;
            case adaptive_choice::flat: rebuild_as<flat>(ids, range, links, on); break;
        }
        range_ = range;
        seen_ = seen;
    }

    /// @throws limit_error as rebuild. Strong guarantee.
    void assign(Id t, index_t index) {
        const auto range = range_.with(t);
        if (choice() == adaptive_choice::flat || range_.contains(t) || suits(range)) {
            try {
                with_table([&](auto& table) { table.assign(t, index); });
            } catch (const limit_error&) {
                if (choice() == adaptive_choice::flat) throw;
                assign_in_flat(t, index);
            }
        } else {
            assign_in_flat(t, index);
        }
        range_ = range;
    }
    bool erase(Id t) noexcept {
        return with_table([&](auto& table) { return table.erase(t); });
    }
    /// Room in the present table; the next rebuild may pick another. @throws limit_error as that table.
    void reserve(std::size_t count) {
        with_table([&](auto& table) { table.reserve(count); });
    }
    void clear() noexcept {
        with_table([](auto& table) { table.clear(); });
        range_ = {};
        seen_ = {};
    }
    [[nodiscard]] std::size_t size() const noexcept {
        return with_table([](const auto& table) { return table.size(); });
    }
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return with_table([](const auto& table) { return table.memory_bytes(); });
    }
    [[nodiscard]] Allocator get_allocator() const noexcept {
        return with_table([](const auto& table) { return table.get_allocator(); });
    }

    /// The table that holds the ids.
    [[nodiscard]] adaptive_choice choice() const noexcept { return static_cast<adaptive_choice>(table_.index()); }
    /// What the last rebuild saw.
    [[nodiscard]] const id_distribution& seen() const noexcept { return seen_; }
    /// The choice and its reason in one sentence.
    [[nodiscard]] std::string explain() const {
        if (range_.empty()) return "no ids yet";
        const auto numbers = std::to_string(size()) + " ids between " + std::to_string(range_.lowest) + " and " +
                             std::to_string(range_.highest);
        switch (choice()) {
            case adaptive_choice::dense:
                return "dense_storage: " + numbers + " fill enough of their range for an array of it";
            case adaptive_choice::paged:
                return "paged_storage: " + numbers + " come in blocks, " +
                       std::to_string(static_cast<int>(100 * seen_.occupancy)) +
                       " % full, in a range that is mostly empty";
            case adaptive_choice::flat: break;
        }
        return std::string("flat_storage with ") + name_of(std::get<flat>(table_).lines()) + " lines: " + numbers +
               " are scattered over a range that is mostly empty";
    }

private:
    using flat = flat_storage<Id, Allocator>;
    using dense = dense_storage<Id, Allocator>;
    using paged = paged_storage<Id, Allocator>;

    // Emptier pages than the sample promised would take more than flat lines do.
    static constexpr std::uint64_t paged_bytes_per_id = 20;
    static constexpr std::uint64_t paged_floor = std::uint64_t{1} << 18;  // 64 pages, however few ids

    // Each table refuses by itself what the limit does not admit; these are their bytes, rounded up.
    [[nodiscard]] bool admits(adaptive_choice choice, const id_distribution& ids) const noexcept {
        const auto values = ids.extent + 1;
        switch (choice) {
            case adaptive_choice::dense: return limit_.admits(values * 4 + values / 1024 + 64, ids.count);
            case adaptive_choice::paged:  // has a limit of its own, and is judged by the pages it really needs
            case adaptive_choice::flat: break;
        }
        return true;
    }
    [[nodiscard]] bool suits(id_range<Id> range) const noexcept {
        const id_distribution widened{size() + 1, range.extent(), seen_.occupancy};
        return choose_table(widened) == choice() && admits(choice(), widened);
    }
    template <class Table, executor Executor>
    void rebuild_as(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links, const Executor& on) {
        const auto build = [&](Table& table) {
            if constexpr (parallel_rebuild<Table> && detail::may_have_threads<Executor>)
                table.rebuild(ids, range, links, on);
            else
                table.rebuild(ids, range, links);
        };
        auto limit = limit_;
        if constexpr (std::same_as<Table, paged>)
            limit = memory_limit((std::min)(limit_.bytes(ids.size()), paged_floor + paged_bytes_per_id * ids.size()));
        if (auto* const same = std::get_if<Table>(&table_)) {
            same->limit_memory(limit);
            return build(*same);
        }
        Table fresh(limit, get_allocator());
        build(fresh);
        table_ = std::move(fresh);  // the former table gives its memory back
    }
    void assign_in_flat(Id t, index_t index) {
        flat sparse(limit_, get_allocator());
        sparse.reserve(size() + 1);
        with_table(
            [&](const auto& table) { table.for_each([&](Id present, index_t at) { sparse.assign(present, at); }); });
        sparse.assign(t, index);
        table_ = std::move(sparse);
    }
    // Not std::visit: find() of the tables, or the call that flat_storage makes, is inlined into the caller.
    template <class Self, class Call>
    [[gnu::always_inline]] static decltype(auto) with_table_of(Self& table, Call&& call) {
        if (auto* const t = std::get_if<flat>(&table)) return call(*t);
        if (auto* const t = std::get_if<dense>(&table)) return call(*t);
        return call(*std::get_if<paged>(&table));
    }
    template <class Call>
    [[gnu::always_inline]] decltype(auto) with_table(Call&& call) {
        return with_table_of(table_, call);
    }
    template <class Call>
    [[gnu::always_inline]] decltype(auto) with_table(Call&& call) const {
        return with_table_of(table_, call);
    }

    std::variant<flat, dense, paged> table_{};
    id_range<Id> range_{};  // of all ids since the last rebuild or clear, erased ones included
    id_distribution seen_{};
    memory_limit limit_{};
};
static_assert(id_storage<adaptive_storage<>> && batched_lookup<adaptive_storage<>> &&
              prefetchable<adaptive_storage<>> && parallel_rebuild<adaptive_storage<>>);

}  // namespace tsubu
