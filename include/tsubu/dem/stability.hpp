// SPDX-License-Identifier: MIT
/// @file
/// How long a time step may be: the greatest frequency of what touches.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/springs.hpp>

#include <algorithm>  // std::max
#include <array>      // std::array
#include <cmath>      // std::abs, std::sqrt
#include <cstddef>    // std::size_t
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

}  // namespace detail

/// An upper bound of the angular frequency of any mode of what touches on this rank, as stiff as it is at the moment
/// [rad/s]: sqrt(2 max lambda_max(sum k n n^T) / m) of the forces along normals; or sqrt(7/2 k_t / m*) of a contact that
/// sticks, whose slip has the mass 2/7 m*, if that is more. A time step below 2 over it is stable; with the damping of the
/// half step, of ratio z, below 2 (sqrt(1 + z^2) - z) over it.
///
/// Exact for the infinite chain and the FCC crystal. No bound where several contacts of one particle stick and k_t is above
/// 2/7 of k_n. Of several ranks the greatest counts.
/// Complexity: O(contacts).
/// Source: Rayleigh's quotient, with (n (x_i - x_j))^2 <= 2 (n x_i)^2 + 2 (n x_j)^2; a wall stands still, and counts half.
template <class Run>
[[nodiscard]] double greatest_frequency(const Run& of) {
    constexpr auto D = Run::simulation_type::dimension;
    std::vector<std::array<vec<D, double>, D>> sums(of.particles().owned_count());
    const auto add = [&](std::size_t i, const vec<D, double>& n, double k) {
        if (i >= sums.size()) return;  // a ghost: its owner sees to it
        for (std::size_t a = 0; a < D; ++a)
            for (std::size_t b = 0; b < D; ++b) sums[i][a][b] += k * n[a] * n[b];
    };
    double stuck = 0;  // the square of the greatest frequency of slip
    if constexpr (Run::simulation_type::has_contacts)
        of.each_contact([&](const auto& pair) {
            const double k = of.template model<typename Run::simulation_type::contact_type>().normal().stiffness(pair.at.overlap,
                                                                                                     pair.at.radius);
            // A wall does not move: half of what a partner that moves the other way would give.
            add(static_cast<std::size_t>(pair.i), pair.at.normal, pair.is_wall ? k / 2 : k);
            if (!pair.is_wall) add(static_cast<std::size_t>(pair.j), pair.at.normal, k);
            const auto& friction = of.template model<typename Run::simulation_type::contact_type>().tangential();
            if constexpr (requires { friction.stiffness(pair.at.overlap, pair.at.radius); })
                if (pair.at.mass > 0)
                    stuck = (std::max)(stuck, 3.5 * friction.stiffness(pair.at.overlap, pair.at.radius) / pair.at.mass);
        });
    of.each_spring([&](index_t i, index_t j, const spring& one) {
        auto n = of.apart(i, j);
        double square = 0;
        for (const double d : n) square += d * d;
        for (double& d : n) d /= std::sqrt(square);
        add(static_cast<std::size_t>(i), n, one.k);
    });
    double most = 0;
    for (std::size_t i = 0; i < sums.size(); ++i)
        most = (std::max)(most, detail::greatest_eigenvalue<D>(sums[i]) / of.mass(static_cast<index_t>(i)));
    return std::sqrt((std::max)(2 * most, stuck));
}

}  // namespace tsubu::dem
