// SPDX-License-Identifier: MIT
/// @file
/// The loops of all integrators: forces change velocities, velocities change positions.
#pragma once

#include <tsubu/core/lanes.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/unrolled.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/domain/lattice.hpp>

#include <cmath>    // std::nearbyint, std::sqrt
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <limits>   // std::numeric_limits
#include <type_traits>  // std::is_same_v

#if defined(__SSE2__)
#include <emmintrin.h>  // _mm_cvtsd_si64
#endif

namespace tsubu::dem::detail {

// Velocities and forces are arrays of vectors, x y z x y z ...: a group of as many particles as a register has lanes is
// D registers of each, whatever D. What each lane of them needs of its particle, or of its axis, is put together by
// place:
//
//     register 0      1      2          lane l of register r: component c = r width + l of the group,
//     [x0 y0] [z0 x1] [y1 z1]           particle c / D, axis c % D

/// Moves the owned particles of a scene.
template <class Simulation>
class motion {
    static constexpr auto D = Simulation::dimension;
    static constexpr auto spins = Simulation::quantities_type::spins;
    using real = typename Simulation::real;
    using coordinate = typename Simulation::coordinate;
    using V = lanes<real>;
    static constexpr std::size_t width = V::count;

public:
    motion(const columns<Simulation>& of, std::size_t owned, const vec<D, double>& gravity) noexcept
        : of_(of), owned_(owned), gravity_(gravity) {}

    /// v += duration a. [s]
    void kick(double duration) const noexcept { go<1, false, false>(duration, 0); }
    /// x += duration v. @return the square of the greatest speed [m^2/s^2]
    real drift(double duration) const noexcept { return go<0, true, false>(0, duration); }
    /// A kick of each duration and a drift, in one pass that also clears the forces: the end of one step and the
    /// beginning of the next.
    template <bool Twice>
    real kick_and_drift(double kicked, double drifted) const noexcept {
        return go<Twice ? 2 : 1, true, true>(kicked, drifted);
    }
    void clear_forces() const noexcept { go<0, false, true>(0, 0); }
    /// x += step(i). @return the square of the longest step [m^2]
    template <class Step>
    real displace(Step&& step) const {
        greatest_seen<real> farthest;
        for (std::size_t i = 0; i < owned_; ++i) {
            const vec<D, real> by = step(i);
            real square = 0;
            for (std::size_t k = 0; k < D; ++k) {
                square += by[k] * by[k];
                move(i, k, static_cast<double>(by[k]));
            }
            farthest.see(square);
        }
        return farthest.most + farthest.poison;
    }
    [[nodiscard]] vec<D, real> acceleration(std::size_t i) const noexcept {
        const auto by = factors(i, 1);
        vec<D, real> a;
        for (std::size_t k = 0; k < D; ++k) {
            a[k] = static_cast<real>(by.linear) * of_.f[i][k];
            if constexpr (Simulation::has_gravity) a[k] += static_cast<real>(by.gravity[k]);
        }
        return a;
    }

private:
    static constexpr bool drifts_in_lanes = std::is_same_v<coordinate, real>;

    /// What a kick multiplies forces and torques with, and adds.
    struct kick_factors {
        double linear;   // duration / m
        double angular;  // duration / (2/5 m r^2)
        vec<D, double> gravity;
    };
    [[nodiscard, gnu::always_inline]] kick_factors factors(std::size_t i, double duration) const noexcept {
        const double m = Simulation::bodies_type::are_equal ? static_cast<double>(of_.mass_of_all) : of_.mass[i];
        kick_factors by{duration / m, 0, {}};
        if constexpr (Simulation::turns) {
            const double r =
                Simulation::bodies_type::are_equal ? static_cast<double>(of_.radius_of_all) : of_.radius[i];
            by.angular = duration / (sphere_inertia * m * r * r);
        }
        if constexpr (Simulation::has_gravity)
            if (m <= (std::numeric_limits<double>::max)())  // what is held fast does not fall
                for (std::size_t k = 0; k < D; ++k) by.gravity[k] = duration * gravity_[k];
        return by;
    }
    template <int Kicks, bool Drifts, bool Clears>
    real go(double kicked, double drifted) const noexcept {
        const auto by = factors_of_all(kicked);
        greatest_seen<real> fastest;
        std::size_t i = 0;
        greatest_seen<V> fastest_lanes;
        for (; i + width <= owned_; i += width)
            go_group<Kicks, Drifts, Clears>(i, by, kicked, drifted, fastest_lanes);
        if constexpr (Drifts)
            unrolled<width>([&](auto l) __attribute__((always_inline)) {
                fastest.see(fastest_lanes.most[l] + fastest_lanes.poison[l]);
            });
        for (; i < owned_; ++i) go_one<Kicks, Drifts, Clears>(i, kicked, drifted, fastest);
        return fastest.most + fastest.poison;
    }
    [[nodiscard]] kick_factors factors_of_all(double duration) const noexcept {
        if constexpr (Simulation::bodies_type::are_equal)
            return factors(0, duration);
        else
            return {};
    }
    /// The greatest of all that it has seen; not a number, if one of them is none or infinite.
    template <class Numbers>
    struct greatest_seen {
        Numbers most = Numbers(real(0));
        Numbers poison = Numbers(real(0));  // 0, or not a number: a maximum passes over what is none
        [[gnu::always_inline]] void see(const Numbers& square) noexcept {
            most = lanewise::select(most < square, square, most);
            poison = poison + (square - square);  // NOLINT(misc-redundant-expression)
        }
    };

