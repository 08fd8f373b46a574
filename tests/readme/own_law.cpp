// SPDX-License-Identifier: MIT
#include <tsubu/dem/contact_law.hpp>
#include <tsubu/testing/normal_law_conformance.hpp>

#include <cstdio>

// Cones that meet at their tips: F = c d^2.
struct cone_normal {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = false;
    double c;  // [N/m^2]

    void check() const {}
    // Real is double, float, or lanes of them: as many contacts at a time as a register holds.
    template <class Real>
    Real elastic(const Real& overlap, const Real&) const {
        return tsubu::dem::constant<Real>(c) * overlap * overlap;
    }
    template <class Real>
    Real stiffness(const Real& overlap, const Real&) const {
        return tsubu::dem::constant<Real>(2 * c) * overlap;
    }
    double energy(double overlap, double) const { return c / 3 * overlap * overlap * overlap; }
    template <class Real>
    Real damping(const Real&, const Real&, const Real&) const {
        return Real(0);
    }
};
static_assert(tsubu::dem::normal_law<cone_normal>);
using cones = tsubu::dem::contact_law<cone_normal, tsubu::dem::coulomb>;  // goes into a scene as hooke<> does

int main() {
    bool kept_all = true;
    tsubu::testing::check_normal_law(cone_normal{1e6}, 1e-2, [&](bool kept, std::string_view law) {
        if (!kept) std::printf("%.*s\n", static_cast<int>(law.size()), law.data());
        kept_all = kept_all && kept;
    });
    return kept_all && cones({1e6}, {.mu = 0.5, .gamma_t = 10}).normal().c == 1e6 ? 0 : 1;
}
