// SPDX-License-Identifier: MIT
/// @file
/// The forces of all contacts: which neighbours touch, and what the law does to them, several at a time.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/prefetch.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/unrolled.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact.hpp>
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/dem/walls.hpp>
#include <tsubu/neighbor/pair_list.hpp>

#include <algorithm>  // std::min
#include <cstddef>    // std::size_t
#include <cstdint>    // std::uint32_t, std::uint8_t
#include <span>       // std::span

namespace tsubu::dem::detail {

/// Whether neighbours touched: bit 0 in the last evaluation, bit 1 in the one before.
using touch_state = std::uint8_t;

// Of all neighbours some touch, which cannot be predicted: a first pass over a block finds them without a branch. A
// second computes normals and overlaps, as many at a time as there are lanes, and a third lets the law act: in passes
// of their own the roots and quotients of one contact do not wait for those of the one before. What is left over of a
// block waits for the next.

/// Finds who touches, and lets the law act.
template <class Simulation>
class contact_kernel {
    static constexpr auto D = Simulation::dimension;
    static constexpr auto spins = Simulation::quantities_type::spins;
    static constexpr auto history_size = Simulation::history_size;
    static constexpr bool turns = Simulation::turns;
    using real = typename Simulation::real;
    using law_type = typename Simulation::contact_type;
    using V = lanes<real>;
    static constexpr auto width = static_cast<unsigned>(V::count);
    using history_type = vec<history_size, real>;
    static constexpr std::uint32_t block = 256;  // what is noted of a block stays in the first-level cache
    /// Where bodies touch, and how far they overlap.
    struct shape {
        vec<D, V> normal;
        V overlap;
    };

public:
    contact_kernel(const columns<Simulation>& of, const law_type& law, double time_step) noexcept
        : of_(of), law_(law), time_step_(static_cast<real>(time_step)) {}

    /// @param touches  of each pair; null if the law remembers nothing
    /// @param history   of each pair; likewise
    void act_on_pairs(std::span<const index_pair> pairs, touch_state* touches, history_type* history) const {
        walk<pair_meeting>(pair_meeting{of_, pairs.data()}, pairs.size(), touches, history);
    }
    /// @param near  i is a particle, j a wall
    void act_on_walls(std::span<const index_pair> near, std::span<const wall_plane<D>> planes, touch_state* touches,
                      history_type* history) const {
        walk<wall_meeting>(wall_meeting{of_, near.data(), planes.data()}, near.size(), touches, history);
    }

private:
    /// Two particles.
    struct pair_meeting {
        static constexpr bool has_partner = true;
        const columns<Simulation>& of;
        const index_pair* pairs;

        [[gnu::always_inline]] index_t first(std::uint32_t k) const noexcept { return pairs[k].i; }
        [[gnu::always_inline]] index_t second(std::uint32_t k) const noexcept { return pairs[k].j; }
        template <class Which>
        [[gnu::always_inline]] vec<D, V> apart(Which which) const noexcept {
            return vector_of<D, V>([&](auto k) __attribute__((always_inline)) {
                return V::of([&](auto l) __attribute__((always_inline)) {
                    const auto& pair = pairs[which(l)];
                    return of.apart(k, pair.i, pair.j);
                });
            });
        }
        template <class Which>
        [[gnu::always_inline]] unsigned touching(Which which) const noexcept {
            const auto d = apart(which);
            const V sum = radii(which);
            return (dot<D, V>(d, d) < sum * sum).bits();
        }
        template <class Which>
        [[gnu::always_inline]] V radii(Which which) const noexcept {
            if constexpr (Simulation::bodies_type::are_equal)
                return V(2 * of.radius_of_all);
            else
                return V::of([&](auto l) __attribute__((always_inline)) {
                    const auto& pair = pairs[which(l)];
                    return static_cast<real>(of.radius[pair.i] + of.radius[pair.j]);
                });
        }
        template <class Which>
        [[gnu::always_inline]] shape find_shape(Which which) const noexcept {
            const auto d = apart(which);
            const V distance = lanewise::sqrt(dot<D, V>(d, d));
            return {scaled<D, V>(d, V(1) / distance), radii(which) - distance};
        }
        template <class Which>
        [[gnu::always_inline]] void measure(Which which, contact<D, V>& at) const noexcept {
            if constexpr (Simulation::bodies_type::are_equal) {
                at.mass = V(of.mass_of_all / 2);
                at.radius = V(of.radius_of_all / 2);
            } else {
                at.mass = V::of([&](auto l) __attribute__((always_inline)) {
                    const auto& pair = pairs[which(l)];
                    return static_cast<real>(effective_mass(of.mass[pair.i], of.mass[pair.j]));
                });
                at.radius = V::of([&](auto l) __attribute__((always_inline)) {
                    const auto& pair = pairs[which(l)];
                    const auto r_i = of.radius[pair.i];
                    const auto r_j = of.radius[pair.j];
                    return static_cast<real>(r_i * r_j / (r_i + r_j));
                });
            }
            if constexpr (law_type::needs_velocity)
                at.velocity = vector_of<D, V>([&](auto k) __attribute__((always_inline)) {
                    return V::of([&](auto l) __attribute__((always_inline)) {
                        const auto& pair = pairs[which(l)];
                        return of.v[pair.i][k] - of.v[pair.j][k];
                    });
                });
            if constexpr (turns) {
                at.sliding = vector_of<spins, V>([&](auto k) __attribute__((always_inline)) {
                    return V::of([&](auto l) __attribute__((always_inline)) {
                        const auto& pair = pairs[which(l)];
                        return of.radius_at(pair.i) * of.w[pair.i][k] + of.radius_at(pair.j) * of.w[pair.j][k];
                    });
                });
                if constexpr (law_type::rolling_type::resists)
                    at.turning = vector_of<spins, V>([&](auto k) __attribute__((always_inline)) {
                        return V::of([&](auto l) __attribute__((always_inline)) {
                            const auto& pair = pairs[which(l)];
                            return of.w[pair.i][k] - of.w[pair.j][k];
                        });
                    });
            }
        }
    };
    /// A particle and a wall.
    struct wall_meeting {
        static constexpr bool has_partner = false;
        const columns<Simulation>& of;
        const index_pair* pairs;
        const wall_plane<D>* planes;

