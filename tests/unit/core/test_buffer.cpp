// SPDX-License-Identifier: MIT
#include <tsubu/core/buffer.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

namespace {

using tsubu::buffer;
using tsubu::testing::allocation_gate;
using tsubu::testing::throwing_allocator;
using gated_buffer = buffer<int, throwing_allocator<std::byte>>;

struct alignas(64) line {
    std::uint32_t slots[16];
};

gated_buffer counting(std::size_t count, allocation_gate& gate) {
    gated_buffer values(count, throwing_allocator<std::byte>(gate));
    for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<int>(k);
    return values;
}

}  // namespace

TEST_CASE("a buffer gives back what it took", "[core]") {
    allocation_gate gate;
    {
        const auto values = counting(100, gate);
        CHECK(values.size() == 100);
        CHECK(values.memory_bytes() == 100 * sizeof(int));
        CHECK(gate.bytes() == values.memory_bytes());
        CHECK(values.end() - values.begin() == 100);
    }
    CHECK(gate.bytes() == 0);
}

TEST_CASE("an empty buffer takes no memory", "[core][T2]") {
    allocation_gate gate;
    gate.refuse_from(0);
    const gated_buffer none(0, throwing_allocator<std::byte>(gate));
    const auto copy = none;
    CHECK(none.empty());
    CHECK(copy.empty());
    CHECK(none.begin() == none.end());
    CHECK(gate.asked() == 0);
}

TEST_CASE("a copy of a buffer is independent, a moved-from one is empty", "[core]") {
    allocation_gate gate;
    auto values = counting(5, gate);
    auto copy = values;
    copy[2] = 70;
    CHECK(values[2] == 2);
    auto moved = std::move(copy);
    CHECK(moved[2] == 70);
    CHECK(copy.empty());  // NOLINT(bugprone-use-after-move): what a moved-from buffer is
    copy = values;
    CHECK(copy[4] == 4);
    copy = std::move(moved);
    CHECK(copy[2] == 70);
    auto& same = copy;
    copy = same;
    CHECK(copy[2] == 70);
    CHECK(gate.bytes() == values.memory_bytes() + copy.memory_bytes() + moved.memory_bytes());
}

TEST_CASE("a buffer that cannot be copied leaves both sides as they were", "[core][T10]") {
    allocation_gate gate;
    const auto values = counting(5, gate);
    auto other = counting(3, gate);
    gate.refuse_at(0);
    CHECK_THROWS_AS(other = values, std::bad_alloc);
    CHECK(other.size() == 3);
    CHECK(other[2] == 2);
    CHECK(values.size() == 5);
}

TEST_CASE("a count whose bytes do not fit the address space is refused", "[core]") {
    const auto too_many = (std::numeric_limits<std::size_t>::max)() / 2;
    CHECK_THROWS_AS((buffer<int>(too_many, std::allocator<int>())), std::bad_alloc);
}

TEST_CASE("values keep their alignment", "[core]") {
    for (std::size_t count = 1; count < 20; ++count) {
        const buffer<line, std::allocator<std::byte>> lines(count, std::allocator<std::byte>());
        CHECK(reinterpret_cast<std::uintptr_t>(lines.data()) % 64 == 0);
    }
}

TEST_CASE("memory above the threshold of huge pages is as good as other", "[core]") {
    const auto count = tsubu::huge_page_threshold / sizeof(line) + 3;
    buffer<line, std::allocator<std::byte>> lines(count, std::allocator<std::byte>());
    lines[0].slots[0] = 1;
    lines[count - 1].slots[15] = 2;
    CHECK(lines[0].slots[0] + lines[count - 1].slots[15] == 3);
}
