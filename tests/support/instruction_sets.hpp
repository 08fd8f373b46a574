// SPDX-License-Identifier: MIT
/// @file
/// The same with each instruction set that the machine has.
#pragma once

#include <tsubu/core/instruction_set.hpp>

struct each_instruction_set {
    ~each_instruction_set() { tsubu::use_instruction_set(tsubu::supported_instruction_set()); }
    template <class Body>
    void run(Body&& body) const {
        for (const auto set :
             {tsubu::instruction_set::portable, tsubu::instruction_set::avx2, tsubu::instruction_set::avx512}) {
            tsubu::use_instruction_set(set);
            body();
        }
    }
};
