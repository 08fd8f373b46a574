// SPDX-License-Identifier: MIT
/// @file
/// The loops of all integrators: forces change velocities, velocities change positions.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/domain/lattice.hpp>

#include <cmath>    // std::nearbyint, std::sqrt
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t
#include <limits>   // std::numeric_limits

namespace tsubu::dem::detail {

/// The moment of inertia of a solid sphere is 2/5 m r^2.
inline constexpr double sphere_inertia = 0.4;

/// Moves the owned particles of a scene.
template <class Scene>
class motion {
    static constexpr auto D = Scene::dimension;
    static constexpr auto spins = Scene::quantities_type::spins;
    using real = typename Scene::real;
    using coordinate = typename Scene::coordinate;

public:
    motion(const columns<Scene>& of, std::size_t owned, const vec<D, double>& gravity) noexcept
        : of_(of), owned_(owned), gravity_(gravity) {}

    /// v += duration a. [s]
    void kick(double duration) const noexcept {
        each([&](std::size_t i) __attribute__((always_inline)) { kick_one(i, factors(i, duration)); });
    }
    /// x += duration v. @return the square of the greatest speed [m^2/s^2]
    real drift(double duration) const noexcept {
        real fastest = 0;
        each([&](std::size_t i) __attribute__((always_inline)) { drift_one(i, duration, fastest); });
        return fastest;
    }
    /// A kick of each duration and a drift, in one pass that also clears the forces: the end of one step and the
    /// beginning of the next.
    template <bool Twice>
    real kick_and_drift(double kicked, double drifted) const noexcept {
        real fastest = 0;
        each([&](std::size_t i) __attribute__((always_inline)) {
            const auto by = factors(i, kicked);
            kick_one(i, by);
            if constexpr (Twice) kick_one(i, by);
            drift_one(i, drifted, fastest);
            clear_one(i);
        });
        return fastest;
    }
    /// x += step(i). @return the square of the longest step [m^2]
    template <class Step>
    real displace(Step&& step) const {
        real farthest = 0;
        for (std::size_t i = 0; i < owned_; ++i) {
            const vec<D, real> by = step(i);
            real square = 0;
            for (std::size_t k = 0; k < D; ++k) {
                square += by[k] * by[k];
                move(i, k, static_cast<double>(by[k]));
            }
            farthest = !(square <= farthest) ? square : farthest;
        }
        return farthest;
    }
    [[nodiscard]] vec<D, real> acceleration(std::size_t i) const noexcept {
        const auto by = factors(i, 1);
        vec<D, real> a;
        for (std::size_t k = 0; k < D; ++k) {
            a[k] = by.linear * of_.f[i][k];
            if constexpr (Scene::has_gravity) a[k] += by.gravity[k];
        }
        return a;
    }
    void clear_forces() const noexcept {
        each([&](std::size_t i) __attribute__((always_inline)) { clear_one(i); });
    }

private:
    struct kick_factors {
        real linear;   // duration / m
        real angular;  // duration / (2/5 m r^2)
        vec<D, real> gravity;
    };
    template <class Body>
    [[gnu::always_inline]] void each(Body&& body) const noexcept {
        for (std::size_t i = 0; i < owned_; ++i) body(i);
    }
    [[gnu::always_inline]] kick_factors factors(std::size_t i, double duration) const noexcept {
        const double m = Scene::bodies_type::are_equal ? static_cast<double>(of_.mass_of_all) : of_.mass[i];
        kick_factors by;
        by.linear = static_cast<real>(duration / m);
        if constexpr (Scene::turns) {
            const double r = Scene::bodies_type::are_equal ? static_cast<double>(of_.radius_of_all) : of_.radius[i];
            by.angular = static_cast<real>(duration / (sphere_inertia * m * r * r));
        }
        if constexpr (Scene::has_gravity)
            for (std::size_t k = 0; k < D; ++k)
                by.gravity[k] = m <= (std::numeric_limits<double>::max)() ? static_cast<real>(duration * gravity_[k])
                                                                          : real(0);
        return by;
    }
    [[gnu::always_inline]] void kick_one(std::size_t i, const kick_factors& by) const noexcept {
        for (std::size_t k = 0; k < D; ++k) {
            of_.v[i][k] += by.linear * of_.f[i][k];
            if constexpr (Scene::has_gravity) of_.v[i][k] += by.gravity[k];
        }
        if constexpr (Scene::turns)
            for (std::size_t k = 0; k < spins; ++k) of_.w[i][k] += by.angular * of_.t[i][k];
    }
    [[gnu::always_inline]] void drift_one(std::size_t i, double duration, real& fastest) const noexcept {
        real square = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const auto v = of_.v[i][k];
            square += v * v;
            move(i, k, duration * static_cast<double>(v));
        }
        // Not a number is fastest of all, and stays it.
        fastest = !(square <= fastest) ? square : fastest;
    }
    [[gnu::always_inline]] void move(std::size_t i, std::size_t k, double by) const noexcept {
        if constexpr (is_lattice<coordinate>) {
            using integer = decltype(of_.x[i][k].value);
            const double steps = std::nearbyint(by / of_.step[k]);
            of_.x[i][k] = of_.x[i][k] + static_cast<integer>(static_cast<std::int64_t>(steps));
        } else {
            of_.x[i][k] += static_cast<coordinate>(by);
        }
    }
    [[gnu::always_inline]] void clear_one(std::size_t i) const noexcept {
        of_.f[i] = {};
        if constexpr (Scene::turns) of_.t[i] = {};
    }

    const columns<Scene>& of_;
    std::size_t owned_;
    vec<D, double> gravity_;
};

}  // namespace tsubu::dem::detail
