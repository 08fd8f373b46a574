// SPDX-License-Identifier: MIT
/// @file
/// The laws of id_storage as the conformance suite reports them: the number, and what was found to be otherwise.
#pragma once

#include <tsubu/version.hpp>

namespace tsubu::testing {

/// A name for each text; never an object.
struct law {
    law() = delete;

    static constexpr const char* lookup =
        "law 1: after rebuild, find(t) is the lowest index of t, and nothing else is left";
    static constexpr const char* accepts = "law 1: rebuild takes the ids 0 .. N-1";
    static constexpr const char* links =
        "law 2: links[i] is the lowest j > i with the same id; each is written, none read";
    static constexpr const char* outside = "law 2: rebuild writes no link outside the span";
    static constexpr const char* total = "law 3: find is total: a value that is no id here yields absent";
    static constexpr const char* assigned = "law 4: after assign(id, index), find(id) == index";
    static constexpr const char* assigned_others = "law 4: assign changes no other answer";
    static constexpr const char* erased = "law 5: erase says whether the id was there; then it is absent";
    static constexpr const char* erased_others = "law 5: erase changes no other answer";
    static constexpr const char* cleared = "law 6: clear forgets all";
    static constexpr const char* size = "law 6: size() is the number of ids present";
    static constexpr const char* bytes = "law 6: memory_bytes() is what the tables hold";
    static constexpr const char* reserved = "law 7: reserve changes no answer";
    static constexpr const char* strong = "law 8: where rebuild, assign or reserve throws, every answer is the old one";
    static constexpr const char* strong_links = "law 8: where rebuild throws, no link has been written";
    static constexpr const char* no_memory = "law 8: assign to an id that is present takes no memory";
    static constexpr const char* recovers = "law 8: where memory is there again, the same call succeeds";
    static constexpr const char* copied = "law 9: a copy is independent of its source";
    static constexpr const char* moved = "law 9: a moved-from storage can be assigned to";
    static constexpr const char* batch = "ability batched_lookup: out[k] == find(ids[k]) for every k";
    static constexpr const char* prefetched = "ability prefetchable: prefetch changes no answer";
    static constexpr const char* parallel = "ability parallel_rebuild: answers and links as if built by one thread";
};

}  // namespace tsubu::testing
