// SPDX-License-Identifier: MIT
#include <tsubu/core/executor.hpp>
#include <tsubu/core/threads.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <thread>
#include <vector>

static_assert(tsubu::executor<tsubu::this_thread> && tsubu::executor<tsubu::threads>);
static_assert(!tsubu::executor<int>);

TEST_CASE("this_thread runs one part, here", "[core]") {
    std::vector<std::size_t> parts;
    const auto here = std::this_thread::get_id();
    tsubu::this_thread{}.run([&](std::size_t part) {
        parts.push_back(part);
        CHECK(std::this_thread::get_id() == here);
    });
    CHECK(parts == std::vector<std::size_t>{0});
    CHECK(tsubu::this_thread::concurrency() == 1);
}

TEST_CASE("threads run each part once, and their writes are seen after", "[core]") {
    const auto count = GENERATE(std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{8});
    const tsubu::threads team(count);
    REQUIRE(team.concurrency() == count);
    std::vector<int> runs(count, 0);
    for (int round = 0; round < 20; ++round) team.run([&](std::size_t part) { ++runs[part]; });
    CHECK(runs == std::vector<int>(count, 20));
}

TEST_CASE("part 0 runs on the calling thread", "[core]") {
    std::vector<std::thread::id> ids(3);
    tsubu::threads(3).run([&](std::size_t part) { ids[part] = std::this_thread::get_id(); });
    CHECK(ids[0] == std::this_thread::get_id());
}

TEST_CASE("no threads at all are refused", "[core]") {
    const auto text = thrown<tsubu::input_error>([] { tsubu::threads team(0); });
    INFO(text);
    CHECK(says(text, "0 threads"));
    CHECK(says(text, "at least 1"));
}
