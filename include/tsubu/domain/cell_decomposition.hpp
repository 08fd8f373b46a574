// SPDX-License-Identifier: MIT
/// @file
/// cell_decomposition: a box that is not rectangular, divided among ranks.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/domain/concepts.hpp>

#include <cstddef>  // std::size_t
#include <string>   // std::to_string
#include <utility>  // std::move

namespace tsubu {

/// Whose is x, in a triclinic_box or a wedge: the decomposition of its cell, asked with cell coordinates.
///
///     tsubu::cell_decomposition parts(box, tsubu::brick_decomposition<3>(box.cell(), ranks));
///     const auto rank = parts.owner(box.wrap(x).position);
///
/// Cost: one Box::to_cell more than the decomposition's own.
template <class Box, decomposition Decomposition>
class cell_decomposition {
public:
    using box_type = Box;
    using inner_type = Decomposition;
    using position_type = typename Box::position_type;
    static constexpr std::size_t dimension = Box::dimension;

    /// @throws input_error if the decomposition is of another domain than box.cell().
    cell_decomposition(const Box& box, Decomposition inner) : box_(box), inner_(std::move(inner)) {
        for (std::size_t k = 0; k < dimension; ++k) {
            const auto& cell = box_.cell().along(k);
            const auto& divided = inner_.whole().along(k);
            if (cell.lo() != divided.lo() || cell.hi() != divided.hi() || cell.is_periodic() != divided.is_periodic())
                detail::raise<input_error>("cell_decomposition",
                                           "the decomposition is of another axis " + std::to_string(k) +
                                               " than that of the cell",
                                           "make it with box.cell()");
        }
    }

    [[nodiscard]] const Box& box() const noexcept { return box_; }
    [[nodiscard]] const Decomposition& inner() const noexcept { return inner_; }
    [[nodiscard]] std::size_t ranks() const noexcept { return inner_.ranks(); }
    /// The rank of any finite point: beyond the faces of the cell, periodic or not, that of the nearest part (B4).
    [[nodiscard]] std::size_t owner(const position_type& x) const noexcept { return inner_.owner(box_.to_cell(x)); }
    /// B3: over all ranks, exactly one owns a point that the box contains, and none any other.
    /// @throws input_error if there is no such rank.
    [[nodiscard]] bool owns(std::size_t rank, const position_type& x) const {
        return inner_.subdomain(rank).owns(box_.to_cell(x));
    }

private:
    Box box_;
    Decomposition inner_;
};

}  // namespace tsubu
