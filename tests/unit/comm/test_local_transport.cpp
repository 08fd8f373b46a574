// SPDX-License-Identifier: MIT
#include <tsubu/comm/local_transport.hpp>

#include "support/catch.hpp"
#include "support/counted_memory.hpp"
#include "unit/thrown.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace {

/// What run_ranks throws if the last of `ranks` throws and the others do `meanwhile`, which waits for it.
template <class Meanwhile>
std::string thrown_beside(std::size_t ranks, Meanwhile&& meanwhile) {
    std::vector<char> has_lost(ranks, 0);
    std::string text;
    try {
        tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) {
            if (on.rank() + 1 == on.ranks()) throw std::runtime_error("this rank has failed");
            try {
                meanwhile(on);
            } catch (const tsubu::lost_rank_error&) {
                has_lost[on.rank()] = 1;
                throw;
            }
        });
    } catch (const std::runtime_error& thrown) {
        text = thrown.what();
    }
    for (std::size_t rank = 0; rank + 1 < ranks; ++rank)
        if (has_lost[rank] == 0) text += "; rank " + std::to_string(rank) + " was not told";
    return text;
}

}  // namespace

TEST_CASE("ranks that wait for one that has thrown are told, and its exception is the answer",
          "[comm][local_transport]") {
    for (const std::size_t ranks : {2U, 4U}) {
        CHECK(thrown_beside(ranks, [](auto& on) { static_cast<void>(on.exchange({}, {})); }) == "this rank has failed");
        CHECK(thrown_beside(ranks, [](auto& on) { static_cast<void>(on.gather({})); }) == "this rank has failed");
        CHECK(thrown_beside(ranks, [](auto& on) {
                  const auto last = static_cast<tsubu::rank_t>(on.ranks() - 1);
                  tsubu::local_transport::channel way(on, on.next_tag(), {{last, 1}}, {{last, 1}});
                  way.start();
                  way.finish();
              }) == "this rank has failed");
    }
}
TEST_CASE("ranks that wait for one that has returned are told", "[comm][local_transport]") {
    const auto lost = [](auto&& waits) {
        return thrown<tsubu::lost_rank_error>([&] {
            tsubu::run_ranks(3, [&](tsubu::local_transport& on) {
                if (on.rank() != 1) waits(on);
            });
        });
    };
    const auto text = lost([](auto& on) { static_cast<void>(on.gather({})); });
    INFO(text);
    CHECK(says(text, "rank 1 has returned"));
    CHECK(says(lost([](auto& on) {
                   tsubu::local_transport::channel way(on, on.next_tag(), {}, {{1, 1}});
                   way.start();
                   way.finish();
               }),
               "rank 1 has returned"));
}
TEST_CASE("what a rank has sent before it returned is taken", "[comm][local_transport]") {
    std::uint64_t came = 0;
    bool was_told = false;
    tsubu::run_ranks(2, [&](tsubu::local_transport& on) {
        const bool sends = on.rank() == 0;
        const std::vector<tsubu::lane> lanes{{sends ? tsubu::rank_t{1} : tsubu::rank_t{0}, 1}};
        const std::vector<tsubu::lane> none;
        tsubu::local_transport::channel way(on, on.next_tag(), sends ? lanes : none, sends ? none : lanes);
        if (sends) way.out()[0] = 7;
        way.start();
        if (sends) return;
        was_told = thrown<tsubu::lost_rank_error>([&] { on.reduce(std::span<double>(), tsubu::reduction::sum); }) !=
                   "nothing was thrown";  // rank 0 is gone then
        way.finish();
        came = way.in()[0];
    });
    CHECK(was_told);
    CHECK(came == 7);
}
TEST_CASE("if a thread cannot be started, those that were end first", "[comm][local_transport]") {
    using counted_memory::granted;
    bool was_refused = true;
    std::size_t least_started = 3;
    for (std::size_t requests = 0; was_refused && requests < 100; ++requests) {
        std::atomic<std::size_t> started = 0;
        std::atomic<std::size_t> ended = 0;
        granted = requests;  // of this thread, which starts the others
        try {
            tsubu::run_ranks(3, [&](tsubu::local_transport& on) {
                ++started;
                try {
                    static_cast<void>(on.sum_before(1));
                } catch (const tsubu::lost_rank_error&) {
                    ++ended;
                    throw;
                }
                ++ended;
            });
            was_refused = false;
        } catch (const std::bad_alloc&) {
        }
        granted = counted_memory::no_limit;
        CHECK(started == ended);
        if (was_refused && started > 0) least_started = started;
    }
    CHECK_FALSE(was_refused);
    CHECK(least_started < 3);
}
TEST_CASE("a reduction asks for no memory, however many numbers it has", "[comm][local_transport]") {
    std::vector<std::size_t> asked(3, 99);
    std::vector<char> is_right(3, 1);
    tsubu::run_ranks(3, [&](tsubu::local_transport& on) {
        std::vector<std::uint64_t> words(200);
        std::vector<double> numbers(64);
        for (std::size_t k = 0; k < words.size(); ++k) words[k] = k + on.rank();
        for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<double>(k) - on.rank();
        asked[on.rank()] = counted_memory::times_asked([&] {
            on.reduce(std::span<std::uint64_t>(words), tsubu::reduction::sum);
            on.reduce(std::span<double>(numbers), tsubu::reduction::least);
        });
        for (std::size_t k = 0; k < words.size(); ++k)
            if (words[k] != 3 * k + 3) is_right[on.rank()] = 0;
        for (std::size_t k = 0; k < numbers.size(); ++k)
            if (numbers[k] != static_cast<double>(k) - 2) is_right[on.rank()] = 0;
    });
    CHECK(asked == std::vector<std::size_t>(3, 0));
    CHECK(is_right == std::vector<char>(3, 1));
}
static_assert(!std::is_copy_constructible_v<tsubu::local_transport> &&
              !std::is_copy_assignable_v<tsubu::local_transport>);
TEST_CASE("run_ranks waits for all ranks, and gives each its number", "[comm][local_transport]") {
    std::vector<std::size_t> seen(5, 99);
    tsubu::run_ranks(5, [&](tsubu::local_transport& on) {
        if (on.ranks() == 5) seen[on.rank()] = on.rank();
    });
    CHECK(seen == std::vector<std::size_t>{0, 1, 2, 3, 4});
}
TEST_CASE("ranks that do not call the same are told so", "[comm][local_transport]") {
    CHECK_THROWS_AS(tsubu::run_ranks(3,
                                     [](tsubu::local_transport& on) {
                                         std::vector<std::uint64_t> sums(on.rank() == 1 ? 2 : 1);
                                         on.reduce(std::span<std::uint64_t>(sums), tsubu::reduction::sum);
                                     }),
                    tsubu::input_error);
    CHECK_THROWS_AS(tsubu::run_ranks(2,
                                     [](tsubu::local_transport& on) {
                                         const auto other = static_cast<tsubu::rank_t>(1 - on.rank());
                                         tsubu::local_transport::channel way(on, on.next_tag(), {{other, 2}},
                                                                             {{other, 3}});
                                         way.start();
                                         way.finish();
                                     }),
                    tsubu::input_error);
    CHECK_THROWS_AS(tsubu::run_ranks(2,
                                     [](tsubu::local_transport& on) {
                                         const tsubu::parcel nowhere[] = {{2, {}}};
                                         static_cast<void>(on.exchange(nowhere, {}));
                                     }),
                    tsubu::input_error);
}
