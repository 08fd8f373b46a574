// SPDX-License-Identifier: MIT
/// @file
/// Sums and products of vectors in 1, 2 and 3 dimensions, of numbers or of lanes.
#pragma once

#include <tsubu/core/vec.hpp>

#include <cstddef>      // std::size_t
#include <type_traits>  // std::integral_constant
#include <utility>      // std::index_sequence, std::make_index_sequence

namespace tsubu::dem {

/// Numbers of a spin or a torque: in two dimensions one, about z; in one dimension none.
template <std::size_t D>
inline constexpr std::size_t spin_count = D == 3 ? 3 : D == 2 ? 1 : 0;

/// The vector whose component k is make(k), k a constant.
template <std::size_t D, class Real, class Make>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> vector_of(Make&& make) {
    return [&]<std::size_t... K>(std::index_sequence<K...>) __attribute__((always_inline)) {
        return vec<D, Real>{make(std::integral_constant<std::size_t, K>{})...};
    }
    (std::make_index_sequence<D>{});
}
/// The scalar product.
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline Real dot(const vec<D, Real>& a, const vec<D, Real>& b) noexcept {
    Real sum = a[0] * b[0];
    if constexpr (D > 1) sum = sum + a[1] * b[1];
    if constexpr (D > 2) sum = sum + a[2] * b[2];
    return sum;
}
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> scaled(const vec<D, Real>& a, const Real& by) noexcept {
    return vector_of<D, Real>([&](auto k) __attribute__((always_inline)) { return a[k] * by; });
}
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> plus(const vec<D, Real>& a, const vec<D, Real>& b) noexcept {
    return vector_of<D, Real>([&](auto k) __attribute__((always_inline)) { return a[k] + b[k]; });
}
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> minus(const vec<D, Real>& a, const vec<D, Real>& b) noexcept {
    return vector_of<D, Real>([&](auto k) __attribute__((always_inline)) { return a[k] - b[k]; });
}
/// The part of a that is at right angles to a unit vector.
template <std::size_t D, class Real>
[[nodiscard, gnu::always_inline]] inline vec<D, Real> tangential(const vec<D, Real>& a,
                                                                 const vec<D, Real>& unit) noexcept {
    return minus<D, Real>(a, scaled<D, Real>(unit, dot<D, Real>(a, unit)));
}
/// The velocity that a spin gives at the end of an arm: spin x arm. In two dimensions the spin is about z.
template <class Real>
[[nodiscard, gnu::always_inline]] inline vec<3, Real> spin_across(const vec<3, Real>& spin,
                                                                  const vec<3, Real>& arm) noexcept {
    return {spin[1] * arm[2] - spin[2] * arm[1], spin[2] * arm[0] - spin[0] * arm[2],
            spin[0] * arm[1] - spin[1] * arm[0]};
}
template <class Real>
[[nodiscard, gnu::always_inline]] inline vec<2, Real> spin_across(const vec<1, Real>& spin,
                                                                  const vec<2, Real>& arm) noexcept {
    return {-(spin[0] * arm[1]), spin[0] * arm[0]};
}
/// The torque of a force at the end of an arm: arm x force.
template <class Real>
[[nodiscard, gnu::always_inline]] inline vec<3, Real> torque_of(const vec<3, Real>& arm,
                                                                const vec<3, Real>& force) noexcept {
    return {arm[1] * force[2] - arm[2] * force[1], arm[2] * force[0] - arm[0] * force[2],
            arm[0] * force[1] - arm[1] * force[0]};
}
template <class Real>
[[nodiscard, gnu::always_inline]] inline vec<1, Real> torque_of(const vec<2, Real>& arm,
                                                                const vec<2, Real>& force) noexcept {
    return {arm[0] * force[1] - arm[1] * force[0]};
}

}  // namespace tsubu::dem
