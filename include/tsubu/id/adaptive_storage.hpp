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

#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <memory>   // std::allocator
#include <span>     // std::span
#include <string>   // std::string, std::to_string
#include <utility>  // std::move, std::swap

namespace tsubu {

/// Where adaptive_storage keeps the ids.
enum class adaptive_choice { flat, dense };

/// When a dense table beats flat lines: the range is at most this many times the number of ids.
/// The crossovers that bench/run draws: look-up and rebuild in a dense table win while the table stays in the caches.
struct adaptive_rule {
    std::uint64_t small_table_bytes = std::uint64_t{8} << 20;  ///< up to this much table ...
    std::uint64_t small_ratio = 4;                              ///< ... this ratio of range to ids,
    std::uint64_t large_ratio = 2;                              ///< beyond it this one [1]

    /// Is the dense table the better one for `count` ids that span extent + 1 values?
    [[nodiscard]] constexpr bool prefers_dense(std::size_t count, std::uint64_t extent) const noexcept {
        const std::uint64_t ratio = extent < small_table_bytes / sizeof(index_t) ? small_ratio : large_ratio;
        return extent / ratio < count;
    }
};

/// Looks at count and range of the ids at each rebuild, picks a table, remembers it, and says why.
///
///     tsubu::id_map<> where;                       // adaptive is the default
///     where.rebuild(ids);
///     std::puts(where.storage().explain().c_str());
///
/// Concept:       id_storage, batched_lookup, prefetchable, parallel_rebuild.
/// Cost:          that of the chosen table, and one predictable branch per call.
/// Bytes per id:  4 T / N where it picks dense (so at most 16), else 8 | 16 | 20.
/// Growth:        that of the chosen table. An assign that widens the range moves the ids from dense to flat when
///                dense no longer suits, in O(N); back only at a rebuild.
/// Deterministic: yes: the choice depends on the ids alone.
/// Choose it when you do not know the ids, or they change during the run. Do not when you know better.
/// Source:        the crossovers measured by bench/run.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class adaptive_storage {
public:
    using id_type = Id;
    using allocator_type = Allocator;

    adaptive_storage() = default;
    explicit adaptive_storage(const Allocator& allocator) : flat_(allocator), dense_(allocator) {}
    explicit adaptive_storage(memory_limit limit, const Allocator& allocator = {})
        : flat_(limit, allocator), dense_(limit, allocator), limit_(limit) {}

    [[nodiscard]] index_t find(Id id) const noexcept {
        return choice_ == adaptive_choice::dense ? dense_.find(id) : flat_.find(id);
    }
    void find(std::span<const Id> ids, std::span<index_t> indices) const noexcept {
        with_table([&](const auto& table) { table.find(ids, indices); });
    }
    void prefetch(Id id) const noexcept {
        with_table([&](const auto& table) { table.prefetch(id); });
    }

    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links) {
        rebuild(ids, range, links, this_thread{});
    }
    template <executor Executor>
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links, const Executor& on) {
        if (prefers_dense(ids.size(), range)) {
            dense_.rebuild(ids, range, links, on);
            adopt(adaptive_choice::dense);
        } else {
            flat_.rebuild(ids, range, links, on);
            adopt(adaptive_choice::flat);
        }
        range_ = range;
    }

    void assign(Id id, index_t index) {
        const auto range = range_.with(id);
        if (choice_ == adaptive_choice::dense && !range_.contains(id) && !prefers_dense(size() + 1, range)) {
            flat_storage<Id, Allocator> sparse(limit_, allocator_of_flat());
            dense_.for_each([&](Id present, index_t at) { sparse.assign(present, at); });
            sparse.assign(id, index);
            flat_ = std::move(sparse);
            adopt(adaptive_choice::flat);
        } else {
            with_table([&](auto& table) { table.assign(id, index); });
        }
        range_ = range;
    }
    bool erase(Id id) noexcept {
        return with_table([&](auto& table) { return table.erase(id); });
    }
    void reserve(std::size_t count) {
        with_table([&](auto& table) { table.reserve(count); });
    }
    void clear() noexcept {
        with_table([](auto& table) { table.clear(); });
        range_ = {};
    }
    [[nodiscard]] std::size_t size() const noexcept {
        return with_table([](const auto& table) { return table.size(); });
    }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return flat_.memory_bytes() + dense_.memory_bytes(); }

    /// The table that holds the ids.
    [[nodiscard]] adaptive_choice choice() const noexcept { return choice_; }
    /// The choice and its reason in one sentence.
    [[nodiscard]] std::string explain() const {
        if (size() == 0) return "no ids yet: flat_storage, which suits any";
        const std::string numbers = std::to_string(size()) + " ids between " + std::to_string(range_.lowest) + " and " +
                                    std::to_string(range_.highest);
        if (choice_ == adaptive_choice::dense)
            return "dense_storage: " + numbers + " fill their range, so one array entry per value is smallest and fastest";
        return std::string("flat_storage with ") + name_of(flat_.lines()) + " lines: " + numbers +
               " leave most of their range empty";
    }

private:
    [[nodiscard]] bool prefers_dense(std::size_t count, id_range<Id> range) const noexcept {
        return !range.empty() && adaptive_rule{}.prefers_dense(count, range.extent()) &&
               limit_.admits((range.extent() + 1) * sizeof(index_t), count);
    }
    template <class Call>
    decltype(auto) with_table(Call&& call) {
        return choice_ == adaptive_choice::dense ? call(dense_) : call(flat_);
    }
    template <class Call>
    decltype(auto) with_table(Call&& call) const {
        return choice_ == adaptive_choice::dense ? call(dense_) : call(flat_);
    }
    [[nodiscard]] Allocator allocator_of_flat() const noexcept { return flat_.get_allocator(); }
    /// The other table gives its memory back.
    void adopt(adaptive_choice choice) noexcept {
        if (choice == choice_) return;
        choice_ = choice;
        if (choice == adaptive_choice::dense)
            flat_ = flat_storage<Id, Allocator>(limit_, flat_.get_allocator());
        else
            dense_ = dense_storage<Id, Allocator>(limit_, dense_.get_allocator());
    }

    flat_storage<Id, Allocator> flat_{};
    dense_storage<Id, Allocator> dense_{};
    adaptive_choice choice_ = adaptive_choice::flat;
    id_range<Id> range_{};  // of all ids since the last rebuild or clear, erased ones included
    memory_limit limit_{};
};
static_assert(id_storage<adaptive_storage<>> && batched_lookup<adaptive_storage<>> && prefetchable<adaptive_storage<>> &&
              parallel_rebuild<adaptive_storage<>>);

}  // namespace tsubu
