// SPDX-License-Identifier: MIT
/// @file
/// h5md_options: who writes an H5MD file, and with what.
#pragma once

#include <string>  // std::string

namespace tsubu {

/// What an H5MD file says of itself, and whether it may replace another one.
struct h5md_options {
    std::string author = "unknown";  ///< the person who is responsible for the simulation
    std::string email{};             ///< of the author; left out if empty
    std::string creator{};           ///< the program; if empty, tsubu and its version
    std::string creator_version{};   ///< of that program
    std::string group = "all";       ///< the particles are /particles/<group>
    bool replace = false;            ///< a file of the same name; otherwise it is refused
};

}  // namespace tsubu
