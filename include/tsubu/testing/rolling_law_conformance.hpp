// SPDX-License-Identifier: MIT
/// @file
/// Does a rolling law keep its six laws? A suite for any test framework, or none.
///
///     tsubu::testing::check_rolling_law<3>(my_resistance{...}, [](bool ok, std::string_view law) { ... });
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

/// The laws of rolling_law as the suite reports them: a name for each text; never an object.
struct rolling_law_text {
    rolling_law_text() = delete;

    static constexpr const char* across = "law 1: in space the torque is at right angles to the normal";
    static constexpr const char* limit = "law 2: the torque on what does not turn is no more than mu_r R* |F_n|";
    static constexpr const char* resists = "law 3: without history the torque does not drive the rolling";
    static constexpr const char* at_rest = "law 3: without rolling and history there is no torque";
    static constexpr const char* again = "law 4: after no time the history is the same";
    static constexpr const char* opposite = "law 5: seen from j torque and history are the opposite";
    static constexpr const char* lanes = "law 6: lanes have the results of the numbers, unless built to fuse products";
};

/// Does this law of rolling keep laws 1 to 6 in D dimensions, until it yields and beyond?
///
/// @param stiffness  of the normal law [N/m]
/// @param check      called as check(bool kept, std::string_view law); a broken law with the round behind its text
/// @param seed       of the contacts that are tried
template <std::size_t D, dem::rolling_law Law, class Check>
    requires(Law::resists && D > 1)
void check_rolling_law(const Law& law, double stiffness, Check&& check, std::uint64_t seed = 1) {
    constexpr auto spins = dem::spin_count<D>;
    using history = vec<Law::template history_size<D>, double>;
    random_stream random(seed);
    int round = 0;
    const auto report = [&](bool kept, const char* text) {
        if (kept) return check(true, std::string_view(text));
        check(false, std::string_view(std::string(text) + ", in round " + detail::shown(round)));
    };
    // The same instructions each time: where products are fused, copies of them may round otherwise.
    const auto torque_of = [&](const dem::contact<D, double>& at, double normal_force,
                               history& past) __attribute__((noinline)) {
        return law.template torque<D, double>(at, normal_force, stiffness, past);
    };
    // The part of a torque along the normal: in a plane the normal has none.
    const auto along = [](const auto& torque, const auto& normal) {
        if constexpr (D == 3)
            return std::abs(dem::dot<3, double>(torque, normal));
        else
            return 0 * torque[0] * normal[0];
    };
    constexpr double boundless = 1e15;  // a normal force under which nothing yields
    double greatest_force = 0;
    double greatest_history = 0;
    for (; round < 100; ++round) {
        const auto at = detail::any_contact<D>(random);
        // From the beginning of a contact: this sets the scale.
        history begun{};
        const auto free = torque_of(at, boundless, begun);
        const double strength = detail::length_of<spins>(free);
        const double size = detail::length_of(begun);
        const double yields_at = law.mu_r > 0 ? strength / (law.mu_r * at.radius) : 1;
        greatest_force = yields_at > greatest_force ? yields_at : greatest_force;
        greatest_history = size > greatest_history ? size : greatest_history;
        report(along(free, at.normal) <= 1e-12 * strength, rolling_law_text::across);
        report(dem::dot<spins, double>(free, at.turning) <= 1e-12 * strength * detail::length_of<spins>(at.turning),
               rolling_law_text::resists);

        auto resting = at;
        resting.turning = {};
        history none{};
        bool is_none = detail::length_of<spins>(torque_of(resting, boundless, none)) == 0 &&
                       detail::length_of(none) == 0;
        if constexpr (D == 3) {
            resting.turning = at.normal;  // it twists
            is_none = is_none && detail::length_of<spins>(torque_of(resting, boundless, none)) <= 1e-10 * strength;
        }
        report(is_none, rolling_law_text::at_rest);

        history past{};
        for (int step = 0; step < 4; ++step) {
            auto now = detail::any_contact<D>(random);
            const double pressed = (step == 2 ? -1 : 1) * yields_at * std::exp2(2 * detail::signed_unit(random));
            auto other = past;
            for (double& one : other) one = -one;
            const auto torque = torque_of(now, pressed, past);
            report(along(torque, now.normal) <= 1e-9 * (strength + detail::length_of<spins>(torque)),
                   rolling_law_text::across);

            const auto on_other = torque_of(detail::seen_from_other<D>(now), pressed, other);
            bool is_opposite = true;
            for (std::size_t k = 0; k < spins; ++k) is_opposite = is_opposite && on_other[k] == -torque[k];
            for (std::size_t k = 0; k < past.size(); ++k) is_opposite = is_opposite && other[k] == -past[k];
            report(is_opposite, rolling_law_text::opposite);

            now.time_step = 0;
            auto held = past;
            (void)torque_of(now, pressed, held);
            bool is_same = true;
            for (std::size_t k = 0; k < past.size(); ++k)
                is_same = is_same && std::abs(held[k] - past[k]) <= 1e-9 * (size + detail::length_of(past));
            report(is_same, rolling_law_text::again);

            now.turning = {};
            const double most = law.mu_r * now.radius * std::abs(pressed);
            report(detail::length_of<spins>(torque_of(now, pressed, held)) <= most * (1 + 1e-12),
                   rolling_law_text::limit);
        }
    }
    const auto in_lanes = [&]<class Real>(Real) {
        for (round = 0; round < 20; ++round) {
            detail::contacts_in_lanes<D, Real, Law::template history_size<D>> asked(random, greatest_force,
                                                                                    greatest_history);
            report(asked.agree([&](auto& q) {
                using number = decltype(q.normal_force);
                const number stiff = dem::constant<number>(stiffness);
                return law.template torque<D, number>(q.at, q.normal_force, stiff, q.history);
            }),
                   rolling_law_text::lanes);
        }
    };
    in_lanes(double{});
    in_lanes(float{});
}

}  // namespace tsubu::testing
