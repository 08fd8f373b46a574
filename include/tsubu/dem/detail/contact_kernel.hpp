// SPDX-License-Identifier: MIT
/// @file
/// The forces of all contacts: which neighbours touch, and what the law does to them, several at a time.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/dem/walls.hpp>
#include <tsubu/neighbor/pair_list.hpp>

#include <algorithm>    // std::min
#include <cstddef>      // std::size_t
#include <cstdint>      // std::uint32_t, std::uint8_t
#include <span>         // std::span
#include <type_traits>  // std::conditional_t

namespace tsubu::dem::detail {

/// Whether neighbours touched: bit 0 in the last evaluation, bit 1 in the one before.
using touch_state = std::uint8_t;

// Of all neighbours some touch, which cannot be predicted: a first pass over a block finds them without a branch, a
// second acts on as many at a time as there are lanes. What is left over of a block waits for the next.

/// Finds who touches, and lets the law act.
template <class Scene>
class contact_kernel {
    static constexpr auto D = Scene::dimension;
    static constexpr auto spins = Scene::quantities_type::spins;
    static constexpr auto springs = Scene::springs;
    static constexpr bool turns = Scene::turns;
    using real = typename Scene::real;
    using law_type = typename Scene::contact_type;
    using V = lanes<real>;
    static constexpr auto width = static_cast<unsigned>(V::count);
    using memory_type = vec<springs, real>;
    static constexpr std::uint32_t block = 512;  // the lists of a block stay in the first-level cache

public:
    contact_kernel(const columns<Scene>& of, const law_type& law, double time_step) noexcept
        : of_(of), law_(law), time_step_(static_cast<real>(time_step)) {}

    /// @param touches  of each pair; null if the law remembers nothing
    /// @param memory   of each pair; likewise
    void act_on_pairs(std::span<const index_pair> pairs, touch_state* touches, memory_type* memory) const {
        walk<pair_meeting>(pair_meeting{of_, pairs.data()}, static_cast<std::uint32_t>(pairs.size()), touches, memory);
    }
    /// @param near  i is a particle, j a wall
    void act_on_walls(std::span<const index_pair> near, std::span<const wall_plane<D>> planes, touch_state* touches,
                      memory_type* memory) const {
        walk<wall_meeting>(wall_meeting{of_, near.data(), planes.data()}, static_cast<std::uint32_t>(near.size()),
                           touches, memory);
    }

private:
    /// Two particles.
    struct pair_meeting {
        static constexpr bool has_partner = true;
        const columns<Scene>& of;
        const index_pair* pairs;

