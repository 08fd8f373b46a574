// SPDX-License-Identifier: MIT
/// @file
/// What a scene refuses: parameters, particles, and what its guards see.
#pragma once

#include <tsubu/comm/transport.hpp>
#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/dem/detail/columns.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/stability.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/lattice.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <algorithm>  // std::max, std::min
#include <cmath>    // std::abs, std::nextafter
#include <cstddef>  // std::size_t
#include <cstdint>  // std::uint64_t
#include <limits>   // std::numeric_limits
#include <span>     // std::span
#include <string>   // std::string, std::to_string
#include <tuple>    // std::get
#include <vector>   // std::vector

namespace tsubu::dem::detail {

/// The walls in the dimensions of the scene.
template <class Simulation>
[[nodiscard]] std::vector<wall_plane<Simulation::dimension>> walls_of(const typename Simulation::models_type& models) {
    std::vector<wall_plane<Simulation::dimension>> result;
    if constexpr (Simulation::has_walls)
        for (const auto& one : std::get<typename Simulation::walls_type>(models).planes) {
            wall_plane<Simulation::dimension> wall;
            for (std::size_t k = 0; k < Simulation::dimension; ++k) {
                wall.point[k] = one.point[k];
                wall.normal[k] = one.normal[k];
            }
            for (auto k = Simulation::dimension; k < 3; ++k)
                if (one.normal[k] != 0)
                    tsubu::detail::raise<input_error>("dem::walls",
                                                      "the normal of wall " + std::to_string(result.size()) +
                                                          " has a component " + tsubu::detail::shown(one.normal[k]) +
                                                          " along axis " + std::to_string(k) + " of a scene in " +
                                                          std::to_string(Simulation::dimension) + " dimensions",
                                                      "give a normal in the dimensions of the scene");
            result.push_back(wall);
        }
    return result;
}
template <class Simulation>
[[nodiscard]] std::size_t spring_kinds_of(const typename Simulation::models_type& models) {
    if constexpr (Simulation::has_springs)
        return std::get<typename Simulation::springs_type>(models).kinds.size();
    else
        return 0;
}

/// @throws input_error at the first particle whose radius, mass, position or velocity is not what it may be.
template <class Simulation>
void check_particles(const typename Simulation::store_type& store) {
    constexpr auto D = Simulation::dimension;
    using quantities = typename Simulation::quantities_type;
    const auto refuse = [&](std::size_t i, const std::string& what, const char* remedy) {
        tsubu::detail::raise<input_error>("dem::run::start",
                                          "particle " + std::to_string(store[tsubu::id][i]) + " has " + what, remedy);
    };
    for (std::size_t i = 0; i < store.owned_count(); ++i) {
        if (store[tsubu::id][i] < 0) refuse(i, "a negative id", "ids of particles are 0 or greater");
        if constexpr (!Simulation::bodies_type::are_equal) {
            const double r = store[tsubu::radius][i];
            const double m = store[tsubu::mass][i];
            if (!(r > 0) || !tsubu::detail::is_finite(r))
                refuse(i, "a radius of " + tsubu::detail::shown(r) + " m", "give a finite length above 0");
            if (!(m > 0))
                refuse(i, "a mass of " + tsubu::detail::shown(m) + " kg",
                       "give a mass above 0; an infinite one holds it in place");
        }
        if constexpr (Simulation::turns)
            for (const auto w : store[quantities::angular_velocity][i])
                if (!tsubu::detail::is_finite(w))
                    refuse(i, "an angular velocity of " + tsubu::detail::shown(w) + " rad/s", "give finite numbers");
        if constexpr (Simulation::has_history)
            for (const auto& one : store[quantities::template contacts<Simulation::history_size>][i])
                for (const auto number : one.history)
                    if (!tsubu::detail::is_finite(number))
                        refuse(i,
                               "a history of " + tsubu::detail::shown(number) + " with " + std::to_string(one.partner),
                               "give finite numbers, or clear the field `contacts`");
        for (std::size_t k = 0; k < D; ++k) {
            if constexpr (quantities::has_offsets)
                if (!tsubu::detail::is_finite(store[quantities::offset][i][k]))
                    refuse(i, "an offset of " + tsubu::detail::shown(store[quantities::offset][i][k]) + " m",
                           "give finite numbers");
            const auto v = store[quantities::velocity][i][k];
            if (!tsubu::detail::is_finite(v))
                refuse(i, "a velocity of " + tsubu::detail::shown(v) + " m/s on axis " + std::to_string(k),
                       "give finite numbers");
            if constexpr (!is_lattice<typename Simulation::coordinate>) {
                const auto x = store[quantities::position][i][k];
                if (!tsubu::detail::is_finite(x))
                    refuse(i, "a position of " + tsubu::detail::shown(x) + " m on axis " + std::to_string(k),
                           "give finite numbers");
            }
        }
    }
}

/// Looks at what guards watch.
template <class Run>
class watcher {
    using simulation = typename Run::simulation_type;
    static constexpr auto D = simulation::dimension;

public:
    explicit watcher(Run& of) noexcept : of_(of) {}

