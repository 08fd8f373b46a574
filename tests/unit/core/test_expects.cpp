// SPDX-License-Identifier: MIT
#undef NDEBUG  // this file is about what debug builds do
#include <tsubu/core/expects.hpp>

#include "support/catch.hpp"

#if defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#endif

namespace {

struct positive {
    explicit positive(int value) : value_((TSUBU_EXPECTS(value > 0, "not positive; pass 1 or more"), value)) {}
    int value_;
};

}  // namespace

TEST_CASE("a kept precondition is an expression without effect", "[core]") {
    int evaluated = 0;
    TSUBU_EXPECTS(++evaluated == 1, "never seen");
    CHECK(evaluated == 1);
    CHECK(positive(3).value_ == 3);
}

#if defined(__unix__)
TEST_CASE("a broken precondition says what and ends the program", "[core]") {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const auto child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        ::dup2(ends[1], STDERR_FILENO);
        for (const int number : {SIGABRT, SIGSEGV}) std::signal(number, SIG_DFL);  // not the framework's report
        const positive broken(0);
        ::_exit(broken.value_);
    }
    ::close(ends[1]);
    std::string text;
    char part[256];
    for (auto got = ::read(ends[0], part, sizeof part); got > 0; got = ::read(ends[0], part, sizeof part))
        text.append(part, static_cast<std::size_t>(got));
    ::close(ends[0]);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    INFO(text);
    CHECK(WIFSIGNALED(status));
    CHECK(text.find("not positive; pass 1 or more (value > 0)") != std::string::npos);
    CHECK(text.find("test_expects.cpp:") != std::string::npos);
}
#endif
