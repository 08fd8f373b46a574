// SPDX-License-Identifier: MIT
/// @file
/// The same numbers on every machine and with every compiler: splitmix64.
#pragma once

#include <tsubu/version.hpp>

#include <cstdint>  // std::uint64_t

namespace tsubu {

/// 2^64 / golden ratio, made odd: multiples of it spread evenly over 64 bits.
inline constexpr std::uint64_t golden_stride = 0x9e3779b97f4a7c15U;

/// The output of splitmix64 for one state: a bijection on 64-bit words whose every output bit depends on every
/// input bit, so it serves as a hash finaliser too.
///
/// Source: Steele, Lea & Flood 2014, "Fast splittable pseudorandom number generators", doi:10.1145/2660193.2660195;
/// constants of Vigna's public-domain implementation.
[[nodiscard]] constexpr std::uint64_t splitmix64(std::uint64_t state) noexcept {
    state += golden_stride;
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9U;
    state = (state ^ (state >> 27)) * 0x94d049bb133111ebU;
    return state ^ (state >> 31);
}

/// A stream of splitmix64 numbers; models std::uniform_random_bit_generator.
class random_stream {
public:
    using result_type = std::uint64_t;

    constexpr explicit random_stream(std::uint64_t seed) noexcept : state_(seed) {}

    constexpr result_type operator()() noexcept {
        const auto value = splitmix64(state_);
        state_ += golden_stride;
        return value;
    }
    /// A number in [0, bound), by taking the remainder: the bias is below bound / 2^64. Precondition: bound > 0.
    constexpr result_type below(result_type bound) noexcept { return (*this)() % bound; }
    /// A number in [0, 1) with 53 random bits.
    constexpr double unit() noexcept { return static_cast<double>((*this)() >> 11) * 0x1p-53; }

    static constexpr result_type(min)() noexcept { return 0; }
    static constexpr result_type(max)() noexcept { return ~result_type{0}; }

private:
    std::uint64_t state_;
};

}  // namespace tsubu
