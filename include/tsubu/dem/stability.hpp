// SPDX-License-Identifier: MIT
/// @file
/// How long a time step may be: the greatest frequency of what touches, and its damping.
#pragma once

#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/contact_pair.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/laws/concepts.hpp>
#include <tsubu/dem/springs.hpp>
#include <tsubu/dem/vector_algebra.hpp>

#include <algorithm>  // std::max, std::min
#include <array>      // std::array
#include <cmath>      // std::abs, std::sqrt
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <vector>     // std::vector

namespace tsubu::dem {
namespace detail {

/// A symmetric matrix of non-negative eigenvalues.
template <std::size_t N>
class form {
public:
    using vector = vec<N, double>;

    /// += k g g^T.
    void add(double k, const vector& g) noexcept {
        for (std::size_t a = 0; a < N; ++a)
            for (std::size_t b = 0; b < N; ++b) rows_[a][b] += k * g[a] * g[b];
    }
    /// At least the greatest eigenvalue: the greatest sum of a row.
    [[nodiscard]] double bound() const noexcept {
        double most = 0;
        for (const auto& row : rows_) {
            double sum = 0;
            for (const double one : row) sum += std::abs(one);
            most = (std::max)(most, sum);
        }
        return most;
    }
    /// The greatest eigenvalue, by Jacobi's rotations.
    [[nodiscard]] double greatest() const noexcept {
        auto a = rows_;
        for (int sweep = 0; sweep < 32; ++sweep) {  // converges quadratically: a few are enough
            double off = 0;
            double trace = 0;
            for (std::size_t p = 0; p < N; ++p) {
                trace += a[p][p];
                for (std::size_t q = p + 1; q < N; ++q) off += a[p][q] * a[p][q];
            }
            if (off <= 1e-30 * trace * trace) break;  // of the size of rounding
            for (std::size_t p = 0; p < N; ++p)
                for (std::size_t q = p + 1; q < N; ++q) turn(a, p, q);
        }
        double most = 0;
        for (std::size_t k = 0; k < N; ++k) most = (std::max)(most, a[k][k]);
        return most;
    }

private:
    using matrix = std::array<vector, N>;
    static void turn(matrix& a, std::size_t p, std::size_t q) noexcept {
        if (a[p][q] == 0) return;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1);
        const double s = t * c;
        for (std::size_t k = 0; k < N; ++k) {
            const double kp = a[k][p];
            const double kq = a[k][q];
            a[k][p] = c * kp - s * kq;
            a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < N; ++k) {
            const double pk = a[p][k];
            const double qk = a[q][k];
            a[p][k] = c * pk - s * qk;
            a[q][k] = s * pk + c * qk;
        }
    }

    matrix rows_{};
};

// Of a contact between i and j the relative motion is a part of i less a part of j: along the normal n v, along the
// surface v - R w x n without its normal component, of rolling w. With (a - b)^2 <= 2 a^2 + 2 b^2 the energy of all
// contacts is at most a sum over particles, and what each has is a form of its own velocity and spin, scaled by the
// roots of mass and inertia. A wall stands still: b is 0, and it counts half.

/// What contacts and springs make of the motion of one particle: stiffness over mass [1/s^2], damping over mass [1/s].
template <std::size_t N>
struct particle_modes {
    form<N> stiffness;
    form<N> damping;
};

/// The modes of some owned particles, that stand one after the other.
template <class Run>
class modes_of_some {
    using simulation = typename Run::simulation_type;
    static constexpr auto D = simulation::dimension;
    static constexpr std::size_t spins = simulation::turns ? spin_count<D> : 0;
    using velocity = vec<D, double>;
    using spin_vector = vec<spins, double>;

public:
    using modes = particle_modes<D + spins>;

    explicit modes_of_some(const Run& of) : of_(of) {}

