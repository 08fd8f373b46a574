// SPDX-License-Identifier: MIT
/// @file
/// bitmap_storage: one bit per id of the range, and the indices packed in the order of the ids.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/detail/bitmap_kernels.hpp>
#include <tsubu/id/detail/fill_absent.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>

#include <algorithm>  // std::min, std::max
#include <bit>        // std::countr_zero
#include <cstddef>    // std::byte, std::size_t
#include <cstdint>    // std::int64_t, std::uint32_t, std::uint64_t
#include <cstring>    // std::memcpy, std::memset
#include <limits>     // std::numeric_limits
#include <memory>     // std::allocator
#include <span>       // std::span
#include <string>     // std::string
#include <utility>    // std::exchange, std::move, std::swap

namespace tsubu {

//     words_    [ ..1.11.. ][ ........ ][ 1......1 ]     bit b of word w: is id (first_word_ + w) * 64 + b there?
//     starts_   [ 1        ][ 4        ][ 4        ]     where the indices of the word begin in the pool
//     pool_     [ absent | i  i  i | i  i | unused ... ]
//                 0        1         4      used_
//
// After a rebuild the blocks of the words stand in order and without gaps. An id that is assigned later moves the
// block of its word (at most 64 indices) to the end of the pool, one longer; what it leaves behind is dropped when
// the pool is full and copied to a larger one. An erased id keeps its bit and its place, with the index absent.

/// One bit per id of the range, and the indices packed in the order of the ids.
///
///     tsubu::id_map<tsubu::bitmap_storage<>> where;
///
/// Concept:       id_storage, batched_lookup (POPCNT), prefetchable.
/// Cost:          find a count of bits and two dependent loads; rebuild O(N + T / 64); erase O(1); assign O(1) if the
///                id is there, else amortised O(64 + T / N), and O(T / 64) when it lies outside the range.
/// Bytes per id:  4 + .19 T / N after a rebuild, T = highest - lowest; up to 4 more after assigns.
/// Growth:        bitmap and pool at least double, within the memory limit; a rebuild that needs less than a quarter
///                gives memory back.
/// Deterministic: yes.
/// Choose it when memory is tight and T / N <= 16.
/// Do not when    T / N is above 64, or single look-ups dominate and there is room for dense_storage.
/// Source:        A1, A4; rank on a bitmap: Jacobson 1989, doi:10.1109/SFCS.1989.63533.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>>
class bitmap_storage {
    using unsigned_type = detail::unsigned_id<Id>;

public:
    using id_type = Id;
    using allocator_type = Allocator;

    bitmap_storage() = default;
    explicit bitmap_storage(memory_limit limit, const Allocator& allocator = {})
        : limit_(limit), words_(allocator), starts_(allocator), pool_(allocator) {}
    explicit bitmap_storage(const Allocator& allocator) : bitmap_storage(memory_limit{}, allocator) {}

    bitmap_storage(const bitmap_storage&) = default;
    bitmap_storage(bitmap_storage&& other) noexcept
        : limit_(other.limit_),
          words_(std::move(other.words_)),
          starts_(std::move(other.starts_)),
          pool_(std::move(other.pool_)),
          first_word_(other.first_word_),
          used_(std::exchange(other.used_, 1)),
          size_(std::exchange(other.size_, 0)),
          reserved_(std::exchange(other.reserved_, 0)) {}
    bitmap_storage& operator=(bitmap_storage other) noexcept {
        swap(other);
        return *this;
    }
    ~bitmap_storage() = default;

    [[nodiscard]] index_t find(Id t) const noexcept {
        const auto map = window();
        return map.word_of(t) < map.count ? pool_[map.template place_of<false>(t)] : absent;
    }
    void find(std::span<const Id> ids, std::span<index_t> out) const noexcept {
        detail::bitmap_find(best_instruction_set(), window(), pool_.data(), ids.data(), out.data(), ids.size());
    }
    void prefetch(Id t) const noexcept {
        if (const auto w = window().word_of(t); w < words_.size()) {
            detail::prefetch(words_.data() + w);
            detail::prefetch(starts_.data() + w);
        }
    }

