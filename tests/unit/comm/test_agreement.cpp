// SPDX-License-Identifier: MIT
#include <tsubu/comm/agreement.hpp>

#include <tsubu/comm/local_transport.hpp>

#include "comm_laws/on_ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <new>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

enum class how { well, refuses, exceeds, has_no_memory, fails };

/// What each of three ranks throws if they do their work so.
std::vector<std::string> thrown_by(const std::vector<how>& ranks) {
    std::vector<std::string> texts(ranks.size());
    tsubu::run_ranks(ranks.size(), [&](tsubu::local_transport& on) {
        tsubu::agreement<2> all(on.rank());
        bool has_gone_on = false;
        all.attempt([&] {
            switch (ranks[on.rank()]) {
                case how::well: return;
                case how::refuses: throw tsubu::input_error("bad input");
                case how::exceeds: throw tsubu::limit_error("too many");
                case how::has_no_memory: throw std::bad_alloc();
                case how::fails: throw std::runtime_error("no such file");
            }
        });
        all.attempt([&] { has_gone_on = true; });
        all[0] = 5;
        all[1] = on.rank();
        auto& text = texts[on.rank()];
        text = has_gone_on == all.has_failed_here() ? "went on; " : "";
        on.reduce(all.words(), tsubu::reduction::sum);
        if (all[0] != 5 * ranks.size() || all[1] != 3) text += "wrong sums; ";
        try {
            all.settle("test");
        } catch (const tsubu::input_error& thrown) {
            text += std::string("input: ") + thrown.what();
        } catch (const tsubu::limit_error& thrown) {
            text += std::string("limit: ") + thrown.what();
        } catch (const tsubu::other_rank_error& thrown) {
            text += std::string("other: ") + thrown.what();
        } catch (const std::bad_alloc&) {
            text += "memory";
        } catch (const std::exception& thrown) {
            text += thrown.what();
        }
    });
    return texts;
}
bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

}  // namespace

TEST_CASE("where all work is done nobody throws, and sums are those of all", "[comm][agreement]") {
    CHECK(thrown_by({how::well, how::well, how::well}) == std::vector<std::string>(3));
}
TEST_CASE("a rank that refuses its input throws what it threw, the others name it", "[comm][agreement]") {
    const auto texts = thrown_by({how::well, how::well, how::refuses});
    CHECK(texts[2] == "input: bad input");
    CHECK(begins(texts[0], "input: tsubu::test: rank 2 refused the input"));
    CHECK(texts[1] == texts[0]);
}
TEST_CASE("a rank without room throws its own, the others a limit_error", "[comm][agreement]") {
    auto texts = thrown_by({how::exceeds, how::well, how::well});
    CHECK(texts[0] == "limit: too many");
    CHECK(begins(texts[1], "limit: tsubu::test: rank 0 exceeded a limit"));
    texts = thrown_by({how::well, how::has_no_memory, how::well});
    CHECK(texts[1] == "memory");
    CHECK(begins(texts[2], "limit: tsubu::test: rank 1 exceeded a limit"));
}
TEST_CASE("where a rank fails otherwise, the others get an error of its own type", "[comm][agreement]") {
    const auto texts = thrown_by({how::well, how::fails, how::well});
    CHECK(texts[1] == "no such file");
    CHECK(texts[0] ==
          "other: tsubu::test: rank 1 failed; see the message there; nothing was done on any rank");
}
TEST_CASE("of several ranks that have failed the others are told the number", "[comm][agreement]") {
    const auto texts = thrown_by({how::exceeds, how::well, how::refuses});
    CHECK(texts[0] == "limit: too many");
    CHECK(texts[2] == "input: bad input");
    CHECK(begins(texts[1], "input: tsubu::test: 2 ranks refused the input"));
}
