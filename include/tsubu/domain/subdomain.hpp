// SPDX-License-Identifier: MIT
/// @file
/// subdomain: the part of a domain that one rank owns.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/shown.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/detail/inside.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/interval.hpp>

#include <algorithm>  // std::min
#include <array>      // std::array
#include <cmath>      // std::abs
#include <cstddef>    // std::size_t
#include <span>       // std::span
#include <string>     // std::to_string

namespace tsubu {

/// Positions as one span per axis [D], all of the same length.
template <std::size_t D, class Scalar>
using position_columns = std::array<std::span<const Scalar>, D>;

/// Whose is x: mine?
///
///     const auto mine = bricks.subdomain(rank);
///     if (mine.owns(x)) ...
///     const auto count = mine.leavers(positions, left);   // left[0 .. count) have to go
///
/// A value: it does not refer to the decomposition that made it. Its faces are those of its intervals of ownership, in
/// real units.
template <std::size_t D, class Scalar = double>
class subdomain {
public:
    using position_type = vec<D, Scalar>;
    using real_type = typename axis<Scalar>::real_type;
    using real_position_type = vec<D, real_type>;
    using columns = position_columns<D, Scalar>;

    /// Made by a decomposition.
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
    void owns(const columns& x, std::span<unsigned char> mask) const {
        detail::inside(owned_, points_of("owns", x, mask.size()), mask.size(), mask.data());
    }
    void owns(std::span<const position_type> x, std::span<unsigned char> mask) const {
        detail::inside(owned_, points_of("owns", x, mask.size()), mask.size(), mask.data());
    }
    void owns_extended(const columns& x, std::span<unsigned char> mask) const {
        detail::inside(extended_, points_of("owns_extended", x, mask.size()), mask.size(), mask.data());
    }
    void owns_extended(std::span<const position_type> x, std::span<unsigned char> mask) const {
        detail::inside(extended_, points_of("owns_extended", x, mask.size()), mask.size(), mask.data());
    }
    /// Writes the indices of the points that are not owned to the front of `left`, in increasing order. @return how many.
    /// @throws input_error if left is shorter than the points are many, or the columns differ in length.
    std::size_t leavers(const columns& x, std::span<index_t> left) const {
        return detail::outside(owned_, points_of("leavers", x, x[0].size(), left.size()), x[0].size(), left.data());
    }
    std::size_t leavers(std::span<const position_type> x, std::span<index_t> left) const {
        return detail::outside(owned_, points_of("leavers", x, x.size(), left.size()), x.size(), left.data());
    }

    /// At least d[k] away from both faces of each axis k, inside (B6 as decided). @throws input_error if a d is negative or
    /// NaN.
    [[nodiscard]] bool clear_of_borders(const real_position_type& x, const real_position_type& d) const {
        bool clear = true;
        for (std::size_t k = 0; k < D; ++k) {
            if (!(d[k] >= 0))
                detail::raise<input_error>("subdomain::clear_of_borders",
                                           "the distance " + detail::shown(d[k]) + " on axis " + std::to_string(k),
                                           "give a length of at least 0");
            clear = clear && x[k] >= lo_[k] + d[k] && x[k] <= hi_[k] - d[k];
        }
        return clear;
    }
    [[nodiscard]] bool clear_of_borders(const real_position_type& x, real_type d) const {
        real_position_type each{};
        each.fill(d);
        return clear_of_borders(x, each);
    }
    /// The distance to the plane of the nearest face, from either side (B6 as printed: the smallest of its deltas) [m].
    [[nodiscard]] real_type face_distance(const real_position_type& x) const noexcept {
        auto least = std::abs(x[0] - lo_[0]);
        for (std::size_t k = 0; k < D; ++k)
            least = (std::min)({least, std::abs(x[k] - lo_[k]), std::abs(x[k] - hi_[k])});
        return least;
    }
    /// B7, B8; of equal edges that of the lowest axis.
    [[nodiscard]] shortest_extent<real_type> min_extent() const noexcept {
        shortest_extent<real_type> shortest{hi_[0] - lo_[0], 0};
        for (std::size_t k = 1; k < D; ++k)
            if (hi_[k] - lo_[k] < shortest.width) shortest = {hi_[k] - lo_[k], k};
        return shortest;
    }

private:
    static bool in(const std::array<interval<Scalar>, D>& box, const position_type& x) noexcept {
        bool inside = true;
        for (std::size_t k = 0; k < D; ++k) inside &= box[k].contains(x[k]);
        return inside;
    }
    static void check(const char* member, std::size_t length, std::size_t expected) {
        if (length == expected) return;
        const auto where = std::string("subdomain::") + member;
        detail::raise<input_error>(where.c_str(),
                                   std::to_string(length) + " coordinates for " + std::to_string(expected) + " points",
                                   "give spans of equal length");
    }
    static auto points_of(const char* member, const columns& x, std::size_t count) {
        detail::column_points<D, Scalar> points{};
        for (std::size_t k = 0; k < D; ++k) {
            check(member, x[k].size(), count);
            points.column[k] = x[k].data();
        }
        return points;
    }
    static auto points_of(const char* member, std::span<const position_type> x, std::size_t count) {
        check(member, x.size(), count);
        return detail::row_points<D, Scalar>{x.data()};
    }
    template <class Points>
    static auto points_of(const char* member, const Points& x, std::size_t count, std::size_t room) {
        if (room < count) check(member, room, count);
        return points_of(member, x, count);
    }

    std::array<interval<Scalar>, D> owned_;
    std::array<interval<Scalar>, D> extended_;
    real_position_type lo_;
    real_position_type hi_;
};

}  // namespace tsubu
