// SPDX-License-Identifier: MIT
#include <tsubu/domain/domain.hpp>

// Without -ffast-math this compiles: the control.
int main() { return tsubu::domain<1>{{0}, {1}}.contains({0.5}) ? 0 : 1; }
