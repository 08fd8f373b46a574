// SPDX-License-Identifier: MIT
/// @file
/// Questions about ids, each to the rank that is its home, and the answers.
#pragma once

#include <tsubu/comm/mailbox.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <span>     // std::span
#include <vector>   // std::vector

namespace tsubu::detail {

/// The rank that knows of an id: about as many ids for each, whatever they look like.
template <particle_id Id>
[[nodiscard]] constexpr rank_t home_of(Id t, std::size_t ranks) noexcept {
    return static_cast<rank_t>(splitmix64(static_cast<std::uint64_t>(t)) % ranks);
}

/// Ids of this rank, grouped by their homes.
class home_calls {
public:
    home_calls() = default;
    /// @param home  home(t) is the rank that id t goes to
    template <particle_id Id, class Home>
    home_calls(std::span<const Id> ids, std::size_t ranks, Home&& home) : words_(ids.size()), place_(ids.size()) {
        std::vector<rank_t> homes(ids.size());
        begins_.assign(ranks + 1, 0);
        for (std::size_t k = 0; k < ids.size(); ++k) ++begins_[(homes[k] = home(ids[k])) + 1];
        for (std::size_t r = 0; r < ranks; ++r) begins_[r + 1] += begins_[r];
        auto next = begins_;
        for (std::size_t k = 0; k < ids.size(); ++k) {
            place_[k] = next[homes[k]]++;
            words_[place_[k]] = static_cast<std::uint64_t>(ids[k]);
        }
    }
    void add_parcels(std::vector<parcel>& parcels) const {
        for (std::size_t r = 0; r + 1 < begins_.size(); ++r)
            if (begins_[r + 1] != begins_[r])
                parcels.push_back({static_cast<rank_t>(r),
                                   std::span(words_).subspan(begins_[r], begins_[r + 1] - begins_[r])});
    }
    /// The answers of the homes, a word for each id, in the order in which the ids were given.
    [[nodiscard]] std::vector<std::uint64_t> answers(const mailbox& came) const {
        std::vector<std::uint64_t> by_home;
        by_home.reserve(words_.size());
        for (const auto& [from, words] : came) by_home.insert(by_home.end(), words.begin(), words.end());
        std::vector<std::uint64_t> result(words_.size());
        for (std::size_t k = 0; k < result.size(); ++k) result[k] = by_home[place_[k]];
        return result;
    }

private:
    std::vector<std::uint64_t> words_;  // the ids, home by home
    std::vector<std::size_t> place_;    // of each id in words_
    std::vector<std::size_t> begins_;   // of each home in words_ [ranks + 1]
};

/// Answers to each of the questions that have come, to be sent back: answer(id) is one word.
class home_answers {
public:
    home_answers() = default;
    template <class Answer>
    home_answers(const mailbox& asked, Answer&& answer) {
        for (const auto& [from, ids] : asked) {
            auto& words = answers_.emplace_back();
            words.reserve(ids.size());
            for (const auto t : ids) words.push_back(answer(t));
            to_.push_back(from);
        }
    }
    void add_parcels(std::vector<parcel>& parcels) const {
        for (std::size_t k = 0; k < to_.size(); ++k) parcels.push_back({to_[k], answers_[k]});
    }

private:
    std::vector<rank_t> to_;
    std::vector<std::vector<std::uint64_t>> answers_;
};

}  // namespace tsubu::detail
