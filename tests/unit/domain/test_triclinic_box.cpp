// SPDX-License-Identifier: MIT
#include <tsubu/domain/triclinic_box.hpp>

#include "support/catch.hpp"

#include <tsubu/core/random.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>
#include <vector>

using tsubu::triclinic_box;
using tsubu::vec;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <std::size_t D, class Scalar>
struct shape {
    vec<D, Scalar> lo;
    vec<D, Scalar> lengths;
    vec<D*(D - 1) / 2, Scalar> tilt;
    [[nodiscard]] triclinic_box<D, Scalar> box(const std::array<bool, D>& periodic) const {
        return {lo, lengths, tilt, periodic};
    }
};

/// Weak tilt, the limit of LAMMPS, strong and very strong; near the origin and beside it.
template <std::size_t D, class Scalar>
std::vector<shape<D, Scalar>> shapes() {
    if constexpr (D == 2)
        return {{{0, 0}, {1, 1}, {0}},
                {{0, 0}, {1, 1}, {Scalar(0.1)}},
                {{0, 0}, {1, 1}, {Scalar(0.5)}},
                {{Scalar(-0.3), 7}, {2, Scalar(1.3)}, {-1}},
                {{Scalar(0.1), Scalar(-0.7)}, {1, Scalar(1.7)}, {Scalar(61.3)}},
                {{Scalar(100.1), Scalar(-2000.7)}, {1, Scalar(1.7)}, {Scalar(-1234.3)}}};
    else
        return {{{0, 0, 0}, {1, 1, 1}, {0, 0, 0}},
                {{0, 0, 0}, {1, 1, 1}, {Scalar(0.1), Scalar(-0.05), Scalar(0.07)}},
                {{0, 0, 0}, {1, 1, 1}, {Scalar(0.5), Scalar(0.5), Scalar(0.5)}},
                {{0, 0, 0}, {1, 1, 1}, {Scalar(0.5), Scalar(-0.5), Scalar(0.5)}},
                {{Scalar(-0.3), 7, 1}, {2, Scalar(1.3), Scalar(1.1)}, {-1, 1, Scalar(0.65)}},
                {{Scalar(0.1), Scalar(-0.7), 3},
                 {1, Scalar(1.7), Scalar(1.2)},
                 {Scalar(61.3), Scalar(-47.1), Scalar(33.3)}},
                {{Scalar(100.1), Scalar(-2000.7), 30},
                 {1, Scalar(1.7), Scalar(0.9)},
                 {Scalar(1234.3), Scalar(777.7), Scalar(-999.1)}}};
}

template <std::size_t D>
std::array<bool, D> along_all() {
    std::array<bool, D> periodic{};
    periodic.fill(true);
    return periodic;
}

/// A fraction in [from, to), or one on or beside a face or a simple cut.
template <class Scalar>
Scalar some_fraction(tsubu::random_stream& random, double from, double to) {
    const auto kind = random.below(4);
    const auto inner = static_cast<Scalar>(from + (to - from) * random.unit());
    if (kind < 2) return inner;
    const auto face = static_cast<Scalar>(std::floor(inner)) +
                      static_cast<Scalar>(random.below(8)) / static_cast<Scalar>(1 + random.below(7));
    if (kind == 2) return face;
    return std::nextafter(face, static_cast<Scalar>(random.below(2) == 0 ? -100 : 100));
}
template <std::size_t D, class Scalar>
vec<D, Scalar> some_point(const triclinic_box<D, Scalar>& box, tsubu::random_stream& random, double from, double to) {
    vec<D, Scalar> fraction{};
    for (auto& f : fraction) f = some_fraction<Scalar>(random, from, to);
    return box.from_cell(fraction);
}

