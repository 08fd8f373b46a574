// SPDX-License-Identifier: MIT
/// @file
/// Does a tangential law keep its eight laws? A suite for any test framework, or none.
///
///     tsubu::testing::check_tangential_law<3>(my_friction{...}, [](bool ok, std::string_view law) { ... });
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/testing/detail/contacts.hpp>

#include <cmath>        // std::abs, std::exp2
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint64_t
#include <string>       // std::string
#include <string_view>  // std::string_view

namespace tsubu::testing {

/// The laws of tangential_law as the suite reports them: a name for each text; never an object.
struct tangential_law_text {
    tangential_law_text() = delete;

    static constexpr const char* across = "law 1: the force is at right angles to the normal";
    static constexpr const char* limit = "law 2: the force is no more than mu times the normal force";
    static constexpr const char* resists = "law 3: without history the force does not drive the slip";
    static constexpr const char* at_rest = "law 3: without slip and history there is no force, and no history";
    static constexpr const char* again = "law 4: after no time force and history are the same";
    static constexpr const char* opposite = "law 5: seen from j force and history are the opposite";
    static constexpr const char* lanes = "law 6: lanes have the results of the numbers, unless built to fuse products";
    static constexpr const char* viscosity = "law 7: the viscosity is the force per slip without history";
    static constexpr const char* stiffness = "law 8: the stiffness is that of the spring";
};

/// Does this law of friction keep laws 1 to 8 in D dimensions, up to the limit of friction and beyond?
///
/// @param check  called as check(bool kept, std::string_view law); a broken law with the round behind its text
/// @param seed   of the contacts that are tried
template <std::size_t D, dem::tangential_law Law, class Check>
    requires(Law::turns)
void check_tangential_law(const Law& law, Check&& check, std::uint64_t seed = 1) {
    using history = vec<Law::template history_size<D>, double>;
    random_stream random(seed);
    int round = 0;
    const auto report = [&](bool kept, const char* text) {
        if (kept) return check(true, std::string_view(text));
        check(false, std::string_view(std::string(text) + ", in round " + detail::shown(round)));
    };
    // The same instructions each time: where products are fused, copies of them may round otherwise.
    const auto force_of = [&](const dem::contact<D, double>& at, double normal_force, double damping,
                              history& past) __attribute__((noinline)) {
        return law.template force<D, double>(at, normal_force, damping, past);
    };
    constexpr double boundless = 1e15;  // a normal force under which nothing slides
    double greatest_force = 0;
    double greatest_way = 0;
    for (; round < 100; ++round) {
        const auto at = detail::any_contact<D>(random);
        const double damping = random.unit();
        const auto slip = dem::slip_of<D, double>(at);

        // From the beginning of a contact, and within the limit: this sets the scale of forces and ways.
        history begun{};
        const auto free = force_of(at, boundless, damping, begun);
        const double strength = detail::length_of<D>(free);
        const double way = detail::length_of(begun);
        greatest_force = strength > greatest_force ? strength : greatest_force;
        greatest_way = way > greatest_way ? way : greatest_way;
        report(std::abs(dem::dot<D, double>(free, at.normal)) <= 1e-12 * strength, tangential_law_text::across);
        report(dem::dot<D, double>(free, slip) <= 1e-12 * strength * detail::length_of<D>(slip),
               tangential_law_text::resists);
        auto sudden = at;
        sudden.time_step = 0;
        history nothing{};
        const double viscous = detail::length_of<D>(force_of(sudden, boundless, damping, nothing));
        const double expected = law.viscosity(at.mass, damping) * detail::length_of<D>(slip);
        report(std::abs(viscous - expected) <= 1e-12 * expected, tangential_law_text::viscosity);
        if constexpr (dem::sticking_law<Law>) {
            history later{};
            auto longer = at;
            longer.time_step *= 2;
            const auto more = force_of(longer, boundless, damping, later);
            const double stiffness = detail::length_of<D>(dem::minus<D, double>(more, free)) /
                                     (detail::length_of<D>(slip) * at.time_step);
            const double told = law.stiffness(at.overlap, at.radius);
            report(std::abs(stiffness - told) <= 1e-9 * told, tangential_law_text::stiffness);
        }

        auto resting = at;
        resting.velocity = {};
        resting.sliding = {};
        history none{};
        report(detail::length_of<D>(force_of(resting, boundless, damping, none)) == 0 && detail::length_of(none) == 0,
               tangential_law_text::at_rest);

        // Some steps with the limit about where the force is, and the normal another each time.
        history past{};
        for (int step = 0; step < 4; ++step) {
            auto now = detail::any_contact<D>(random);
            const double pressed = (step == 2 ? -1 : 1) * (law.mu > 0 ? strength / law.mu : 1) *
                                   std::exp2(2 * detail::signed_unit(random));
            auto other = past;
            for (double& one : other) one = -one;
            const auto force = force_of(now, pressed, damping, past);
            const double scale = 1e-9 * (strength + std::abs(law.mu * pressed));
            report(std::abs(dem::dot<D, double>(force, now.normal)) <= scale, tangential_law_text::across);
            report(detail::length_of<D>(force) <= law.mu * std::abs(pressed) * (1 + 1e-12), tangential_law_text::limit);

            const auto on_other = force_of(detail::seen_from_other<D>(now), pressed, damping, other);
            bool is_opposite = true;
            for (std::size_t k = 0; k < D; ++k) is_opposite = is_opposite && on_other[k] == -force[k];
            for (std::size_t k = 0; k < past.size(); ++k) is_opposite = is_opposite && other[k] == -past[k];
            report(is_opposite, tangential_law_text::opposite);

            now.time_step = 0;
            auto held = past;
            const auto same = force_of(now, pressed, damping, held);
            bool is_same = detail::length_of<D>(dem::minus<D, double>(same, force)) <= scale;
            for (std::size_t k = 0; k < past.size(); ++k)
                is_same = is_same && std::abs(held[k] - past[k]) <= 1e-9 * (way + detail::length_of(past));
            report(is_same, tangential_law_text::again);
        }
    }
    const auto in_lanes = [&]<class Real>(Real) {
        for (round = 0; round < 20; ++round) {
            detail::contacts_in_lanes<D, Real, Law::template history_size<D>> asked(
                random, law.mu > 0 ? greatest_force / law.mu : 1, greatest_way);
            report(asked.agree([&](auto& q) {
                using number = decltype(q.normal_force);
                return law.template force<D, number>(q.at, q.normal_force, q.factor, q.history);
            }),
                   tangential_law_text::lanes);
        }
    };
    in_lanes(double{});
    in_lanes(float{});
}

}  // namespace tsubu::testing
