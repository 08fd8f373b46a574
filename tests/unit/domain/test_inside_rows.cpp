// SPDX-License-Identifier: MIT
/// @file
/// The kernels behind the batched predicates, for points in an array of vectors, against one comparison after another.
#include <tsubu/domain/detail/inside_rows.hpp>

#include "support/catch.hpp"
#include "support/instruction_sets.hpp"

#include <tsubu/core/instruction_set.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/domain/detail/each_point.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>  // _mm_getcsr, _mm_setcsr
#endif

using tsubu::index_t;
using tsubu::interval;
using tsubu::lattice;
using tsubu::vec;

namespace {

constexpr unsigned char untouched = 7;

/// Numbers of every kind, many of them equal to one another or next to one another.
template <class Scalar>
Scalar some_number(tsubu::random_stream& random) {
    if constexpr (tsubu::is_lattice<Scalar>) {
        using Int = decltype(Scalar{}.value);
        using limits = std::numeric_limits<Int>;
        const Int edges[] = {limits::min(), limits::min() + 1, -1, 0, 1, limits::max() - 1, limits::max()};
        return {random.below(3) == 0 ? edges[random.below(7)] : static_cast<Int>(random())};
    } else {
        using limits = std::numeric_limits<Scalar>;
        constexpr Scalar zero = 0;
        constexpr Scalar one = 1;
        const Scalar beside_one[] = {std::nextafter(one, zero), one, std::nextafter(one, 2 * one)};
        const Scalar small[] = {zero, limits::denorm_min(), (limits::min)(), 2 * (limits::min)()};
        const Scalar edges[] = {beside_one[0], beside_one[1], beside_one[2], (limits::max)(),
                                small[0],      small[1],      small[2],      small[3]};
        if (random.below(3) == 0) return random.below(2) == 0 ? edges[random.below(8)] : -edges[random.below(8)];
        return static_cast<Scalar>(random.unit() * 4 - 2);
    }
}
template <class Scalar>
Scalar some_coordinate(tsubu::random_stream& random) {
    if constexpr (!tsubu::is_lattice<Scalar>) {
        using limits = std::numeric_limits<Scalar>;
        const Scalar bad[] = {limits::quiet_NaN(), -limits::quiet_NaN(), limits::infinity(), -limits::infinity()};
        if (random.below(16) == 0) return bad[random.below(4)];
    }
    return some_number<Scalar>(random);
}

/// Boxes that hold nothing, one coordinate, some, and all; faces in both signs of zero.
template <std::size_t D, class Scalar>
std::array<interval<Scalar>, D> some_box(tsubu::random_stream& random) {
    std::array<interval<Scalar>, D> box{};
    const auto kind = random.below(8);
    for (auto& side : box) {
        const auto a = some_number<Scalar>(random);
        const auto b = some_number<Scalar>(random);
        side = kind < 3   ? interval<Scalar>::all()
               : kind < 7 ? (a <= b ? interval<Scalar>{a, b} : interval<Scalar>{b, a})
                          : interval<Scalar>{a, b};
    }
    if (kind == 1) box[random.below(D)] = {some_number<Scalar>(random), interval<Scalar>::all().last};
    if (kind == 2) box[random.below(D)] = {interval<Scalar>::all().first, some_number<Scalar>(random)};
    return box;
}

template <std::size_t D, class Scalar>
void kernels_are_comparisons() {
    tsubu::random_stream random(D);
    for (std::size_t count = 0; count <= 200; ++count)
        for (const std::size_t begin : {std::size_t{0}, 1 + count % 17}) {
            const auto box = some_box<D, Scalar>(random);
            const auto frequent = some_number<Scalar>(random);
            const bool often_inside = random.below(2) == 0;
            std::vector<vec<D, Scalar>> x(begin + count);
            for (auto& row : x)
                for (std::size_t k = 0; k < D; ++k)
                    row[k] = !often_inside          ? some_coordinate<Scalar>(random)
                             : random.below(9) == 0 ? frequent
                                                    : (random.below(2) == 0 ? box[k].first : box[k].last);
            std::vector<unsigned char> expected(count + 2, untouched);
            for (std::size_t i = 0; i < count; ++i) {
                bool inside = true;
                for (std::size_t k = 0; k < D; ++k) inside = inside && box[k].contains(x[begin + i][k]);
                expected[i + 1] = inside ? 1 : 0;
            }
            each_instruction_set{}.run([&] {
                CAPTURE(D, count, begin, tsubu::name_of(tsubu::best_instruction_set()));
                std::vector<unsigned char> mask(count + 2, untouched);
                tsubu::detail::inside<D, Scalar>(box, x, begin, count, mask.data() + 1);
                CHECK(mask == expected);
            });
        }
}

}  // namespace

TEMPLATE_TEST_CASE("rows are inside if each of their numbers is, for every instruction set", "[domain][B3][batch]",
                   double, float, lattice<std::int32_t>, lattice<std::int64_t>, lattice<std::int8_t>) {
    kernels_are_comparisons<1, TestType>();
    kernels_are_comparisons<2, TestType>();
    kernels_are_comparisons<3, TestType>();
    kernels_are_comparisons<4, TestType>();
}

#if defined(__SSE2__)
TEMPLATE_TEST_CASE("rows where denormal numbers are 0, for every instruction set", "[domain][B3][batch][F3]", double,
                   float) {
    struct flush_to_zero {
        flush_to_zero() { _mm_setcsr(before | 0x8040U); }
        ~flush_to_zero() { _mm_setcsr(before); }
        unsigned before = _mm_getcsr();
    } const now;
    kernels_are_comparisons<2, TestType>();
    kernels_are_comparisons<3, TestType>();
}
#endif

TEST_CASE("the points outside are listed in order, few or many", "[domain][batch]") {
    constexpr index_t unwritten = -5;
    tsubu::random_stream random(1);
    for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0})
        for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 63U, 64U, 65U, 200U, 8191U, 8192U, 8193U, 20000U}) {
            std::vector<vec<3>> x(count);
            std::vector<index_t> expected;
            for (std::size_t i = 0; i < count; ++i)
                if (random.unit() < part) {
                    x[i][random.below(3)] = 2;
                    expected.push_back(static_cast<index_t>(i));
                }
            each_instruction_set{}.run([&] {
                CAPTURE(part, count, tsubu::name_of(tsubu::best_instruction_set()));
                const std::array<interval<double>, 3> box{{{-1, 1}, {-1, 1}, {-1, 1}}};
                std::vector<index_t> out(count + 1, unwritten);
                const auto found = tsubu::detail::list_outside<3, double>(box, x, out.data());
                CHECK(out.back() == unwritten);
                out.resize(found);
                CHECK(out == expected);
            });
        }
}
