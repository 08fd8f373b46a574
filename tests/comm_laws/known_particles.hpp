// SPDX-License-Identifier: MIT
/// @file
/// Particles of which every rank knows everything: what they carry follows from their ids, and where they are from a
/// seed. Boxes and decompositions to have them in.
#pragma once

#include <tsubu/core/random.hpp>
#include <tsubu/domain/bisection_decomposition.hpp>
#include <tsubu/domain/brick_decomposition.hpp>
#include <tsubu/domain/cell_decomposition.hpp>
#include <tsubu/domain/triclinic_box.hpp>
#include <tsubu/domain/wedge.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/bonus_of.hpp>
#include <tsubu/store/list_of.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace comm_laws {

struct contact {
    std::int64_t other;
    double overlap;
    friend bool operator==(const contact&, const contact&) = default;
};
/// Of 12 bytes, which do not fill their last word.
struct outline {
    std::int32_t edges;
    float length[2];
    friend bool operator==(const outline&, const outline&) = default;
};
inline constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};
inline constexpr tsubu::field<"shape", tsubu::bonus_of<outline>> shape{};
inline constexpr tsubu::field<"tally", double, "", tsubu::field_traits{.reverse = tsubu::ghosts_add::sum}> tally{};
inline constexpr tsubu::field<"lowest", std::int32_t, "", tsubu::field_traits{.reverse = tsubu::ghosts_add::least}>
    lowest{};
inline constexpr tsubu::field<"highest", tsubu::vec<2, float>, "",
                              tsubu::field_traits{.reverse = tsubu::ghosts_add::greatest}>
    highest{};
inline constexpr tsubu::field<"hidden", double, "", tsubu::field_traits{.when = tsubu::travels::never}> hidden{};

template <std::size_t D, class Scalar, class Real>
using known_fields = tsubu::fields<tsubu::id, tsubu::position<D, Scalar>, tsubu::velocity<D, Real>, tsubu::image<D>,
                                   contacts, shape, tsubu::force<D, Real>, tally, lowest, highest, hidden>;
template <class Parts, class Layout = tsubu::soa>
using known_store =
    tsubu::particle_store<known_fields<Parts::dimension, typename Parts::scalar_type, typename Parts::real_type>,
                          Layout>;

/// What a particle carries.
[[nodiscard]] inline std::vector<contact> contacts_of(std::int64_t t) {
    std::vector<contact> list;
    for (std::int64_t k = 0; k < t % 4; ++k) list.push_back({1000 * t + k, 0.5 * static_cast<double>(k)});
    return list;
}
[[nodiscard]] inline bool has_shape(std::int64_t t) { return t % 3 == 1; }
[[nodiscard]] inline outline shape_of(std::int64_t t) {
    return {static_cast<std::int32_t>(t), {static_cast<float>(t) / 2, -1}};
}
template <std::size_t D, class Real>
[[nodiscard]] tsubu::vec<D, Real> velocity_of(std::int64_t t) {
    tsubu::vec<D, Real> v{};
    for (std::size_t k = 0; k < D; ++k) v[k] = static_cast<Real>((t + 1) * static_cast<std::int64_t>(k + 1));
    return v;
}
/// A particle of the store, with all that it carries.
template <class Parts, class Store>
void add_known(Store& store, std::int64_t t, const typename Parts::position_type& at) {
    constexpr auto D = Parts::dimension;
    const auto i = static_cast<std::size_t>(store.push_back(
        tsubu::id = t, tsubu::position<D, typename Parts::scalar_type> = at,
        tsubu::velocity<D, typename Parts::real_type> = velocity_of<D, typename Parts::real_type>(t),
        tally = 1000.0 + static_cast<double>(t), hidden = 3.5 + static_cast<double>(t)));
    store[contacts][i].assign(contacts_of(t));
    if (has_shape(t)) store[shape][i].emplace(shape_of(t));
}
/// Whether its list and its shape have come along.
template <class Store>
[[nodiscard]] bool carries_its_own(const Store& store, std::size_t i, std::int64_t t) {
    const auto list = store[contacts][i].span();
    const auto bonus = store[shape][i];
    return std::vector<contact>(list.begin(), list.end()) == contacts_of(t) && bonus.has_value() == has_shape(t) &&
           (!has_shape(t) || *bonus == shape_of(t));
}