    /// What each rank can tell. @throws input_error
    void check(std::uint64_t step) const {
        const auto& guard = of_.how().guard;
        if (guard.overlap) check_overlaps(step);
        if (guard.time_step) check_time_step(step);
        if (guard.coordinates) check_speeds(step);
    }
    /// Collective. @throws input_error on all ranks
    void check_together(std::uint64_t step, bool& has_been_at_rest) const {
        if (of_.how().guard.coordinates) check_coordinates(step);
        check_energy(step, has_been_at_rest);
    }

private:
    void check_energy(std::uint64_t step, bool& has_been_at_rest) const {
        const double floor = of_.how().guard.energy_floor;
        if (!(floor > 0)) return;
        const double energy = kinetic_energy(of_);
        if (has_been_at_rest && !(energy <= 10 * floor))
            refuse(step,
                   "a kinetic energy of " + tsubu::detail::shown(energy) + " J, after it was below the floor of " +
                       tsubu::detail::shown(floor) + " J",
                   "take a smaller time step, if nothing else has set the scene in motion");
        has_been_at_rest = has_been_at_rest || energy <= floor;
    }
    [[noreturn]] static void refuse(std::uint64_t step, const std::string& what, const char* remedy) {
        tsubu::detail::raise<input_error>("dem::run", "step " + std::to_string(step) + ": " + what, remedy);
    }
    [[nodiscard]] std::string named(index_t i) const {
        return std::to_string(of_.particles()[tsubu::id][i]);
    }
    void check_overlaps(std::uint64_t step) const {
        of_.each_contact([&](const contact_pair<D>& pair) {
            const double smaller =
                pair.is_wall ? of_.radius(pair.i) : (std::min)(of_.radius(pair.i), of_.radius(pair.j));
            if (!(pair.at.overlap <= smaller))
                refuse(step,
                       "particle " + named(pair.i) + " overlaps " +
                           (pair.is_wall ? "wall " + std::to_string(pair.j) : "particle " + named(pair.j)) + " by " +
                           tsubu::detail::shown(pair.at.overlap) + " m, more than a radius of " +
                           tsubu::detail::shown(smaller) + " m",
                       "place them apart; or take a stiffer law, or a smaller time step");
        });
    }
    void check_time_step(std::uint64_t step) const {
        const double longest = longest_time_step_here(of_);
        if (longest == 0)
            refuse(step, "no time step is stable with this integrator and contacts without damping",
                   "take velocity_verlet; to see what happens, switch guards::time_step off");
        if (!(of_.how().time_step <= longest))
            refuse(step,
                   "a time step of " + tsubu::detail::shown(of_.how().time_step) +
                       " s, and contacts that are stable up to " + tsubu::detail::shown(longest) + " s",
                   "take a smaller time step, softer contacts or another integrator; to see what happens, switch "
                   "guards::time_step off");
    }
    void check_speeds(std::uint64_t step) const {
        const auto& particles = of_.particles();
        for (std::size_t i = 0; i < particles.owned_count(); ++i)
            for (std::size_t k = 0; k < D; ++k) {
                const double v = std::abs(static_cast<double>(particles[simulation::quantities_type::velocity][i][k]));
                const double length = static_cast<double>(of_.box().real_axis(k).length());
                if (!(v * of_.how().time_step <= length))
                    refuse(step,
                           "particle " + named(static_cast<index_t>(i)) + " moves by " +
                               tsubu::detail::shown(v * of_.how().time_step) +
                               " m in a step, farther than the box of " + tsubu::detail::shown(length) +
                               " m along axis " + std::to_string(k),
                           "look where its velocity comes from, or take a smaller time step");
            }
    }
    // Of a scene at rest the speeds end in the noise of rounding: what touches something may stand still.
    void check_coordinates(std::uint64_t step) const {
        const auto& particles = of_.particles();
        std::vector<unsigned char> is_held(particles.size(), 0);
        of_.each_contact([&](const contact_pair<D>& pair) {
            is_held[static_cast<std::size_t>(pair.i)] = 1;
            if (!pair.is_wall) is_held[static_cast<std::size_t>(pair.j)] = 1;
        });
        of_.each_spring([&](index_t i, index_t, const spring&) { is_held[static_cast<std::size_t>(i)] = 1; });
        double fastest[2] = {0, 0};  // of the free and of the held: units of the last place of a coordinate per step
        for (std::size_t i = 0; i < particles.owned_count(); ++i)
            for (std::size_t k = 0; k < D; ++k) {
                const double v = std::abs(static_cast<double>(particles[simulation::quantities_type::velocity][i][k]));
                auto& most = fastest[is_held[i]];
                most = (std::max)(most, v * of_.how().time_step / resolution(static_cast<index_t>(i), k));
            }
        of_.on().reduce(std::span<double>(fastest), reduction::greatest);
        const auto& [free, held] = fastest;
        if (free > held && free < 0.5)
            refuse(step,
                   "frozen coordinates: a time step of " + tsubu::detail::shown(of_.how().time_step) +
                       " s moves the fastest particle by " + tsubu::detail::shown(free) +
                       " units in the last place of its position, less than a half",
                   "shift the origin to the particles, or take lattice<std::int64_t> or a longer time step");
    }
    /// The distance of neighbouring coordinates where a particle is [m].
    [[nodiscard]] double resolution(index_t i, std::size_t k) const {
        using coordinate = typename simulation::coordinate;
        if constexpr (simulation::quantities_type::has_offsets) {
            return of_.box().along(k).length_of(1.0) *
                   static_cast<double>(std::numeric_limits<typename simulation::real>::epsilon());
        } else if constexpr (is_lattice<coordinate>) {
            return of_.box().along(k).length_of(1.0);
        } else {
            const auto x = std::abs(of_.particles()[simulation::quantities_type::position][i][k]);
            return static_cast<double>(std::nextafter(x, (std::numeric_limits<coordinate>::max)()) - x);
        }
    }

    Run& of_;
};

}  // namespace tsubu::dem::detail