    /// Of `count` particles from `first` on.
    [[nodiscard]] std::span<const modes> of(std::size_t first, std::size_t count) {
        first_ = first;
        modes_.assign(count, {});
        if constexpr (simulation::has_contacts)
            of_.each_contact([&](const contact_pair<D>& pair) { add_contact(pair); });
        of_.each_spring([&](index_t i, index_t j, const spring& one) { add_spring(i, j, one); });
        return modes_;
    }

private:
    /// Neither of a later turn nor a ghost, which its owner sees to.
    [[nodiscard]] bool has(index_t i) const noexcept {
        return static_cast<std::size_t>(i) - first_ < modes_.size() && static_cast<std::size_t>(i) >= first_;
    }
    /// Adds k and c along the direction `v` of the velocity and `w` of the spin.
    void add(index_t i, double k, double c, const velocity& v, const spin_vector& w) {
        const double mass = of_.mass(i);
        if (!(mass <= (std::numeric_limits<double>::max)())) return;  // it does not move
        const double per_root = 1 / std::sqrt(mass);
        vec<D + spins, double> g{};
        for (std::size_t a = 0; a < D; ++a) g[a] = v[a] * per_root;
        for (std::size_t a = 0; a < spins; ++a)
            g[D + a] = w[a] * per_root / (std::sqrt(sphere_inertia) * of_.radius(i));
        auto& at = modes_[static_cast<std::size_t>(i) - first_];
        if (k != 0) at.stiffness.add(2 * k, g);
        if (c != 0) at.damping.add(2 * c, g);
    }
    /// Of both sides of a contact; spin(i, side) is the direction of the spin.
    template <class Spin>
    void add_both(const contact_pair<D>& pair, double k, double c, const velocity& v, const Spin& spin) {
        if (has(pair.i)) add(pair.i, k, c, v, spin(pair.i, 1.0));
        if (!pair.is_wall && has(pair.j)) add(pair.j, k, c, v, spin(pair.j, -1.0));
    }
    void add_contact(const contact_pair<D>& pair) {
        if (!has(pair.i) && (pair.is_wall || !has(pair.j))) return;
        const auto& law = of_.template model<typename simulation::contact_type>();
        const auto& at = pair.at;
        const double share = pair.is_wall ? 0.5 : 1;
        const double k = law.normal().stiffness(at.overlap, at.radius);
        const double c = law.normal().damping(at.overlap, at.mass, at.radius);
        add_both(pair, share * k, share * c, at.normal, [](index_t, double) { return spin_vector{}; });
        if constexpr (simulation::turns) add_friction(pair, law, share, k, c);
    }
    template <class Law>
    void add_friction(const contact_pair<D>& pair, const Law& law, double share, double k, double c) {
        const auto& at = pair.at;
        double k_t = 0;
        if constexpr (sticking_law<typename Law::tangential_type>)
            k_t = law.tangential().stiffness(at.overlap, at.radius);
        const double c_t = law.tangential().viscosity(at.mass, c);
        for (std::size_t a = 0; a < D; ++a) {
            // Along axis a: e_a (v_t - R w x n), of j with the normal that points to it.
            const auto spin = [&](index_t i, double side) {
                spin_vector w{};
                for (std::size_t b = 0; b < spins; ++b)
                    w[b] = -side * of_.radius(i) * spin_across(unit<spins>(b), at.normal)[a];
                return w;
            };
            add_both(pair, share * k_t, share * c_t, tangential<D, double>(unit<D>(a), at.normal), spin);
        }
        if constexpr (Law::rolling_type::resists) {
            const double k_r = law.rolling().stiffness(k, at.radius);
            const double c_r = law.rolling().viscosity(k, at.mass, at.radius);
            for (std::size_t a = 0; a < spins; ++a)
                add_both(pair, share * k_r, share * c_r, {}, [&](index_t, double) {
                    if constexpr (D == 3)
                        return tangential<3, double>(unit<spins>(a), at.normal);
                    else
                        return unit<spins>(a);
                });
        }
    }
    void add_spring(index_t i, index_t j, const spring& one) {
        if (!has(i)) return;
        auto n = of_.apart(i, j);
        double square = 0;
        for (const double d : n) square += d * d;
        const double distance = std::sqrt(square);
        for (double& d : n) d /= distance;
        add(i, one.k, 0, n, {});
        // Stretched, it is stiff across too, as a string is.
        const double across = one.k * (std::max)(0.0, 1 - one.length / distance);
        for (std::size_t a = 0; a < D && across > 0; ++a) add(i, across, 0, tangential<D, double>(unit<D>(a), n), {});
    }
    template <std::size_t N>
    static vec<N, double> unit(std::size_t a) noexcept {
        vec<N, double> one{};
        one[a] = 1;
        return one;
    }

