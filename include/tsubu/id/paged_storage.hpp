// SPDX-License-Identifier: MIT
/// @file
/// paged_storage: a directory of pages, with memory only for the pages where ids are.
#pragma once

#include <tsubu/core/buffer.hpp>
#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>
#include <tsubu/id/detail/fill_absent.hpp>
#include <tsubu/id/detail/gather.hpp>
#include <tsubu/id/id_range.hpp>
#include <tsubu/id/memory_limit.hpp>

#include <algorithm>  // std::min, std::max
#include <cstddef>    // std::byte, std::size_t
#include <cstdint>    // std::int64_t, std::uint32_t, std::uint64_t
#include <cstring>    // std::memcpy, std::memset
#include <limits>     // std::numeric_limits
#include <memory>     // std::allocator
#include <span>       // std::span
#include <string>     // std::string
#include <utility>    // std::exchange, std::move, std::swap

namespace tsubu {

//     directory_   [ 1 ][ 0 ][ 0 ][ 3 ][ 2 ]        of page first_ + k: its number in the pool, 0 if it has no ids
//     pool_        [ absent ... | page 1 | page 2 | page 3 | unused ]
//     places_      [ -          | 0      | 4      | 3      | ]           where in the directory each page stands
//
// Page 0 is always empty, so a look-up has two loads and no question between them. places_ lets a rebuild take its
// marks out of the directory without a pass over it: it costs O(N + pages), however long the directory.

/// Options of paged_storage.
struct paged_options {
    unsigned page_bits = 10;  ///< 2^page_bits ids per page: 10 makes a page of 4 KiB, a page of memory
    friend constexpr bool operator==(const paged_options&, const paged_options&) = default;
};

/// A directory of pages, with memory only for the pages where ids are.
///
///     tsubu::id_map<tsubu::paged_storage<>> where;
///
/// Concept:       id_storage, batched_lookup (AVX2, AVX-512), prefetchable.
/// Cost:          find two dependent loads; rebuild O(N + pages), O(N + T / 1024) when the directory grows; erase
///                O(1); assign O(1) in a page that exists, else amortised O(page).
/// Bytes per id:  4 x 1024 x pages / N + 4 x T / 1024 / N: 4 to 5 for full blocks, up to 4096 for random ids.
/// Growth:        directory and pool at least double, within the memory limit; a rebuild that needs less than a
///                quarter gives memory back.
/// Deterministic: yes.
/// Choose it when ids come in blocks of some hundreds or more, far apart: ids that ranks or inserters hand out in runs.
/// Do not when    ids are random in a wide range: nearly every id would own a page.
/// Source:        A1, A4; EnTT's sparse set pages the same way.
template <particle_id Id = std::int64_t, class Allocator = std::allocator<std::byte>,
          paged_options Options = paged_options{}>
class paged_storage {
    static_assert(Options.page_bits >= 4 && Options.page_bits <= 20, "a page has 2^4 to 2^20 entries");
    using unsigned_type = detail::unsigned_id<Id>;

public:
    using id_type = Id;
    using allocator_type = Allocator;

    paged_storage() = default;
    explicit paged_storage(memory_limit limit, const Allocator& allocator = {})
        : limit_(limit), directory_(allocator), places_(allocator), pool_(allocator) {}
    explicit paged_storage(const Allocator& allocator) : paged_storage(memory_limit{}, allocator) {}

    paged_storage(const paged_storage&) = default;
    paged_storage(paged_storage&& other) noexcept
        : limit_(other.limit_),
          directory_(std::move(other.directory_)),
          places_(std::move(other.places_)),
          pool_(std::move(other.pool_)),
          first_(other.first_),
          used_(std::exchange(other.used_, 1)),
          size_(std::exchange(other.size_, 0)),
          reserved_(std::exchange(other.reserved_, 0)) {}
    paged_storage& operator=(paged_storage other) noexcept {
        swap(other);
        return *this;
    }
    ~paged_storage() = default;

    [[nodiscard]] index_t find(Id t) const noexcept {
        const std::uint64_t place = place_of(t);
        return place < directory_.size() ? pool_[entry_of(directory_[static_cast<std::size_t>(place)], t)] : absent;
    }
    void find(std::span<const Id> ids, std::span<index_t> out) const noexcept {
        detail::gather(best_instruction_set(),
                       detail::paged_window<Id>{directory_.data(), directory_.size(), first_, Options.page_bits,
                                                pool_.data()},
                       ids.data(), out.data(), ids.size());
    }
    /// Loads the directory, which is small, to know which entry to fetch.
    void prefetch(Id t) const noexcept {
        if (const std::uint64_t place = place_of(t); place < directory_.size())
            detail::prefetch(pool_.data() + entry_of(directory_[static_cast<std::size_t>(place)], t));
    }

