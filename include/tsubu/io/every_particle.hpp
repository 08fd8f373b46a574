// SPDX-License-Identifier: MIT
/// @file
/// every_particle: what keeps all that a file has.
#pragma once

#include <tsubu/version.hpp>

namespace tsubu {

/// For lammps_reader::read and restart_reader::read: every particle is wanted, as by a program of one rank.
struct every_particle {
    template <class Particle>
    [[nodiscard]] constexpr bool operator()(const Particle&) const noexcept {
        return true;
    }
};

}  // namespace tsubu
