// SPDX-License-Identifier: MIT
/// @file
/// Impacts of two spheres by the laws of Hertz.

#include "impact_sweep.hpp"

namespace bench {

void add_hertz(std::vector<sweep>& all) {
    add_law<hertz<>>(all);
    add_law<hertz_tsuji<>>(all);
}

}  // namespace bench