/// The shortest of the images of d within some periods of the nearest along each edge in turn, c first: 6, or 16 where
/// an edge is tilted over one that is not periodic, since its nearest image is not at its own height then.
template <std::size_t D, class Scalar>
long double shortest_square(const triclinic_box<D, Scalar>& box, const vec<D, Scalar>& displacement,
                            const std::array<bool, D>& periodic) {
    const int reach = std::all_of(periodic.begin(), periodic.end(), [](bool p) { return p; }) ? 6 : 16;
    std::array<long double, D> d{};
    for (std::size_t k = 0; k < D; ++k) d[k] = displacement[k];
    long double least = std::numeric_limits<long double>::infinity();
    const auto search = [&](auto&& self, std::size_t edges_left) -> void {
        if (edges_left == 0) {
            long double square = 0;
            for (const auto x : d) square += x * x;
            least = (std::min)(least, square);
            return;
        }
        const auto k = edges_left - 1;
        if (!periodic[k]) return self(self, k);
        const auto kept = d;
        const auto nearest = std::nearbyint(d[k] / box.edge(k)[k]);
        for (int n = -reach; n <= reach; ++n) {
            for (std::size_t j = 0; j <= k; ++j) d[j] = kept[j] - (nearest + n) * box.edge(k)[j];
            self(self, k);
        }
        d = kept;
    };
    search(search, D);
    return least;
}
template <std::size_t D, class Scalar>
long double square_of(const vec<D, Scalar>& d) {
    long double square = 0;
    for (const auto x : d) square += static_cast<long double>(x) * x;
    return square;
}

template <std::size_t Dimension, class Scalar>
struct kind {
    static constexpr std::size_t dimension = Dimension;
    using scalar = Scalar;
};
using kinds = std::tuple<kind<2, double>, kind<3, double>, kind<2, float>, kind<3, float>>;

}  // namespace

TEST_CASE("the edges are those of LAMMPS", "[domain][triclinic]") {
    const triclinic_box<3> box({1, 2, 3}, {4, 5, 6}, {0.5, -0.25, 1.5}, {true, true, true});
    CHECK(box.edge(0) == vec<3>{4, 0, 0});
    CHECK(box.edge(1) == vec<3>{0.5, 5, 0});
    CHECK(box.edge(2) == vec<3>{-0.25, 1.5, 6});
    CHECK(box.from_cell({0, 0, 0}) == vec<3>{1, 2, 3});
    CHECK(box.from_cell({1, 1, 1}) == vec<3>{5.25, 8.5, 9});
    CHECK(box.to_cell({5.25, 8.5, 9}) == vec<3>{1, 1, 1});
    CHECK(box.to_cell({1.5, 7, 3}) == vec<3>{0, 1, 0});
}

TEST_CASE("the example of the documentation", "[domain][triclinic]") {
    const triclinic_box<3> box({0, 0, 0}, {1, 1, 1}, {0.5, 0, 0}, {true, true, true});
    const auto [y, shift] = box.wrap({1.8, 1.25, 0.5});
    CHECK(y[0] == Approx(0.3));
    CHECK(y[1] == 0.25);
    CHECK(y[2] == 0.5);
    CHECK(shift == tsubu::image_shift<3>{1, 1, 0});
}

TEMPLATE_LIST_TEST_CASE("of 1 to 7 bricks of the cell exactly one owns a point inside, none any other",
                        "[domain][triclinic][B3]", kinds) {
    constexpr auto D = TestType::dimension;
    using Scalar = typename TestType::scalar;
    tsubu::random_stream random(31);
    for (const auto& form : shapes<D, Scalar>())
        for (const bool periodic : {true, false}) {
            std::array<bool, D> flags{};
            flags.fill(periodic);
            const auto box = form.box(flags);
            for (std::size_t ranks = 1; ranks <= 7; ++ranks) {
                const tsubu::cell_decomposition parts(box, tsubu::brick_decomposition<D, Scalar>(box.cell(), ranks));
                REQUIRE(parts.ranks() == ranks);
                int inside = 0;
                for (int i = 0; i < 150; ++i) {
                    const auto x = some_point(box, random, -0.2, 1.2);
                    std::size_t owners = 0;
                    for (std::size_t rank = 0; rank < ranks; ++rank) owners += parts.subdomain(rank).owns(x) ? 1U : 0U;
                    REQUIRE(owners == (box.contains(x) ? 1U : 0U));
                    if (owners == 1) REQUIRE(parts.subdomain(parts.owner(x)).owns(x));
                    inside += owners == 1 ? 1 : 0;
                    if (!periodic) continue;
                    const auto y = box.wrap(x).position;
                    REQUIRE(box.contains(y));
                    REQUIRE(parts.subdomain(parts.owner(y)).owns(y));
                }
                CHECK(inside > 5);
            }
        }
}