        [[gnu::always_inline]] index_t first(std::uint32_t k) const noexcept { return pairs[k].i; }
        [[gnu::always_inline]] index_t second(std::uint32_t k) const noexcept { return pairs[k].j; }
        template <class Which>
        [[gnu::always_inline]] vec<D, V> apart(Which which) const noexcept {
            vec<D, V> d;
            for (unsigned l = 0; l < width; ++l) {
                const auto& a = of.x[pairs[which(l)].i];
                const auto& b = of.x[pairs[which(l)].j];
                for (std::size_t k = 0; k < D; ++k) d[k].set(l, of.apart(k, a[k], b[k]));
            }
            return d;
        }
        template <class Which>
        [[gnu::always_inline]] unsigned touching(Which which) const noexcept {
            const auto d = apart(which);
            const V sum = radii(which);
            return (dot<D, V>(d, d) < sum * sum).bits();
        }
        template <class Which>
        [[gnu::always_inline]] V radii(Which which) const noexcept {
            if constexpr (Scene::bodies_type::are_equal) {
                return V(2 * of.radius_of_all);
            } else {
                V sum;
                for (unsigned l = 0; l < width; ++l)
                    sum.set(l, static_cast<real>(of.radius[pairs[which(l)].i] + of.radius[pairs[which(l)].j]));
                return sum;
            }
        }
        template <class Which>
        [[gnu::always_inline]] void measure(Which which, contact<D, V>& at) const noexcept {
            const auto d = apart(which);
            const V distance = sqrt(dot<D, V>(d, d));
            at.normal = scaled<D, V>(d, V(1) / distance);
            at.overlap = radii(which) - distance;
            if constexpr (Scene::bodies_type::are_equal) {
                at.mass = V(of.mass_of_all / 2);
                at.radius = V(of.radius_of_all / 2);
            } else {
                for (unsigned l = 0; l < width; ++l) {
                    const auto [i, j] = pairs[which(l)];
                    // Reciprocals, so that one mass may be infinite.
                    at.mass.set(l, static_cast<real>(1 / (1 / of.mass[i] + 1 / of.mass[j])));
                    at.radius.set(l, static_cast<real>(of.radius[i] * of.radius[j] / (of.radius[i] + of.radius[j])));
                }
            }
            if constexpr (law_type::needs_velocity)
                for (unsigned l = 0; l < width; ++l) {
                    const auto& a = of.v[pairs[which(l)].i];
                    const auto& b = of.v[pairs[which(l)].j];
                    for (std::size_t k = 0; k < D; ++k) at.velocity[k].set(l, a[k] - b[k]);
                }
            if constexpr (turns)
                for (unsigned l = 0; l < width; ++l) {
                    const auto [i, j] = pairs[which(l)];
                    for (std::size_t k = 0; k < spins; ++k) {
                        at.sliding[k].set(l, of.radius_at(i) * of.w[i][k] + of.radius_at(j) * of.w[j][k]);
                        at.turning[k].set(l, of.w[i][k] - of.w[j][k]);
                    }
                }
        }
    };
    /// A particle and a wall.
    struct wall_meeting {
        static constexpr bool has_partner = false;
        const columns<Scene>& of;
        const index_pair* pairs;
        const wall_plane<D>* planes;

        [[gnu::always_inline]] index_t first(std::uint32_t k) const noexcept { return pairs[k].i; }
        [[gnu::always_inline]] index_t second(std::uint32_t k) const noexcept { return pairs[k].j; }
        template <class Which>
        [[gnu::always_inline]] V distance(Which which) const noexcept {
            V result;
            for (unsigned l = 0; l < width; ++l) {
                const auto [i, w] = pairs[which(l)];
                result.set(l, static_cast<real>(planes[w].distance(of.real_position(i))));
            }
            return result;
        }
        template <class Which>
        [[gnu::always_inline]] V radii(Which which) const noexcept {
            V result;
            for (unsigned l = 0; l < width; ++l) result.set(l, of.radius_at(pairs[which(l)].i));
            return result;
        }
        template <class Which>
        [[gnu::always_inline]] unsigned touching(Which which) const noexcept {
            return (distance(which) < radii(which)).bits();
        }
        template <class Which>
        [[gnu::always_inline]] void measure(Which which, contact<D, V>& at) const noexcept {
            at.radius = radii(which);
            at.overlap = at.radius - distance(which);
            for (unsigned l = 0; l < width; ++l) {
                const auto [i, w] = pairs[which(l)];
                at.mass.set(l, of.mass_at(i));
                for (std::size_t k = 0; k < D; ++k)
                    at.normal[k].set(l, static_cast<real>(planes[w].normal[k]));
                if constexpr (law_type::needs_velocity)
                    for (std::size_t k = 0; k < D; ++k) at.velocity[k].set(l, of.v[i][k]);
                if constexpr (turns)
                    for (std::size_t k = 0; k < spins; ++k) {
                        at.sliding[k].set(l, of.radius_at(i) * of.w[i][k]);
                        at.turning[k].set(l, of.w[i][k]);
                    }
            }
        }
    };

