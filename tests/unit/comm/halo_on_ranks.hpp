// SPDX-License-Identifier: MIT
/// @file
/// The laws of halos on 1 to 8 ranks, in all decompositions, by all patterns.
#pragma once

#include "comm_laws/halo_laws.hpp"
#include "comm_laws/on_ranks.hpp"

#include <cstddef>
#include <initializer_list>

namespace comm_laws {

inline constexpr std::initializer_list<double> no_cutoff_to_several_boxes = {0, 0.07, 0.4, 1.1, 2.5};

template <class Layout = tsubu::soa, class Box>
void check_ghosts(const Box& box, std::initializer_list<double> cutoffs = no_cutoff_to_several_boxes) {
    for (const auto ranks : some_ranks)
        for (const auto cutoff : cutoffs)
            each_decomposition(box, ranks, [&](const auto& parts) {
                check_on_ranks(ranks,
                               [&](auto& on, verdict& seen) { ghosts_are_images<Layout>(parts, on, cutoff, seen); });
            });
}

}  // namespace comm_laws
