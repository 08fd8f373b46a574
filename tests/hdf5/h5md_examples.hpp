// SPDX-License-Identifier: MIT
/// @file
/// Fields of every type that an H5MD file takes, and stores that are compared bit by bit.
#pragma once

#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

enum class phase : std::int16_t { solid = -1, liquid = 300 };
inline constexpr tsubu::field<"frozen", bool> frozen{};
inline constexpr tsubu::field<"walls", std::array<bool, 3>> walls{};
inline constexpr tsubu::field<"phase", phase> phase_of{};
inline constexpr tsubu::field<"charge", float, "C"> charge{};
inline constexpr tsubu::field<"tiny", unsigned char> tiny{};
inline constexpr tsubu::field<"count", std::uint64_t> counted{};
inline constexpr tsubu::field<"stress", std::array<std::array<double, 3>, 3>, "Pa"> stress{};
inline constexpr tsubu::field<"acceleration", tsubu::vec<3, float>, "m/s^2"> acceleration{};

template <std::size_t D>
using every_type = tsubu::fields<tsubu::id, tsubu::species, tsubu::position<D>, tsubu::velocity<D, float>,
                                 tsubu::angular_velocity<D>, tsubu::image<D>, tsubu::mass, frozen, walls, phase_of,
                                 charge, tiny, counted, stress, acceleration>;

/// Bits that are easily lost: NaN with a payload, -0, denormal numbers, the ends of the integers.
template <std::size_t D, class Store>
void add_odd_particles(Store& g, int count, int seed) {
    using limits = std::numeric_limits<double>;
    for (int i = 0; i < count; ++i) {
        const double x = 0.1 * i + seed;
        const double odd = i % 5 == 0   ? -0.0
                           : i % 5 == 1 ? limits::denorm_min()
                           : i % 5 == 2 ? std::bit_cast<double>(std::uint64_t{0x7ff8'0000'0000'1234})
                           : i % 5 == 3 ? -limits::infinity()
                                        : 0.1 + 0.2;
        const auto at = g.push_back(tsubu::id = (std::int64_t{1} << 53) + i + 1);
        auto p = g[at];
        p[tsubu::species] = i % 2 == 0 ? std::numeric_limits<std::int32_t>::min() : i;
        for (std::size_t k = 0; k < D; ++k) {
            p[tsubu::position<D>][k] = x + static_cast<double>(k) * odd;
            p[tsubu::velocity<D, float>][k] = static_cast<float>(x) / 3;
            p[tsubu::image<D>][k] = i % 2 == 0 ? std::numeric_limits<std::int64_t>::max() : -i;
        }
        p[tsubu::angular_velocity<D>][0] = odd;
        p[tsubu::mass] = odd;
        p[frozen] = i % 3 == 0;
        p[walls] = {i % 2 == 0, true, false};
        p[phase_of] = i % 2 == 0 ? phase::solid : phase::liquid;
        p[charge] = std::numeric_limits<float>::denorm_min();
        p[tiny] = static_cast<unsigned char>(255 - i);
        p[counted] = std::numeric_limits<std::uint64_t>::max() - static_cast<std::uint64_t>(i);
        p[stress] = {{{1, 2, odd}, {x, 5, 6}, {7, 8, -x}}};
        p[acceleration] = {0, -0.0F, 1e-40F};
    }
}

/// Bit for bit, in the same order, in all fields of the first.
template <class Store, class Other>
bool same_particles(const Store& a, const Other& b) {
    bool same = a.size() == b.size();
    if (!same) return false;
    Store::fields_type::each([&](auto field) {
        using value_type = typename decltype(field)::value_type;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const value_type x = a[field][i];
            const value_type y = b[field][i];
            same = same && std::memcmp(&x, &y, sizeof(x)) == 0;
        }
    });
    return same;
}