    template <class Meeting>
    void walk(const Meeting& meet, std::uint32_t count, touch_state* touches, memory_type* memory) const {
        std::uint32_t active[block + 2 * width];
        std::uint32_t waiting = 0;
        for (std::uint32_t begin = 0; begin < count; begin += block) {
            const auto end = (std::min)(count, begin + block);
            auto k = begin;
            for (; k + width <= end; k += width)
                note(meet.touching([k](unsigned l) { return k + l; }), k, width, active, waiting, touches);
            if (k < end)  // the last of all stands in for those that are missing
                note(meet.touching([k, end](unsigned l) { return (std::min)(k + l, end - 1); }), k, end - k, active,
                     waiting, touches);
            std::uint32_t done = 0;
            for (; done + width <= waiting; done += width) act(meet, active + done, width, touches, memory);
            waiting -= done;
            for (std::uint32_t l = 0; l < waiting; ++l) active[l] = active[done + l];
        }
        if (waiting != 0) {
            for (auto l = waiting; l < width; ++l) active[l] = active[0];
            act(meet, active, waiting, touches, memory);
        }
    }
    [[gnu::always_inline]] static void note(unsigned bits, std::uint32_t k, unsigned count, std::uint32_t* active,
                                            std::uint32_t& waiting, touch_state* touches) noexcept {
        for (unsigned l = 0; l < count; ++l) {
            const auto touching = bits >> l & 1U;
            active[waiting] = k + l;
            waiting += touching;
            if constexpr (springs != 0)
                touches[k + l] = static_cast<touch_state>((unsigned{touches[k + l]} << 1U | touching) & 3U);
        }
    }
    template <class Meeting>
    [[gnu::always_inline]] void act(const Meeting& meet, const std::uint32_t* active, unsigned count,
                                    touch_state* touches, memory_type* memory) const noexcept {
        const auto which = [active](unsigned l) __attribute__((always_inline)) { return active[l]; };
        contact<D, V> at;
        meet.measure(which, at);
        at.time_step = V(time_step_);
        vec<springs, V> remembered;
        if constexpr (springs != 0)
            for (unsigned l = 0; l < width; ++l) {
                const auto& held = memory[active[l]];
                const bool is_old = (touches[active[l]] & 2U) != 0;
                for (std::size_t k = 0; k < springs; ++k) remembered[k].set(l, is_old ? held[k] : real(0));
            }
        const auto action = law_.template act<!Scene::integrator_type::solves_damping, D, V>(at, remembered);
        for (unsigned l = 0; l < count; ++l) {
            if constexpr (springs != 0)
                for (std::size_t k = 0; k < springs; ++k) memory[active[l]][k] = remembered[k][l];
            const auto i = meet.first(active[l]);
            auto& on_i = of_.f[i];
            for (std::size_t k = 0; k < D; ++k) on_i[k] += action.force[k][l];
            if constexpr (Meeting::has_partner) {
                auto& on_j = of_.f[meet.second(active[l])];
                for (std::size_t k = 0; k < D; ++k) on_j[k] -= action.force[k][l];
            }
            if constexpr (turns) turn(meet, action, active[l], l);
        }
    }
    template <class Meeting>
    [[gnu::always_inline]] void turn(const Meeting& meet, const contact_action<D, V>& action, std::uint32_t which,
                                     unsigned l) const noexcept {
        const auto i = meet.first(which);
        auto& on_i = of_.t[i];
        for (std::size_t k = 0; k < spins; ++k) on_i[k] -= of_.radius_at(i) * action.twist[k][l];
        if constexpr (law_type::rolling_type::turns)
            for (std::size_t k = 0; k < spins; ++k) on_i[k] += action.rolling[k][l];
        if constexpr (Meeting::has_partner) {
            const auto j = meet.second(which);
            auto& on_j = of_.t[j];
            for (std::size_t k = 0; k < spins; ++k) on_j[k] -= of_.radius_at(j) * action.twist[k][l];
            if constexpr (law_type::rolling_type::turns)
                for (std::size_t k = 0; k < spins; ++k) on_j[k] -= action.rolling[k][l];
        }
    }

    const columns<Scene>& of_;
    const law_type& law_;
    real time_step_;
};

}  // namespace tsubu::dem::detail