    /// @throws limit_error if the range needs more than the memory limit. Strong guarantee.
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links) {
        prepare(ids.size(), range);
        clear();
        if (ids.empty()) return;
        const auto map = window();
        std::uint64_t* const words = words_.data();
        for (const auto t : ids) words[map.word_of(t)] |= std::uint64_t{1} << (static_cast<unsigned_type>(t) & 63U);
        const auto set = best_instruction_set();
        used_ = detail::bitmap_number(set, words_.data(), starts_.data(), words_.size());
        size_ = used_ - 1;
        detail::fill_absent(pool_.data(), used_);
        detail::bitmap_insert(set, map, pool_.data(), ids.data(), links.empty() ? nullptr : links.data(), ids.size());
    }

    /// @throws limit_error if the bitmap or the pool would pass the memory limit. Strong guarantee.
    void assign(Id t, index_t index) {
        if (window().word_of(t) >= words_.size()) widen(t);
        auto place = window().template place_of<false>(t);
        if (place == 0) place = insert_place(t);
        if (std::exchange(pool_[place], index) == absent) ++size_;
    }
    bool erase(Id t) noexcept {
        const auto map = window();
        if (map.word_of(t) >= map.count) return false;
        // Place 0 stays absent.
        if (std::exchange(pool_[map.template place_of<false>(t)], absent) == absent) return false;
        --size_;
        return true;
    }

    /// Room for the indices of `count` ids and for the bits of as many ids without gaps.
    /// @throws limit_error if that passes the memory limit. Strong guarantee.
    void reserve(std::size_t count) {
        const auto words = (std::max)(words_.size(), static_cast<std::size_t>(word_count_of(count)));
        check("reserve", words, count + 1, count, count == 0 ? 0 : count - 1);
        if (count + 1 > pool_.size()) copy_pool(count + 1);
        if (words > words_.size()) regrow(first_fit(first_word_, words), words);
        reserved_ = (std::max)(reserved_, count);
    }
    void clear() noexcept {
        if (!words_.empty()) std::memset(words_.data(), 0, words_.memory_bytes());
        used_ = 1;
        size_ = 0;
    }

    /// Calls each(id, index) for every id that is present, in increasing id.
    template <class Each>
    void for_each(Each&& each) const {
        for (std::size_t w = 0; w < words_.size(); ++w) {
            std::size_t place = starts_[w];
            for (auto rest = words_[w]; rest != 0; rest &= rest - 1, ++place)
                if (pool_[place] != absent)
                    each(static_cast<Id>(static_cast<unsigned_type>((first_word_ + w) * word_bits +
                                                                    static_cast<unsigned>(std::countr_zero(rest)))),
                         pool_[place]);
        }
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return words_.memory_bytes() + starts_.memory_bytes() + pool_.memory_bytes();
    }
    /// Bounds the tables from here on; what they hold already stays.
    void limit_memory(memory_limit limit) noexcept { limit_ = limit; }
    [[nodiscard]] Allocator get_allocator() const noexcept { return pool_.get_allocator(); }

private:
    using word_buffer = buffer<std::uint64_t, Allocator>;
    using start_buffer = buffer<std::uint32_t, Allocator>;
    using index_buffer = buffer<index_t, Allocator>;

    static constexpr std::size_t word_bits = 64;
    static constexpr std::uint64_t all_words =
        static_cast<std::uint64_t>((std::numeric_limits<Id>::max)()) / word_bits + 1;

    [[nodiscard]] detail::bitmap_window<Id> window() const noexcept {
        return {words_.data(), starts_.data(), words_.size(), first_word_};
    }
    [[nodiscard]] static std::uint64_t word_count_of(std::uint64_t ids) noexcept { return ids / word_bits + 1; }
    // At most 12 * 2^58 + 4 * 2^32: no overflow.
    [[nodiscard]] static std::uint64_t bytes_of(std::uint64_t words, std::uint64_t entries) noexcept {
        return words * (sizeof(std::uint64_t) + sizeof(std::uint32_t)) + entries * sizeof(index_t);
    }
    // The window never reaches past the largest id, so that ids below it and negative ones wrap to words past its end.
    [[nodiscard]] static unsigned_type first_fit(unsigned_type first, std::size_t words) noexcept {
        return static_cast<unsigned_type>((std::min)(std::uint64_t{first}, all_words - words));
    }
    [[nodiscard]] static unsigned_type word_number(Id t) noexcept {
        return static_cast<unsigned_type>(static_cast<unsigned_type>(t) / word_bits);
    }
    void check(const char* member, std::uint64_t words, std::uint64_t entries, std::size_t count,
               std::uint64_t t) const {
        if (limit_.admits(bytes_of(words, entries), count)) return;
        const auto where = std::string("bitmap_storage::") + member;
        limit_.check(where.c_str(), bytes_of(words, entries), count, t,
                     "use flat_storage, whose size does not depend on the range, or raise the limit");
    }