/// A vector that belongs to a particle, in an image.
template <class Box, class Vector>
[[nodiscard]] Vector turned(const Box& where, const Vector& v, const tsubu::image_shift<Box::dimension>& shift) {
    if constexpr (requires { where.rotate(v, shift); })
        return where.rotate(v, shift);
    else
        return v;
}
template <std::size_t D>
[[nodiscard]] tsubu::image_shift<D> back(tsubu::image_shift<D> shift) {
    for (auto& one : shift) one = -one;
    return shift;
}

/// A point of the box.
template <class Box>
[[nodiscard]] typename Box::position_type point_in(const Box& where, tsubu::random_stream& random) {
    using Scalar = typename Box::scalar_type;
    for (;;) {
        typename Box::position_type at{};
        for (std::size_t k = 0; k < Box::dimension; ++k) {
            if constexpr (tsubu::is_lattice<Scalar>) {
                at[k] = {static_cast<decltype(at[k].value)>(random())};
            } else {
                const auto& along = where.cell().along(k);
                at[k] = along.lo() + static_cast<Scalar>(random.unit()) * along.length();
            }
        }
        const auto x = where.wrap(where.from_cell(at)).position;
        if (where.contains(x)) return x;  // rounding may leave a face that is not periodic
    }
}
template <class Box>
[[nodiscard]] std::vector<typename Box::position_type> points_in(const Box& where, std::size_t count,
                                                                 std::uint64_t seed) {
    tsubu::random_stream random(seed);
    std::vector<typename Box::position_type> points(count);
    for (auto& x : points) x = point_in(where, random);
    return points;
}

// --- boxes ----------------------------------------------------------------------------------------------------------

/// Edges of 1, 1.3 and 0.9; bit k of `periodic` is of axis k.
template <std::size_t D, class Scalar = double>
[[nodiscard]] tsubu::domain<D, Scalar> box_of(unsigned periodic) {
    constexpr double edges[] = {1, 1.3, 0.9};
    typename tsubu::domain<D, Scalar>::real_position_type lo{};
    typename tsubu::domain<D, Scalar>::real_position_type hi{};
    typename tsubu::domain<D, Scalar>::options with{};
    for (std::size_t k = 0; k < D; ++k) {
        lo[k] = static_cast<typename tsubu::domain<D, Scalar>::real_type>(0.3 * static_cast<double>(k) - 0.2);
        hi[k] = lo[k] + static_cast<typename tsubu::domain<D, Scalar>::real_type>(edges[k]);
        with.periodic[k] = (periodic >> k & 1U) != 0;
    }
    return {lo, hi, with};
}
template <std::size_t D>
[[nodiscard]] tsubu::triclinic_box<D> tilted_box_of(double tilt, unsigned periodic) {
    std::array<bool, D> along{};
    for (std::size_t k = 0; k < D; ++k) along[k] = (periodic >> k & 1U) != 0;
    if constexpr (D == 2)
        return {{-0.2, 0.1}, {1, 1.3}, {tilt}, along};
    else
        return {{-0.2, 0.1, 0.4}, {1, 1.3, 0.9}, {tilt, -tilt / 2, 0.3 * tilt}, along};
}
[[nodiscard]] inline tsubu::wedge<> wedge_of(std::size_t sectors) {
    return {sectors, {0.2, -0.1}, 1.0, -0.5, 0.4, true};
}

// --- decompositions -------------------------------------------------------------------------------------------------

/// As many bricks along each axis, of which the first are the narrowest.
template <std::size_t D, class Scalar>
[[nodiscard]] tsubu::brick_decomposition<D, Scalar> uneven(const tsubu::brick_decomposition<D, Scalar>& even) {
    const auto table = [&](std::size_t k) {
        const auto& along = even.whole().along(k);
        const auto& real = along.real();
        const auto parts = even.along(k).parts();
        std::vector<Scalar> inner;
        for (std::size_t m = 1; m < parts; ++m) {
            const auto share = std::pow(static_cast<double>(m) / static_cast<double>(parts), 1.7);
            const auto cut = real.lo() + share * real.length();
            inner.push_back(along.from_real(static_cast<std::remove_cvref_t<decltype(real.lo())>>(cut)).position);
        }
        return tsubu::cuts<Scalar>(along, inner);
    };
    std::array<tsubu::cuts<Scalar>, D> tables = [&]<std::size_t... K>(std::index_sequence<K...>) {
        return std::array<tsubu::cuts<Scalar>, D>{table(K)...};
    }(std::make_index_sequence<D>{});
    return {even.whole(), tables};
}

