// SPDX-License-Identifier: MIT
/// @file
/// One answer for each of many points: the loops behind the batched predicates.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/instruction_set.hpp>
#include <tsubu/domain/detail/inside_columns.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/domain/points.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstring>  // std::memcpy, std::memset
#include <span>     // std::span
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
        if (x.are_columns() && best_instruction_set() != instruction_set::portable) {
            column_question<D, Number> asked{{}, first, last};
            for (std::size_t k = 0; k < D; ++k) asked.start[k] = reinterpret_cast<const Number*>(x.start(k)) + begin;
            done = best_instruction_set() == instruction_set::avx512 ? inside_avx512(asked, count, mask)
                                                                     : inside_avx2(asked, count, mask);
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