    /// @throws limit_error if directory and pages need more than the memory limit. Strong guarantee.
    void rebuild(std::span<const Id> ids, id_range<Id> range, std::span<index_t> links) {
        if (ids.empty()) return clear();
        prepare(ids, range);
        // The pages of the ids are marked; each gets its memory when the scan first meets it.
        used_ = 1;
        size_ = 0;
        std::size_t repeated = 0;
        for (std::size_t i = ids.size(); i-- > 0;) {
            const auto place = static_cast<std::size_t>(place_of(ids[i]));
            if (directory_[place] == marked) take_page(place);
            const index_t next = std::exchange(pool_[entry_of(directory_[place], ids[i])], static_cast<index_t>(i));
            if (!links.empty()) links[i] = next;
            repeated += next != absent ? 1U : 0U;
        }
        size_ = ids.size() - repeated;
    }

    /// @throws limit_error if directory or pages would pass the memory limit. Strong guarantee.
    void assign(Id t, index_t index) {
        if (place_of(t) >= directory_.size()) widen(t);
        const auto place = static_cast<std::size_t>(place_of(t));
        if (directory_[place] == 0) {
            if (used_ == page_count()) grow_pool(t);
            take_page(place);
        }
        if (std::exchange(pool_[entry_of(directory_[place], t)], index) == absent) ++size_;
    }
    /// The page stays until the next rebuild.
    bool erase(Id t) noexcept {
        const std::uint64_t place = place_of(t);
        if (place >= directory_.size()) return false;
        // An entry of page 0 is absent and stays so.
        auto& entry = pool_[entry_of(directory_[static_cast<std::size_t>(place)], t)];
        if (entry == absent) return false;
        entry = absent;
        --size_;
        return true;
    }

    /// Pages for `count` ids without gaps; how many a rebuild needs depends on the ids.
    /// @throws limit_error if they pass the memory limit. Strong guarantee.
    void reserve(std::size_t count) {
        const auto pages = static_cast<std::size_t>(count >> Options.page_bits) + 3;  // both ends, and page 0
        const auto reachable = static_cast<std::size_t>((std::min)(std::uint64_t{pages}, all_pages));
        const auto places = (std::max)(directory_.size(), reachable);
        const auto t = count == 0 ? 0 : count - 1;
        check("reserve", places, (std::max)(pages, page_count()), count, t);
        if (pages > page_count()) regrow_pool(pages);
        if (places > directory_.size()) regrow_directory(first_fit(first_, places), places);
        reserved_ = (std::max)(reserved_, pages);
    }
    void clear() noexcept {
        unmark();
        used_ = 1;
        size_ = 0;
    }

    /// Calls each(id, index) for every id that is present, page by page.
    template <class Each>
    void for_each(Each&& each) const {
        for (std::size_t page = 1; page < used_; ++page)
            for (std::size_t k = 0; k < page_size; ++k)
                if (const index_t index = pool_[(page << Options.page_bits) + k]; index != absent)
                    each(static_cast<Id>(
                             static_cast<unsigned_type>(((first_ + places_[page]) << Options.page_bits) + k)),
                         index);
    }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return directory_.memory_bytes() + places_.memory_bytes() + pool_.memory_bytes();
    }
    /// Bounds the tables from here on; what they hold already stays.
    void limit_memory(memory_limit limit) noexcept { limit_ = limit; }
    [[nodiscard]] Allocator get_allocator() const noexcept { return pool_.get_allocator(); }

    /// Pages that hold ids, or held some since the last rebuild.
    [[nodiscard]] std::size_t used_pages() const noexcept { return used_ - 1; }

private:
    using number_buffer = buffer<std::uint32_t, Allocator>;
    using place_buffer = buffer<std::size_t, Allocator>;
    using index_buffer = buffer<index_t, Allocator>;

    static constexpr std::size_t page_size = std::size_t{1} << Options.page_bits;
    static constexpr std::uint64_t all_pages =
        static_cast<std::uint64_t>((std::numeric_limits<Id>::max)()) / page_size + 1;
    static constexpr std::size_t least_shrunk = 1024;           // places: less is not worth giving back
    static constexpr std::uint32_t marked = ~std::uint32_t{0};  // has ids, but no memory yet

