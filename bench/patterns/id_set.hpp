// SPDX-License-Identifier: MIT
/// @file
/// The ids that one rank holds, and how to draw them.
#pragma once

#include <tsubu/core/random.hpp>

#include <algorithm>  // std::sort, std::unique, std::binary_search
#include <bit>        // std::bit_width
#include <cmath>      // std::log
#include <cstddef>    // std::size_t
#include <cstdint>    // std::int64_t
#include <utility>    // std::swap
#include <vector>     // std::vector

namespace bench {

using id_t = std::int64_t;

/// Different ids of one rank: first those of its owned particles in the order of their indices, then those that
/// its ghosts bring in. `elsewhere` are ids of particles on other ranks, to be asked for in vain.
struct id_set {
    std::vector<id_t> ids;
    std::vector<id_t> elsewhere;
};

/// Ghosts with ids that the rank does not own: 15 % of the owned. Another 5 % are images of owned particles.
[[nodiscard]] constexpr std::size_t different_ids(std::size_t owned) noexcept { return owned + owned * 15 / 100; }
[[nodiscard]] constexpr std::size_t image_count(std::size_t owned) noexcept { return owned * 5 / 100; }

/// A pseudo-random permutation of [0, size) that needs no memory.
///
/// Rounds of odd multiplications and xor-shifts are a bijection of W-bit words; a word >= size is sent round again.
class random_permutation {
public:
    random_permutation(std::uint64_t size, std::uint64_t seed) noexcept
        : size_(size), bits_(static_cast<unsigned>(std::bit_width(size > 1 ? size - 1 : 1))) {
        tsubu::random_stream random(seed);
        for (auto& m : multiplier_) m = random() | 1;
        for (auto& a : addend_) a = random();
    }
    [[nodiscard]] std::uint64_t operator()(std::uint64_t k) const noexcept {
        const std::uint64_t mask = ~std::uint64_t{0} >> (64 - bits_);
        do {
            for (int round = 0; round < rounds; ++round) {
                k = (k * multiplier_[round] + addend_[round]) & mask;
                k ^= k >> (bits_ / 2 + 1);
            }
        } while (k >= size_);
        return k;
    }

private:
    static constexpr int rounds = 4;  // with 3, neighbours are still correlated for W < 16
    std::uint64_t size_;
    unsigned bits_;
    std::uint64_t multiplier_[rounds];
    std::uint64_t addend_[rounds];
};

template <class Value>
void shuffle(std::vector<Value>& values, std::uint64_t seed) {
    tsubu::random_stream random(seed);
    for (std::size_t k = values.size(); k > 1; --k) std::swap(values[k - 1], values[random.below(k)]);
}

/// `count` different ids, shuffled, each from draw(random); where the law is so crowded that draws repeat
/// themselves for long, the lowest free ids fill up.
template <class Draw>
[[nodiscard]] std::vector<id_t> distinct(std::size_t count, std::uint64_t seed, Draw&& draw) {
    tsubu::random_stream random(seed);
    std::vector<id_t> found;
    for (int round = 0; round < 24 && found.size() < count; ++round) {
        const std::size_t missing = count - found.size();
        for (std::size_t k = 0; k < missing + missing / 8 + 16; ++k) found.push_back(draw(random));
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
    }
    const std::size_t drawn = found.size();
    for (id_t id = 1; found.size() < count; ++id)
        if (!std::binary_search(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(drawn), id))
            found.push_back(id);
    shuffle(found, seed + 1);
    found.resize(count);
    return found;
}

/// Ids within the range of these that are not among them; beyond it if the range is all but full.
[[nodiscard]] inline std::vector<id_t> gaps_between(const std::vector<id_t>& ids, std::size_t count,
                                                    std::uint64_t seed) {
    auto sorted = ids;
    std::sort(sorted.begin(), sorted.end());
    const auto lowest = static_cast<std::uint64_t>(sorted.front());
    const std::uint64_t extent = static_cast<std::uint64_t>(sorted.back()) - lowest + 1;
    const bool crowded = extent < 2 * sorted.size();
    tsubu::random_stream random(seed);
    std::vector<id_t> found;
    while (found.size() < count) {
        const auto id = static_cast<id_t>(lowest + random.below(extent) + (crowded ? extent : 0));
        if (!std::binary_search(sorted.begin(), sorted.end(), id)) found.push_back(id);
    }
    return found;
}

/// -log(u) / rate: the age of a particle whose chance to leave is the same at any age.
[[nodiscard]] inline double exponential(tsubu::random_stream& random, double mean) {
    return -mean * std::log(1.0 - random.unit());
}

}  // namespace bench