    // Bitmap and pool fit for a rebuild; afterwards nothing throws. What is replaced loses its content.
    void prepare(std::size_t count, id_range<Id> range) {
        if (range.empty()) return;
        const auto first = word_number(range.lowest);
        const std::uint64_t needed = std::uint64_t{word_number(range.highest)} - first + 1;
        check("rebuild", needed, count + 1, count, static_cast<std::uint64_t>(range.highest));
        auto words = static_cast<std::size_t>(needed);
        auto entries = count + 1;
        const bool fits = words <= words_.size() && entries <= pool_.size();
        const auto kept_words = (std::max)(words, static_cast<std::size_t>(word_count_of(reserved_)));
        const auto kept_entries = (std::max)(entries, reserved_ + 1);
        if (limit_.admits(bytes_of(kept_words, kept_entries), (std::max)(count, reserved_))) {
            words = kept_words;
            entries = kept_entries;
        }
        if (!fits) {
            replace(words, entries);
        } else if (words_.size() / 4 > words || pool_.size() / 4 > entries + word_bits ||
                   !limit_.admits(bytes_of(words_.size(), pool_.size()), (std::max)(count, reserved_))) {
            try {
                replace(words, entries);
            } catch (...) {
                // Giving memory back is no reason to fail: what we have is large enough.
            }
        }
        first_word_ = first_fit(first, words_.size());
    }
    void replace(std::size_t words, std::size_t entries) {
        word_buffer fresh_words(words, words_.get_allocator());
        start_buffer fresh_starts(words, starts_.get_allocator());
        index_buffer fresh_pool(entries, pool_.get_allocator());
        std::memset(fresh_words.data(), 0, fresh_words.memory_bytes());
        words_ = std::move(fresh_words);
        starts_ = std::move(fresh_starts);
        pool_ = std::move(fresh_pool);
    }
    // A bitmap of `words` words from `first` on that covers the old one; the answers stay.
    void regrow(unsigned_type first, std::size_t words) {
        word_buffer fresh_words(words, words_.get_allocator());
        start_buffer fresh_starts(words, starts_.get_allocator());
        std::memset(fresh_words.data(), 0, fresh_words.memory_bytes());
        std::memset(fresh_starts.data(), 0, fresh_starts.memory_bytes());
        if (!words_.empty()) {
            const auto shift = static_cast<std::size_t>(first_word_ - first);
            std::memcpy(fresh_words.data() + shift, words_.data(), words_.memory_bytes());
            std::memcpy(fresh_starts.data() + shift, starts_.data(), starts_.memory_bytes());
        }
        words_ = std::move(fresh_words);
        starts_ = std::move(fresh_starts);
        first_word_ = first;
    }
    // The window grows to the id, at least to twice its size, with the slack on the side of the id.
    [[gnu::noinline]] void widen(Id t) {
        const auto wanted = word_number(t);
        if (size_ == 0 && !words_.empty()) {  // nothing to keep: the window moves to the id
            clear();
            first_word_ = first_fit(wanted, words_.size());
            return;
        }
        auto low = std::uint64_t{wanted};
        auto high = std::uint64_t{wanted};
        if (!words_.empty()) {
            low = (std::min)(low, std::uint64_t{first_word_});
            high = (std::max)(high, std::uint64_t{first_word_} + (words_.size() - 1));
        }
        const auto entries = (std::max)(pool_.size(), word_bits);
        check("assign", high - low + 1, entries, size_ + 1, static_cast<std::uint64_t>(t));
        const std::uint64_t doubled = (std::min)(2 * std::uint64_t{words_.size()} + 16, all_words);
        if (doubled > high - low + 1 && limit_.admits(bytes_of(doubled, entries), size_ + 1)) {
            const auto slack = doubled - (high - low + 1);
            if (wanted >= first_word_)
                high += (std::min)(slack, all_words - 1 - high);
            else
                low -= (std::min)(slack, low);
        }
        if (pool_.empty()) copy_pool(entries);
        regrow(static_cast<unsigned_type>(low), static_cast<std::size_t>(high - low) + 1);
    }

