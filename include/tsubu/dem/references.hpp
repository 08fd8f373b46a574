// SPDX-License-Identifier: MIT
/// @file
/// What scenes are compared with: exact solutions of impacts, bounces, chains and cooling gases.
#pragma once

#include <cmath>    // std::asin, std::atan2, std::cos, std::exp, std::pow, std::sin, std::sqrt
#include <cstddef>  // std::size_t

namespace tsubu::dem {

/// The circle's circumference over its diameter.
inline constexpr double pi = 3.14159265358979323846;

/// How an impact ends.
struct impact {
    double restitution;  ///< speed after over speed before
    double duration;     ///< [s]
};

/// A spring and a dashpot until the bodies part: e = exp(-beta t_c), t_c = pi / sqrt(w0^2 - beta^2), beta = gamma / 2.
/// @param k      [N/m]
/// @param gamma  force m* gamma v [1/s]; less than 2 sqrt(k/m*)
/// @param mass   effective, m* [kg]
[[nodiscard]] inline impact dashpot_impact(double k, double gamma, double mass) noexcept {
    const double beta = gamma / 2;
    const double duration = pi / std::sqrt(k / mass - beta * beta);
    return {std::exp(-beta * duration), duration};
}
/// The same, if it ends where the dashpot would begin to pull: t_c' = (pi - atan(2 beta wd / (wd^2 - beta^2))) / wd.
/// Source: Schwager & Poschel 2007, doi:10.1007/s10035-007-0065-z.
[[nodiscard]] inline impact dashpot_impact_without_attraction(double k, double gamma, double mass) noexcept {
    const double beta = gamma / 2;
    const double wd = std::sqrt(k / mass - beta * beta);
    // The angle of atan2 is right on both sides of wd = beta.
    const double duration = (pi - std::atan2(2 * beta * wd, wd * wd - beta * beta)) / wd;
    return {std::exp(-beta * duration), duration};
}
/// The greatest overlap and force, and the duration, of an elastic Hertzian impact.
struct hertz_peak {
    double overlap;   ///< [m]
    double force;     ///< [N]
    double duration;  ///< [s]
};
/// delta_m = (5 m* v^2 / (4 K))^(2/5), F_m = K delta_m^(3/2), t_c = 2.943275184 delta_m / v, K = 4/3 E* sqrt(R*).
/// @param modulus  effective, E* [Pa]
/// @param radius   effective, R* [m]
/// @param mass     effective, m* [kg]
/// @param speed    of approach [m/s]
/// Source: Johnson 1985, "Contact mechanics", 11.4.
[[nodiscard]] inline hertz_peak hertz_impact(double modulus, double radius, double mass, double speed) noexcept {
    const double stiffness = 4.0 / 3 * modulus * std::sqrt(radius);
    const double overlap = std::pow(5 * mass * speed * speed / (4 * stiffness), 0.4);
    // 2.943275184 = 2 times the integral of 1 / sqrt(1 - x^(5/2)) from 0 to 1
    return {overlap, stiffness * std::pow(overlap, 1.5), 2.943275184 * overlap / speed};
}
/// e = exp(-pi b / sqrt(1 - b^2)), b = alpha / sqrt 5, of hertz_tsuji.
/// Source: Antypov & Elliott 2011, doi:10.1209/0295-5075/94/50004.
[[nodiscard]] inline double tsuji_restitution(double alpha) noexcept {
    const double b = alpha / std::sqrt(5.0);
    return std::exp(-pi * b / std::sqrt(1 - b * b));
}

/// How a sphere leaves a wall.
struct oblique_rebound {
    double tangential;  ///< velocity along the wall [m/s]
    double spin;        ///< [rad/s]
};
/// An elastic Hookean sphere with a tangential spring of 2/7 of the normal stiffness. If tan(theta) <= 3.5 mu it
/// sticks, and leaves with its slip reversed, at 3/7 v_t and a spin of 10/7 v_t / R; else it slides, and leaves at
/// v_t - 2 mu v_n with 5 mu v_n / R.
/// @param normal, along  velocities before, both positive [m/s]
/// @param mu             coefficient of friction
/// @param radius         [m]
/// Source: slip has the mass 2/7 m, so with this stiffness both springs have the same period, and slip is reversed.
[[nodiscard]] inline oblique_rebound oblique_impact(double normal, double along, double mu, double radius) noexcept {
    if (along <= 3.5 * mu * normal) return {along * 3 / 7, along * 10 / 7 / radius};
    return {along - 2 * mu * normal, 5 * mu * normal / radius};
}

/// Slides at first: from where on it rolls, and how fast.
struct rolling_onset {
    double time;   ///< [s]
    double speed;  ///< [m/s]
};
/// t_s = 2 u0 / (7 mu g), u = 5 u0 / 7.
[[nodiscard]] inline rolling_onset slip_to_roll(double speed, double mu, double gravity) noexcept {
    return {2 * speed / (7 * mu * gravity), 5 * speed / 7};
}

/// The frequency of mode 1 .. n of n masses between fixed ends [rad/s]: 2 sin(mode pi / (2 (n + 1))) sqrt(k / m); the
/// greatest is that of mode n.
[[nodiscard]] inline double chain_frequency(std::size_t mode, std::size_t n, double k, double mass) noexcept {
    return 2 * std::sin(static_cast<double>(mode) * pi / (2 * static_cast<double>(n + 1))) * std::sqrt(k / mass);
}
/// The frequency at which velocity_verlet oscillates where the exact one is w: (2 / dt) asin(w dt / 2).
[[nodiscard]] inline double verlet_frequency(double w, double time_step) noexcept {
    return 2 / time_step * std::asin(w * time_step / 2);
}

/// The granular temperature of a gas that cools: T0 / (1 + t / tau)^2.
struct cooling {
    double temperature;  ///< at the beginning: 2/3 of the kinetic energy per mass [m^2/s^2]
    double time;         ///< tau [s]
    [[nodiscard]] double at(double t) const noexcept {
        const double ratio = 1 + t / time;
        return temperature / (ratio * ratio);
    }
};
/// Haff's law for spheres: tau = 6 / ((1 - e^2) nu0), nu0 = 4 sqrt(pi) n d^2 g0 sqrt(T0), g0 = (1 - phi/2) / (1 -
/// phi)^3.
/// @param n         number density [1/m^3]
/// @param diameter  [m]
/// Source: Haff 1983, doi:10.1017/S0022112083003419; Carnahan & Starling 1969, doi:10.1063/1.1672048.
[[nodiscard]] inline cooling haff_cooling(double temperature, double restitution, double n, double diameter) noexcept {
    const double phi = n * pi / 6 * diameter * diameter * diameter;
    const double g0 = (1 - phi / 2) / std::pow(1 - phi, 3);
    const double nu0 = 4 * std::sqrt(pi) * n * diameter * diameter * g0 * std::sqrt(temperature);
    return {temperature, 6 / ((1 - restitution * restitution) * nu0)};
}

/// A ball on a spring and dashpot under gravity, in closed form: free fall, then half an oscillation about the
/// equilibrium, for any stiffness.
///
///     tsubu::dem::bouncing_ball ball{.height = 0.5, .radius = 0.2, .mass = 1, .k = 5e4, .gamma = 10, .gravity = 9.81};
///     while (...) ball.bounce();
///
/// Source: the contact is m x'' = k (R - x) - m gamma x' - m g while x < R; MFiX' case DEM01.
struct bouncing_ball {
    double height;   ///< of the centre at the top [m]
    double radius;   ///< [m]
    double mass;     ///< [kg]
    double k;        ///< [N/m]
    double gamma;    ///< force m gamma v [1/s]
    double gravity;  ///< [m/s^2]
    double time = 0;  ///< of that top [s]

