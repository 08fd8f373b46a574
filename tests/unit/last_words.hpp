// SPDX-License-Identifier: MIT
/// @file
/// What does a program say that ends itself? Run in a child, whose stderr is read.
#pragma once

#if defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <string>

/// What the call writes to stderr before abort() ends it; says so if it ends otherwise.
template <class Call>
std::string last_words(Call&& call) {
    int ends[2];
    if (::pipe(ends) != 0) return "no pipe";
    const auto child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDERR_FILENO);
        std::signal(SIGABRT, SIG_DFL);  // not the framework's report
        call();
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string text;
    char part[256];
    for (auto got = ::read(ends[0], part, sizeof part); got > 0; got = ::read(ends[0], part, sizeof part))
        text.append(part, static_cast<std::size_t>(got));
    ::close(ends[0]);
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child) return "no child";
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT ? text : "it did not abort; " + text;
}
#endif
