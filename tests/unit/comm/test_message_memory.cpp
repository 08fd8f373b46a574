// SPDX-License-Identifier: MIT
#include <tsubu/comm/message_memory.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

TEST_CASE("memory that comes back is taken again, for any type", "[comm]") {
    tsubu::message_memory memory;
    CHECK(memory.memory_bytes() == 0);
    const void* was = nullptr;
    {
        auto words = memory.take<std::uint64_t>(1000);
        CHECK(words.size() == 1000);
        words[999] = 7;
        was = words.data();
        CHECK(memory.memory_bytes() == 0);  // it is out
    }
    CHECK(memory.memory_bytes() >= 8000);
    auto fewer = memory.take<std::int32_t>(100);
    CHECK(static_cast<const void*>(fewer.data()) == was);
    CHECK(memory.memory_bytes() == 0);
    const auto more = memory.take<std::int32_t>(100);
    CHECK(more.data() != fewer.data());
    auto moved = std::move(fewer);
    CHECK(moved.size() == 100);
    CHECK(static_cast<const void*>(moved.data()) == was);
    moved.shrink(3);
    CHECK(moved.end() - moved.begin() == 3);
}
TEST_CASE("the smallest that is large enough is taken, so that calls that repeat find all they need", "[comm]") {
    tsubu::message_memory memory;
    std::size_t held = 0;
    for (int call = 0; call < 20; ++call) {
        {
            const auto small = memory.take<std::uint64_t>(100 + static_cast<std::size_t>(call % 3));
            const auto large = memory.take<std::uint64_t>(10000 - static_cast<std::size_t>(call % 5));
            { const auto middle = memory.take<std::uint64_t>(1000); }
            const auto late = memory.take<std::uint64_t>(5000);
        }
        if (call == 4) held = memory.memory_bytes();
    }
    CHECK(held > 0);
    CHECK(memory.memory_bytes() == held);
    memory.clear();
    CHECK(memory.memory_bytes() == 0);
}
TEST_CASE("a small request leaves a large block alone", "[comm]") {
    tsubu::message_memory memory;
    { const auto large = memory.take<char>(std::size_t{32} << 20); }
    const auto held = memory.memory_bytes();
    const auto small = memory.take<char>(100);
    CHECK(memory.memory_bytes() == held);
    const auto large = memory.take<char>(std::size_t{30} << 20);
    CHECK(memory.memory_bytes() == 0);
}
TEST_CASE("what is kept has an end", "[comm]") {
    tsubu::message_memory memory;
    { const auto vast = memory.take<std::uint64_t>(tsubu::message_memory::most_kept / 8 + 1); }
    CHECK(memory.memory_bytes() == 0);
    {
        std::vector<tsubu::message_memory::array<char>> all;
        for (std::size_t k = 0; k < 2 * tsubu::message_memory::most_blocks; ++k) all.push_back(memory.take<char>(1000));
    }
    CHECK(memory.memory_bytes() >= 1000 * tsubu::message_memory::most_blocks);
    CHECK(memory.memory_bytes() < 1500 * tsubu::message_memory::most_blocks);
    constexpr auto too_many = (std::numeric_limits<std::size_t>::max)() / 8;
    CHECK_THROWS_AS(memory.take<std::uint64_t>(too_many), std::bad_array_new_length);
}
TEST_CASE("an array may outlive the memory that it is from", "[comm]") {
    tsubu::message_memory::array<std::uint64_t> words;
    {
        tsubu::message_memory memory;
        const tsubu::message_memory same = memory;
        words = memory.take<std::uint64_t>(10);
        { const auto more = memory.take<std::uint64_t>(5); }
        CHECK(same.memory_bytes() == memory.memory_bytes());
    }
    words[9] = 1;
    CHECK(words.size() == 10);
}