        [[gnu::always_inline]] index_t first(std::uint32_t k) const noexcept { return pairs[k].i; }
        [[gnu::always_inline]] index_t second(std::uint32_t k) const noexcept { return pairs[k].j; }
        template <class Which>
        [[gnu::always_inline]] V distance(Which which) const noexcept {
            return V::of([&](auto l) __attribute__((always_inline)) {
                const auto& pair = pairs[which(l)];
                return static_cast<real>(planes[pair.j].distance(of.real_position(pair.i)));
            });
        }
        template <class Which>
        [[gnu::always_inline]] V radii(Which which) const noexcept {
            return V::of([&](auto l) __attribute__((always_inline)) { return of.radius_at(pairs[which(l)].i); });
        }
        template <class Which>
        [[gnu::always_inline]] unsigned touching(Which which) const noexcept {
            return (distance(which) < radii(which)).bits();
        }
        template <class Which>
        [[gnu::always_inline]] shape find_shape(Which which) const noexcept {
            return {vector_of<D, V>([&](auto k) __attribute__((always_inline)) {
                        return V::of([&](auto l) __attribute__((always_inline)) {
                            return static_cast<real>(planes[pairs[which(l)].j].normal[k]);
                        });
                    }),
                    radii(which) - distance(which)};
        }
        template <class Which>
        [[gnu::always_inline]] void measure(Which which, contact<D, V>& at) const noexcept {
            at.radius = radii(which);
            if constexpr (Simulation::bodies_type::are_equal)
                at.mass = V(of.mass_of_all);
            else
                at.mass = V::of([&](auto l) __attribute__((always_inline)) {
                    return static_cast<real>(effective_mass(of.mass[pairs[which(l)].i], mass_of_wall));
                });
            if constexpr (law_type::needs_velocity)
                at.velocity = vector_of<D, V>([&](auto k) __attribute__((always_inline)) {
                    return V::of([&](auto l) __attribute__((always_inline)) { return of.v[pairs[which(l)].i][k]; });
                });
            if constexpr (turns) {
                at.turning = vector_of<spins, V>([&](auto k) __attribute__((always_inline)) {
                    return V::of([&](auto l) __attribute__((always_inline)) { return of.w[pairs[which(l)].i][k]; });
                });
                at.sliding = scaled<spins, V>(at.turning, at.radius);
            }
        }
    };