TEMPLATE_LIST_TEST_CASE("wrap returns a point inside, that wraps to itself, and unwraps to where it was",
                        "[domain][triclinic][I8]", kinds) {
    constexpr auto D = TestType::dimension;
    using Scalar = typename TestType::scalar;
    tsubu::random_stream random(32);
    for (const auto& form : shapes<D, Scalar>()) {
        const auto box = form.box(along_all<D>());
        for (int i = 0; i < 4000; ++i) {
            const auto x = some_point(box, random, -3, 4);
            const auto at = box.wrap(x);
            REQUIRE(box.contains(at.position));
            const auto again = box.wrap(at.position);
            REQUIRE(again.position == at.position);
            REQUIRE(again.shift == tsubu::image_shift<D>{});
            const auto back = box.unwrap(at);
            for (std::size_t k = 0; k < D; ++k) {
                Scalar size = std::abs(x[k]) + std::abs(box.lo()[k]);
                for (std::size_t j = k; j < D; ++j) size += 4 * std::abs(box.edge(j)[k]);
                REQUIRE(std::abs(back[k] - x[k]) <= 4 * std::numeric_limits<Scalar>::epsilon() * size);
            }
        }
    }
}

TEMPLATE_LIST_TEST_CASE("wrap leaves alone the edges that are not periodic", "[domain][triclinic][B1]", kinds) {
    constexpr auto D = TestType::dimension;
    using Scalar = typename TestType::scalar;
    tsubu::random_stream random(33);
    for (const auto& form : shapes<D, Scalar>())
        for (unsigned mask = 0; mask < (1U << D); ++mask) {
            std::array<bool, D> periodic{};
            for (std::size_t k = 0; k < D; ++k) periodic[k] = (mask >> k & 1U) != 0;
            const auto box = form.box(periodic);
            for (int i = 0; i < 300; ++i) {
                const auto x = some_point(box, random, -3, 4);
                const auto at = box.wrap(x);
                const auto fraction = box.to_cell(at.position);
                for (std::size_t k = 0; k < D; ++k) {
                    if (periodic[k])
                        REQUIRE((fraction[k] >= 0 && fraction[k] < 1));
                    else
                        REQUIRE(at.shift[k] == 0);
                }
                REQUIRE(box.wrap(at.position).position == at.position);
            }
        }
}

TEMPLATE_LIST_TEST_CASE("wrap is total: far points too have an image inside", "[domain][triclinic][I8]", kinds) {
    constexpr auto D = TestType::dimension;
    using Scalar = typename TestType::scalar;
    tsubu::random_stream random(34);
    constexpr Scalar huge = (std::numeric_limits<Scalar>::max)();
    for (const auto& form : shapes<D, Scalar>()) {
        const auto box = form.box(along_all<D>());
        for (int i = 0; i < 2000; ++i) {
            vec<D, Scalar> x{};
            for (auto& coordinate : x) {
                const auto power = static_cast<int>(random.below(2 * std::numeric_limits<Scalar>::max_exponent)) -
                                   std::numeric_limits<Scalar>::max_exponent;
                coordinate = std::ldexp(static_cast<Scalar>(2 * random.unit() - 1), power);
                if (random.below(20) == 0) coordinate = random.below(2) == 0 ? huge : -huge;
            }
            const auto at = box.wrap(x);
            REQUIRE(box.contains(at.position));
            REQUIRE(box.wrap(at.position).position == at.position);
        }
    }
    const auto box = shapes<D, Scalar>()[1].box(along_all<D>());
    vec<D, Scalar> x{};
    x[D - 1] = huge;
    CHECK(box.wrap(x).shift[D - 1] == std::numeric_limits<std::int64_t>::max());
    x[D - 1] = -huge;
    CHECK(box.wrap(x).shift[D - 1] == std::numeric_limits<std::int64_t>::min());
}

