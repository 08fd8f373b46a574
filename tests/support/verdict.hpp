// SPDX-License-Identifier: MIT
/// @file
/// verdict: what a conformance suite has said.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

/// The laws that were broken, by what stands before the colon, and the first text.
struct verdict {
    void operator()(bool kept, std::string_view law) {
        ++checked;
        if (kept) return;
        if (broken.empty()) first = law;
        broken.insert(std::string(law.substr(0, law.find(':'))));
    }
    std::size_t checked = 0;
    std::set<std::string> broken;
    std::string first;
};
