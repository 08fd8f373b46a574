// SPDX-License-Identifier: MIT
/// @file
/// Where the fields of a scene lie in memory, for its kernels.
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/vector_algebra.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <limits>   // std::numeric_limits

namespace tsubu::dem::detail {

/// The moment of inertia of a solid sphere is 2/5 m r^2.
inline constexpr double sphere_inertia = 0.4;

/// A wall is as heavy as a particle that is held in place.
inline constexpr double mass_of_wall = std::numeric_limits<double>::infinity();
/// Of two bodies, from reciprocals, so that one mass may be infinite; 0 if both are: there is nothing to damp.
[[nodiscard, gnu::always_inline]] inline double effective_mass(double m_i, double m_j) noexcept {
    const double inverse = 1 / m_i + 1 / m_j;
    return inverse > 0 ? 1 / inverse : 0;
}

/// A wall in the dimensions of a scene.
template <std::size_t D>
struct wall_plane {
    vec<D, double> point;
    vec<D, double> normal;
    [[nodiscard, gnu::always_inline]] double distance(const vec<D, double>& x) const noexcept {
        double sum = 0;
        for (std::size_t k = 0; k < D; ++k) sum += (x[k] - point[k]) * normal[k];
        return sum;
    }
};

/// The columns that a scene has, taken anew whenever particles have come or gone.
template <class Simulation>
struct columns {
    static constexpr auto D = Simulation::dimension;
    using quantities = typename Simulation::quantities_type;
    using coordinate = typename Simulation::coordinate;
    using real = typename Simulation::real;
    using position_type = vec<D, coordinate>;
    using vector_type = vec<D, real>;
    using spin_type = vec<spin_count<D>, real>;

    position_type* x = nullptr;
    vector_type* offset = nullptr;  // from x, where that is a cell
    vector_type* v = nullptr;
    vector_type* f = nullptr;
    spin_type* w = nullptr;  // angular velocity
    spin_type* t = nullptr;  // torque
    const double* radius = nullptr;
    const double* mass = nullptr;
    real radius_of_all{};
    real mass_of_all{};
    std::array<double, D> step{};              // of a lattice [m]
    std::array<double, D> steps_per_length{};  // [1/m]
    const typename Simulation::box_type* box = nullptr;

    columns() = default;
    columns(typename Simulation::store_type& store, const typename Simulation::box_type& where,
            const typename Simulation::bodies_type& bodies)
        : x(store[quantities::position].data()),
          v(store[quantities::velocity].data()),
          f(store[quantities::force].data()),
          box(&where) {
        if constexpr (quantities::has_offsets) offset = store[quantities::offset].data();
        if constexpr (Simulation::turns) {
            w = store[quantities::angular_velocity].data();
            t = store[quantities::torque].data();
        }
        if constexpr (Simulation::bodies_type::are_equal) {
            radius_of_all = static_cast<real>(bodies.radius);
            mass_of_all = static_cast<real>(bodies.mass);
        } else {
            radius = store[tsubu::radius].data();
            mass = store[tsubu::mass].data();
        }
        if constexpr (is_lattice<coordinate>)
            for (std::size_t k = 0; k < D; ++k) {
                step[k] = where.along(k).length_of(1.0);
                steps_per_length[k] = 1 / step[k];
            }
    }

    /// From particle j to i along axis k; on a lattice the shorter way round.
    [[nodiscard, gnu::always_inline]] real apart(std::size_t k, index_t i, index_t j) const noexcept {
        if constexpr (quantities::has_offsets)
            return static_cast<real>(x[i][k] - x[j][k]) * static_cast<real>(step[k]) + (offset[i][k] - offset[j][k]);
        else if constexpr (is_lattice<coordinate>)
            return static_cast<real>(static_cast<double>(x[i][k] - x[j][k]) * step[k]);
        else
            return static_cast<real>(x[i][k] - x[j][k]);
    }
    [[nodiscard, gnu::always_inline]] vec<D, double> real_position(index_t i) const noexcept {
        vec<D, double> at;
        for (std::size_t k = 0; k < D; ++k) {
            at[k] = static_cast<double>(box->along(k).to_real(x[i][k]));
            if constexpr (quantities::has_offsets) at[k] += static_cast<double>(offset[i][k]);
        }
        return at;
    }
    [[nodiscard, gnu::always_inline]] real radius_at(index_t i) const noexcept {
        if constexpr (Simulation::bodies_type::are_equal)
            return radius_of_all;
        else
            return static_cast<real>(radius[i]);
    }
    [[nodiscard, gnu::always_inline]] real mass_at(index_t i) const noexcept {
        if constexpr (Simulation::bodies_type::are_equal)
            return mass_of_all;
        else
            return static_cast<real>(mass[i]);
    }
};

}  // namespace tsubu::dem::detail