TEST_CASE("boxes of any scale wrap, and find the same image", "[domain][triclinic][I8]") {
    tsubu::random_stream random(35);
    for (const double scale : {0x1p-996, 0x1p-43, 0x1p-23, 1.0, 0x1p50, 0x1p996}) {
        const triclinic_box<3> one({-0.5, 0.25, 0}, {1, 1.25, 0.75}, {3.5, -0.375, 0.625}, {true, true, true});
        const triclinic_box<3> box({-0.5 * scale, 0.25 * scale, 0}, {scale, 1.25 * scale, 0.75 * scale},
                                   {3.5 * scale, -0.375 * scale, 0.625 * scale}, {true, true, true});
        for (int i = 0; i < 500; ++i) {
            vec<3> x{};  // multiples of 2^-53: no scale makes them denormal
            vec<3> y{};
            for (std::size_t k = 0; k < 3; ++k) {
                x[k] = static_cast<double>(random.below(500)) / 64 - 4;
                y[k] = 8 * random.unit() - 4;
            }
            vec<3> big_x{};
            vec<3> big_y{};
            for (std::size_t k = 0; k < 3; ++k) {
                big_x[k] = x[k] * scale;
                big_y[k] = y[k] * scale;
            }
            CHECK(box.to_cell(big_x) == one.to_cell(x));
            CHECK(box.wrap(big_x).shift == one.wrap(x).shift);
            const auto d = box.minimum_image(big_x, big_y);
            const auto expected = one.minimum_image(x, y);
            for (std::size_t k = 0; k < 3; ++k) CHECK(d[k] / scale == expected[k]);
        }
    }
}

TEST_CASE("what rounds to a face is on it", "[domain][triclinic][B1]") {
    const triclinic_box<2> box({0, 0}, {1, 1}, {0.5}, {true, true});
    CHECK(box.contains({-1e-17, 0}));
    CHECK(box.to_cell({-1e-17, 0}) == vec<2>{0, 0});
    CHECK_FALSE(box.contains({1, 0}));
    CHECK(box.wrap({1, 0}).position == vec<2>{0, 0});
    CHECK(box.wrap({1, 0}).shift == tsubu::image_shift<2>{1, 0});
    CHECK(box.wrap({0.5, 1}).position == vec<2>{0, 0});
    CHECK(box.wrap({0.5, 1}).shift == tsubu::image_shift<2>{0, 1});
    CHECK(box.contains({0.5, std::nextafter(1.0, 0.0)}));
    const triclinic_box<2> walls({0, 0}, {1, 1}, {0.5}, {false, false});
    CHECK(walls.contains({1.5, 1}));
    CHECK(walls.wrap({1.5, 1}).position == vec<2>{1.5, 1});
    CHECK_FALSE(walls.contains({1.5, 1.01}));
}

TEMPLATE_LIST_TEST_CASE("the minimum image is as short as the shortest of all images near by, for any tilt",
                        "[domain][triclinic]", kinds) {
    constexpr auto D = TestType::dimension;
    using Scalar = typename TestType::scalar;
    tsubu::random_stream random(36);
    for (const auto& form : shapes<D, Scalar>())
        for (unsigned mask = 0; mask < (1U << D); ++mask) {
            std::array<bool, D> periodic{};
            for (std::size_t k = 0; k < D; ++k) periodic[k] = (mask >> k & 1U) != 0;
            const bool all_below = (mask & (mask + 1)) == 0;
            if (!all_below && std::abs(form.tilt[0]) > 2) continue;  // farther than the search by brute force looks
            const auto box = form.box(periodic);
            for (int i = 0; i < 100; ++i) {
                const auto a = some_point(box, random, -1, 2);
                const auto b = some_point(box, random, -1, 2);
                vec<D, Scalar> difference{};
                for (std::size_t k = 0; k < D; ++k) difference[k] = a[k] - b[k];
                const auto d = box.minimum_image(a, b);
                const auto expected = std::sqrt(shortest_square(box, difference, periodic));
                INFO("xy = " << form.tilt[0] << ", periodic: " << mask);
                const auto tolerance = 16 * std::numeric_limits<Scalar>::epsilon() *
                                       (std::sqrt(square_of<D>(difference)) + std::sqrt(square_of<D>(box.edge(1))) + 1);
                REQUIRE(std::sqrt(square_of<D>(d)) == Approx(expected).epsilon(0).margin(tolerance));
                // and an image of a: as many whole edges away, of those that are periodic
                auto rest = difference;
                for (std::size_t k = 0; k < D; ++k) rest[k] -= d[k];
                for (std::size_t k = D; k-- > 0;) {
                    const auto edges = std::nearbyint(rest[k] / box.edge(k)[k]);
                    if (!periodic[k]) REQUIRE(edges == 0);
                    for (std::size_t j = 0; j <= k; ++j) rest[j] -= edges * box.edge(k)[j];
                }
                REQUIRE(std::sqrt(square_of<D>(rest)) <= 4 * tolerance);
            }
        }
}

