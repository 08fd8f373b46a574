// SPDX-License-Identifier: MIT
/// @file
/// parcel and mailbox: words for a rank, and what came from ranks.
#pragma once

#include <tsubu/comm/message_memory.hpp>
#include <tsubu/core/types.hpp>

#include <algorithm>  // std::copy_n, std::sort
#include <cstddef>    // std::ptrdiff_t, std::size_t
#include <cstdint>    // std::uint64_t
#include <span>       // std::span
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu {

/// Words to a rank, or from one; a view.
struct parcel {
    rank_t rank;
    std::span<const std::uint64_t> words;
};

/// What came from ranks, this one included.
///
///     for (const auto& [rank, words] : on.exchange(parcels, {})) ...
class mailbox {
public:
    mailbox() = default;
    mailbox(mailbox&&) noexcept = default;
    mailbox& operator=(mailbox&&) noexcept = default;
    /// @param from  what its words lie in
    explicit mailbox(message_memory from) noexcept : memory_(std::move(from)) {}

    [[nodiscard]] std::size_t size() const noexcept { return letters_.size(); }
    [[nodiscard]] bool empty() const noexcept { return letters_.empty(); }
    [[nodiscard]] parcel operator[](std::size_t k) const& noexcept {
        const auto& one = letters_[k];
        return {one.from, {one.words.data(), one.words.size()}};
    }
    void operator[](std::size_t) const&& = delete;  // its words would be gone
    /// Of all parcels.
    [[nodiscard]] std::size_t words() const noexcept {
        std::size_t sum = 0;
        for (const auto& one : letters_) sum += one.words.size();
        return sum;
    }

    /// From message to message, in the order of their senders.
    class iterator {
    public:
        using value_type = parcel;
        using difference_type = std::ptrdiff_t;
        iterator() = default;
        iterator(const mailbox& of, std::size_t at) noexcept : of_(&of), at_(at) {}
        parcel operator*() const noexcept { return (*of_)[at_]; }
        iterator& operator++() noexcept {
            ++at_;
            return *this;
        }
        iterator operator++(int) noexcept {
            const auto before = *this;
            ++at_;
            return before;
        }
        friend bool operator==(const iterator& a, const iterator& b) noexcept { return a.at_ == b.at_; }

    private:
        const mailbox* of_ = nullptr;
        std::size_t at_ = 0;
    };
    [[nodiscard]] iterator begin() const noexcept { return {*this, 0}; }
    [[nodiscard]] iterator end() const noexcept { return {*this, size()}; }

    /// For transports: room for a parcel, to be filled. It stays where it is until the mailbox ends.
    [[nodiscard]] std::span<std::uint64_t> add(rank_t from, std::size_t words) {
        add(from, memory_.take<std::uint64_t>(words));
        return {letters_.back().words.data(), words};
    }
    void add(rank_t from, message_memory::array<std::uint64_t>&& words) {
        letters_.push_back({from, letters_.size(), std::move(words)});
    }
    /// A parcel with these words.
    void add(const parcel& one) {
        const auto room = add(one.rank, one.words.size());
        std::copy_n(one.words.data(), one.words.size(), room.data());
    }
    /// The words of a parcel, which has none then.
    [[nodiscard]] message_memory::array<std::uint64_t> take(std::size_t k) noexcept {
        return std::move(letters_[k].words);
    }
    /// Copies the words of parcel k from here.
    void fill(std::size_t k, const std::uint64_t* from) noexcept {
        std::copy_n(from, letters_[k].words.size(), letters_[k].words.data());
    }
    /// By rank of the sender; those of one sender stay in their order.
    void sort() {
        std::sort(letters_.begin(), letters_.end(), [](const letter& a, const letter& b) {
            return a.from != b.from ? a.from < b.from : a.number < b.number;
        });
    }

private:
    struct letter {
        rank_t from;
        std::size_t number;  // in the order of arrival
        message_memory::array<std::uint64_t> words;
    };

    message_memory memory_{nullptr};
    std::vector<letter> letters_;
};

}  // namespace tsubu
