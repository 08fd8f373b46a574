// SPDX-License-Identifier: MIT
/// @file
/// The loops of bitmap_storage that count bits, once with the POPCNT instruction and once without.
///
/// Both are compiled from one body: it is inlined into a function that carries the target attribute and into one that
/// does not, and only the count differs. (Without the instruction, __builtin_popcountll is a call of the compiler's
/// runtime library; the sum by halves below is inlined.)
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/types.hpp>

#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint32_t, std::uint64_t

namespace tsubu::detail {

template <bool Native>
[[gnu::always_inline]] inline std::uint32_t popcount(std::uint64_t word) noexcept {
#if defined(__POPCNT__) || !defined(__x86_64__)
    return static_cast<std::uint32_t>(__builtin_popcountll(word));
#else
    if constexpr (Native) return static_cast<std::uint32_t>(__builtin_popcountll(word));
    word -= (word >> 1) & 0x5555555555555555U;                                   // sums of 2 bits
    word = (word & 0x3333333333333333U) + ((word >> 2) & 0x3333333333333333U);   // of 4
    word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fU;                           // of 8
    return static_cast<std::uint32_t>((word * 0x0101010101010101U) >> 56);       // all 8 bytes, in the highest
#endif
}

/// Bit b of word w says whether the id (first + w) * 64 + b is there; its index is pool[start of w + bits below b].
/// pool[0] is always absent: the place of every id whose bit is not set.
template <particle_id Id>
struct bitmap_window {
    const std::uint64_t* words;
    const std::uint32_t* starts;
    std::uint64_t count;
    unsigned_id<Id> first;

    [[nodiscard]] std::uint64_t word_of(Id t) const noexcept {
        using unsigned_type = unsigned_id<Id>;
        return static_cast<unsigned_type>(static_cast<unsigned_type>(static_cast<unsigned_type>(t) >> 6) - first);
    }
    /// Place in the pool, 0 if the bit is not set. Precondition: word_of(id) < count.
    template <bool Native>
    [[nodiscard, gnu::always_inline]] std::size_t place_of(Id t) const noexcept {
        const auto w = static_cast<std::size_t>(word_of(t));
        const auto bit = static_cast<unsigned>(static_cast<unsigned_id<Id>>(t) & 63U);
        const std::uint64_t below = words[w] & ((std::uint64_t{1} << bit) - 1);
        const std::uint64_t present = (words[w] >> bit) & 1U;
        return (starts[w] + popcount<Native>(below)) & (std::uint64_t{0} - present);
    }
};

template <bool Native, particle_id Id>
[[gnu::always_inline]] inline void bitmap_find(const bitmap_window<Id>& map, const index_t* pool, const Id* ids,
                                               index_t* out, std::size_t n) noexcept {
    for (std::size_t k = 0; k < n; ++k) {
        using unsigned_type = unsigned_id<Id>;
        // Ids outside look at the first id of the window, and their answer is dropped: no branch.
        const bool inside = map.word_of(ids[k]) < map.count;
        const auto asked =
            static_cast<Id>(inside ? static_cast<unsigned_type>(ids[k]) : static_cast<unsigned_type>(map.first << 6));
        const index_t found = pool[map.template place_of<Native>(asked)];
        out[k] = inside ? found : absent;
    }
}

/// starts[w] = 1 + bits in the words below w. @return 1 + bits in all words.
template <bool Native>
[[gnu::always_inline]] inline std::uint32_t bitmap_number(const std::uint64_t* words, std::uint32_t* starts,
                                                          std::size_t count) noexcept {
    std::uint32_t next = 1;
    for (std::size_t w = 0; w < count; ++w) {
        starts[w] = next;
        next += popcount<Native>(words[w]);
    }
    return next;
}

/// The reverse scan, once the bits are set and numbered.
template <bool Native, particle_id Id>
[[gnu::always_inline]] inline void bitmap_insert(const bitmap_window<Id>& map, index_t* pool, const Id* ids,
                                                 index_t* links, std::size_t n) noexcept {
    for (std::size_t i = n; i-- > 0;) {
        auto& entry = pool[map.template place_of<Native>(ids[i])];
        const index_t next = entry;
        entry = static_cast<index_t>(i);
        if (links != nullptr) links[i] = next;
    }
}

#if defined(__x86_64__) && defined(__GNUC__)

template <particle_id Id>
[[gnu::target("popcnt,bmi,bmi2,avx2")]] void bitmap_find_avx2(const bitmap_window<Id>& map, const index_t* pool,
                                                              const Id* ids, index_t* out, std::size_t n) noexcept {
    bitmap_find<true>(map, pool, ids, out, n);
}
[[gnu::target("popcnt,bmi,bmi2,avx2")]] inline std::uint32_t bitmap_number_avx2(const std::uint64_t* words,
                                                                                std::uint32_t* starts,
                                                                                std::size_t count) noexcept {
    return bitmap_number<true>(words, starts, count);
}
template <particle_id Id>
[[gnu::target("popcnt,bmi,bmi2,avx2")]] void bitmap_insert_avx2(const bitmap_window<Id>& map, index_t* pool,
                                                                const Id* ids, index_t* links,
                                                                std::size_t n) noexcept {
    bitmap_insert<true>(map, pool, ids, links, n);
}

#endif

/// What rebuild and batched look-up call; `set` must be supported by the machine.
template <particle_id Id>
void bitmap_find(instruction_set set, const bitmap_window<Id>& map, const index_t* pool, const Id* ids, index_t* out,
                 std::size_t n) noexcept {
    if (map.count == 0) {
        for (std::size_t k = 0; k < n; ++k) out[k] = absent;
        return;
    }
#if defined(__x86_64__) && defined(__GNUC__)
    if (set != instruction_set::portable) return bitmap_find_avx2(map, pool, ids, out, n);
#else
    static_cast<void>(set);
#endif
    bitmap_find<false>(map, pool, ids, out, n);
}
inline std::uint32_t bitmap_number(instruction_set set, const std::uint64_t* words, std::uint32_t* starts,
                                   std::size_t count) noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    if (set != instruction_set::portable) return bitmap_number_avx2(words, starts, count);
#else
    static_cast<void>(set);
#endif
    return bitmap_number<false>(words, starts, count);
}
template <particle_id Id>
void bitmap_insert(instruction_set set, const bitmap_window<Id>& map, index_t* pool, const Id* ids, index_t* links,
                   std::size_t n) noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    if (set != instruction_set::portable) return bitmap_insert_avx2(map, pool, ids, links, n);
#else
    static_cast<void>(set);
#endif
    bitmap_insert<false>(map, pool, ids, links, n);
}

}  // namespace tsubu::detail