    /// To the next top.
    void bounce() noexcept {
        const double fall = std::sqrt(2 * (height - radius) / gravity);
        const double speed = gravity * fall;
        const auto [duration, after] = contact(speed);
        time += fall + duration + after / gravity;
        height = radius + after * after / (2 * gravity);
    }

private:
    struct result {
        double duration;
        double speed;
    };
    // About the equilibrium, y = x - R + m g / k: y(0) = m g / k, y'(0) = -v; ends when y is m g / k again.
    [[nodiscard]] result contact(double speed) const noexcept {
        const double beta = gamma / 2;
        const double wd = std::sqrt(k / mass - beta * beta);
        const double sag = mass * gravity / k;
        const double sine = (-speed + beta * sag) / wd;
        const auto place = [&](double t) {
            return std::exp(-beta * t) * (sag * std::cos(wd * t) + sine * std::sin(wd * t));
        };
        // It comes back up between half a period and a whole one; bisection, since the rest is exact.
        double lo = pi / wd / 2;
        double hi = 2 * pi / wd;
        while (place(hi) < sag && hi < 4 * pi / wd) hi += pi / wd / 8;
        for (int n = 0; n < 200; ++n) {
            const double middle = (lo + hi) / 2;
            (place(middle) < sag ? lo : hi) = middle;
        }
        const double e = std::exp(-beta * lo);
        const double slope = e * (-sag * wd * std::sin(wd * lo) + sine * wd * std::cos(wd * lo)) - beta * place(lo);
        return {lo, slope};
    }
};

}  // namespace tsubu::dem
