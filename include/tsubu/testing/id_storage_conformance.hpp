// SPDX-License-Identifier: MIT
/// @file
/// Does a storage policy keep the nine laws of id_storage? A suite for any test framework, or none.
///
///     tsubu::testing::check_id_storage<my_storage>(7, 10'000, [](bool ok, std::string_view law) {
///         if (!ok) { std::cerr << law << '\n'; std::exit(1); }
///     });
///
/// Every law that is checked is reported, kept or not; a broken one with the ids, the sizes and the seed that broke
/// it behind its text. The text begins with "law" and the number that it has in id/concepts.hpp, or with "ability"
/// and the name of the sub-concept. A policy may refuse ids by limit_error (a dense table, and ids up to 2^62): then
/// law 8 is what is checked, and those ids are skipped; ids 0 .. N-1 it must take.
#pragma once

#include <tsubu/id/concepts.hpp>
#include <tsubu/testing/detail/id_storage_examiner.hpp>
#include <tsubu/testing/throwing_allocator.hpp>

#include <concepts>     // std::constructible_from
#include <cstddef>      // std::byte, std::size_t
#include <cstdint>      // std::uint64_t
#include <string_view>  // std::string_view
#include <type_traits>  // std::remove_reference_t

namespace tsubu::testing {

/// Does this storage keep the nine laws?
///
/// @param seed       same seed, same run, on every machine
/// @param steps      random rebuilds; 10 000 take about a second with optimisation
/// @param check      called as check(bool kept, std::string_view law), many times per step
/// @param prototype  an empty storage as it is to be configured: every storage of the run is a copy of it
/// Complexity: sizes from 0 to 4100 ids, mostly below 64.
template <id_storage Storage, class Check>
void check_id_storage(std::uint64_t seed, std::size_t steps, Check&& check, Storage prototype = {}) {
    detail::id_storage_examiner<Storage, std::remove_reference_t<Check>> examiner(seed, check, prototype);
    examiner.walk_sizes();
    for (std::size_t k = 0; k < steps; ++k) examiner.step();
}

/// The laws of look-up and links, and rebuild by 1, 2 and 3 threads, for `count` ids of three patterns: for the
/// branches that a policy takes only where its table is large.
template <id_storage Storage, class Check>
void check_id_storage_large(std::uint64_t seed, std::size_t count, Check&& check, Storage prototype = {}) {
    detail::id_storage_examiner<Storage, std::remove_reference_t<Check>>(seed, check, prototype).examine_large(count);
}

/// Law 8 where memory ends: every allocation of rebuild, reserve and assign is refused in turn. Laws 6 and 9 too:
/// memory_bytes() against the bytes that were handed out, and all of them are given back.
///
/// @param prototype  an empty storage that takes all its memory through `gate`
template <id_storage Storage, class Check>
void check_id_storage_allocation(std::uint64_t seed, std::size_t steps, Check&& check, allocation_gate& gate,
                                 const Storage& prototype) {
    const auto before = gate.bytes();
    {
        detail::id_storage_examiner<Storage, std::remove_reference_t<Check>> examiner(seed, check, prototype);
        for (std::size_t k = 0; k < steps; ++k) {
            examiner.examine_failures(gate);
            examiner.examine_bytes(gate);
        }
    }
    check(gate.bytes() == before, std::string_view("law 9: a storage that is destroyed gives back all its memory"));
}

/// The same for a storage that is constructed from an allocator.
template <id_storage Storage, class Check>
    requires std::constructible_from<Storage, throwing_allocator<std::byte>>
void check_id_storage_allocation(std::uint64_t seed, std::size_t steps, Check&& check) {
    allocation_gate gate;
    check_id_storage_allocation(seed, steps, check, gate, Storage(throwing_allocator<std::byte>(gate)));
}

}  // namespace tsubu::testing
