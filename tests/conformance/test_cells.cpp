// SPDX-License-Identifier: MIT
/// @file
/// Decompositions of boxes that are not domains.
#include <tsubu/domain/cell_decomposition.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/domain/wedge.hpp>
#include <tsubu/testing/decomposition_conformance.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using tsubu::bisection_decomposition;
using tsubu::brick_decomposition;
using tsubu::cell_decomposition;
using tsubu::triclinic_box;
using tsubu::vec;
using tsubu::wedge;

template <class Box>
void check_all_laws(const Box& where) {
    constexpr std::size_t D = Box::dimension;
    using Scalar = typename Box::scalar_type;
    const auto check = [](const auto& parts) {
        verdict seen;
        tsubu::testing::check_decomposition(parts, parts.ranks(), 60, seen);
        INFO(seen.first);
        CAPTURE(parts.ranks());
        CHECK(seen.first.empty());
        CHECK(seen.checked > 0);
    };
    std::vector<vec<D, Scalar>> sample;
    tsubu::random_stream random(3);
    for (int i = 0; i < 200; ++i) {
        vec<D, Scalar> at{};
        for (std::size_t k = 0; k < D; ++k)
            at[k] = where.cell().along(k).lo() +
                    static_cast<Scalar>(random.unit() * random.unit()) * where.cell().along(k).length();
        sample.push_back(at);
    }
#if defined(NDEBUG)
    constexpr std::size_t some_ranks[] = {1, 2, 3, 6, 12};
#else  // with sanitizers and without optimisation the same takes minutes
    constexpr std::size_t some_ranks[] = {1, 3};
#endif
    for (const std::size_t ranks : some_ranks) {
        check(cell_decomposition(where, brick_decomposition<D, Scalar>(where.cell(), ranks)));
        check(cell_decomposition(where, bisection_decomposition<D, Scalar>(where.cell(), ranks, sample)));
    }
}

}  // namespace

TEMPLATE_TEST_CASE("decompositions of tilted boxes keep all laws", "[domain][conformance][triclinic][I6][I7]", double,
                   float) {
    using vec2 = vec<2, TestType>;
    using vec3 = vec<3, TestType>;
    const auto tilted2 = [](double xy, bool periodic) {
        return triclinic_box<2, TestType>(vec2{TestType(-0.3), TestType(0.1)}, vec2{1, TestType(0.7)},
                                          {static_cast<TestType>(xy)}, {true, periodic});
    };
    for (const double xy : {0.0, 0.31, -0.5, 2.3}) check_all_laws(tilted2(xy, xy > 0));
    const auto tilted3 = [](double tilt, bool periodic) {
        const auto t = static_cast<TestType>(tilt);
        return triclinic_box<3, TestType>(vec3{}, vec3{1, TestType(0.9), TestType(1.3)}, {t, -t / 2, t / 3},
                                          {periodic, true, true});
    };
    for (const double tilt : {0.4, -1.1}) check_all_laws(tilted3(tilt, tilt > 0));
}

TEMPLATE_TEST_CASE("decompositions of wedges keep all laws", "[domain][conformance][wedge][I6][I7]", double, float) {
    for (const std::size_t sectors : {2U, 3U, 4U, 7U, 12U})
        check_all_laws(wedge<TestType>(sectors, {TestType(0.2), TestType(-0.1)}, TestType(0.5), -1, 1, sectors != 4));
}