    template <int Kicks, bool Drifts, bool Clears>
    [[gnu::always_inline]] void go_group(std::size_t i, const kick_factors& of_all, double kicked, double drifted,
                                         greatest_seen<V>& fastest) const noexcept {
        real* const v = of_.v[i].data();
        real* const f = of_.f[i].data();
        vec<width, kick_factors> each;
        if constexpr (Kicks != 0)
            unrolled<width>([&](auto l) __attribute__((always_inline)) {
                each[l] = Simulation::bodies_type::are_equal ? of_all : factors(i + l, kicked);
            });
        unrolled<D>([&](auto r) __attribute__((always_inline)) {
            auto moving = V::load(v + r * width);
            if constexpr (Kicks != 0) {
                const auto force = V::load(f + r * width);
                const auto linear = V::of([&](auto l) __attribute__((always_inline)) {
                    return static_cast<real>(each[(r * width + l) / D].linear);
                });
                [[maybe_unused]] const auto gravity = V::of([&](auto l) __attribute__((always_inline)) {
                    return static_cast<real>(each[(r * width + l) / D].gravity[(r * width + l) % D]);
                });
                unrolled<static_cast<std::size_t>(Kicks)>([&](auto) __attribute__((always_inline)) {
                    moving += linear * force;
                    if constexpr (Simulation::has_gravity) moving += gravity;
                });
                moving.store(v + r * width);
            }
            if constexpr (Drifts && drifts_in_lanes) {
                real* const x = of_.x[i].data() + r * width;
                (V::load(x) + V(static_cast<real>(drifted)) * moving).store(x);
            }
            if constexpr (Clears) V(real(0)).store(f + r * width);
        });
        if constexpr (Drifts) {
            const auto velocity = vector_of<D, V>([&](auto k) __attribute__((always_inline)) {
                return V::of([&](auto l) __attribute__((always_inline)) { return of_.v[i + l][k]; });
            });
            fastest.see(dot<D, V>(velocity, velocity));
            if constexpr (!drifts_in_lanes)
                unrolled<width>([&](auto l) __attribute__((always_inline)) {
                    unrolled<D>([&](auto k) __attribute__((always_inline)) {
                        move(i + l, k, drifted * static_cast<double>(of_.v[i + l][k]));
                    });
                });
        }
        if constexpr (Simulation::turns) turn_group<Kicks, Clears>(i, each);
    }
    template <int Kicks, bool Clears>
    [[gnu::always_inline]] void turn_group(std::size_t i, const vec<width, kick_factors>& each) const noexcept {
        real* const w = of_.w[i].data();
        real* const t = of_.t[i].data();
        unrolled<spins>([&](auto r) __attribute__((always_inline)) {
            if constexpr (Kicks != 0) {
                auto turning = V::load(w + r * width);
                const auto torque = V::load(t + r * width);
                const auto angular = V::of([&](auto l) __attribute__((always_inline)) {
                    return static_cast<real>(each[(r * width + l) / spins].angular);
                });
                unrolled<static_cast<std::size_t>(Kicks)>(
                    [&](auto) __attribute__((always_inline)) { turning += angular * torque; });
                turning.store(w + r * width);
            }
            if constexpr (Clears) V(real(0)).store(t + r * width);
        });
    }
    /// The same of one particle: the last ones, which do not fill a group.
    template <int Kicks, bool Drifts, bool Clears>
    void go_one(std::size_t i, double kicked, double drifted, greatest_seen<real>& fastest) const noexcept {
        [[maybe_unused]] const auto by = factors(i, kicked);
        real square = 0;
        for (std::size_t k = 0; k < D; ++k) {
            auto& v = of_.v[i][k];
            for (int n = 0; n < Kicks; ++n) {
                v += static_cast<real>(by.linear) * of_.f[i][k];
                if constexpr (Simulation::has_gravity) v += static_cast<real>(by.gravity[k]);
            }
            square += v * v;
            if constexpr (Drifts && drifts_in_lanes) of_.x[i][k] += static_cast<real>(drifted) * v;
            if constexpr (Drifts && !drifts_in_lanes) move(i, k, drifted * static_cast<double>(v));
            if constexpr (Clears) of_.f[i][k] = 0;
        }
        if constexpr (Drifts) fastest.see(square);
        if constexpr (Simulation::turns)
            for (std::size_t k = 0; k < spins; ++k) {
                for (int n = 0; n < Kicks; ++n) of_.w[i][k] += static_cast<real>(by.angular) * of_.t[i][k];
                if constexpr (Clears) of_.t[i][k] = 0;
            }
    }
    [[gnu::always_inline]] void move(std::size_t i, std::size_t k, double by) const noexcept {
        if constexpr (Simulation::quantities_type::has_offsets) {
            using integer = decltype(of_.x[i][k].value);
            auto& offset = of_.offset[i][k];
            offset += static_cast<real>(by);
            const auto cells = nearest(static_cast<double>(offset) * of_.steps_per_length[k]);
            of_.x[i][k] = of_.x[i][k] + static_cast<integer>(cells);
            offset -= static_cast<real>(static_cast<double>(cells) * of_.step[k]);
        } else if constexpr (is_lattice<coordinate>) {
            using integer = decltype(of_.x[i][k].value);
            of_.x[i][k] = of_.x[i][k] + static_cast<integer>(nearest(by * of_.steps_per_length[k]));
        } else {
            of_.x[i][k] += static_cast<coordinate>(by);
        }
    }
    [[nodiscard, gnu::always_inline]] static std::int64_t nearest(double steps) noexcept {
#if defined(__SSE2__)
        return _mm_cvtsd_si64(_mm_set_sd(steps));  // std::nearbyint is a call
#else
        return static_cast<std::int64_t>(std::nearbyint(steps));
#endif
    }

    const columns<Simulation>& of_;
    std::size_t owned_;
    vec<D, double> gravity_;
};

}  // namespace tsubu::dem::detail
