// SPDX-License-Identifier: MIT
#include <tsubu/dem/implicit_velocity_verlet.hpp>
#include <tsubu/dem/runge_kutta_4.hpp>
#include <tsubu/dem/simulation.hpp>
#include <tsubu/dem/springs.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include <cstddef>

using namespace tsubu::dem;
using verlet = velocity_verlet;

/// One type short of a model.
struct half_a_model {
    static constexpr auto role = model_role::acceleration;
    template <class>
    using reads = tsubu::fields<>;
#if CASE != 20
    template <class>
    using partner_reads = tsubu::fields<>;
#endif
    template <class>
    using writes = tsubu::fields<>;
    void check() const {}
};

/// Friction that lacks something in two of the cases.
struct half_a_friction {
    static constexpr auto role = contact_role::tangential;
    static constexpr bool turns = true;
    template <class Normal>
    static constexpr bool goes_with = true;
#if CASE != 22
    template <std::size_t D>
    static constexpr std::size_t history_size = 0;
#endif
    double mu;
    void check() const {}
    double viscosity(double, double) const { return 0; }
#if CASE == 23
    template <std::size_t D, class>
    tsubu::vec<D> force(const contact<D, double>&, double, double, tsubu::vec<0>&) const {
        return {};
    }
#else
    template <std::size_t D, class Real>
    tsubu::vec<D, Real> force(const contact<D, Real>&, const Real&, const Real&, tsubu::vec<0, Real>&) const {
        return {};
    }
#endif
};
/// A normal law; in one of the cases for double alone.
struct normal_of_doubles {
    static constexpr bool is_damped = false;
    static constexpr bool is_hertzian = false;
    double k;
    void check() const {}
#if CASE != 24
    template <class Number>
#else
    using Number = double;
#endif
    Number elastic(const Number& overlap, const Number&) const {
        return constant<Number>(k) * overlap;
    }
    template <class Real>
    Real stiffness(const Real&, const Real&) const {
        return constant<Real>(k);
    }
    double energy(double overlap, double) const { return k * overlap * overlap / 2; }
    template <class Real>
    Real damping(const Real&, const Real&, const Real&) const {
        return constant<Real>(0);
    }
};

#if CASE == 1
using scene = simulation<4, double, verlet, hooke<>>;
#elif CASE == 2
using scene = simulation<3, double, verlet, hooke<>, hertz<>>;
#elif CASE == 3
using scene = simulation<3, double, verlet, gravity, walls>;
#elif CASE == 4
using scene = simulation<1, double, verlet, hooke<coulomb>>;
#elif CASE == 5
using scene = simulation<3, double, runge_kutta_4, hooke<linear_history>>;
#elif CASE == 6
using scene = simulation<3, double, runge_kutta_4, hooke<coulomb>>;
#elif CASE == 7
using scene = simulation<1, double, implicit_velocity_verlet, springs>;
#elif CASE == 8
using scene = simulation<3, double, verlet, hooke<coulomb, linear_history>>;
#elif CASE == 9
using scene = simulation<3, double, verlet, hooke<mindlin_history>>;
#elif CASE == 10
using scene = simulation<3, double, verlet, hertz<linear_history>>;
#elif CASE == 11
using scene = simulation<3, double, verlet, hooke<dmt_cohesion>>;
#elif CASE == 12
using scene = simulation<3, double, verlet, hooke<rolling_resistance>>;
#elif CASE == 13
using scene = simulation<3, double, verlet, hooke<without_attraction>>;
#elif CASE == 14
using scene = simulation<3, double, verlet, hertz_tsuji<dmt_cohesion, without_attraction>>;
#elif CASE == 15
using scene = simulation<3, double, verlet, hooke<>, equal_spheres, spheres>;
#elif CASE == 16
using scene = simulation<3, double, verlet, hooke<>, gravity, gravity>;
#elif CASE == 17
using scene = simulation<3, int, verlet, hooke<>>;
#elif CASE == 18
using scene = simulation<3, double, verlet, hooke<>, walls, walls>;
#elif CASE == 19
using scene = simulation<3, double, implicit_velocity_verlet, hooke_dashpot<coulomb>>;
#elif CASE == 21
using scene = simulation<3, double, verlet, hooke<int>>;
#else
using scene = simulation<3, double, verlet, contact_law<normal_of_doubles, half_a_friction>, walls, half_a_model>;
#endif

int main() { return scene::bytes_per_particle > 0 ? 0 : 1; }
