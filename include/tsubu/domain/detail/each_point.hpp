// SPDX-License-Identifier: MIT
/// @file
/// One answer for each of many points: the loops behind the batched predicates.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/mask_number.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/domain/detail/inside_columns.hpp>
#include <tsubu/domain/detail/inside_rows.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/domain/points.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <cstring>  // std::memcpy, std::memset
#include <string>   // std::to_string
#include <utility>  // std::index_sequence

namespace tsubu::detail {

/// @throws input_error unless there is one answer for each point.
inline void check_answers(const char* where, std::size_t answers, std::size_t points) {
    if (answers != points)
        raise<input_error>(where, std::to_string(answers) + " answers for " + std::to_string(points) + " points",
                           "give spans of equal length");
}

/// out[i] = answer(i) for i < count. The answers of a block, whose length is fixed, go to memory that nothing else
/// points to: so a compiler vectorises the loop without being asked for more than -O2.
template <class Answer, class Function>
[[gnu::always_inline]] inline void each_point_loop(std::size_t count, Answer* out, Function answer) noexcept {
    constexpr std::size_t block = 64;
    Answer answers[block];
    std::size_t i = 0;
    for (; i + block <= count; i += block) {
        for (std::size_t j = 0; j < block; ++j) answers[j] = answer(i + j);
        std::memcpy(out + i, answers, sizeof(answers));
    }
    for (; i < count; ++i) out[i] = answer(i);
}

#if defined(__x86_64__) && defined(__GNUC__)
template <class Answer, class Function>
[[gnu::target("avx2")]] void each_point_avx2(std::size_t count, Answer* out, Function answer) noexcept {
    each_point_loop(count, out, answer);
}
#endif

template <class Answer, class Function>
void each_point(std::size_t count, Answer* out, Function answer) noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    if (best_instruction_set() != instruction_set::portable) return each_point_avx2(count, out, answer);
#endif
    each_point_loop(count, out, answer);
}

template <class Scalar>
[[nodiscard, gnu::always_inline]] constexpr auto comparable(Scalar x) noexcept {
    if constexpr (is_lattice<Scalar>)
        return x.value;
    else
        return x;
}

/// mask[i] = 1 if point begin + i lies in the box, else 0, for i < count.
template <std::size_t D, class Scalar>
void inside(const std::array<interval<Scalar>, D>& box, const points<D, const Scalar>& x, std::size_t begin,
            std::size_t count, unsigned char* mask) noexcept {
    std::array<decltype(comparable(Scalar{})), D> first;
    std::array<decltype(comparable(Scalar{})), D> last;
    for (std::size_t k = 0; k < D; ++k) {
        first[k] = comparable(box[k].first);
        last[k] = comparable(box[k].last);
    }
    for (std::size_t k = 0; k < D; ++k)
        if (!(first[k] <= last[k])) {  // nothing is; the kernels count from first to last
            std::memset(mask, 0, count);
            return;
        }
    std::size_t done = 0;
#if defined(__x86_64__) && defined(__GNUC__)
    using Number = decltype(comparable(Scalar{}));
    if constexpr (has_column_kernel<Number>)
        if (const auto set = best_instruction_set(); set != instruction_set::portable) {
            if (x.are_columns() || D == 1) {
                column_question<D, Number> asked{{}, first, last};
                for (std::size_t k = 0; k < D; ++k)
                    asked.start[k] = reinterpret_cast<const Number*>(x.start(k)) + begin;
                done = set == instruction_set::avx512 ? inside_avx512(asked, count, mask)
                                                      : inside_avx2(asked, count, mask);
            } else if constexpr (has_row_kernel<D, Number>) {
                const row_question<D, Number> asked{reinterpret_cast<const Number*>(x.start(0)) + D * begin, first,
                                                    last};
                done = set == instruction_set::avx512 ? inside_avx512(asked, count, mask)
                                                      : inside_avx2(asked, count, mask);
            }
        }
#endif
    x.visit([&](auto at) {
        // Folds, not loops over k: g++ -O2 vectorises no loop around another.
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            each_point(
                count - done, mask + done, [=](std::size_t i) __attribute__((always_inline)) {
                    const std::size_t j = begin + done + i;
                    bool is_inside = true;
                    ((is_inside &= comparable(at(j, K)) >= first[K]), ...);
                    ((is_inside &= comparable(at(j, K)) <= last[K]), ...);
                    return static_cast<unsigned char>(is_inside);
                });
        }
        (std::make_index_sequence<D>{});
    });
}