TEST_CASE("the minimum image of random cells, from flat to upright", "[domain][triclinic]") {
    tsubu::random_stream random(37);
    const std::array<bool, 3> periodic{true, true, true};
    for (int i = 0; i < 3000; ++i) {
        const auto length = [&] { return 0.7 + random.unit(); };
        const double strength = std::ldexp(1.0, static_cast<int>(random.below(12)) - 4);
        const auto tilt = [&] { return strength * (2 * random.unit() - 1); };
        const triclinic_box<3> box({0, 0, 0}, {length(), length(), length()}, {tilt(), tilt(), tilt()}, periodic);
        const vec<3> d = some_point(box, random, -1, 1);
        const auto v = box.minimum_image(d, {0, 0, 0});
        const auto expected = std::sqrt(shortest_square(box, d, periodic));
        REQUIRE(std::sqrt(square_of<3>(v)) == Approx(expected).epsilon(0).margin(1e-11));
    }
}

TEMPLATE_LIST_TEST_CASE("the minimum image back is the opposite, ties included", "[domain][triclinic]", kinds) {
    constexpr auto D = TestType::dimension;
    using Scalar = typename TestType::scalar;
    tsubu::random_stream random(38);
    for (const auto& form : shapes<D, Scalar>()) {
        const auto box = form.box(along_all<D>());
        for (int i = 0; i < 3000; ++i) {
            auto a = some_point(box, random, -3, 4);
            auto b = some_point(box, random, -3, 4);
            if (i % 2 == 0) {  // halves and thirds of edges: where images are equally near
                vec<D, Scalar> fraction{};
                const auto parts = static_cast<Scalar>(2 + random.below(3));
                for (auto& f : fraction) f = static_cast<Scalar>(random.below(9)) / parts - 2;
                a = box.from_cell(fraction);
                b = box.lo();
            }
            const auto there = box.minimum_image(a, b);
            const auto back = box.minimum_image(b, a);
            for (std::size_t k = 0; k < D; ++k) REQUIRE(there[k] == -back[k]);
        }
    }
    const triclinic_box<2> square({0, 0}, {1, 1}, {0}, {true, true});
    CHECK(square.minimum_image({0.5, 0}, {0, 0}) == vec<2>{0.5, 0});
    CHECK(square.minimum_image({0, 0}, {0.5, 0}) == vec<2>{-0.5, 0});
    CHECK(square.minimum_image({-0.5, 0.5}, {0, 0}) == vec<2>{-0.5, -0.5});
    CHECK(square.minimum_image({0.5, -0.5}, {0, 0}) == vec<2>{0.5, 0.5});
}

