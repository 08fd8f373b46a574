// SPDX-License-Identifier: MIT
/// @file
/// The decompositions of domains, and nothing else.
#include <tsubu/testing/decomposition_conformance.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/brick_decomposition.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using tsubu::bisection_decomposition;
using tsubu::brick_decomposition;
using tsubu::domain;
using tsubu::lattice;
using tsubu::vec;

#define CHECK_KEPT(seen)             \
    do {                             \
        INFO((seen).first);          \
        CHECK((seen).first.empty()); \
        CHECK((seen).checked > 0);   \
    } while (false)

#if defined(NDEBUG)
constexpr std::size_t some_ranks[] = {1, 2, 3, 4, 7, 8, 12, 16, 61, 64};
constexpr std::size_t scale_ranks[] = {1, 2, 6, 13};
constexpr std::size_t rank_step = 1;
#else  // with sanitizers and without optimisation the same takes ten minutes
constexpr std::size_t some_ranks[] = {1, 7, 12};
constexpr std::size_t scale_ranks[] = {6};
constexpr std::size_t rank_step = 21;
#endif

template <std::size_t D, class Scalar>
domain<D, Scalar> box_of_size(double scale, unsigned periodic) {
    using box = domain<D, Scalar>;
    using real = typename box::real_type;
    typename box::real_position_type lo{};
    typename box::real_position_type hi{};
    typename box::options with{};
    for (std::size_t k = 0; k < D; ++k) {
        lo[k] = static_cast<real>(-0.31 * scale * static_cast<double>(k));
        hi[k] = lo[k] + static_cast<real>(scale * (1 + 0.37 * static_cast<double>(k)));
        with.periodic[k] = tsubu::is_lattice<Scalar> || (periodic >> k & 1U) != 0;
    }
    return {lo, hi, with};
}
/// Most of them near the lower faces, some on one plane.
template <std::size_t D, class Scalar>
std::vector<vec<D, Scalar>> uneven_sample(const domain<D, Scalar>& box) {
    tsubu::random_stream random(5);
    std::vector<vec<D, Scalar>> sample(500);
    for (auto& x : sample)
        for (std::size_t k = 0; k < D; ++k) {
            const auto u = random.below(4) == 0 ? 0.25 : random.unit();
            if constexpr (tsubu::is_lattice<Scalar>)
                x[k] = box.along(k).from_real(box.real_axis(k).lo() + u * u * box.real_axis(k).length()).position;
            else
                x[k] = box.along(k).lo() + static_cast<Scalar>(u * u) * box.along(k).length();
        }
    return sample;
}

template <std::size_t D, class Scalar, class Check>
void for_both(const domain<D, Scalar>& box, std::size_t ranks, Check&& check) {
    check(brick_decomposition<D, Scalar>(box, ranks));
    check(bisection_decomposition<D, Scalar>(box, ranks, {}));
    check(bisection_decomposition<D, Scalar>(box, ranks, uneven_sample(box)));
}

template <std::size_t D, class Scalar>
void check_all_laws() {
    for (const std::size_t ranks : some_ranks)
        for (const unsigned periodic : {0U, 1U, 7U}) {
            if (tsubu::is_lattice<Scalar> && periodic != 7) continue;
            for_both(box_of_size<D, Scalar>(1, periodic), ranks, [&](const auto& parts) {
                verdict seen;
                tsubu::testing::check_decomposition(parts, ranks, 100, seen);
                CAPTURE(D, ranks, periodic);
                CHECK_KEPT(seen);
            });
        }
}

template <std::size_t D, class Scalar>
void check_scales() {
    for (const double scale : {1e-300, 1e-150, 1e-13, 1e-7, 1e5, 134217728.0, 1e9, 1e15, 1e150, 1e300}) {
        if (sizeof(Scalar) == 4 && !tsubu::is_lattice<Scalar> && (scale < 1e-30 || scale > 1e30)) continue;
        for (const std::size_t ranks : scale_ranks)
            for_both(box_of_size<D, Scalar>(scale, 5), ranks, [&](const auto& parts) {
                verdict seen;
                tsubu::testing::check_decomposition(parts, ranks, 30, seen);
                CAPTURE(D, ranks, scale);
                CHECK_KEPT(seen);
            });
    }
}

}  // namespace

TEMPLATE_TEST_CASE("decompositions keep all laws, up to 64 ranks", "[domain][conformance][I6][I7][F3][F4]", double,
                   float, lattice<std::int32_t>, lattice<std::int64_t>) {
    check_all_laws<1, TestType>();
    check_all_laws<2, TestType>();
    check_all_laws<3, TestType>();
}

