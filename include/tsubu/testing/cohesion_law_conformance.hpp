// SPDX-License-Identifier: MIT
/// @file
/// Does a cohesion law keep its two laws? A suite for any test framework, or none.
///
///     tsubu::testing::check_cohesion_law(my_pull{...}, [](bool ok, std::string_view law) { ... });
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/testing/detail/contacts.hpp>

#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <string>       // std::string
#include <string_view>  // std::string_view

namespace tsubu::testing {

/// The laws of cohesion_law as the suite reports them: a name for each text; never an object.
struct cohesion_law_text {
    cohesion_law_text() = delete;

    static constexpr const char* pulls = "law 1: the pull is not negative";
    static constexpr const char* lanes = "law 2: lanes have the results of the numbers, unless built to fuse products";
};

/// Does this law of cohesion keep laws 1 and 2?
///
/// @param check  called as check(bool kept, std::string_view law); a broken law with the radius behind its text
/// @param seed   of the radii that are tried
template <dem::cohesion_law Law, class Check>
    requires(Law::pulls)
void check_cohesion_law(const Law& law, Check&& check, std::uint64_t seed = 1) {
    random_stream random(seed);
    const auto report = [&](bool kept, const char* text, double radius) {
        if (kept) return check(true, std::string_view(text));
        check(false, std::string_view(std::string(text) + ", at a radius of " + detail::shown(radius)));
    };
    const auto in_lanes = [&]<class Real>(Real radius) {
        const auto radii =
            lanes<Real>::of([&](auto l) { return radius * static_cast<Real>(1 + 0.1 * static_cast<double>(l)); });
        const auto pulls = law.pull(radii);
        bool is_same = true;
        for (std::size_t l = 0; l < lanes<Real>::count; ++l)
            is_same = is_same && detail::is_same_number(pulls[l], law.pull(radii[l]));
        report(is_same, cohesion_law_text::lanes, static_cast<double>(radius));
    };
    for (int round = 0; round < 100; ++round) {
        const double radius = 0.1 + random.unit();
        report(law.pull(radius) >= 0, cohesion_law_text::pulls, radius);
        in_lanes(radius);
        in_lanes(static_cast<float>(radius));
    }
}

}  // namespace tsubu::testing
