// SPDX-License-Identifier: MIT
/// @file
/// points: positions of many points, however they are stored.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/vec.hpp>

#include <array>        // std::array
#include <concepts>     // std::convertible_to
#include <cstddef>      // std::size_t
#include <span>         // std::span
#include <string>       // std::to_string
#include <type_traits>  // std::remove_const_t

namespace tsubu {
namespace detail {

/// Coordinate k of point i, Stride numbers after that of point i - 1.
template <std::size_t D, class Scalar, std::size_t Stride>
struct strided_points {
    std::array<Scalar*, D> start;
    [[nodiscard, gnu::always_inline]] Scalar& operator()(std::size_t i, std::size_t k) const noexcept {
        return start[k][i * Stride];
    }
};

}  // namespace detail

/// Many positions, as one column per axis or as an array of vectors; a view that owns nothing, as std::span.
///
///     std::vector<double> x, y, z;
///     mine.owns({{x, y, z}}, mask);      // one column per axis
///     std::vector<tsubu::vec<3>> all;
///     mine.owns(all, mask);              // an array of vectors
///
/// @tparam Scalar  const, if the points are only read.
template <std::size_t D, class Scalar = const double>
class points {
public:
    using row = std::conditional_t<std::is_const_v<Scalar>, const vec<D, std::remove_const_t<Scalar>>, vec<D, Scalar>>;
    using columns = std::array<std::span<Scalar>, D>;

    /// None.
    points() noexcept = default;
    /// @throws input_error if the columns differ in length.
    points(const columns& x) : count_(x[0].size()), are_columns_(true) {
        for (std::size_t k = 0; k < D; ++k) {
            if (x[k].size() != count_)
                detail::raise<input_error>("points",
                                           "column " + std::to_string(k) + " has " + std::to_string(x[k].size()) +
                                               " coordinates, column 0 has " + std::to_string(count_),
                                           "give columns of equal length");
            start_[k] = x[k].data();
        }
    }
    /// Any contiguous range of vec<D, Scalar>.
    template <class Rows>
        requires std::convertible_to<Rows&&, std::span<row>>
    points(Rows&& x) noexcept {  // NOLINT(bugprone-forwarding-reference-overload): points are no range of rows
        const std::span<row> rows(x);
        count_ = rows.size();
        for (std::size_t k = 0; k < D && !rows.empty(); ++k) start_[k] = rows.front().data() + k;
    }
    /// Points that may be written can be read.
    points(const points<D, std::remove_const_t<Scalar>>& x) noexcept requires std::is_const_v<Scalar>
        : count_(x.size()), are_columns_(x.are_columns()) {
        for (std::size_t k = 0; k < D; ++k) start_[k] = x.start(k);
    }

    [[nodiscard]] std::size_t size() const noexcept { return count_; }
    [[nodiscard]] bool are_columns() const noexcept { return are_columns_; }
    /// Where coordinate k of point 0 lies; null if there are no points.
    [[nodiscard]] Scalar* start(std::size_t k) const noexcept { return start_[k]; }
    [[nodiscard]] vec<D, std::remove_const_t<Scalar>> operator[](std::size_t i) const noexcept {
        vec<D, std::remove_const_t<Scalar>> x{};
        for (std::size_t k = 0; k < D; ++k) x[k] = start_[k][i * stride()];
        return x;
    }
    /// Moves point i there.
    void set(std::size_t i, const vec<D, Scalar>& x) const noexcept requires(!std::is_const_v<Scalar>) {
        for (std::size_t k = 0; k < D; ++k) start_[k][i * stride()] = x[k];
    }
    /// body(at), where at(i, k) is coordinate k of point i: which of the two storages it is, is known to the compiler
    /// there, so that loops over i vectorise.
    template <class Body>
    decltype(auto) visit(Body&& body) const {
        if (are_columns_) return body(detail::strided_points<D, Scalar, 1>{start_});
        return body(detail::strided_points<D, Scalar, D>{start_});
    }

private:
    [[nodiscard]] std::size_t stride() const noexcept { return are_columns_ ? 1 : D; }

    std::array<Scalar*, D> start_{};
    std::size_t count_ = 0;
    bool are_columns_ = false;
};

}  // namespace tsubu
