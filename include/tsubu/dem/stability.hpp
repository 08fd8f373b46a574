// SPDX-License-Identifier: MIT
/// @file
/// How long a time step may be: the greatest frequency of what touches, and its damping.
#pragma once

#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/springs.hpp>

#include <algorithm>  // std::max, std::min
#include <array>      // std::array
#include <cmath>      // std::abs, std::sqrt
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <vector>     // std::vector

namespace tsubu::dem {
namespace detail {

/// The greatest eigenvalue of a symmetric matrix of non-negative ones, by Jacobi's rotations.
template <std::size_t D>
[[nodiscard]] double greatest_eigenvalue(std::array<vec<D, double>, D> a) noexcept {
    for (int sweep = 0; sweep < 32; ++sweep) {  // converges quadratically: a few are enough
        double off = 0;
        double trace = 0;
        for (std::size_t p = 0; p < D; ++p) {
            trace += a[p][p];
            for (std::size_t q = p + 1; q < D; ++q) off += a[p][q] * a[p][q];
        }
        if (off <= 1e-30 * trace * trace) break;
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = p + 1; q < D; ++q) {
                if (a[p][q] == 0) continue;
                const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1);
                const double s = t * c;
                for (std::size_t k = 0; k < D; ++k) {
                    const double kp = a[k][p];
                    const double kq = a[k][q];
                    a[k][p] = c * kp - s * kq;
                    a[k][q] = s * kp + c * kq;
                }
                for (std::size_t k = 0; k < D; ++k) {
                    const double pk = a[p][k];
                    const double qk = a[q][k];
                    a[p][k] = c * pk - s * qk;
                    a[q][k] = s * pk + c * qk;
                }
            }
    }
    double most = 0;
    for (std::size_t k = 0; k < D; ++k) most = (std::max)(most, a[k][k]);
    return most;
}

/// body(k, c) for bounds of k/m [1/s^2] and c/m [1/s] of all modes that an owned particle takes part in, and for the
/// slip of each contact.
template <class Run, class Body>
void each_mode(const Run& of, Body&& body) {
    using simulation = typename Run::simulation_type;
    constexpr auto D = simulation::dimension;
    using matrix = std::array<vec<D, double>, D>;
    struct sums {
        matrix stiffness{};
        matrix damping{};
    };
    std::vector<sums> all(of.particles().owned_count());
    const auto add = [&](index_t i, const vec<D, double>& n, double k, double c, double across = 0) {
        if (static_cast<std::size_t>(i) >= all.size()) return;  // a ghost: its owner sees to it
        auto& at = all[static_cast<std::size_t>(i)];
        for (std::size_t a = 0; a < D; ++a)
            for (std::size_t b = 0; b < D; ++b) {
                at.stiffness[a][b] += (k - across) * n[a] * n[b] + (a == b ? across : 0);
                at.damping[a][b] += c * n[a] * n[b];
            }
    };
    if constexpr (simulation::has_contacts) {
        const auto& law = of.template model<typename simulation::contact_type>();
        of.each_contact([&](const auto& pair) {
            const auto& at = pair.at;
            const double k = law.normal().stiffness(at.overlap, at.radius);
            const double c = law.normal().damping(at.overlap, at.mass, at.radius);
            // A wall does not move: half of what a partner that moves the other way would give.
            const double share = pair.is_wall ? 0.5 : 1;
            add(pair.i, at.normal, share * k, share * c);
            if (!pair.is_wall) add(pair.j, at.normal, k, c);
            [[maybe_unused]] const auto& friction = law.tangential();
            double k_t = 0;
            double c_t = 0;
            if constexpr (sticking_law<typename simulation::contact_type::tangential_type>)
                k_t = friction.stiffness(at.overlap, at.radius);
            if constexpr (simulation::turns) c_t = friction.viscosity(at.mass, c);
            // The slip of a solid sphere has the inertia m / (1 + 5/2).
            if (at.mass > 0 && (k_t > 0 || c_t > 0)) body(3.5 * k_t / at.mass, 3.5 * c_t / at.mass);
        });
    }
    of.each_spring([&](index_t i, index_t j, const spring& one) {
        auto n = of.apart(i, j);
        double square = 0;
        for (const double d : n) square += d * d;
        const double distance = std::sqrt(square);
        for (double& d : n) d /= distance;
        // Stretched, it is stiff across too, as a string is.
        add(i, n, one.k, 0, one.k * (std::max)(0.0, 1 - one.length / distance));
    });
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double m = of.mass(static_cast<index_t>(i));
        body(2 * greatest_eigenvalue<D>(all[i].stiffness) / m, 2 * greatest_eigenvalue<D>(all[i].damping) / m);
    }
}
/// The longest stable time step of what touches on this rank [s]; infinite if nothing does.
template <class Run>
[[nodiscard]] double longest_time_step_here(const Run& of) {
    using simulation = typename Run::simulation_type;
    double longest = std::numeric_limits<double>::infinity();
    const auto see = [&](double k, double c) {
        // Where there is a dashpot and no spring, one that is too soft to matter.
        const double omega = (std::max)(std::sqrt(k), 1e-6 * c);
        if (omega > 0)
            longest = (std::min)(longest, simulation::integrator_type::stable_until(c / (2 * omega)) / omega);
    };
    each_mode(of, see);
    if constexpr (simulation::has_contacts) {
        // The first touch of the lightest, if the law is as stiff from there on: what will be where nothing
        // touches.
        const auto& law = of.template model<typename simulation::contact_type>().normal();
        const auto owned = of.particles().owned_count();
        double lightest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < owned; ++i) lightest = (std::min)(lightest, of.mass(static_cast<index_t>(i)));
        const double effective = lightest / (owned > 1 ? 2 : 1);
        if (effective <= (std::numeric_limits<double>::max)())
            see(law.stiffness(0.0, 1.0) / effective, law.damping(0.0, effective, 1.0) / effective);
    }
    return longest;
}

}  // namespace detail

