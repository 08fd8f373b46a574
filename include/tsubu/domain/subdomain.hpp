// SPDX-License-Identifier: MIT
/// @file
/// subdomain: the part of a domain that one rank owns.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/detail/each_point.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/interval.hpp>
#include <tsubu/domain/points.hpp>

#include <array>    // std::array
#include <cmath>    // std::abs
#include <cstddef>  // std::size_t
#include <limits>   // std::numeric_limits
#include <span>     // std::span
#include <string>   // std::to_string

namespace tsubu {

/// Whose is x: mine?
///
///     const auto mine = bricks.subdomain(rank);
///     if (mine.owns(x)) ...
///     const auto count = mine.leavers(positions, left);   // left[0 .. count) have to go
///
/// A value: it does not refer to the decomposition that made it. Its faces are those of its part of the
/// box [m]; a border policy may own a little more or less. Every predicate takes one point, or many (see points), by
/// the same arithmetic.
template <std::size_t D, class Scalar = double>
class subdomain {
public:
    using position_type = vec<D, Scalar>;
    using real_type = typename axis<Scalar>::real_type;
    using real_position_type = vec<D, real_type>;
    using points_type = points<D, const Scalar>;
    using real_points_type = points<D, const real_type>;

    /// Made by a decomposition: the intervals owned [D], those owned_extended [D], and the faces in real units [D].
    subdomain(const std::array<interval<Scalar>, D>& owned, const std::array<interval<Scalar>, D>& owned_extended,
              const real_position_type& lo, const real_position_type& hi) noexcept
        : owned_(owned), extended_(owned_extended), lo_(lo), hi_(hi) {}

    [[nodiscard]] const real_position_type& lo() const noexcept { return lo_; }
    [[nodiscard]] const real_position_type& hi() const noexcept { return hi_; }

    /// B3: over all ranks, exactly one owns a point of the domain, and none any other.
    [[nodiscard]] bool owns(const position_type& x) const noexcept { return in(owned_, x); }
    /// B4, B5: over all ranks, exactly one owns any finite point.
    [[nodiscard]] bool owns_extended(const position_type& x) const noexcept { return in(extended_, x); }

    /// mask[i] = 1 if point i is owned, else 0. @throws input_error if the lengths differ.
    void owns(const points_type& x, std::span<unsigned char> mask) const {
        detail::check_answers("subdomain::owns", mask.size(), x.size());
        detail::inside(owned_, x, 0, x.size(), mask.data());
    }
    void owns_extended(const points_type& x, std::span<unsigned char> mask) const {
        detail::check_answers("subdomain::owns_extended", mask.size(), x.size());
        detail::inside(extended_, x, 0, x.size(), mask.data());
    }
    /// Writes the indices of the points that are not owned to the front of `left`, in increasing order.
    /// @return how many; what is behind them in left has no meaning.
    /// @throws input_error if left is not as long as the points are many.
    std::size_t leavers(const points_type& x, std::span<index_t> left) const {
        detail::check_answers("subdomain::leavers", left.size(), x.size());
        return detail::list_outside(owned_, x, left.data());
    }

    /// At least d[k] away from both faces of each axis k, inside (B6 as decided). @throws input_error if a d is
    /// negative or NaN.
    [[nodiscard]] bool clear_of_borders(const real_position_type& x, const real_position_type& d) const {
        return in(clear(d), x);
    }
    [[nodiscard]] bool clear_of_borders(const real_position_type& x, real_type d) const {
        return in(clear(filled(d)), x);
    }
    /// mask[i] = 1 if point i is clear. @throws input_error as above, and if the lengths differ.
    void clear_of_borders(const real_points_type& x, real_type d, std::span<unsigned char> mask) const {
        detail::check_answers("subdomain::clear_of_borders", mask.size(), x.size());
        detail::inside(clear(filled(d)), x, 0, x.size(), mask.data());
    }
    /// The distance to the plane of the nearest face, from either side (B6 as printed: the smallest of its deltas) [m].
    [[nodiscard]] real_type face_distance(const real_position_type& x) const noexcept {
        return distance([&](std::size_t k) { return x[k]; });
    }
    /// The same for each of many points. @throws input_error if the lengths differ.
    void face_distance(const real_points_type& x, std::span<real_type> distances) const {
        detail::check_answers("subdomain::face_distance", distances.size(), x.size());
        x.visit([&](auto at) {
            detail::each_point(x.size(), distances.data(), [at, *this](std::size_t i) {
                return distance([&](std::size_t k) { return at(i, k); });
            });
        });
    }
    /// The shortest edge [m] and its axis (B7, B8); of equal edges the lowest axis.
    [[nodiscard]] shortest_extent<real_type> min_extent() const noexcept {
        shortest_extent<real_type> shortest{hi_[0] - lo_[0], 0};
        for (std::size_t k = 1; k < D; ++k)
            if (hi_[k] - lo_[k] < shortest.width) shortest = {hi_[k] - lo_[k], k};
        return shortest;
    }

private:
    template <class Coordinate>
    static bool in(const std::array<interval<Coordinate>, D>& box, const vec<D, Coordinate>& x) noexcept {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k) inside &= box[k].contains(x[k]);
        return inside;
    }
    static real_position_type filled(real_type d) noexcept {
        real_position_type each{};
        each.fill(d);
        return each;
    }
    [[nodiscard]] std::array<interval<real_type>, D> clear(const real_position_type& d) const {
        std::array<interval<real_type>, D> box{};
        for (std::size_t k = 0; k < D; ++k) {
            if (!(d[k] >= 0))
                detail::raise<input_error>("subdomain::clear_of_borders",
                                           "the distance " + detail::shown(d[k]) + " on axis " + std::to_string(k),
                                           "give a length of at least 0");
            box[k] = {lo_[k] + d[k], hi_[k] - d[k]};
        }
        return box;
    }
    template <class Coordinate>
    [[nodiscard, gnu::always_inline]] real_type distance(Coordinate x) const noexcept {
        auto least = std::numeric_limits<real_type>::infinity();
        for (std::size_t k = 0; k < D; ++k) {
            const real_type below = std::abs(x(k) - lo_[k]);
            const real_type above = std::abs(x(k) - hi_[k]);
            least = below < least ? below : least;
            least = above < least ? above : least;
        }
        return least;
    }

    std::array<interval<Scalar>, D> owned_;
    std::array<interval<Scalar>, D> extended_;
    real_position_type lo_;
    real_position_type hi_;
};

}  // namespace tsubu
