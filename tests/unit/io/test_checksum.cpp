// SPDX-License-Identifier: MIT
#include <tsubu/io/checksum.hpp>

#include "support/catch.hpp"

#include <tsubu/core/random.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace {

constexpr std::uint64_t crc_of_text(std::string_view text) {
    tsubu::crc64 sum;
    for (const char c : text) {
        const std::array<std::byte, 1> one{static_cast<std::byte>(c)};
        sum.add(one);
    }
    return sum.value();
}

/// Bit by bit, after the definition.
std::uint64_t slow_crc(std::span<const std::byte> bytes) {
    std::uint64_t remainder = ~std::uint64_t{0};
    for (const auto byte : bytes) {
        remainder ^= std::to_integer<std::uint64_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            remainder = (remainder & 1) != 0 ? (remainder >> 1) ^ 0xC96C5795D7870F42 : remainder >> 1;
    }
    return ~remainder;
}

}  // namespace

TEST_CASE("the checksum is CRC-64/XZ", "[io][checksum]") {
    // The check value of the catalogue of CRCs; the others are those of Go's hash/crc64.
    STATIC_REQUIRE(crc_of_text("123456789") == 0x995DC9BBDF1939FA);
    STATIC_REQUIRE(crc_of_text("") == 0);
    STATIC_REQUIRE(crc_of_text("a") == 0x330284772E652B05);
    STATIC_REQUIRE(crc_of_text("abc") == 0x2CD8094A1A277627);
    STATIC_REQUIRE(crc_of_text("abcdefghij") == 0x32093A2ECD5773F4);
    constexpr std::string_view long_text = "This is a test of the emergency broadcast system.";
    STATIC_REQUIRE(crc_of_text(long_text) == 0x27DB187FC15BBC72);
    CHECK(tsubu::crc64_of(std::as_bytes(std::span(long_text))) == 0x27DB187FC15BBC72);
}

TEST_CASE("sixteen bytes at a time give what bit by bit gives, however they are cut", "[io][checksum]") {
    tsubu::random_stream random(4);
    std::vector<std::byte> bytes(300);
    for (auto& byte : bytes) byte = static_cast<std::byte>(random.below(256));
    for (std::size_t first = 0; first < 20; ++first)
        for (std::size_t count = 0; first + count <= bytes.size(); count += 1 + count / 8) {
            const auto part = std::span<const std::byte>(bytes).subspan(first, count);
            CAPTURE(first, count);
            CHECK(tsubu::crc64_of(part) == slow_crc(part));
            tsubu::crc64 sum;
            sum.add(part.first(count / 3));
            sum.add(part.subspan(count / 3));
            CHECK(sum.value() == slow_crc(part));
        }
}

TEST_CASE("every changed bit changes the checksum", "[io][checksum]") {
    std::vector<std::uint64_t> words{1, 2, 0, ~std::uint64_t{0}, 5};
    const auto sum = tsubu::crc64_of(words);
    for (auto& word : words)
        for (int bit = 0; bit < 64; ++bit) {
            word ^= std::uint64_t{1} << bit;
            CHECK(tsubu::crc64_of(words) != sum);
            word ^= std::uint64_t{1} << bit;
        }
    CHECK(tsubu::crc64_of(words) == sum);
}
