// SPDX-License-Identifier: MIT
/// @file
/// Do the shipped reaches keep what their concept says, and does the suite catch what it is there for?
#include <tsubu/testing/pair_reach_conformance.hpp>

#include "support/catch.hpp"
#include "support/verdict.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace {

using tsubu::index_t;

constexpr std::size_t count = 12;
const std::vector<double> radii{.5, .1, .7, .7, 0, .3, 1e-3, 2, .25, .5, 3, 3};

template <class Reach, class Distance>
verdict judged(const Reach& reach, Distance&& distance) {
    verdict seen;
    tsubu::testing::check_pair_reach(reach, count, distance, seen);
    return seen;
}

/// With the members that the concept names and no others: like ones are near up to 1, unlike ones up to 2.
struct by_kind {
    [[nodiscard]] static double between(index_t i, index_t j) noexcept { return i % 2 == j % 2 ? 1 : 2; }
    double greatest(std::size_t particles) const { return particles > 1 ? 2 : 0; }
    template <class Real>
    Real square(index_t i, index_t j) const noexcept {
        return static_cast<Real>(between(i, j) * between(i, j));
    }
};

/// Each breaks one law.
struct without_skin : tsubu::radii_reach<> {
    [[nodiscard]] double greatest(std::size_t particles) const { return radii_reach::greatest(particles) - skin; }
};
struct without_the_last : tsubu::radii_reach<> {
    [[nodiscard]] double greatest(std::size_t particles) const { return radii_reach::greatest(particles - 1); }
};
struct of_the_first : tsubu::radii_reach<> {
    template <class Real>
    [[nodiscard]] Real square(index_t i, index_t) const noexcept {
        return radii_reach::square<Real>(i, i);
    }
};
struct not_squared : tsubu::radii_reach<> {
    template <class Real>
    [[nodiscard]] Real square(index_t i, index_t j) const noexcept {
        return static_cast<Real>(radii[static_cast<std::size_t>(i)] + radii[static_cast<std::size_t>(j)] + skin);
    }
};

double touching(index_t i, index_t j) {
    return radii[static_cast<std::size_t>(i)] + radii[static_cast<std::size_t>(j)] + .1;
}

}  // namespace

TEST_CASE("the shipped reaches keep their laws", "[neighbor][conformance]") {
    const auto check = [](const verdict& seen) {
        INFO(seen.first);
        CHECK(seen.broken.empty());
        CHECK(seen.checked == 3 * count * (count - 1) / 2);
    };
    check(judged(tsubu::same_reach{.3}, [](index_t, index_t) { return .3; }));
    check(judged(tsubu::radii_reach<>{radii, .1}, touching));
    const std::vector<float> floats(radii.begin(), radii.end());
    check(judged(tsubu::radii_reach<float>{floats, .1}, [&](index_t i, index_t j) {
        return static_cast<double>(floats[static_cast<std::size_t>(i)]) +
               static_cast<double>(floats[static_cast<std::size_t>(j)]) + .1;
    }));
    check(judged(by_kind{}, by_kind::between));
}
TEST_CASE("a reach that breaks a law is caught", "[neighbor][conformance]") {
    const auto only = [](const verdict& seen, const char* law) {
        INFO(seen.first);
        CHECK(seen.broken.size() == 1);
        CHECK(seen.broken.count(law) == 1);
    };
    only(judged(without_skin{{radii, .1}}, touching), "law 1");
    only(judged(without_the_last{{radii, .1}}, touching), "law 1");
    only(judged(of_the_first{{radii, .1}}, touching), "law 2");
    only(judged(not_squared{{radii, .1}}, touching), "law 2");
    // A pair is named.
    const auto seen = judged(without_skin{{radii, .1}}, touching);
    CHECK(seen.first.find("of particles 2 and 3") != std::string::npos);
}