    // Sets the bit of an id and makes a place for its index, absent so far.
    [[gnu::noinline]] std::size_t insert_place(Id t) {
        const auto w = static_cast<std::size_t>(window().word_of(t));
        auto old_count = std::size_t{detail::popcount<false>(words_[w])};
        if (used_ + old_count + 1 > pool_.size()) {
            // As much room for moves as there are indices, and at least for one: O(64 + T / N) per id in the mean.
            const std::uint64_t least = std::uint64_t{size_} + 2 + word_bits;
            const std::uint64_t doubled = (std::max)(least + size_, std::uint64_t{reserved_} + 1);
            const auto fits = doubled <= most_entries && limit_.admits(bytes_of(words_.size(), doubled), size_ + 1);
            if (!fits) check("assign", words_.size(), least, size_ + 1, static_cast<std::uint64_t>(t));
            copy_pool(static_cast<std::size_t>(fits ? doubled : least));
            old_count = detail::popcount<false>(words_[w]);
        }
        const auto bit = static_cast<unsigned>(static_cast<unsigned_type>(t) & 63U);
        const auto below = std::size_t{detail::popcount<false>(words_[w] & ((std::uint64_t{1} << bit) - 1))};
        const auto from = std::size_t{starts_[w]};
        const bool is_last = old_count != 0 && from + old_count == used_;
        const auto to = is_last ? from : used_;
        // Backwards: the two blocks may be one.
        for (auto k = old_count; k > below; --k) pool_[to + k] = pool_[from + k - 1];
        pool_[to + below] = absent;
        if (!is_last)
            for (std::size_t k = 0; k < below; ++k) pool_[to + k] = pool_[from + k];
        used_ = to + old_count + 1;
        starts_[w] = static_cast<std::uint32_t>(to);
        words_[w] |= std::uint64_t{1} << bit;
        return to + below;
    }
    // A pool of `entries` with the indices in order and without gaps; erased ids lose their bits. The answers stay.
    void copy_pool(std::size_t entries) {
        index_buffer fresh(entries, pool_.get_allocator());
        fresh[0] = absent;
        std::size_t next = 1;
        for (std::size_t w = 0; w < words_.size(); ++w) {
            std::size_t place = starts_[w];
            starts_[w] = static_cast<std::uint32_t>(next);
            for (auto rest = words_[w]; rest != 0; rest &= rest - 1, ++place) {
                if (pool_[place] == absent)
                    words_[w] &= ~(rest & (~rest + 1));
                else
                    fresh[next++] = pool_[place];
            }
        }
        pool_ = std::move(fresh);
        used_ = next;
    }

    void swap(bitmap_storage& other) noexcept {
        std::swap(limit_, other.limit_);
        words_.swap(other.words_);
        starts_.swap(other.starts_);
        pool_.swap(other.pool_);
        std::swap(first_word_, other.first_word_);
        std::swap(used_, other.used_);
        std::swap(size_, other.size_);
        std::swap(reserved_, other.reserved_);
    }

    static constexpr std::uint64_t most_entries = (std::numeric_limits<std::uint32_t>::max)();

    memory_limit limit_{};
    word_buffer words_{};
    start_buffer starts_{};
    index_buffer pool_{};
    unsigned_type first_word_ = 0;
    std::size_t used_ = 1;
    std::size_t size_ = 0;
    std::size_t reserved_ = 0;
};

static_assert(id_storage<bitmap_storage<>> && batched_lookup<bitmap_storage<>> && prefetchable<bitmap_storage<>>);

}  // namespace tsubu