/// An upper bound of the angular frequency of any mode of what touches, as stiff as it is at the moment [rad/s]:
/// sqrt(2 max lambda_max(sum k n n^T) / m) of the forces along normals, and of springs, which are stiff across their
/// length as well if they are stretched; or sqrt(7/2 k_t / m*) of a contact that sticks,
/// whose slip has the mass 2/7 m*, if that is more.
///
/// Exact for the infinite chain and the FCC crystal. No bound where several contacts of one particle stick and k_t is
/// above 2/7 of k_n.
/// Collective: yes, one reduction. Complexity: O(contacts).
/// Source: Rayleigh's quotient, with (n (x_i - x_j))^2 <= 2 (n x_i)^2 + 2 (n x_j)^2; a wall stands still, and counts
/// half.
template <class Run>
[[nodiscard]] double greatest_frequency(const Run& of) {
    double square = 0;
    detail::each_mode(of, [&](double k, double) { square = (std::max)(square, k); });
    of.on().reduce(std::span<double>(&square, 1), reduction::greatest);
    return std::sqrt(square);
}
/// The longest time step at which what touches, as stiff and as damped as it is at the moment, is stable with the
/// integrator of the scene [s]; infinite if nothing touches, and the law begins softly.
///
///     if (bed.how().time_step > tsubu::dem::longest_time_step(bed)) ...
///
/// Each particle gives bounds omega and c of the frequency and the damping rate of its modes, as greatest_frequency
/// does; the step is the least integrator::stable_until(c / (2 omega)) / omega. For velocity_verlet and
/// symplectic_euler that is a bound of any packing whose contacts do not stick, since theirs is
/// dt^2 omega^2 / 4 + dt c / 2 <= 1, a sum over contacts. A law that is linear from the first touch counts with two of
/// the lightest particles, even if none touch.
/// Collective: yes, one reduction. Complexity: O(contacts).
template <class Run>
[[nodiscard]] double longest_time_step(const Run& of) {
    double shortest = -detail::longest_time_step_here(of);
    of.on().reduce(std::span<double>(&shortest, 1), reduction::greatest);
    return -shortest;
}

}  // namespace tsubu::dem
