// SPDX-License-Identifier: MIT
#include <tsubu/neighbor/skin_watch.hpp>

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/comm/self_transport.hpp>
#include <tsubu/core/error.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

TEST_CASE("neighbours are due as soon as two particles may have crossed the skin", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    tsubu::skin_watch watch(1);
    CHECK_FALSE(watch.is_due(on));
    for (int step = 1; step <= 4; ++step) {  // exact in binary: 1/8 each
        watch.travel(0.125);
        CHECK(watch.travelled() == 0.125 * step);
        CHECK_FALSE(watch.is_due(on));  // 2 * 4/8 is the skin, not more
    }
    watch.travel(std::numeric_limits<double>::denorm_min());
    CHECK_FALSE(watch.is_due(on));  // no sum of doubles is so little more
    watch.travel(0x1p-53);  // the last place of 0.5
    CHECK(watch.is_due(on));
    CHECK(watch.is_due(on));  // until they have been found
    watch.restart();
    CHECK(watch.travelled() == 0);
    CHECK_FALSE(watch.is_due(on));
}

TEST_CASE("without a skin neighbours are due at each motion", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    tsubu::skin_watch watch(0);
    CHECK_FALSE(watch.is_due(on));
    watch.travel(0);
    CHECK_FALSE(watch.is_due(on));
    watch.travel(1e-300);
    CHECK(watch.is_due(on));
}

TEST_CASE("a way that is no number is due", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    for (const double way : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        tsubu::skin_watch watch(1);
        watch.travel(way);
        CHECK(watch.is_due(on));
    }
    tsubu::run_ranks(3, [](tsubu::local_transport& among) {
        tsubu::skin_watch watch(1);
        watch.travel(among.rank() == 1 ? std::numeric_limits<double>::quiet_NaN() : 0.0);
        if (!watch.is_due(among)) throw tsubu::error("a way that is no number was lost among the ranks");
    });
}

TEST_CASE("it is looked at each so many steps", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    tsubu::skin_watch watch(1, 3);
    std::vector<bool> due;
    for (int step = 0; step < 6; ++step) {
        watch.travel(0.08);  // longer than half of the skin after step 7 only, which is before the look at step 9
        due.push_back(watch.is_due(on));
    }
    CHECK(due == std::vector<bool>{false, false, false, false, false, true});
    watch.restart();
    // The count begins anew.
    watch.travel(1);
    CHECK_FALSE(watch.is_due(on));
    watch.restart();
    watch.travel(0.1);
    for (int step = 0; step < 3; ++step) CHECK_FALSE(watch.is_due(on));
}

TEST_CASE("a look sees as far as the next one", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    for (const unsigned every : {2U, 3U, 5U, 10U}) {
        // Slow at first, faster from look to look, as what falls; in the end 2 v dt every is 0.08.
        tsubu::skin_watch watch(0.1, every);
        std::size_t renewals = 0;
        for (int step = 1; step <= 4000; ++step) {
            watch.travel(1e-6 * step);
            if (!watch.is_due(on)) continue;
            watch.restart();
            ++renewals;
        }
        watch.check(on);
        // 8 m in all: a renewal for each 0.05 m, less what is kept back for the steps until the next look.
        CHECK(renewals >= 160);
        CHECK(renewals <= 480);
    }
}

const char* const late =
    "neighbours were used after the fastest particles had gone 0.75 m each, more than half of the skin of 1 m; it was "
    "looked at every 4 steps";

TEST_CASE("a use that was too late is found and named", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    tsubu::skin_watch watch(1, 4);
    for (int step = 0; step < 3; ++step) {
        watch.travel(0.25);
        CHECK_FALSE(watch.is_due(on));  // the third is too late, and nobody looks
    }
    watch.travel(0.25);
    const auto text = thrown<tsubu::input_error>([&] { static_cast<void>(watch.is_due(on)); });
    CHECK(says(text, "tsubu::skin_watch: "));
    CHECK(says(text, late));
    CHECK(says(text, "2 v_max dt every is to be at most the skin"));
}

TEST_CASE("a use that was too late is found where nobody has looked yet", "[neighbor][skin_watch]") {
    tsubu::self_transport on;
    tsubu::skin_watch watch(1, 4);
    watch.check(on);
    for (int step = 0; step < 3; ++step) {
        watch.travel(0.25);
        CHECK_FALSE(watch.is_due(on));
        if (step == 1) watch.check(on);
    }
    CHECK(says(thrown<tsubu::input_error>([&] { watch.check(on); }), late));
    watch.restart();
    watch.travel(9);  // without a use
    watch.check(on);
}

// One rank alone is fast; all are to find neighbours anew, or none, and all throw the same.
TEST_CASE("ranks agree on what is due, and on what was too late", "[neighbor][skin_watch]") {
    for (const std::size_t ranks : {1U, 2U, 4U})
        for (std::size_t fast = 0; fast < ranks; ++fast) {
            std::vector<std::string> said(ranks);
            std::vector<std::vector<bool>> due(ranks);
            tsubu::run_ranks(ranks, [&](tsubu::local_transport& on) {
                const bool is_fast = on.rank() == fast;
                tsubu::skin_watch each(1);
                for (int step = 0; step < 5; ++step) {
                    each.travel(is_fast ? 0.125 : 0.01);
                    due[on.rank()].push_back(each.is_due(on));
                }
                tsubu::skin_watch watch(1, 4);
                for (int step = 0; step < 3; ++step) {
                    watch.travel(is_fast ? 0.25 : 0.01);
                    static_cast<void>(watch.is_due(on));
                }
                said[on.rank()] = thrown<tsubu::input_error>([&] { static_cast<void>(watch.is_due(on)); });
            });
            INFO(ranks << " ranks, rank " << fast << " fast");
            for (const auto& one : due) CHECK(one == std::vector<bool>{false, false, false, false, true});
            for (const auto& one : said) CHECK(says(one, late));
        }
}

TEST_CASE("a watch tells its skin", "[neighbor][skin_watch]") { CHECK(tsubu::skin_watch(.3).skin() == .3); }
TEST_CASE("a skin that is none is named", "[neighbor][skin_watch]") {
    const auto refused = [](double skin, unsigned every) {
        return thrown<tsubu::input_error>([&] { static_cast<void>(tsubu::skin_watch(skin, every)); });
    };
    CHECK(says(refused(-0.1, 1), "a skin of -0.1 m"));
    CHECK(says(refused(std::numeric_limits<double>::quiet_NaN(), 1), "a skin of nan m"));
    CHECK(says(refused(std::numeric_limits<double>::infinity(), 1), "a skin of inf m"));
    CHECK(says(refused(0.1, 0), "every = 0"));
}

}  // namespace
