// SPDX-License-Identifier: MIT
/// @file
/// The shortest basis of a lattice of periods, and with it the shortest image of any displacement.
#pragma once

#include <tsubu/core/vec.hpp>

#include <algorithm>  // std::clamp, std::max
#include <array>      // std::array
#include <cmath>      // std::abs, std::fma, std::frexp, std::ldexp, std::nearbyint, std::sqrt
#include <concepts>   // std::floating_point
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits
#include <utility>    // std::swap

namespace tsubu::detail {

// Rounding to the nearest multiple of each edge does not find the shortest image in a skewed cell: with b = (61.3, 1)
// and a = (1, 0) it may lie dozens of edges away. In a basis that is reduced (each vector
// is no longer after any multiples of shorter ones are added: Lagrange-Gauss for two, Minkowski for three) it lies at
// most one step of each vector beyond the rounded one. Proof, with u*_i the Gram-Schmidt vectors: for a rounded v each
// (v . u*_i) is at most |u*_i|^2 / 2, and an image of it that is no longer has, since |u*_3|^2 >= |u_3|^2 / 2 and
// |u*_2|^2 >= 3/4 |u_2|^2, fewer than 1.62 steps of u_3, 1.77 of u_2, and then at most 1.5 of u_1.
//
// Everything here is odd in d: round to nearest and fused products are, and ties are broken by the sign of d.

/// @tparam D  2 or 3; of the edges some may not be periods, so the lattice has 0 to D vectors.
template <std::size_t D, std::floating_point Scalar>
class reduced_basis {
public:
    using vector_type = vec<D, Scalar>;

    /// Precondition: the edges are independent, and their squares relative to the largest are normal numbers.
    reduced_basis(const std::array<vector_type, D>& edges, const std::array<bool, D>& is_period) {
        Scalar largest = 0;
        for (std::size_t i = 0; i < D; ++i) {
            if (!is_period[i]) continue;
            basis_[count_++] = edges[i];
            for (const auto component : edges[i]) largest = (std::max)(largest, std::abs(component));
        }
        if (count_ == 0) return;
        int exponent = 0;
        static_cast<void>(std::frexp(largest, &exponent));
        constexpr int most = std::numeric_limits<Scalar>::max_exponent - 8;  // 2^most and 2^-most are normal numbers
        unit_ = std::ldexp(Scalar{1}, std::clamp(exponent, -most, most));
        for (std::size_t i = 0; i < count_; ++i)
            for (auto& component : basis_[i]) component /= unit_;
        while (shorten()) continue;
        shortest_square_ = square(basis_[0]);
        const Scalar half = std::sqrt(shortest_square_) / 2 * (1 - 8 * epsilon);
        near_ = half / std::sqrt(static_cast<Scalar>(D)) * unit_;
    }

    /// The shortest of d + any lattice vector; of equally long ones that for which s v is lexicographically greatest, s
    /// the sign of the first component of d that is not 0.
    [[nodiscard]] vector_type shortest(const vector_type& d) const noexcept {
        bool near = true;  // in the cube inside the sphere of half the shortest period
        for (const auto component : d) near &= (component <= near_) & (component >= -near_);
        return near ? d : shortest_image(d);
    }

private:
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    static Scalar dot(const vector_type& a, const vector_type& b) noexcept {
        Scalar sum = 0;
        for (std::size_t k = 0; k < D; ++k) sum += a[k] * b[k];
        return sum;
    }
    static Scalar square(const vector_type& a) noexcept { return dot(a, a); }

