// SPDX-License-Identifier: MIT
/// @file
/// restart_state: what a restart file holds beside the particles: the box, the step, words of the user.
#pragma once

#include <tsubu/core/error.hpp>
#include <tsubu/core/vec.hpp>

#include <array>    // std::array
#include <cstddef>  // std::size_t
#include <cstdint>  // std::int64_t, std::uint64_t
#include <string>   // std::string, std::to_string
#include <vector>   // std::vector

namespace tsubu {

/// A box as numbers, for files: of D dimensions the first D entries of each hold.
struct restart_box {
    std::size_t dimension = 0;  ///< 0: there is none
    vec<3> lo{};                ///< [m]
    vec<3> hi{};                ///< [m]; of a tilted box lo + lengths
    vec<3> lengths{};           ///< of the edges, along their axes [m]
    vec<3> tilts{};             ///< xy, xz, yz [m]
    std::array<bool, 3> periodic{};

    restart_box() = default;
    /// Of a domain, or of a triclinic_box.
    template <class Box>
        requires requires(const Box& box) { box.cell(); }
    explicit restart_box(const Box& box) : dimension(Box::dimension) {
        static_assert(Box::dimension <= 3);
        std::size_t tilt = 0;
        for (std::size_t k = 0; k < Box::dimension; ++k) {
            periodic[k] = box.cell().along(k).is_periodic();
            if constexpr (requires { box.edge(k); }) {
                lo[k] = box.lo()[k];
                lengths[k] = box.edge(k)[k];
                hi[k] = lo[k] + lengths[k];
                for (std::size_t j = 0; j < k; ++j) tilts[tilt++] = box.edge(k)[j];
            } else {
                lo[k] = box.real_axis(k).lo();
                hi[k] = box.real_axis(k).hi();
                lengths[k] = hi[k] - lo[k];
            }
        }
    }
    /// The box again, its faces bit for bit: `state.box.as<tsubu::domain<3>>()`.
    /// @throws input_error if it has other dimensions, or tilts that this type of box has not; and what its constructor
    ///         does.
    template <class Box>
    [[nodiscard]] Box as() const {
        constexpr auto d = Box::dimension;
        if (dimension != d)
            detail::raise<input_error>("restart_box",
                                       "a box of " + std::to_string(dimension) + " dimensions for one of " +
                                           std::to_string(d),
                                       "ask for the box that was written");
        std::array<bool, d> around{};
        for (std::size_t k = 0; k < d; ++k) around[k] = periodic[k];
        if constexpr (requires { typename Box::tilts; }) {
            return Box(first<typename Box::position_type>(lo), first<typename Box::position_type>(lengths),
                       first<typename Box::tilts>(tilts), around);
        } else {
            for (const auto tilt : tilts)
                if (tilt != 0)
                    detail::raise<input_error>("restart_box", "the box is tilted", "ask for a triclinic_box");
            typename Box::options with{};
            with.periodic = around;
            return Box(first<typename Box::real_position_type>(lo), first<typename Box::real_position_type>(hi), with);
        }
    }

    friend bool operator==(const restart_box&, const restart_box&) = default;

private:
    template <class Numbers>
    [[nodiscard]] static Numbers first(const vec<3>& from) noexcept {
        Numbers numbers{};
        for (std::size_t k = 0; k < numbers.size(); ++k)
            numbers[k] = static_cast<typename Numbers::value_type>(from[k]);
        return numbers;
    }
};

/// What a restart file holds beside the particles.
struct restart_state {
    std::int64_t step = 0;
    restart_box box{};
    std::vector<std::uint64_t> words{};  ///< whatever the user needs: times as bits, states of random streams

    friend bool operator==(const restart_state&, const restart_state&) = default;
};

/// A field of a file.
struct restart_field {
    std::string name;
    std::string type;  ///< "float64[3]", "list of int32", "record of 24 bytes"
    std::string unit;

    friend bool operator==(const restart_field&, const restart_field&) = default;
};

/// What one rank has written.
struct restart_part {
    std::uint64_t particles = 0;
    std::uint64_t blocks = 0;  ///< each with a checksum of its own
    std::uint64_t bytes = 0;

    friend bool operator==(const restart_part&, const restart_part&) = default;
};

}  // namespace tsubu