TEMPLATE_TEST_CASE("decompositions keep all laws at every scale", "[domain][conformance][I6][I7][F3]", double, float,
                   lattice<std::int32_t>, lattice<std::int64_t>) {
    check_scales<1, TestType>();
    check_scales<2, TestType>();
    check_scales<3, TestType>();
}

TEST_CASE("every number of ranks from 1 to 64 shares the space", "[domain][conformance][I6][I7][F3]") {
    for (std::size_t ranks = 1; ranks <= 64; ranks += rank_step)
        for (const double scale : {1e-300, 1e-7, 1.0, 1e9, 1e300})
            for_both(box_of_size<2, double>(scale, 1), ranks, [&](const auto& parts) {
                verdict seen;
                tsubu::testing::check_partition(parts, ranks, 30, seen);
                CAPTURE(ranks, scale);
                CHECK_KEPT(seen);
            });
}

TEST_CASE("given cuts, very uneven, keep all laws", "[domain][conformance][F3]") {
    const auto box = box_of_size<2, double>(1, 3);
    using tsubu::cuts;
    const auto y = box.along(1).lo();
    const brick_decomposition<2> bricks(
        box, std::array{cuts<double>(box.along(0), {1e-300, 0.5, std::nextafter(0.5, 1.0)}),
                        cuts<double>(box.along(1), {std::nextafter(y, 1.0), std::nextafter(box.along(1).hi(), 0.0)})});
    verdict seen;
    tsubu::testing::check_partition(bricks, 1, 1000, seen);
    CHECK_KEPT(seen);
}

/// Sums over all ranks of what they own of many random points, two thirds of them inside.
template <class Scalar, class Decomposition>
void check_random_points(const Decomposition& parts, std::size_t points) {
    constexpr std::size_t block = 1 << 14;
    std::array<std::vector<Scalar>, 3> column;
    typename tsubu::points<3, const Scalar>::columns columns{};
    for (std::size_t k = 0; k < 3; ++k) {
        column[k].resize(block);
        columns[k] = column[k];
    }
    std::vector<tsubu::subdomain<3, Scalar>> mine;
    for (std::size_t rank = 0; rank < parts.ranks(); ++rank) mine.push_back(parts.subdomain(rank));
    std::vector<unsigned char> mask(block);
    std::vector<unsigned char> inside(block);
    std::vector<unsigned char> owners(block);
    std::vector<unsigned char> extended(block);
    std::vector<tsubu::rank_t> owner(block);
    tsubu::random_stream random(parts.ranks());
    std::size_t wrong = 0;
    for (std::size_t done = 0; done < points; done += block) {
        for (std::size_t k = 0; k < 3; ++k)
            for (auto& x : column[k]) {
                if constexpr (tsubu::is_lattice<Scalar>)
                    x = {static_cast<decltype(x.value)>(random())};
                else
                    x = parts.whole().along(k).lo() +
                        static_cast<Scalar>(random.unit() * 1.14 - 0.07) * parts.whole().along(k).length();
            }
        parts.whole().contains(columns, inside);
        parts.owner(columns, owner);
        owners.assign(block, 0);
        extended.assign(block, 0);
        for (std::size_t rank = 0; rank < parts.ranks(); ++rank) {
            mine[rank].owns(columns, mask);
            for (std::size_t i = 0; i < block; ++i) owners[i] = static_cast<unsigned char>(owners[i] + mask[i]);
            mine[rank].owns_extended(columns, mask);
            for (std::size_t i = 0; i < block; ++i) {
                extended[i] = static_cast<unsigned char>(extended[i] + mask[i]);
                wrong += (mask[i] != 0) != (owner[i] == rank) ? 1U : 0U;
            }
        }
        for (std::size_t i = 0; i < block; ++i) wrong += owners[i] != inside[i] || extended[i] != 1 ? 1U : 0U;
    }
    CHECK(wrong == 0);
}

TEMPLATE_TEST_CASE("a hundred million random points have one owner each", "[domain][conformance][slow][I6][I7]", double,
                   float, lattice<std::int32_t>, lattice<std::int64_t>) {
#if defined(NDEBUG)
    constexpr std::size_t points = 100'000'000;
#else
    constexpr std::size_t points = 1'000'000;
#endif
    const auto box = box_of_size<3, TestType>(1, 5);
    check_random_points<TestType>(brick_decomposition<3, TestType>(box, 12), points / 2);
    check_random_points<TestType>(bisection_decomposition<3, TestType>(box, 13, uneven_sample(box)), points / 2);
}