    template <class Meeting>
    void walk(const Meeting& meet, std::size_t count, touch_state* touches, history_type* history) const {
        std::uint32_t active[block + 2 * width];
        shape shapes[block / width + 2];
        std::uint32_t waiting = 0;
        for (std::size_t begin = 0; begin < count; begin += block) {
            const auto end = (std::min)(count, begin + block);
            auto k = begin;
            for (; k + width <= end; k += width)
                note(meet.touching([k](unsigned l) { return k + l; }), k, width, active, waiting, touches);
            if (k < end)  // the last of all stands in for those that are missing
                note(meet.touching([k, end](unsigned l) { return (std::min)(k + l, end - 1); }), k,
                     static_cast<unsigned>(end - k), active, waiting, touches);
            const auto groups = waiting / width;
            for (std::uint32_t g = 0; g < groups; ++g) {
                shapes[g] = meet.find_shape(chosen(active + g * width));
                for (unsigned l = 0; l < width; ++l) ask_for(meet, active[g * width + l], history);
            }
            for (std::uint32_t g = 0; g < groups; ++g)
                act(meet, shapes[g], active + g * width, width, touches, history);
            waiting -= groups * width;
            for (std::uint32_t l = 0; l < waiting; ++l) active[l] = active[groups * width + l];
        }
        if (waiting != 0) {
            for (auto l = waiting; l < width; ++l) active[l] = active[0];
            act(meet, meet.find_shape(chosen(active)), active, waiting, touches, history);
        }
    }
    // What the law will read and write: in scenes that outgrow the second-level cache, waiting for it took a sixth of
    // the time. Of i it is there, since pairs follow each other by i.
    template <class Meeting>
    [[gnu::always_inline]] void ask_for(const Meeting& meet, std::uint32_t which,
                                        history_type* history) const noexcept {
        if constexpr (history_size != 0) tsubu::detail::prefetch<true>(history + which);
        if constexpr (Meeting::has_partner) {
            const auto j = meet.second(which);
            tsubu::detail::prefetch<true>(of_.f + j);
            if constexpr (law_type::needs_velocity) tsubu::detail::prefetch(of_.v + j);
            if constexpr (turns) {
                tsubu::detail::prefetch(of_.w + j);
                tsubu::detail::prefetch<true>(of_.t + j);
            }
        }
    }
    [[gnu::always_inline]] static auto chosen(const std::uint32_t* active) noexcept {
        return [active](unsigned l) __attribute__((always_inline)) { return active[l]; };
    }
    [[gnu::always_inline]] static void note(unsigned bits, std::size_t k, unsigned count, std::uint32_t* active,
                                            std::uint32_t& waiting, touch_state* touches) noexcept {
        for (unsigned l = 0; l < count; ++l) {
            const auto touching = bits >> l & 1U;
            active[waiting] = static_cast<std::uint32_t>(k + l);
            waiting += touching;
            if constexpr (history_size != 0)
                touches[k + l] = static_cast<touch_state>((unsigned{touches[k + l]} << 1U | touching) & 3U);
        }
    }
    template <class Meeting>
    [[gnu::always_inline]] void act(const Meeting& meet, const shape& where, const std::uint32_t* active,
                                    unsigned count, const touch_state* touches, history_type* history) const noexcept {
        contact<D, V> at;
        at.normal = where.normal;
        at.overlap = where.overlap;
        meet.measure(chosen(active), at);
        at.time_step = V(time_step_);
        auto past = vector_of<history_size, V>([&](auto k) __attribute__((always_inline)) {
            return V::of([&](auto l) __attribute__((always_inline)) {
                return (touches[active[l]] & 2U) != 0 ? history[active[l]][k] : real(0);
            });
        });
        const auto action = law_.template act<!Simulation::integrator_type::solves_damping, D, V>(at, past);
        unrolled<width>([&](auto l) __attribute__((always_inline)) {
            if (l >= count) return;
            const auto which_one = active[l];
            unrolled<history_size>([&](auto k) __attribute__((always_inline)) { history[which_one][k] = past[k][l]; });
            const auto i = meet.first(which_one);
            auto& on_i = of_.f[i];
            unrolled<D>([&](auto k) __attribute__((always_inline)) { on_i[k] += action.force[k][l]; });
            if constexpr (turns) {
                const real arm = of_.radius_at(i);
                auto& turns_i = of_.t[i];
                unrolled<spins>([&](auto k) __attribute__((always_inline)) { turns_i[k] -= arm * action.twist[k][l]; });
                if constexpr (law_type::rolling_type::resists)
                    unrolled<spins>([&](auto k) __attribute__((always_inline)) { turns_i[k] += action.rolling[k][l]; });
            }
            if constexpr (Meeting::has_partner) {
                const auto j = meet.second(which_one);
                auto& on_j = of_.f[j];
                unrolled<D>([&](auto k) __attribute__((always_inline)) { on_j[k] -= action.force[k][l]; });
                if constexpr (turns) {
                    const real arm = of_.radius_at(j);
                    auto& turns_j = of_.t[j];
                    unrolled<spins>(
                        [&](auto k) __attribute__((always_inline)) { turns_j[k] -= arm * action.twist[k][l]; });
                    if constexpr (law_type::rolling_type::resists)
                        unrolled<spins>(
                            [&](auto k) __attribute__((always_inline)) { turns_j[k] -= action.rolling[k][l]; });
                }
            }
        });
    }

    const columns<Simulation>& of_;
    const law_type& law_;
    real time_step_;
};

}  // namespace tsubu::dem::detail