    [[nodiscard]] static unsigned_type page_number(Id t) noexcept {
        return static_cast<unsigned_type>(static_cast<unsigned_type>(t) >> Options.page_bits);
    }
    // The directory never reaches past the largest id, so ids below it and negative ones wrap to places past its end.
    [[nodiscard]] std::uint64_t place_of(Id t) const noexcept {
        return static_cast<unsigned_type>(page_number(t) - first_);
    }
    [[nodiscard]] static std::size_t entry_of(std::uint32_t page, Id t) noexcept {
        return (std::size_t{page} << Options.page_bits) |
               static_cast<std::size_t>(static_cast<unsigned_type>(t) & (page_size - 1));
    }
    [[nodiscard]] static unsigned_type first_fit(unsigned_type first, std::size_t places) noexcept {
        return static_cast<unsigned_type>((std::min)(std::uint64_t{first}, all_pages - places));
    }
    [[nodiscard]] std::size_t page_count() const noexcept { return places_.size(); }

    // places <= 2^60, pages < 2^33 and a page at most 2^22 bytes: no overflow.
    [[nodiscard]] static std::uint64_t bytes_of(std::uint64_t places, std::uint64_t pages) noexcept {
        return places * sizeof(std::uint32_t) + pages * (page_size * sizeof(index_t) + sizeof(std::size_t));
    }
    void check(const char* member, std::uint64_t places, std::uint64_t pages, std::size_t count,
               std::uint64_t t) const {
        if (limit_.admits(bytes_of(places, pages), count)) return;
        const auto where = std::string("paged_storage::") + member;
        limit_.check(where.c_str(), bytes_of(places, pages), count, t,
                     "use flat_storage, whose size does not depend on the range, or raise the limit");
    }

    // Precondition: used_ < page_count().
    void take_page(std::size_t place) noexcept {
        detail::fill_absent(pool_.data() + (used_ << Options.page_bits), page_size);
        places_[used_] = place;
        directory_[place] = static_cast<std::uint32_t>(used_++);
    }
    void unmark() noexcept {
        for (std::size_t page = 1; page < used_; ++page) directory_[places_[page]] = 0;
    }

