// SPDX-License-Identifier: MIT
/// @file
/// cell_decomposition: a box that is not a domain, divided among ranks.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/types.hpp>
#include <tsubu/core/vec.hpp>
#include <tsubu/domain/concepts.hpp>
#include <tsubu/domain/detail/checks.hpp>
#include <tsubu/domain/detail/each_point.hpp>
#include <tsubu/domain/detail/owners_of.hpp>
#include <tsubu/domain/detail/reach.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/domain/subdomain.hpp>

#include <algorithm>  // std::sort, std::unique
#include <cstddef>    // std::size_t
#include <limits>     // std::numeric_limits
#include <span>       // std::span
#include <string>     // std::to_string
#include <utility>    // std::move
#include <vector>     // std::vector

namespace tsubu {
namespace detail {

/// Where x is in the cell: a finite point has finite coordinates there, at the ends of the scalar if it is beyond them.
template <class Box>
[[nodiscard]] auto cell_point(const Box& where, const typename Box::position_type& x) noexcept {
    using Scalar = typename Box::scalar_type;
    auto at = where.to_cell(x);
    for (auto& coordinate : at) {
        if (is_finite(coordinate)) continue;
        for (const auto component : x)
            if (!is_finite(component)) return at;
        coordinate = coordinate > 0   ? (std::numeric_limits<Scalar>::max)()
                     : coordinate < 0 ? std::numeric_limits<Scalar>::lowest()
                                      : Scalar{0};
    }
    return at;
}

}  // namespace detail

/// Whose is x: mine? Of a subdomain of the cell.
template <class Box>
class cell_subdomain {
    static constexpr std::size_t D = Box::dimension;

public:
    using scalar_type = typename Box::scalar_type;
    using position_type = typename Box::position_type;
    using points_type = points<D, const scalar_type>;

    /// Made by a cell_decomposition.
    cell_subdomain(const Box& where, const subdomain<D, scalar_type>& part) : box_(where), part_(part) {}

    /// The faces in coordinates of the cell.
    [[nodiscard]] const position_type& lo() const noexcept { return part_.lo(); }
    [[nodiscard]] const position_type& hi() const noexcept { return part_.hi(); }
    /// As those of subdomain.
    [[nodiscard]] bool owns(const position_type& x) const noexcept { return part_.owns(detail::cell_point(box_, x)); }
    [[nodiscard]] bool owns_extended(const position_type& x) const noexcept {
        return part_.owns_extended(detail::cell_point(box_, x));
    }
    void owns(const points_type& x, std::span<unsigned char> mask) const {
        detail::check_answers("cell_subdomain::owns", mask.size(), x.size());
        for (std::size_t i = 0; i < x.size(); ++i) mask[i] = owns(x[i]);
    }
    void owns_extended(const points_type& x, std::span<unsigned char> mask) const {
        detail::check_answers("cell_subdomain::owns_extended", mask.size(), x.size());
        for (std::size_t i = 0; i < x.size(); ++i) mask[i] = owns_extended(x[i]);
    }
    std::size_t leavers(const points_type& x, std::span<index_t> left) const {
        detail::check_answers("cell_subdomain::leavers", left.size(), x.size());
        std::size_t found = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            if (!owns(x[i])) left[found++] = static_cast<index_t>(i);
        return found;
    }

private:
    Box box_;
    subdomain<D, scalar_type> part_;
};

/// A decomposition of the cell of a triclinic_box or a wedge, asked with positions.
///
///     tsubu::cell_decomposition parts(box, tsubu::brick_decomposition<3>(box.cell(), ranks));
///     const auto rank = parts.owner(box.wrap(x).position);
///
/// Concept:      decomposition.
/// Cost:         one to_cell more than the decomposition of the cell for each point.
/// Deterministic: as the box and the decomposition of its cell are.
/// Choose it when the box is not a domain. Do not when it is: the decompositions of its cell take that.
///
/// @tparam Box    triclinic_box, wedge, or another reaching_box.
/// @tparam Parts  brick_decomposition or bisection_decomposition of box.cell().
template <reaching_box Box, decomposition Parts>
class cell_decomposition {
public:
    using box_type = Box;
    using scalar_type = typename Box::scalar_type;
    using real_type = typename Box::real_type;
    using position_type = typename Box::position_type;
    static constexpr std::size_t dimension = Box::dimension;

    /// @throws input_error if the parts are of another domain than where.cell().
    cell_decomposition(const Box& where, Parts parts) : box_(where), parts_(std::move(parts)) {
        for (std::size_t k = 0; k < dimension; ++k) {
            const auto& cell = box_.cell().along(k);
            const auto& divided = parts_.whole().along(k);
            if (cell.lo() != divided.lo() || cell.hi() != divided.hi() || cell.is_periodic() != divided.is_periodic())
                detail::raise<input_error>("cell_decomposition",
                                           "the decomposition is of another axis " + std::to_string(k) +
                                               " than that of the cell",
                                           "make it with box.cell()");
        }
    }

    [[nodiscard]] const Box& whole() const noexcept { return box_; }
    /// The decomposition of the cell.
    [[nodiscard]] const Parts& parts() const noexcept { return parts_; }
    [[nodiscard]] std::size_t ranks() const noexcept { return parts_.ranks(); }
    /// The rank of any finite point: beyond the faces of the cell, periodic or not, that of the nearest part (B4).
    /// Precondition: no coordinate is NaN.
    [[nodiscard]] rank_t owner(const position_type& x) const noexcept {
        return parts_.owner(detail::cell_point(box_, x));
    }
    /// The same for each of many points. Precondition: no coordinate is NaN. @throws input_error if the lengths differ.
    void owner(const points<dimension, const scalar_type>& x, std::span<rank_t> owners) const {
        detail::owners_of("cell_decomposition::owner", *this, x, owners);
    }
    /// @throws input_error if there is no such rank.
    template <std::integral Rank>
    [[nodiscard]] cell_subdomain<Box> subdomain(Rank which) const {
        const auto rank = detail::checked_rank("cell_decomposition::subdomain", which, ranks());
        return {box_, parts_.subdomain(rank)};
    }
    /// As those of the decomposition of the cell; may name ranks that are a little too far, since a distance in the
    /// cell is only a bound of that in the box.
    /// @throws input_error if the cutoff is negative or not finite, or there is no such rank.
    template <std::integral Rank>
    [[nodiscard]] std::vector<neighbor_rank<dimension>> neighbors(Rank rank, real_type cutoff) const {
        constexpr auto where = "cell_decomposition::neighbors";
        detail::check_cutoff(where, cutoff);
        auto found = detail::neighbors_within(
            where, box_.cell(), parts_, rank,
            [&](const auto& mine, const auto& theirs) { return box_.cell_reach(cutoff, mine, theirs); }, false);
        if constexpr (cyclic_box<Box>) {  // after n sectors a wedge is at its begin again
            for (auto& neighbor : found) neighbor.shift = box_.same_image(neighbor.shift);
            std::sort(found.begin(), found.end());
            found.erase(std::unique(found.begin(), found.end()), found.end());
            std::erase(found, neighbor_rank<dimension>{static_cast<rank_t>(rank), {}});
        }
        return found;
    }

private:
    Box box_;
    Parts parts_;
};

}  // namespace tsubu
