// SPDX-License-Identifier: MIT
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>

#include <cstddef>

/// One function short of a border policy.
struct half_a_border {
    template <class Scalar>
    tsubu::interval<Scalar> owned(const tsubu::cuts<Scalar>& where, std::size_t part) const noexcept {
        return where.owned(part);
    }
#if CASE != 2
    template <class Scalar>
    tsubu::interval<Scalar> owned_extended(const tsubu::cuts<Scalar>& where, std::size_t part) const noexcept {
        return where.owned_extended(part);
    }
#endif
};

#if CASE == 1
constexpr std::size_t dimensions = 4;
#else
constexpr std::size_t dimensions = 3;
#endif

int main() {
    const tsubu::domain<dimensions> box({}, {1, 1, 1});
    const tsubu::domain<1, double, half_a_border> other({0}, {1});
#if CASE == 3
    tsubu::cell_decomposition<tsubu::domain<3>, tsubu::brick_decomposition<3>> parts(box, {box, 2});
#else
    const tsubu::brick_decomposition<3> parts({{0, 0, 0}, {1, 1, 1}}, 2);
#endif
    return parts.ranks() == 2 && other.contains({0.5}) && box.contains({}) ? 0 : 1;
}
