// SPDX-License-Identifier: MIT
// The forces of a scene of DIMENSION and LAW: read as assembly by needed.cmake.
#include <tsubu/tsubu.hpp>

namespace dem = tsubu::dem;
using scene = dem::simulation<DIMENSION, double, dem::velocity_verlet, dem::LAW>;

extern "C" void forces(const dem::detail::columns<scene>& of, const scene::contact_type& law,
                       std::span<const tsubu::index_pair> pairs, dem::detail::touch_state* touches,
                       tsubu::vec<scene::history_size>* memory) {
    dem::detail::contact_kernel<scene>(of, law, 1e-4).act_on_pairs(pairs, touches, memory);
}
