// SPDX-License-Identifier: MIT
/// @file
/// What one group of measurements works on: the ids of a rank, and the streams of questions, the same for everyone.
#pragma once

#include "../patterns/id_set.hpp"

#include <tsubu/core/types.hpp>

#include <algorithm>  // std::clamp, std::minmax_element, std::sort
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t, std::uint64_t
#include <numeric>    // std::iota
#include <utility>    // std::swap
#include <vector>     // std::vector

namespace bench {

/// Questions with the places where the oracle finds the answers.
struct question_stream {
    std::vector<id_t> ids;
    std::vector<std::uint32_t> places;
};

struct workload {
    std::vector<id_t> ids;              ///< owned, then ghosts: 15 % new ids and 5 % images, mixed
    std::vector<id_t> after;            ///< the same with 1 % of the entries changed
    std::vector<std::uint32_t> places;  ///< of ids[i] in the oracle's table, a random permutation
    std::size_t different;              ///< number of different ids
    id_t lowest;                        ///< of the ids
    bool fills_range;                   ///< every id from the lowest to the highest is here
    question_stream hit;                ///< every one on the rank, in random order
    question_stream half;               ///< half of them on another rank
    question_stream near;  ///< ascending, but for a jitter of 16 places: partners of particles sorted by id
};

/// At least 2^16 questions, so that no branch predictor knows them by heart; at most 4e6, enough for any cache.
[[nodiscard]] inline std::size_t question_count(std::size_t particles) noexcept {
    return std::clamp(particles, std::size_t{1} << 16, std::size_t{4'000'000});
}

/// Owned as they are, then the ghosts with the images among them. `origin[i]`: which different id ids[i] is.
inline void add_ghosts(workload& work, const id_set& set, std::size_t owned, std::vector<std::uint32_t>& origin,
                       std::uint64_t seed) {
    origin.resize(set.ids.size());
    std::iota(origin.begin(), origin.end(), 0U);
    std::vector<std::uint32_t> ghosts(origin.begin() + static_cast<std::ptrdiff_t>(owned), origin.end());
    tsubu::random_stream random(seed);
    for (std::size_t k = 0; k < image_count(owned); ++k)
        ghosts.push_back(static_cast<std::uint32_t>(random.below(owned)));
    shuffle(ghosts, seed + 1);
    origin.resize(owned);
    origin.insert(origin.end(), ghosts.begin(), ghosts.end());
    for (const auto k : origin) work.ids.push_back(set.ids[k]);
}

/// 1 % of the entries change: half a per cent of pairs of particles swap their places.
[[nodiscard]] inline std::vector<id_t> with_changes(std::vector<id_t> ids, std::uint64_t seed) {
    tsubu::random_stream random(seed);
    for (std::size_t k = 0; k < ids.size() / 200; ++k)
        std::swap(ids[random.below(ids.size())], ids[random.below(ids.size())]);
    return ids;
}

/// Rounds over all different ids, each in another random order.
[[nodiscard]] inline question_stream ask_all(const id_set& set, const std::vector<std::uint32_t>& place_of,
                                             std::size_t count, std::uint64_t seed) {
    question_stream stream;
    while (stream.ids.size() < count) {
        const random_permutation order(set.ids.size(), seed++);
        for (std::size_t k = 0; k < set.ids.size() && stream.ids.size() < count; ++k) {
            const auto which = order(k);
            stream.ids.push_back(set.ids[which]);
            stream.places.push_back(place_of[which]);
        }
    }
    return stream;
}

/// A random half of the questions becomes one for an id of another rank (its place: as random as the others).
inline void miss_half(question_stream& stream, const id_set& set, std::uint64_t seed) {
    tsubu::random_stream random(seed);
    for (auto& id : stream.ids)
        if (random() >> 63 != 0) id = set.elsewhere[random.below(set.elsewhere.size())];
}

[[nodiscard]] inline question_stream ask_nearby(const id_set& set, const std::vector<std::uint32_t>& place_of,
                                                std::size_t count, std::uint64_t seed) {
    std::vector<std::uint32_t> sorted(set.ids.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return set.ids[a] < set.ids[b]; });
    tsubu::random_stream random(seed);
    question_stream stream;
    for (std::size_t k = 0; k < count; ++k) {
        const auto which = sorted[(k + random.below(33)) % sorted.size()];
        stream.ids.push_back(set.ids[which]);
        stream.places.push_back(place_of[which]);
    }
    return stream;
}

[[nodiscard]] inline workload make_workload(const id_set& set, std::size_t owned, std::uint64_t seed) {
    workload work;
    work.different = set.ids.size();
    std::vector<std::uint32_t> origin;
    add_ghosts(work, set, owned, origin, seed);
    work.after = with_changes(work.ids, seed + 2);

    std::vector<std::uint32_t> place_of(set.ids.size());
    std::iota(place_of.begin(), place_of.end(), 0U);
    shuffle(place_of, seed + 3);
    for (const auto k : origin) work.places.push_back(place_of[k]);

    const auto [lowest, highest] = std::minmax_element(set.ids.begin(), set.ids.end());
    work.lowest = *lowest;
    work.fills_range = static_cast<std::size_t>(*highest - *lowest) < set.ids.size();

    const auto count = question_count(work.ids.size());
    work.hit = ask_all(set, place_of, count, seed + 4);
    work.half = ask_all(set, place_of, count, seed + 104);
    miss_half(work.half, set, seed + 5);
    work.near = ask_nearby(set, place_of, count, seed + 6);
    return work;
}

}  // namespace bench