/// The decomposition of a box that has this one of its cell.
template <class Box, class Parts>
[[nodiscard]] auto in_box(const Box& where, const Parts& parts) {
    if constexpr (std::is_same_v<Box, typename Parts::box_type>)
        return parts;
    else
        return tsubu::cell_decomposition(where, parts);
}
template <class Box>
[[nodiscard]] auto bricks_of(const Box& where, std::size_t ranks) {
    return in_box(where, tsubu::brick_decomposition<Box::dimension, typename Box::scalar_type>(where.cell(), ranks));
}
template <class Box>
[[nodiscard]] auto uneven_bricks_of(const Box& where, std::size_t ranks) {
    return in_box(where,
                  uneven(tsubu::brick_decomposition<Box::dimension, typename Box::scalar_type>(where.cell(), ranks)));
}
/// Of points of which most are near the lower faces.
template <class Box>
[[nodiscard]] auto bisection_of(const Box& where, std::size_t ranks) {
    constexpr auto D = Box::dimension;
    using Scalar = typename Box::scalar_type;
    const auto& cell = where.cell();
    auto sample = points_in(cell, 200, 9);
    if constexpr (!tsubu::is_lattice<Scalar>)
        for (auto& x : sample)
            for (std::size_t k = 0; k < D; ++k) {
                const auto u = (x[k] - cell.along(k).lo()) / cell.along(k).length();
                x[k] = cell.along(k).lo() + u * u * cell.along(k).length();
            }
    return in_box(where, tsubu::bisection_decomposition<D, Scalar>(cell, ranks, sample));
}

/// Bricks or a bisection, as is found when the program runs: what takes parts is compiled once for a box, not once for
/// each kind. It has what the concept asks for, and no more.
template <class Box>
class any_parts {
    using bricks_type = decltype(bricks_of(std::declval<const Box&>(), 1));
    using bisection_type = decltype(bisection_of(std::declval<const Box&>(), 1));

public:
    using box_type = Box;
    using scalar_type = typename Box::scalar_type;
    using real_type = typename Box::real_type;
    using position_type = typename Box::position_type;
    static constexpr std::size_t dimension = Box::dimension;

    explicit any_parts(const bricks_type& bricks) : bricks_(bricks) {}
    explicit any_parts(const bisection_type& bisection) : bisection_(bisection) {}

    [[nodiscard]] const Box& whole() const noexcept { return bricks_ ? bricks_->whole() : bisection_->whole(); }
    [[nodiscard]] std::size_t ranks() const noexcept { return bricks_ ? bricks_->ranks() : bisection_->ranks(); }
    [[nodiscard]] tsubu::rank_t owner(const position_type& x) const noexcept {
        return bricks_ ? bricks_->owner(x) : bisection_->owner(x);
    }
    void owner(const tsubu::points<dimension, const scalar_type>& x, std::span<tsubu::rank_t> owners) const {
        bricks_ ? bricks_->owner(x, owners) : bisection_->owner(x, owners);
    }
    [[nodiscard]] auto subdomain(std::size_t rank) const {
        return bricks_ ? bricks_->subdomain(rank) : bisection_->subdomain(rank);
    }
    [[nodiscard]] std::vector<tsubu::neighbor_rank<dimension>> neighbors(std::size_t rank, real_type cutoff) const {
        return bricks_ ? bricks_->neighbors(rank, cutoff) : bisection_->neighbors(rank, cutoff);
    }

private:
    std::optional<bricks_type> bricks_;
    std::optional<bisection_type> bisection_;
};
static_assert(tsubu::decomposition<any_parts<tsubu::domain<2>>> && tsubu::decomposition<any_parts<tsubu::wedge<>>>);

/// body(parts) for bricks, uneven bricks, and a bisection.
template <class Box, class Body>
void each_decomposition(const Box& where, std::size_t ranks, Body&& body) {
    body(any_parts<Box>(bricks_of(where, ranks)));
    body(any_parts<Box>(uneven_bricks_of(where, ranks)));
    body(any_parts<Box>(bisection_of(where, ranks)));
}
/// body(parts) for bricks and uneven ones, by their own type.
template <class Box, class Body>
void each_kind_of_bricks(const Box& where, std::size_t ranks, Body&& body) {
    body(bricks_of(where, ranks));
    body(uneven_bricks_of(where, ranks));
}

}  // namespace comm_laws
