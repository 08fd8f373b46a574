// SPDX-License-Identifier: MIT
/// @file
/// box and decomposition: where the particles of a simulation can be, and how that is divided among ranks; and the
/// tables of their models.
///
/// | box           | cell                    | wrap rounds                    | choose it when                        |
/// |---------------|-------------------------|--------------------------------|---------------------------------------|
/// | domain        | itself                  | in the last bits, at any scale | faces are at right angles             |
/// | triclinic_box | fractions of its edges  | in its farthest corner's bits  | it is sheared, or a crystal's cell    |
/// | wedge         | angle, radius, z        | in its farthest corner's bits  | body and load repeat around an axis   |
///
/// | decomposition           | subdomains             | owner(x)         | choose it when                        |
/// |-------------------------|------------------------|------------------|---------------------------------------|
/// | brick_decomposition     | cuts along each axis   | O(1), equal ones | particles fill the box evenly         |
/// | bisection_decomposition | a tree of cuts         | O(log ranks)     | they are uneven: a heap, a jet        |
/// | cell_decomposition      | either, of a box's cell | and one to_cell | the box is not a domain               |
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/domain/domain.hpp>
#include <tsubu/domain/neighbor_rank.hpp>
#include <tsubu/domain/points.hpp>
#include <tsubu/domain/subdomain.hpp>

#include <concepts>  // std::convertible_to, std::same_as
#include <cstddef>   // std::size_t
#include <span>      // std::span
#include <vector>    // std::vector

namespace tsubu {

/// Where particles can be. A box has a cell, a domain of its own coordinates, in which its faces are at right angles:
/// there it is decided what is inside, and whose it is.
///  1. contains(x) is cell().contains(to_cell(x)), bit for bit;
///  2. the box contains wrap(x).position along every periodic axis of the cell, for any finite x; where no number
///     there is inside, wrap throws. What the box contains already stays as it is, with shift 0;
///  3. image(wrap(x).position, wrap(x).shift) is x, to within rounding, while |shift| < 2^53;
///  4. minimum_image(a, b) is no longer than image(a, shift) - b for any shift, to within rounding;
///     minimum_image(b, a) is its opposite, but for the turn where images are turned.
template <class Box>
concept box = requires(const Box& where, const typename Box::position_type& x,
                       const image_shift<Box::dimension>& shift) {
    { where.cell() } noexcept;
    { where.from_cell(where.to_cell(x)) } noexcept -> std::same_as<typename Box::position_type>;
    { where.contains(x) } noexcept -> std::same_as<bool>;
    { where.wrap(x) } -> std::same_as<wrapped<Box::dimension, typename Box::scalar_type>>;
    { where.image(x, shift) } noexcept -> std::same_as<vec<Box::dimension, typename Box::real_type>>;
    { where.minimum_image(x, x) } noexcept -> std::same_as<vec<Box::dimension, typename Box::real_type>>;
};
static_assert(box<domain<1>> && box<domain<3, float>> && box<domain<2, lattice<int>>>);

/// A box that tells how far a length reaches along each axis of its cell between two subdomains, at least.
template <class Box>
concept reaching_box =
    box<Box> && requires(const Box& where, typename Box::real_type cutoff,
                         const subdomain<Box::dimension, typename Box::scalar_type>& part) {
        { where.cell_reach(cutoff, part, part) } -> std::same_as<typename Box::position_type>;
    };
/// A box that comes round again: an image has several shifts, of which same_image is one.
template <class Box>
concept cyclic_box = box<Box> && requires(const Box& where, const image_shift<Box::dimension>& shift) {
    { where.same_image(shift) } noexcept -> std::same_as<image_shift<Box::dimension>>;
};

/// A subdomain: which points one rank owns. lo() and hi() are in coordinates of the cell.
template <class Part, class Decomposition>
concept subdomain_of =
    requires(const Part& mine, const typename Decomposition::position_type& x,
             points<Decomposition::dimension, const typename Decomposition::scalar_type> many,
             std::span<unsigned char> mask, std::span<index_t> left) {
        { mine.owns(x) } noexcept -> std::same_as<bool>;
        { mine.owns_extended(x) } noexcept -> std::same_as<bool>;
        mine.owns(many, mask);
        mine.owns_extended(many, mask);
        { mine.leavers(many, left) } -> std::same_as<std::size_t>;
        mine.lo();
        mine.hi();
    };

/// How a box is divided among ranks, the same on all of them.
///  1. subdomain(0) .. subdomain(ranks() - 1) own the box without gap or overlap: of all ranks one owns each point of
///     it, and none any other; of owns_extended one each finite point, and none any other; lo() and hi() are its faces;
///  2. owner(x) is the rank whose owns_extended has x, bit for bit; for a point of the box so has its owns;
///  3. neighbors(rank, cutoff) has (other, shift) if some point of other's subdomain, moved by shift, lies within the
///     cutoff of some point of rank's; in a domain only then, rounding aside; never (rank, 0); each once, in increasing
///     order of rank and shift;
///  4. neighbourhood is mutual: (b, s) is a neighbour of a exactly if (a, -s) is one of b; in a wedge of n sectors, s
///     and s + n are the same.
/// A batch answers as the single question does.
template <class Decomposition>
concept decomposition = requires(const Decomposition& parts, const typename Decomposition::position_type& x,
                                 points<Decomposition::dimension, const typename Decomposition::scalar_type> many,
                                 std::span<rank_t> owners, typename Decomposition::real_type cutoff, std::size_t rank) {
    { parts.whole() } noexcept -> std::convertible_to<const typename Decomposition::box_type&>;
    { parts.ranks() } noexcept -> std::same_as<std::size_t>;
    { parts.owner(x) } noexcept -> std::same_as<rank_t>;
    parts.owner(many, owners);
    { parts.subdomain(rank) } -> subdomain_of<Decomposition>;
    { parts.neighbors(rank, cutoff) } -> std::same_as<std::vector<neighbor_rank<Decomposition::dimension>>>;
} && box<typename Decomposition::box_type>;

}  // namespace tsubu
