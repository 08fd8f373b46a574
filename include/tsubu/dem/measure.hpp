// SPDX-License-Identifier: MIT
/// @file
/// What is measured of a run: energies, momentum, contacts. All are sums over ranks: collective, one reduction each.
#pragma once

#include <tsubu/comm/transport.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/contact_pair.hpp>
#include <tsubu/dem/springs.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>    // std::array
#include <cmath>    // std::sqrt
#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <limits>   // std::numeric_limits
#include <span>     // std::span

namespace tsubu::dem {
namespace detail {

template <class Run, std::size_t Count>
[[nodiscard]] std::array<double, Count> summed(Run& of, std::array<double, Count> sums) {
    of.on().reduce(std::span<double>(sums), reduction::sum);
    return sums;
}
[[nodiscard]] inline bool is_movable(double mass) noexcept {
    return mass <= (std::numeric_limits<double>::max)();
}
template <class Vector>
[[nodiscard]] double square_of(const Vector& v) noexcept {
    double sum = 0;
    for (const auto one : v) sum += static_cast<double>(one) * static_cast<double>(one);
    return sum;
}

}  // namespace detail

/// Sum of m v^2 / 2 [J]; particles of infinite mass are left out.
template <class Run>
[[nodiscard]] double kinetic_energy(Run& of) {
    double sum = 0;
    const auto v = of.particles().owned()[Run::simulation_type::quantities_type::velocity];
    for (std::size_t i = 0; i < v.size(); ++i)
        if (const double m = of.mass(static_cast<index_t>(i)); detail::is_movable(m))
            sum += m / 2 * detail::square_of(v[i]);
    return detail::summed(of, std::array{sum})[0];
}
/// Sum of I omega^2 / 2, I = 2/5 m R^2 [J].
template <class Run>
[[nodiscard]] double rotational_energy(Run& of) {
    double sum = 0;
    if constexpr (Run::simulation_type::turns) {
        const auto w = of.particles().owned()[Run::simulation_type::quantities_type::angular_velocity];
        for (std::size_t i = 0; i < w.size(); ++i) {
            const auto at = static_cast<index_t>(i);
            if (const double m = of.mass(at); detail::is_movable(m))
                sum += detail::sphere_inertia / 2 * m * of.radius(at) * of.radius(at) * detail::square_of(w[i]);
        }
    }
    return detail::summed(of, std::array{sum})[0];
}
/// Of all contacts along the normal, and of all springs [J].
template <class Run>
[[nodiscard]] double elastic_energy(Run& of) {
    double sum = 0;
    const auto owned = of.particles().owned_count();
    if constexpr (Run::simulation_type::has_contacts)
        of.each_contact([&](const auto& pair) {
            const bool is_shared = !pair.is_wall && static_cast<std::size_t>(pair.j) >= owned;
            const auto& law = of.template model<typename Run::simulation_type::contact_type>();
            double energy = law.normal().energy(pair.at.overlap, pair.at.radius);
            if constexpr (Run::simulation_type::contact_type::cohesion_type::pulls)
                energy -= law.cohesion().pull(pair.at.radius) * pair.at.overlap;
            sum += (is_shared ? 0.5 : 1.0) * energy;
        });
    of.each_spring([&](index_t i, index_t j, const spring& one) {
        const double stretch = std::sqrt(detail::square_of(of.apart(i, j))) - one.length;
        sum += one.k / 4 * stretch * stretch;  // the other half is on the other side
    });
    return detail::summed(of, std::array{sum})[0];
}
/// -Sum of m g x [J].
template <class Run>
[[nodiscard]] double gravity_energy(Run& of) {
    double sum = 0;
    if constexpr (Run::simulation_type::has_gravity)
        for (std::size_t i = 0; i < of.particles().owned_count(); ++i) {
            const auto at = static_cast<index_t>(i);
            if (!detail::is_movable(of.mass(at))) continue;
            const auto x = of.position(at);
            for (std::size_t k = 0; k < x.size(); ++k) sum -= of.mass(at) * of.gravity_acceleration()[k] * x[k];
        }
    return detail::summed(of, std::array{sum})[0];
}
/// Sum of m v [kg m/s]; particles of infinite mass are left out.
template <class Run>
[[nodiscard]] auto momentum(Run& of) {
    std::array<double, Run::simulation_type::dimension> sum{};
    const auto v = of.particles().owned()[Run::simulation_type::quantities_type::velocity];
    for (std::size_t i = 0; i < v.size(); ++i)
        if (const double m = of.mass(static_cast<index_t>(i)); detail::is_movable(m))
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += m * static_cast<double>(v[i][k]);
    return detail::summed(of, sum);
}
/// Sum of x / N [m].
template <class Run>
[[nodiscard]] auto mean_position(Run& of) {
    constexpr auto D = Run::simulation_type::dimension;
    std::array<double, D + 1> sum{};
    for (std::size_t i = 0; i < of.particles().owned_count(); ++i) {
        const auto x = of.position(static_cast<index_t>(i));
        for (std::size_t k = 0; k < D; ++k) sum[k] += x[k];
        sum[D] += 1;
    }
    sum = detail::summed(of, sum);
    vec<D> mean{};
    for (std::size_t k = 0; k < D; ++k) mean[k] = sum[k] / sum[D];
    return mean;
}
/// How many particles there are on all ranks.
template <class Run>
[[nodiscard]] std::uint64_t particle_count(Run& of) {
    return static_cast<std::uint64_t>(
        detail::summed(of, std::array{static_cast<double>(of.particles().owned_count())})[0]);
}
/// Z: contacts with other particles, per particle; walls do not count.
template <class Run>
[[nodiscard]] double coordination_number(Run& of) {
    std::array<double, 2> sum{0, static_cast<double>(of.particles().owned_count())};
    of.each_contact([&](const auto& pair) {
        if (pair.is_wall) return;
        sum[0] += static_cast<std::size_t>(pair.j) < of.particles().owned_count() ? 2 : 1;  // a ghost counts at home
    });
    sum = detail::summed(of, sum);
    return sum[0] / sum[1];
}

}  // namespace tsubu::dem
