// SPDX-License-Identifier: MIT
/// @file
/// Owners in a thread that takes denormal numbers for 0, as all do in a program linked with -ffast-math.
#include <tsubu/domain/brick_decomposition.hpp>

#include "support/catch.hpp"

#include <tsubu/core/instruction_set.hpp>

#include <limits>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>  // _mm_getcsr, _mm_setcsr

namespace {

/// Denormal numbers are 0 as long as it lives, both where they are read and where they would come out.
struct flush_to_zero {
    flush_to_zero() { _mm_setcsr(before | 0x8040U); }
    ~flush_to_zero() { _mm_setcsr(before); }
    flush_to_zero(const flush_to_zero&) = delete;
    flush_to_zero& operator=(const flush_to_zero&) = delete;
    unsigned before = _mm_getcsr();
};

template <class Scalar>
std::size_t wrong_owners(Scalar lo, Scalar hi, std::size_t ranks, bool periodic) {
    using limits = std::numeric_limits<Scalar>;
    std::vector<Scalar> asked = {lo, hi, lo / 2, hi / 2};
    for (const Scalar x : {Scalar{0}, limits::denorm_min(), 7 * limits::denorm_min(), limits::min(), 2 * limits::min()})
        for (const Scalar signed_x : {x, -x}) asked.insert(asked.end(), 20, signed_x);  // enough for a vector
    const flush_to_zero now;
    typename tsubu::domain<1, Scalar>::options with{};
    with.periodic = {periodic};
    const tsubu::brick_decomposition<1, Scalar> bricks({{lo}, {hi}, with}, ranks);
    std::vector<std::size_t> owners(asked.size(), 0);
    std::vector<unsigned char> mask(asked.size());
    std::size_t wrong = 0;
    for (std::size_t rank = 0; rank < ranks; ++rank) {
        const auto mine = bricks.subdomain(rank);
        mine.owns({{asked}}, mask);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            owners[i] += mask[i];
            wrong += (mask[i] != 0) != mine.owns({asked[i]}) ? 1U : 0U;
            wrong += mine.owns_extended({asked[i]}) != (bricks.owner({asked[i]}) == rank) ? 1U : 0U;
        }
    }
    for (std::size_t i = 0; i < asked.size(); ++i)
        wrong += owners[i] != (bricks.whole().contains({asked[i]}) ? 1U : 0U) ? 1U : 0U;
    return wrong;
}

}  // namespace

TEMPLATE_TEST_CASE("where denormal numbers are 0, each point has one owner all the same", "[domain][B3][F3]", double,
                   float) {
    for (const auto set :
         {tsubu::instruction_set::portable, tsubu::instruction_set::avx2, tsubu::instruction_set::avx512}) {
        tsubu::use_instruction_set(set);
        for (const bool periodic : {false, true})
            for (const std::size_t ranks : {1U, 2U, 3U, 4U}) {
                CAPTURE(periodic, ranks, tsubu::name_of(tsubu::best_instruction_set()));
                CHECK(wrong_owners<TestType>(-1, 1, ranks, periodic) == 0);  // a cut at 0
                CHECK(wrong_owners<TestType>(-1, 0, ranks, periodic) == 0);
                CHECK(wrong_owners<TestType>(0, 1, ranks, periodic) == 0);
            }
    }
    tsubu::use_instruction_set(tsubu::supported_instruction_set());
}
#endif