    const Run& of_;
    std::size_t first_ = 0;
    std::vector<modes> modes_;
};

/// body(particle_modes) for each owned particle.
template <class Run, class Body>
void each_mode(const Run& of, Body&& body) {
    constexpr std::size_t at_once = 65536;  // particles: their forms take 10 to 40 MB
    const auto owned = of.particles().owned_count();
    modes_of_some<Run> some(of);
    for (std::size_t first = 0; first < owned; first += at_once)
        for (const auto& one : some.of(first, (std::min)(at_once, owned - first))) body(one);
}

/// The longest stable time step of what touches on this rank [s]; infinite if nothing does.
template <class Run>
[[nodiscard]] double longest_time_step_here(const Run& of) {
    using simulation = typename Run::simulation_type;
    double longest = std::numeric_limits<double>::infinity();
    const auto limit = [](double k, double c) {
        // Where there is a dashpot and no spring: one so soft that it does not matter.
        const double omega = (std::max)(std::sqrt(k), 1e-6 * c);
        return omega > 0 ? simulation::integrator_type::stable_until(c / (2 * omega)) / omega
                         : std::numeric_limits<double>::infinity();
    };
    each_mode(of, [&](const auto& one) {
        if (limit(one.stiffness.bound(), one.damping.bound()) < longest)  // eigenvalues cost: only where they may count
            longest = (std::min)(longest, limit(one.stiffness.greatest(), one.damping.greatest()));
    });
    if constexpr (simulation::has_contacts) {
        // The first touch of the lightest, if the law is as stiff from there on: what will be where nothing touches.
        const auto& law = of.template model<typename simulation::contact_type>().normal();
        const auto owned = of.particles().owned_count();
        double lightest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < owned; ++i) lightest = (std::min)(lightest, of.mass(static_cast<index_t>(i)));
        const double effective = lightest / (owned > 1 ? 2 : 1);
        if (effective <= (std::numeric_limits<double>::max)())
            longest = (std::min)(longest, limit(law.stiffness(0.0, 1.0) / effective,
                                                law.damping(0.0, effective, 1.0) / effective));
    }
    return longest;
}

}  // namespace detail

/// An upper bound of the angular frequency of any mode of what touches, as stiff as it is at the moment [rad/s]: the root of
/// 2 max lambda_max(sum k g g^T), g what the motion of a particle is to a contact: along its normal, along its surface if
/// there is a spring, and of rolling, over the roots of mass and inertia. All contacts count as sticking. Springs that are
/// stretched are stiff across their length as well.
///
/// Exact for the infinite chain and the FCC crystal without friction, for a contact by itself, and for a square lattice
/// with friction.
/// Collective: yes, one reduction. Complexity: O(contacts), in turns of 65536 particles, and eigenvalues of few.
/// Source: Rayleigh's quotient, with (a - b)^2 <= 2 a^2 + 2 b^2.
template <class Run>
[[nodiscard]] double greatest_frequency(const Run& of) {
    double square = 0;
    detail::each_mode(of, [&](const auto& one) {
        if (one.stiffness.bound() > square) square = (std::max)(square, one.stiffness.greatest());
    });
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
/// symplectic_euler that is a bound of any packing, since theirs is dt^2 omega^2 / 4 + dt c / 2 <= 1, a sum over
/// contacts. A law that is linear from the first touch counts with two of the lightest particles, even if none touch.
/// Collective: yes, one reduction. Complexity: as greatest_frequency.
template <class Run>
[[nodiscard]] double longest_time_step(const Run& of) {
    double shortest = -detail::longest_time_step_here(of);
    of.on().reduce(std::span<double>(&shortest, 1), reduction::greatest);
    return -shortest;
}

}  // namespace tsubu::dem