TEST_CASE("a cutoff reaches over the heights of the faces", "[domain][triclinic]") {
    const triclinic_box<2> flat({0, 0}, {2, 1}, {1}, {true, true});  // heights: 2 sin 45, and 1
    const auto reach = flat.cell_reach(0.5);
    CHECK(reach[0] == Approx(0.5 / std::sqrt(2.0)));
    CHECK(reach[1] == Approx(0.5));
    tsubu::random_stream random(39);
    for (const auto& form : shapes<3, double>()) {
        const auto box = form.box({true, true, true});
        const auto unit = box.cell_reach(1);
        vec<3> farthest{};
        const auto origin = box.to_cell(box.lo());
        for (int i = 0; i < 20000; ++i) {  // no direction reaches further, and some as far
            vec<3> x{};
            for (auto& c : x) c = 2 * random.unit() - 1;
            const double r = std::sqrt(static_cast<double>(square_of<3>(x)));
            for (std::size_t k = 0; k < 3; ++k) x[k] = box.lo()[k] + x[k] / r;
            const auto f = box.to_cell(x);
            for (std::size_t k = 0; k < 3; ++k) farthest[k] = (std::max)(farthest[k], std::abs(f[k] - origin[k]));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(farthest[k] <= unit[k] * (1 + 1e-9));
            CHECK(farthest[k] >= unit[k] * 0.999);
        }
    }
    CHECK_THROWS_AS(flat.cell_reach(-1), tsubu::input_error);
    CHECK_THROWS_AS(flat.cell_reach(not_a_number), tsubu::input_error);
}

TEST_CASE("a box that is none is refused", "[domain][triclinic]") {
    const std::array<bool, 2> periodic{true, true};
    for (const double length : {0.0, -1.0, infinity, not_a_number})
        CHECK_THROWS_AS((triclinic_box<2>({0, 0}, {1, length}, {0}, periodic)), tsubu::input_error);
    for (const double tilt : {infinity, -infinity, not_a_number})
        CHECK_THROWS_AS((triclinic_box<2>({0, 0}, {1, 1}, {tilt}, periodic)), tsubu::input_error);
    CHECK_THROWS_AS((triclinic_box<2>({not_a_number, 0}, {1, 1}, {0}, periodic)), tsubu::input_error);
    CHECK_THROWS_AS((triclinic_box<2>({1e16, 0}, {1, 1}, {0}, periodic)), tsubu::input_error);
    CHECK_THROWS_AS((triclinic_box<2>({0, 0}, {1, 1}, {1e16}, periodic)), tsubu::input_error);
    CHECK_THROWS_AS((triclinic_box<2>({0, 0}, {1e-200, 1}, {0}, periodic)), tsubu::input_error);
    CHECK_NOTHROW(triclinic_box<2>({0, 0}, {1, 1}, {1e12}, periodic));
}

TEST_CASE("a point that is not finite, or whose image no number is, is refused", "[domain][triclinic]") {
    const triclinic_box<2> box({0, 0}, {1, 1}, {0.5}, {true, true});
    for (const double x : {infinity, -infinity, not_a_number}) {
        CHECK_THROWS_AS(box.wrap({x, 0}), tsubu::input_error);
        CHECK_THROWS_AS(box.wrap({0, x}), tsubu::input_error);
        CHECK_FALSE(box.contains({x, 0}));
        CHECK_FALSE(box.contains({0, x}));
    }
    const triclinic_box<2> slab({0, 0}, {1, 1}, {0.3}, {true, false});
    CHECK_THROWS_AS(slab.wrap({0, 1e30}), tsubu::input_error);
    CHECK_THROWS_AS(slab.wrap({0, 1e300}), tsubu::input_error);
    CHECK(slab.to_cell(slab.wrap({0, 1e6}).position)[0] < 1);
}

TEST_CASE("a decomposition of another domain is refused", "[domain][triclinic]") {
    const triclinic_box<2> box({0, 0}, {1, 1}, {0.5}, {true, true});
    const tsubu::domain<2> other({0, 0}, {1, 2}, {.periodic = {true, true}});
    const tsubu::domain<2> walls({0, 0}, {1, 1});
    CHECK_THROWS_AS(tsubu::cell_decomposition(box, tsubu::brick_decomposition<2>(other, 2)), tsubu::input_error);
    CHECK_THROWS_AS(tsubu::cell_decomposition(box, tsubu::brick_decomposition<2>(walls, 2)), tsubu::input_error);
}