    // Marks the pages of the ids in the directory and makes room for them. Afterwards nothing throws.
    void prepare(std::span<const Id> ids, id_range<Id> range) {
        const auto first = page_number(range.lowest);
        const std::uint64_t needed = std::uint64_t{page_number(range.highest)} - first + 1;
        const auto highest = static_cast<std::uint64_t>(range.highest);
        check("rebuild", needed, 2, ids.size(), highest);
        const auto places = static_cast<std::size_t>(needed);
        number_buffer directory(directory_.get_allocator());
        if (places > directory_.size()) {
            directory = blank_directory(places);
        } else if (directory_.size() / 4 > (std::max)(places, reserved_ + least_shrunk) ||
                   (directory_.size() > places && !limit_.admits(bytes_of(directory_.size(), 2), ids.size()))) {
            try {
                directory = blank_directory(places);
            } catch (...) {
                // Giving memory back is no reason to fail: the directory that we have is large enough.
            }
        }
        if (!directory.empty()) {
            const auto pages = mark(directory, first, ids) + 1;
            check("rebuild", needed, pages, ids.size(), highest);
            fit_pool(pages, places, ids.size());
            directory_ = std::move(directory);
            first_ = first;
            return;
        }
        // The old marks are taken out first, because only the marked directory tells how many pages there will be;
        // if these cannot be had, it is put back as it was.
        const auto old_first = first_;
        unmark();
        first_ = first_fit(first, directory_.size());
        const auto pages = mark(directory_, first_, ids) + 1;
        try {
            check("rebuild", needed, pages, ids.size(), highest);
            fit_pool(pages, directory_.size(), ids.size());
        } catch (...) {
            for (const auto t : ids) directory_[static_cast<std::size_t>(place_of(t))] = 0;
            first_ = old_first;
            for (std::size_t page = 1; page < used_; ++page)
                directory_[places_[page]] = static_cast<std::uint32_t>(page);
            throw;
        }
    }
    // Number of different pages.
    [[nodiscard]] static std::size_t mark(number_buffer& directory, unsigned_type first,
                                          std::span<const Id> ids) noexcept {
        std::size_t pages = 0;
        for (const auto t : ids) {
            const auto place = static_cast<std::size_t>(static_cast<unsigned_type>(page_number(t) - first));
            pages += directory[place] == 0 ? 1U : 0U;
            directory[place] = marked;
        }
        return pages;
    }
    // At least `pages`, and not many more; the content is lost if the pool is replaced.
    void fit_pool(std::size_t pages, std::size_t places, std::size_t count) {
        if (pages > page_count()) return replace_pool(pages);
        if (page_count() / 4 > (std::max)(pages, reserved_) ||
            (page_count() > pages && !limit_.admits(bytes_of(places, page_count()), count))) {
            try {
                replace_pool(pages);
            } catch (...) {
                // Here as well: the pool that we have is large enough.
            }
        }
    }
    [[nodiscard]] number_buffer blank_directory(std::size_t places) const {
        number_buffer fresh(places, directory_.get_allocator());
        std::memset(fresh.data(), 0, fresh.memory_bytes());
        return fresh;
    }
    // The content is lost, but for page 0.
    void replace_pool(std::size_t pages) {
        place_buffer fresh_places(pages, places_.get_allocator());
        index_buffer fresh_pool(pages << Options.page_bits, pool_.get_allocator());
        detail::fill_absent(fresh_pool.data(), page_size);
        places_ = std::move(fresh_places);
        pool_ = std::move(fresh_pool);
    }
    // The answers stay.
    void regrow_pool(std::size_t pages) {
        place_buffer fresh_places(pages, places_.get_allocator());
        index_buffer fresh_pool(pages << Options.page_bits, pool_.get_allocator());
        detail::fill_absent(fresh_pool.data(), page_size);
        if (used_ > 1) {
            std::memcpy(fresh_places.data(), places_.data(), used_ * sizeof(std::size_t));
            std::memcpy(fresh_pool.data(), pool_.data(), (used_ << Options.page_bits) * sizeof(index_t));
        }
        places_ = std::move(fresh_places);
        pool_ = std::move(fresh_pool);
    }
    void regrow_directory(unsigned_type first, std::size_t places) {
        auto fresh = blank_directory(places);
        const auto shift = static_cast<std::size_t>(static_cast<unsigned_type>(first_ - first));
        for (std::size_t page = 1; page < used_; ++page) {
            places_[page] += shift;
            fresh[places_[page]] = static_cast<std::uint32_t>(page);
        }
        directory_ = std::move(fresh);
        first_ = first;
    }
    [[gnu::noinline]] void grow_pool(Id t) {
        const std::uint64_t least = used_ + 1;
        const std::uint64_t doubled = 2 * std::uint64_t{used_};
        const bool fits = limit_.admits(bytes_of(directory_.size(), doubled), size_ + 1);
        if (!fits) check("assign", directory_.size(), least, size_ + 1, static_cast<std::uint64_t>(t));
        regrow_pool(static_cast<std::size_t>(fits ? doubled : least));
    }
    // The directory grows to the id, at least to twice its size, with the slack on the side of the id.
    [[gnu::noinline]] void widen(Id t) {
        const auto wanted = page_number(t);
        if (size_ == 0 && !directory_.empty()) {  // nothing to keep: the window moves to the id
            clear();
            first_ = first_fit(wanted, directory_.size());
            return;
        }
        auto low = std::uint64_t{wanted};
        auto high = std::uint64_t{wanted};
        if (!directory_.empty()) {
            low = (std::min)(low, std::uint64_t{first_});
            high = (std::max)(high, std::uint64_t{first_} + (directory_.size() - 1));
        }
        const auto pages = (std::max)(page_count(), std::size_t{2});
        check("assign", high - low + 1, pages, size_ + 1, static_cast<std::uint64_t>(t));
        const std::uint64_t doubled = (std::min)(2 * std::uint64_t{directory_.size()} + 16, all_pages);
        if (doubled > high - low + 1 && limit_.admits(bytes_of(doubled, pages), size_ + 1)) {
            const auto slack = doubled - (high - low + 1);
            if (wanted >= first_)
                high += (std::min)(slack, all_pages - 1 - high);
            else
                low -= (std::min)(slack, low);
        }
        if (page_count() == 0) regrow_pool(pages);  // a directory needs its page 0
        regrow_directory(static_cast<unsigned_type>(low), static_cast<std::size_t>(high - low) + 1);
    }

    void swap(paged_storage& other) noexcept {
        std::swap(limit_, other.limit_);
        directory_.swap(other.directory_);
        places_.swap(other.places_);
        pool_.swap(other.pool_);
        std::swap(first_, other.first_);
        std::swap(used_, other.used_);
        std::swap(size_, other.size_);
        std::swap(reserved_, other.reserved_);
    }

    memory_limit limit_{};
    number_buffer directory_{};
    place_buffer places_{};
    index_buffer pool_{};
    unsigned_type first_ = 0;
    std::size_t used_ = 1;  // pages taken, page 0 among them
    std::size_t size_ = 0;
    std::size_t reserved_ = 0;  // pages
};

static_assert(id_storage<paged_storage<>> && batched_lookup<paged_storage<>> && prefetchable<paged_storage<>>);

}  // namespace tsubu
