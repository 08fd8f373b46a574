// SPDX-License-Identifier: MIT
/// @file
/// Which of many points lie in a product of intervals: the loops behind the batched predicates.
#pragma once

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t

namespace tsubu::detail {

/// Points as D columns.
template <std::size_t D, class Scalar>
struct column_points {
    std::array<const Scalar*, D> column;
    [[nodiscard, gnu::always_inline]] const Scalar& at(std::size_t i, std::size_t k) const noexcept {
        return column[k][i];
    }
};
/// Points as an array of vectors.
template <std::size_t D, class Scalar>
struct row_points {
    const vec<D, Scalar>* row;
    [[nodiscard, gnu::always_inline]] const Scalar& at(std::size_t i, std::size_t k) const noexcept {
        return row[i][k];
    }
};

template <class Scalar>
[[nodiscard, gnu::always_inline]] constexpr auto comparable(Scalar x) noexcept {
    if constexpr (is_lattice<Scalar>)
        return x.value;
    else
        return x;
}

/// mask[i] = 1 if point i lies in the box, else 0. Blocks of a fixed length, whose loop a compiler vectorises without
/// being asked for more than -O2.
template <std::size_t D, class Scalar, class Points>
[[gnu::always_inline]] inline void inside_loop(const std::array<interval<Scalar>, D>& box, Points points,
                                               std::size_t count, unsigned char* mask) noexcept {
    constexpr std::size_t block = 64;
    std::array<decltype(comparable(Scalar{})), D> first;
    std::array<decltype(comparable(Scalar{})), D> last;
    for (std::size_t k = 0; k < D; ++k) {
        first[k] = comparable(box[k].first);
        last[k] = comparable(box[k].last);
    }
    const auto is_inside = [&](std::size_t i) {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k) {
            const auto x = comparable(points.at(i, k));
            const bool from = x >= first[k];
            const bool to = x <= last[k];
            inside &= from & to;
        }
        return static_cast<unsigned char>(inside);
    };
    std::size_t i = 0;
    for (; i + block <= count; i += block)
        for (std::size_t j = 0; j < block; ++j) mask[i + j] = is_inside(i + j);
    for (; i < count; ++i) mask[i] = is_inside(i);
}

#if defined(__x86_64__) && defined(__GNUC__)
template <std::size_t D, class Scalar, class Points>
[[gnu::target("avx2")]] void inside_avx2(const std::array<interval<Scalar>, D>& box, Points points, std::size_t count,
                                         unsigned char* mask) noexcept {
    inside_loop(box, points, count, mask);
}
#endif

template <std::size_t D, class Scalar, class Points>
void inside(const std::array<interval<Scalar>, D>& box, Points points, std::size_t count,
            unsigned char* mask) noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
    if (best_instruction_set() != instruction_set::portable) return inside_avx2(box, points, count, mask);
#endif
    inside_loop(box, points, count, mask);
}

/// The numbers of the points that do not lie in the box, in increasing order. @return how many.
template <std::size_t D, class Scalar, class Points>
std::size_t outside(const std::array<interval<Scalar>, D>& box, Points points, std::size_t count,
                    index_t* numbers) noexcept {
    constexpr std::size_t block = 1024;
    unsigned char mask[block];
    std::size_t found = 0;
    for (std::size_t begin = 0; begin < count; begin += block) {
        const auto length = count - begin < block ? count - begin : block;
        auto part = points;
        if constexpr (requires { part.row; })
            part.row += begin;
        else
            for (auto& column : part.column) column += begin;
        inside(box, part, length, mask);
        for (std::size_t j = 0; j < length; ++j) {  // no branch: the last write is overwritten by the next leaver
            numbers[found] = static_cast<index_t>(begin + j);
            found += mask[j] ^ 1U;
        }
    }
    return found;
}

}  // namespace tsubu::detail
