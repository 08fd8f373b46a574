// SPDX-License-Identifier: MIT
/// @file
/// Ids as simulations make them. Each pattern: (owned particles N, T/N, seed) -> the ids of one rank.
///
/// T is the range of the ids, N here the number of different ids on the rank. Particles lie in memory sorted in
/// space, so ids come in random order; only on a fresh lattice are the two orders the same.
#pragma once

#include "id_set.hpp"

#include <tsubu/id/prime.hpp>
#include <tsubu/id/sizing.hpp>

#include <algorithm>  // std::max, std::min
#include <cmath>      // std::abs, std::cbrt, std::sqrt
#include <cstddef>    // std::ptrdiff_t, std::size_t
#include <cstdint>    // std::uint64_t
#include <utility>    // std::move
#include <vector>     // std::vector

namespace bench {

/// No structure at all: N out of T, each as likely as any other.
[[nodiscard]] inline id_set uniform(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    const auto count = different_ids(owned);
    const random_permutation place(ratio * count, seed);
    id_set set;
    for (std::size_t k = 0; k < count; ++k) set.ids.push_back(static_cast<id_t>(place(k)) + 1);
    for (std::size_t k = count; k < 2 * count; ++k)
        set.elsewhere.push_back(static_cast<id_t>(ratio > 1 ? place(k) : k) + 1);
    return set;
}

/// Particles numbered in the order of a lattice, x fastest, before the first step: the rank owns a cube of the sites.
[[nodiscard]] inline id_set lattice(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    const auto side = static_cast<id_t>(std::cbrt(static_cast<double>(owned)) + 1e-9);
    const auto all = static_cast<id_t>(static_cast<double>(side) * std::cbrt(static_cast<double>(ratio)) + 1e-9);
    const id_t layers = (static_cast<id_t>(owned) + side * side - 1) / (side * side);
    const id_t x0 = (all - side) / 2;
    const id_t z0 = all == side ? 0 : all / 2;
    const auto id = [&](id_t x, id_t y, id_t z) { return 1 + x + all * (y + all * z); };
    id_set set;
    for (id_t z = 0; z < layers; ++z)
        for (id_t y = 0; y < side; ++y)
            for (id_t x = 0; x < side && set.ids.size() < owned; ++x) set.ids.push_back(id(x0 + x, x0 + y, z0 + z));
    // Ghosts and strangers: the shell of sites around the cube, as thick as needed.
    std::vector<id_t> shell;
    const auto wanted = 2 * (different_ids(owned) - owned);
    for (id_t width = 1; shell.size() < wanted; ++width) {
        shell.clear();
        for (id_t z = (std::max)(z0 - width, id_t{0}); z < z0 + layers + width; ++z)
            for (id_t y = (std::max)(x0 - width, id_t{0}); y < (std::min)(x0 + side + width, all); ++y)
                for (id_t x = (std::max)(x0 - width, id_t{0}); x < (std::min)(x0 + side + width, all); ++x)
                    if (x < x0 || x >= x0 + side || y < x0 || y >= x0 + side || z < z0 || z >= z0 + layers)
                        shell.push_back(id(x, y, z));
    }
    shuffle(shell, seed);
    const auto ghosts = static_cast<std::ptrdiff_t>(different_ids(owned) - owned);
    set.ids.insert(set.ids.end(), shell.begin(), shell.begin() + ghosts);
    set.elsewhere.assign(shell.begin() + ghosts, shell.end());
    return set;
}

/// A hopper after a long run: ids are handed out in increasing order at the inlet, and a particle's chance to leave
/// depends on where it is: most fall through the core, some creep along the walls, a few are stuck in a corner.
[[nodiscard]] inline id_set hopper(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    const auto count = different_ids(owned);
    const auto newest = static_cast<double>(ratio * count);
    const double core = 2.0 * static_cast<double>(count);  // mean ages, in insertions
    const double wall = core * std::sqrt(static_cast<double>(ratio));
    id_set set;
    set.ids = distinct(count, seed, [&](tsubu::random_stream& random) {
        const double zone = random.unit();  // 60 % core, 30 % wall, 10 % corner
        double age = newest;
        while (age >= newest)
            age = zone < .6   ? exponential(random, core)
                  : zone < .9 ? exponential(random, wall)
                              : random.unit() * newest;
        return static_cast<id_t>(newest - age);
    });
    set.elsewhere = gaps_between(set.ids, count, seed + 2);
    return set;
}

/// The slice of a rank after the particles have mixed: ids were handed out along x, and have diffused ever since, so
/// most of those here were born nearby, and a fifth anywhere.
[[nodiscard]] inline id_set mixed_slice(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    const auto count = different_ids(owned);
    const auto total = static_cast<double>(ratio * count);
    id_set set;
    set.ids = distinct(count, seed, [&](tsubu::random_stream& random) {
        double x = random.unit();
        if (random.unit() > .2) {
            // The sum of four uniform numbers is close to a normal law: centre .4, deviation .14 of the domain.
            double sum = 0;
            for (int k = 0; k < 4; ++k) sum += random.unit() - .5;
            x = std::abs(.4 + .25 * sum);
        }
        return static_cast<id_t>((std::min)(x, .999999999) * total);
    });
    set.elsewhere = gaps_between(set.ids, count, seed + 2);
    return set;
}

/// Blocks of 1024 consecutive ids at random places: each rank numbered its particles in one go.
[[nodiscard]] inline id_set block(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    constexpr std::uint64_t length = 1024;
    const auto count = different_ids(owned);
    const std::uint64_t blocks = (count + length - 1) / length;
    const random_permutation place(ratio * blocks, seed);
    id_set set;
    for (std::uint64_t k = 0; k < count; ++k)
        set.ids.push_back(static_cast<id_t>(place(k / length) * length + k % length));
    shuffle(set.ids, seed + 1);
    set.elsewhere = gaps_between(set.ids, count, seed + 2);
    return set;
}

/// Multiples of `stride`, all of them from 1 on. Strangers are the multiples that follow.
[[nodiscard]] inline id_set multiples(std::size_t owned, std::uint64_t stride, std::uint64_t seed) {
    const auto count = different_ids(owned);
    id_set set;
    for (std::uint64_t k = 1; k <= count; ++k) {
        set.ids.push_back(static_cast<id_t>(k * stride));
        set.elsewhere.push_back(static_cast<id_t>((k + count) * stride));
    }
    shuffle(set.ids, seed);
    return set;
}

/// Every T/N-th id.
[[nodiscard]] inline id_set strided(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    auto set = multiples(owned, ratio, seed);
    if (ratio > 1) set.elsewhere = gaps_between(set.ids, set.ids.size(), seed + 2);
    return set;
}

/// rank of birth << 40 | counter, of 256 ranks; of each rank's counters every T/N-th is here.
[[nodiscard]] inline id_set clustered(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    constexpr std::uint64_t ranks = 256;
    const auto count = different_ids(owned);
    const std::uint64_t counters = ratio * ((count + ranks - 1) / ranks);
    const random_permutation place(ranks * counters, seed);
    const auto id = [&](std::uint64_t k) { return static_cast<id_t>(k / counters << 40 | k % counters); };
    id_set set;
    for (std::uint64_t k = 0; k < count; ++k) set.ids.push_back(id(place(k)));
    set.elsewhere = {};
    for (std::uint64_t k = count; k < 2 * count; ++k)
        set.elsewhere.push_back(ratio > 1 ? id(place(k)) : id(place(k - count)) + static_cast<id_t>(counters));
    return set;
}

/// id << 24 | rank, of 1000 ranks.
[[nodiscard]] inline id_set rank_in_low_bits(std::size_t owned, std::uint64_t ratio, std::uint64_t seed) {
    auto set = uniform(owned, ratio, seed);
    tsubu::random_stream random(seed + 1);
    for (auto* ids : {&set.ids, &set.elsewhere})
        for (auto& id : *ids) id = id << 24 | static_cast<id_t>(random.below(1000));
    return set;
}

/// Any 62 bits, as from a hash of something else.
[[nodiscard]] inline id_set random_62_bits(std::size_t owned, std::uint64_t, std::uint64_t seed) {
    const auto draw = [](tsubu::random_stream& random) { return static_cast<id_t>(random() >> 2); };
    auto all = distinct(2 * different_ids(owned), seed, draw);
    id_set set;
    set.elsewhere.assign(all.begin() + static_cast<std::ptrdiff_t>(different_ids(owned)), all.end());
    all.resize(different_ids(owned));
    set.ids = std::move(all);
    return set;
}

/// Multiples of LIGGGHTS' bucket count for exactly this many particles: one chain.
[[nodiscard]] inline id_set bucket_multiples(std::size_t owned, std::uint64_t, std::uint64_t seed) {
    const auto particles = different_ids(owned) + image_count(owned);
    return multiples(owned, tsubu::next_prime(tsubu::chained_capacity(particles)), seed);
}

template <std::uint64_t Stride>
[[nodiscard]] id_set stride_of(std::size_t owned, std::uint64_t, std::uint64_t seed) {
    return multiples(owned, Stride, seed);
}

struct pattern {
    const char* name;
    id_set (*make)(std::size_t owned, std::uint64_t ratio, std::uint64_t seed);
    bool quick;  // part of the quick run
};

/// The registration list of patterns.
inline constexpr pattern patterns[] = {
    {"uniform", uniform, true},
    {"lattice", lattice, true},
    {"hopper", hopper, true},
    {"mixed_slice", mixed_slice, true},
    {"block", block, true},
    {"strided", strided, true},
    {"clustered", clustered, true},
    {"rank_in_low_bits", rank_in_low_bits, true},
    {"random_62_bits", random_62_bits, true},
    {"multiples_of_B", bucket_multiples, true},
    {"multiples_of_32771", stride_of<32771>, false},  // LIGGGHTS' B from 16 384 particles
    {"stride_2^6", stride_of<1ULL << 6>, true},
    {"stride_2^7", stride_of<1ULL << 7>, false},
    {"stride_2^8", stride_of<1ULL << 8>, false},
    {"stride_2^9", stride_of<1ULL << 9>, false},
    {"stride_2^10", stride_of<1ULL << 10>, false},
    {"stride_2^11", stride_of<1ULL << 11>, false},
    {"stride_2^12", stride_of<1ULL << 12>, true},
    {"stride_2^13", stride_of<1ULL << 13>, false},
    {"stride_2^14", stride_of<1ULL << 14>, false},
    {"stride_2^15", stride_of<1ULL << 15>, false},
    {"stride_2^16", stride_of<1ULL << 16>, false},
    {"stride_2^17", stride_of<1ULL << 17>, false},
    {"stride_2^18", stride_of<1ULL << 18>, false},
    {"stride_2^19", stride_of<1ULL << 19>, false},
    {"stride_2^20", stride_of<1ULL << 20>, true},
    {"fibonacci_20", stride_of<6765>, false},
    {"fibonacci_30", stride_of<832040>, true},
    {"fibonacci_40", stride_of<102334155>, true},
    {"fibonacci_50", stride_of<12586269025>, false},
};

}  // namespace bench
