// SPDX-License-Identifier: MIT
/// @file
/// Contacts to examine laws with: any one, the same seen from the other body, and several side by side in lanes.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <array>    // std::array
#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t
#include <cstring>  // std::memcmp

namespace tsubu::detail {

/// In [-1, 1).
[[nodiscard]] inline double signed_unit(random_stream& random) { return 2 * random.unit() - 1; }

template <std::size_t Count>
[[nodiscard]] double length_of(const vec<Count, double>& v) {
    double square = 0;
    for (const double one : v) square += one * one;
    return std::sqrt(square);
}
/// Equal to the last bit, or both not a number.
template <class Real>
[[nodiscard]] bool is_same_number(Real a, Real b) {
    const auto is_nan = [](Real x) { return x != x; };  // NOLINT(misc-redundant-expression)
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): 0 and -0 differ
    return std::memcmp(&a, &b, sizeof(Real)) == 0 || (is_nan(a) && is_nan(b));
}

/// body(number) for each number that a contact consists of.
template <class Contact, class Body>
void each_number(Contact&& at, Body&& body) {
    body(at.overlap);
    body(at.mass);
    body(at.radius);
    body(at.time_step);
    for (auto& one : at.normal) body(one);
    for (auto& one : at.velocity) body(one);
    for (auto& one : at.sliding) body(one);
    for (auto& one : at.turning) body(one);
}

/// A contact of bodies of the order of 1 that overlap by about a hundredth, and move and turn in any way.
template <std::size_t D>
[[nodiscard]] dem::contact<D, double> any_contact(random_stream& random) {
    dem::contact<D, double> at{};
    each_number(at, [&](double& one) { one = signed_unit(random); });
    at.overlap = 1e-2 * (0.1 + random.unit());
    at.mass = 0.1 + random.unit();
    at.radius = 0.1 + random.unit();
    at.time_step = 1e-3;
    const double length = length_of<D>(at.normal);
    for (double& one : at.normal) one /= length;
    return at;
}
/// The same as j sees it.
template <std::size_t D>
[[nodiscard]] dem::contact<D, double> seen_from_other(dem::contact<D, double> at) {
    at.normal = dem::scaled<D, double>(at.normal, -1);
    at.velocity = dem::scaled<D, double>(at.velocity, -1);
    at.turning = dem::scaled<dem::spin_count<D>, double>(at.turning, -1);
    return at;
}

/// As many contacts as there are lanes, with a force, a factor and a history each: alone, and side by side.
template <std::size_t D, class Real, std::size_t History>
struct contacts_in_lanes {
    using several = lanes<Real>;
    static constexpr auto count = several::count;
    /// What a law is asked with.
    template <class Number>
    struct question {
        dem::contact<D, Number> at{};
        Number normal_force{};
        Number factor{};
        vec<History, Number> history{};
    };

    std::array<question<Real>, count> alone;
    question<several> together;

    /// @param force   the normal forces that are tried are as great as this
    /// @param way     histories likewise
    contacts_in_lanes(random_stream& random, double force, double way) {
        for (std::size_t l = 0; l < count; ++l) {
            std::size_t n = 0;
            std::array<double, 32> numbers{};
            each_number(any_contact<D>(random), [&](double one) { numbers[n++] = one; });
            n = 0;
            each_number(alone[l].at, [&](Real& one) { one = static_cast<Real>(numbers[n++]); });
            n = 0;
            each_number(together.at, [&](several& one) { one.set(l, static_cast<Real>(numbers[n++])); });
            const auto both = [&](Real& one, several& all, double value) {
                one = static_cast<Real>(value);
                all.set(l, one);
            };
            both(alone[l].normal_force, together.normal_force, force * signed_unit(random));
            both(alone[l].factor, together.factor, random.unit());
            for (std::size_t k = 0; k < History; ++k)
                both(alone[l].history[k], together.history[k], way * signed_unit(random));
        }
    }
    /// Whether answer(question), a vec, is the same in lanes and alone, and the history that it leaves.
    template <class Answer>
    [[nodiscard]] bool agree(Answer&& answer) {
        const auto all = answer(together);
        bool is_same = true;
        for (std::size_t l = 0; l < count; ++l) {
            const auto one = answer(alone[l]);
            for (std::size_t k = 0; k < one.size(); ++k) is_same = is_same && is_same_number(all[k][l], one[k]);
            for (std::size_t k = 0; k < History; ++k)
                is_same = is_same && is_same_number(together.history[k][l], alone[l].history[k]);
        }
        return is_same;
    }
};

}  // namespace tsubu::detail
