// SPDX-License-Identifier: MIT
/// @file
/// Does a normal law keep its three laws? A suite for any test framework, or none.
///
///     tsubu::testing::check_normal_law(my_law{...}, 1e-3, [](bool ok, std::string_view law) { ... });
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/testing/detail/contacts.hpp>

#include <cmath>        // std::abs
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <string>       // std::string
#include <string_view>  // std::string_view

namespace tsubu::testing {

/// The laws of normal_law as the suite reports them: a name for each text; never an object.
struct normal_law_text {
    normal_law_text() = delete;

    static constexpr const char* begins = "law 1: there is no elastic force where bodies begin to touch";
    static constexpr const char* rises = "law 1: the elastic force does not fall with the overlap";
    static constexpr const char* stiffness = "law 1: the stiffness is the derivative of the force";
    static constexpr const char* energy = "law 1: the energy is the integral of the force";
    static constexpr const char* damping = "law 2: the damping is not negative, and none if the law says so";
    static constexpr const char* lanes = "law 3: lanes have the results of the numbers, unless built to fuse products";
};

/// Does this law keep laws 1 to 3, up to this overlap [m]?
///
/// @param check  called as check(bool kept, std::string_view law); a broken law with the overlap behind its text
/// @param seed   of the overlaps, masses and radii that are tried
template <dem::normal_law Law, class Check>
void check_normal_law(const Law& law, double most, Check&& check, std::uint64_t seed = 1) {
    random_stream random(seed);
    const auto report = [&](bool kept, const char* text, double overlap) {
        if (kept) return check(true, std::string_view(text));
        check(false, std::string_view(std::string(text) + ", at an overlap of " + detail::shown(overlap)));
    };
    const auto is_near = [](double a, double b, double relative, double absolute) {
        return std::abs(a - b) <= relative * std::abs(b) + absolute;
    };
    for (int round = 0; round < 100; ++round) {
        const double radius = 0.1 + random.unit();
        const double mass = 0.1 + random.unit();
        const double d = most * (0.05 + 0.95 * random.unit());
        const double force = law.elastic(d, radius);
        report(law.elastic(0.0, radius) == 0, normal_law_text::begins, 0);
        report(law.elastic(0.9 * d, radius) <= force, normal_law_text::rises, d);

        // A fourth-order difference: exact to 1e-8 for powers of the overlap.
        const double h = 1e-3 * d;
        const double slope = (8 * (law.elastic(d + h, radius) - law.elastic(d - h, radius)) -
                              (law.elastic(d + 2 * h, radius) - law.elastic(d - 2 * h, radius))) /
                             (12 * h);
        // Where the law has a kink within the difference, the slope is between those of its sides, or not far.
        const double before = law.stiffness(d - 2 * h, radius);
        const double after = law.stiffness(d + 2 * h, radius);
        const double kink = std::abs(after - before) > 0.02 * std::abs(before) ? std::abs(after - before) : 0;
        report(is_near(law.stiffness(d, radius), slope, 1e-8, 1.2 * kink), normal_law_text::stiffness, d);
        // The work from d/2 to d, by Simpson's rule, whose error is 1e-7 where the law has a kink.
        constexpr int parts = 512;
        double work = 0;
        for (int n = 0; n <= parts; ++n)
            work += (n == 0 || n == parts ? 1 : n % 2 == 1 ? 4 : 2) * law.elastic(d / 2 + d / 2 * n / parts, radius);
        work *= d / 2 / parts / 3;
        report(is_near(law.energy(d, radius) - law.energy(d / 2, radius), work, 1e-6, 0), normal_law_text::energy, d);

        const double damping = law.damping(d, mass, radius);
        report(Law::is_damped ? damping >= 0 : damping == 0, normal_law_text::damping, d);

        const auto in_lanes = [&]<class Real>(Real overlap, Real m, Real r) {
            using several = lanes<Real>;
            const auto overlaps =
                several::of([&](auto l) { return overlap * static_cast<Real>(1 + 0.1 * static_cast<double>(l)); });
            const auto forces = law.elastic(overlaps, several(r));
            const auto slopes = law.stiffness(overlaps, several(r));
            const auto dampings = law.damping(overlaps, several(m), several(r));
            bool is_same = true;
            for (std::size_t l = 0; l < several::count; ++l)
                is_same = is_same && detail::is_same_number(forces[l], law.elastic(overlaps[l], r)) &&
                          detail::is_same_number(slopes[l], law.stiffness(overlaps[l], r)) &&
                          detail::is_same_number(dampings[l], law.damping(overlaps[l], m, r));
            report(is_same, normal_law_text::lanes, d);
        };
        in_lanes(d, mass, radius);
        in_lanes(static_cast<float>(d), static_cast<float>(mass), static_cast<float>(radius));
    }
}

}  // namespace tsubu::testing
