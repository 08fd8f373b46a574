// SPDX-License-Identifier: MIT
/// @file
/// Which other copies of this particle are on this rank? The chain from each index to the next with the same id.
///
///     index      0    1    2    3    4          particle 5 is owned (1), particle 9 as well (0);
///     id         9    5    9    5    5          2, 3 and 4 are ghosts
///     links      2    3   -1    4   -1          images(find(5)): 1, 3, 4
///
/// It is critical that links only ever point upwards: then no chain can be a cycle, whatever was left in memory.
#pragma once

#include <tsubu/core/expects.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/id/concepts.hpp>

#include <cstddef>   // std::ptrdiff_t, std::size_t
#include <iterator>  // std::default_sentinel_t, std::forward_iterator_tag
#include <span>      // std::span
#include <vector>    // std::vector

namespace tsubu {

template <id_storage Storage>
class id_map;

/// The copies of one particle, in increasing index; a forward range of index_t.
/// Invalidates: lives as long as the same_id_links it came from is neither rebuilt nor destroyed.
class image_range {
public:
    /// From copy to copy, the lowest index first.
    class iterator {
    public:
        using value_type = index_t;
        using difference_type = std::ptrdiff_t;
        using iterator_category = std::forward_iterator_tag;

        iterator() = default;
        iterator(const index_t* links, index_t at) noexcept : links_(links), at_(at) {}
        [[nodiscard]] index_t operator*() const noexcept { return at_; }
        iterator& operator++() noexcept {
            at_ = links_[at_];
            return *this;
        }
        iterator operator++(int) noexcept {
            auto before = *this;
            ++*this;
            return before;
        }
        friend bool operator==(const iterator& a, const iterator& b) noexcept { return a.at_ == b.at_; }
        friend bool operator==(const iterator& a, std::default_sentinel_t) noexcept { return a.at_ == absent; }

    private:
        const index_t* links_ = nullptr;
        index_t at_ = absent;
    };

    image_range(const index_t* links, index_t first) noexcept : first_(links, first) {}
    [[nodiscard]] iterator begin() const noexcept { return first_; }
    [[nodiscard]] static std::default_sentinel_t end() noexcept { return {}; }
    [[nodiscard]] bool empty() const noexcept { return first_ == end(); }

private:
    iterator first_;
};

/// Which other copies of this particle are on this rank?
///
///     tsubu::same_id_links same;
///     where.rebuild(ids, same);
///     for (auto k : same.images(where.find(42))) ...   // every copy of 42, lowest index first
///
/// Written only by id_map::rebuild and id_map::update; the memory is kept between rebuilds.
///
/// Invariant:  next(i) is the lowest j > i with the same id, else absent.
/// Complexity: 4 bytes per particle; next O(1), images O(number of copies).
/// Threads:    many readers or one writer.
/// Source:     A13.
class same_id_links {
public:
    /// The next copy after `index`, or absent. Precondition: 0 <= index < size().
    [[nodiscard]] index_t next(index_t index) const noexcept {
        TSUBU_EXPECTS(index >= 0 && static_cast<std::size_t>(index) < links_.size(),
                      "same_id_links::next: no such index; rebuild the links with the ids");
        return links_[static_cast<std::size_t>(index)];
    }
    /// Every copy from `first` on; from find(id): all of them. Empty for absent.
    [[nodiscard]] image_range images(index_t first) const noexcept {
        TSUBU_EXPECTS(first == absent || static_cast<std::size_t>(first) < links_.size(),
                      "same_id_links::images: no such index; rebuild the links with the ids");
        return {links_.data(), first};
    }
    /// next(i) for every index i.
    [[nodiscard]] std::span<const index_t> links() const noexcept { return {links_.data(), links_.size()}; }
    [[nodiscard]] std::size_t size() const noexcept { return links_.size(); }
    [[nodiscard]] std::size_t memory_bytes() const noexcept { return links_.capacity() * sizeof(index_t); }

private:
    template <id_storage Storage>
    friend class id_map;

    std::vector<index_t> links_;
};

}  // namespace tsubu
