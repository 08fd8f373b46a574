// SPDX-License-Identifier: MIT
/// @file
/// Boxes and decompositions of every dimension and every scalar, each with all of its members.
#include <tsubu/testing/archetypes.hpp>
#include <tsubu/tsubu.hpp>

#include <cstdint>

#define TSUBU_TEST_DIMENSIONS(Scalar)                         \
    template class tsubu::axis<Scalar>;                       \
    template class tsubu::cuts<Scalar>;                       \
    template class tsubu::domain<1, Scalar>;                  \
    template class tsubu::domain<2, Scalar>;                  \
    template class tsubu::domain<3, Scalar>;                  \
    template class tsubu::subdomain<1, Scalar>;               \
    template class tsubu::subdomain<3, Scalar>;               \
    template class tsubu::brick_decomposition<1, Scalar>;     \
    template class tsubu::brick_decomposition<2, Scalar>;     \
    template class tsubu::brick_decomposition<3, Scalar>;     \
    template class tsubu::bisection_decomposition<1, Scalar>; \
    template class tsubu::bisection_decomposition<2, Scalar>; \
    template class tsubu::bisection_decomposition<3, Scalar>

TSUBU_TEST_DIMENSIONS(double);
TSUBU_TEST_DIMENSIONS(float);
TSUBU_TEST_DIMENSIONS(tsubu::lattice<std::int32_t>);
TSUBU_TEST_DIMENSIONS(tsubu::lattice<std::int64_t>);
template class tsubu::subdomain<2, tsubu::lattice<long long>>;  // no kernel
template class tsubu::subdomain<2, tsubu::lattice<std::int8_t>>;
template class tsubu::brick_decomposition<3, double, tsubu::padded>;
template class tsubu::brick_decomposition<2, float, tsubu::padded>;
template class tsubu::brick_decomposition<2, double, tsubu::testing::minimal_border>;

template class tsubu::triclinic_box<2, double>;
template class tsubu::triclinic_box<3, float>;
template class tsubu::wedge<double>;
template class tsubu::wedge<float>;

#define TSUBU_TEST_CELLS(D, Scalar, ...)                                                              \
    template class tsubu::cell_subdomain<__VA_ARGS__>;                                                \
    template class tsubu::cell_decomposition<__VA_ARGS__, tsubu::brick_decomposition<D, Scalar>>;     \
    template class tsubu::cell_decomposition<__VA_ARGS__, tsubu::bisection_decomposition<D, Scalar>>; \
    static_assert(                                                                                    \
        tsubu::decomposition<tsubu::cell_decomposition<__VA_ARGS__, tsubu::brick_decomposition<D, Scalar>>>); \
    static_assert(                                                                                    \
        tsubu::decomposition<tsubu::cell_decomposition<__VA_ARGS__, tsubu::bisection_decomposition<D, Scalar>>>)

TSUBU_TEST_CELLS(2, double, tsubu::triclinic_box<2, double>);
TSUBU_TEST_CELLS(3, float, tsubu::triclinic_box<3, float>);
TSUBU_TEST_CELLS(3, double, tsubu::wedge<double>);
TSUBU_TEST_CELLS(3, float, tsubu::wedge<float>);
