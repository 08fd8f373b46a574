// SPDX-License-Identifier: MIT
/// @file
/// particle_layout: how the fields of particles lie in memory; and the table of the models.
///
/// | layout        | memory                          | choose it when                                               |
/// |---------------|---------------------------------|--------------------------------------------------------------|
/// | soa (default) | one array per field             | always, unless a measurement says otherwise                  |
/// | aos           | one record per particle         | particles are mostly moved as a whole: sorted, permuted      |
/// | aosoa<N>      | N of each field, block by block | kernels of one's own take vectors of N of several fields     |
#pragma once

#include <tsubu/core/types.hpp>
#include <tsubu/store/field.hpp>

#include <concepts>  // std::same_as
#include <cstddef>   // std::size_t

namespace tsubu {

/// The memory of a layout for fixed types: Layout::memory<Values...>.
///  1. at<K>(i) is where value K of row i lies, for i < capacity(): aligned, and apart from all others;
///  2. place<K>() finds the same: place<K>().at(i), and place<K>().from(f).at(i - f);
///  3. copy_row and swap_rows copy or swap each value of a row, and change no other row;
///  4. gather(order, n) makes row i what row order[i] was, for i < n; of other rows nothing is said. Strong guarantee;
///  5. reallocate(n, kept) makes capacity() at least n and keeps rows 0 .. kept - 1, where kept <= n. Strong guarantee;
///  6. memory_bytes() is at most capacity() times the sum of the sizes of the values, rounded up to their strictest
///     alignment, 1 % and 128 bytes per value type more;
///  7. a copy is independent of its source.
template <class Layout>
concept particle_layout = requires(typename Layout::template memory<int, double>& rows,
                                   const typename Layout::template memory<int, double>& read, std::size_t n,
                                   const index_t* order) {
    { rows.template at<1>(n) } noexcept -> std::same_as<double&>;
    { read.template at<1>(n) } noexcept -> std::same_as<const double&>;
    { rows.template place<0>().at(n) } noexcept -> std::same_as<int&>;
    { read.template place<0>().at(n) } noexcept -> std::same_as<const int&>;
    { read.capacity() } noexcept -> std::same_as<std::size_t>;
    { read.memory_bytes() } noexcept -> std::same_as<std::size_t>;
    { rows.template place<1>().from(n).at(n) } noexcept -> std::same_as<double&>;
    { read.template place<1>().from(n).at(n) } noexcept -> std::same_as<const double&>;
    rows.reallocate(n, n);             // a new capacity, and how many rows to keep
    { rows.copy_row(n, n) } noexcept;  // from, to
    { rows.swap_rows(n, n) } noexcept;
    rows.gather(order, n);             // row i becomes row order[i], for i < n
};

}  // namespace tsubu