/// Writes first + j for each j < count with mask[j] == 0 to the front of out, in increasing order; the others are 1.
/// @return how many. What is behind them in out[0 .. count) has no meaning.
inline std::size_t list_zeros_loop(const unsigned char* mask, std::size_t count, std::size_t first,
                                   index_t* out) noexcept {
    constexpr std::uint64_t eight_ones = 0x0101010101010101;
    std::size_t found = 0;
    std::size_t j = 0;
    const auto list_until = [&](std::size_t end) {
        for (; j < end; ++j) {
            out[found] = static_cast<index_t>(first + j);  // no branch: the next one writes over it
            found += mask[j] == 0 ? 1U : 0U;
        }
    };
    while (j + 32 <= count) {
        std::uint64_t words[4];
        std::memcpy(words, mask + j, sizeof words);
        if ((words[0] & words[1] & words[2] & words[3]) == eight_ones)
            j += sizeof words;
        else
            list_until(j + sizeof words);
    }
    list_until(count);
    return found;
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,popcnt")]] inline std::size_t list_zeros_avx512(
    const unsigned char* mask, std::size_t count, std::size_t first, index_t* out) noexcept {
    static_assert(sizeof(index_t) == 4);
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    std::size_t found = 0;
    std::size_t j = 0;
    for (; j + 64 <= count; j += 64) {
        const __m512i here = _mm512_loadu_si512(mask + j);
        const std::uint64_t zeros = _mm512_testn_epi8_mask(here, here);
        if (zeros == 0) continue;
        for (std::size_t k = 0; k < 64; k += 16) {
            // Compressed in the register and stored as a whole: storing under a mask takes far longer.
            const auto which = static_cast<__mmask16>(zeros >> k);
            const __m512i index = _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<index_t>(first + j + k)));
            _mm512_storeu_si512(out + found, _mm512_maskz_compress_epi32(which, index));
            found += static_cast<std::size_t>(_mm_popcnt_u32(number_of(which)));
        }
    }
    return found + list_zeros_loop(mask + j, count - j, first + j, out + found);
}
#endif

/// Writes the indices of the points outside the box to the front of out, in increasing order.
/// @return how many. What is behind them in out[0 .. x.size()) is overwritten.
template <std::size_t D, class Scalar>
std::size_t list_outside(const std::array<interval<Scalar>, D>& box, const points<D, const Scalar>& x,
                         index_t* out) noexcept {
    constexpr std::size_t block = 8192;  // a quarter of the first cache; with fewer, the starts of the kernels count
    unsigned char mask[block];
    std::size_t found = 0;
    for (std::size_t begin = 0; begin < x.size(); begin += block) {
        const auto length = x.size() - begin < block ? x.size() - begin : block;
        inside(box, x, begin, length, mask);
#if defined(__x86_64__) && defined(__GNUC__)
        if (best_instruction_set() == instruction_set::avx512) {
            found += list_zeros_avx512(mask, length, begin, out + found);
            continue;
        }
#endif
        found += list_zeros_loop(mask, length, begin, out + found);
    }
    return found;
}

/// Calls tell(i, outside) for every point, in increasing order: whether it lies outside the box.
template <std::size_t D, class Scalar, class Tell>
void tell_outside(const std::array<interval<Scalar>, D>& box, const points<D, const Scalar>& x, Tell&& tell) {
    constexpr std::size_t block = 1024;
    unsigned char mask[block];
    for (std::size_t begin = 0; begin < x.size(); begin += block) {
        const auto length = x.size() - begin < block ? x.size() - begin : block;
        inside(box, x, begin, length, mask);
        for (std::size_t j = 0; j < length; ++j) tell(begin + j, mask[j] == 0);
    }
}

}  // namespace tsubu::detail