    // Out of line: where a caller's code surrounds it, products might be fused for d and not for -d.
    [[nodiscard, gnu::noinline]] vector_type shortest_image(const vector_type& d) const noexcept {
        vector_type v{};
        for (std::size_t k = 0; k < D; ++k) v[k] = d[k] / unit_;
        v = nearest(v, count_);
        for (auto& component : v) component *= unit_;
        return v;
    }
    /// v less the nearest vector of the lattice of the first `count` vectors.
    [[nodiscard]] vector_type nearest(const vector_type& d, std::size_t count) const noexcept {
        auto best = d;
        // A pass leaves the rounding of its products, 2^-digits of what it took off: this many bring down any number.
        constexpr int passes = 2 * std::numeric_limits<Scalar>::max_exponent / std::numeric_limits<Scalar>::digits + 2;
        bool far = true;
        for (int pass = 0; far && pass < passes; ++pass) {
            far = false;
            for (std::size_t i = count; i-- > 0;) {
                const Scalar steps = std::nearbyint(dot(best, direction_[i]));
                far |= std::abs(steps) > 1;
                for (std::size_t k = 0; k < D; ++k) best[k] = std::fma(-steps, basis_[i][k], best[k]);
            }
        }
        Scalar least = square(best);
        if (least < shortest_square_ / 4 * (1 - 16 * epsilon)) return best;  // all others are longer
        Scalar sign = 0;
        for (std::size_t k = D; k-- > 0;)
            if (d[k] != 0) sign = d[k] > 0 ? Scalar{1} : Scalar{-1};
        const auto start = best;
        int combinations = 1;
        for (std::size_t i = 0; i < count; ++i) combinations *= 3;
        for (int number = 0; number < combinations; ++number) {
            auto v = start;
            int digits = number;  // to base 3
            for (std::size_t i = 0; i < count; ++i, digits /= 3)
                for (std::size_t k = 0; k < D; ++k) v[k] += static_cast<Scalar>(digits % 3 - 1) * basis_[i][k];
            const Scalar length = square(v);
            if (length < least || (!(length > least) && is_greater(v, best, sign))) {
                best = v;
                least = length;
            }
        }
        return best;
    }
    static bool is_greater(const vector_type& a, const vector_type& b, Scalar sign) noexcept {
        for (std::size_t k = 0; k < D; ++k)
            if (a[k] != b[k]) return sign * a[k] > sign * b[k];
        return false;
    }

    /// Makes one vector shorter by the shorter ones; false if none is. (The greedy algorithm of Nguyen & Stehle 2009,
    /// doi:10.1145/1597036.1597050: for up to four vectors its result is Minkowski-reduced.)
    bool shorten() noexcept {
        for (std::size_t last = count_; last > 1; --last)  // by length
            for (std::size_t i = 1; i < last; ++i)
                if (square(basis_[i]) < square(basis_[i - 1])) std::swap(basis_[i], basis_[i - 1]);
        for (std::size_t i = 0; i < count_; ++i) {
            if (i > 0) {
                const auto shorter = nearest(basis_[i], i);
                // By less than its rounding is not shorter: else two that are as long would take turns.
                if (square(shorter) < square(basis_[i]) * (1 - 64 * epsilon)) {
                    basis_[i] = shorter;
                    return true;
                }
            }
            auto upright = basis_[i];  // Gram-Schmidt: upon all before it
            for (std::size_t j = 0; j < i; ++j) {
                const Scalar share = dot(upright, direction_[j]);
                const Scalar length = square(direction_[j]);
                for (std::size_t k = 0; k < D; ++k) upright[k] -= share * direction_[j][k] / length;
            }
            const Scalar length = square(upright);
            for (std::size_t k = 0; k < D; ++k) direction_[i][k] = upright[k] / length;
        }
        return false;
    }

    std::size_t count_ = 0;
    Scalar unit_ = 1;  // a power of 2: of the length that the vectors below are measured in
    std::array<vector_type, D> basis_{};
    std::array<vector_type, D> direction_{};  // v . direction_[i]: how many basis_[i] are in v, those after i taken off
    Scalar shortest_square_ = 0;              // of the shortest lattice vector; 0 while there is none
    Scalar near_ = std::numeric_limits<Scalar>::infinity();
};

}  // namespace tsubu::detail
