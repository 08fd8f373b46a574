// SPDX-License-Identifier: MIT
/// @file
/// id_map with every policy and every kind of id, and with the archetype: it asks no more than its concept says.
#include <tsubu/testing/archetypes.hpp>
#include <tsubu/tsubu.hpp>

#include <cstdint>

template class tsubu::id_map<tsubu::testing::minimal_id_storage<std::int64_t>>;
template class tsubu::id_map<tsubu::testing::minimal_id_storage<std::uint32_t>>;

// NOLINTBEGIN(bugprone-macro-parentheses): a type stands in none.
#define TSUBU_TEST_ALL_POLICIES(Id)                                      \
    template class tsubu::id_map<tsubu::adaptive_storage<Id>>;           \
    template class tsubu::id_map<tsubu::bitmap_storage<Id>>;             \
    template class tsubu::id_map<tsubu::chained_storage<tsubu::mod_prime, Id>>; \
    template class tsubu::id_map<tsubu::chained_storage<tsubu::mixed, Id>>;     \
    template class tsubu::id_map<tsubu::dense_storage<Id>>;              \
    template class tsubu::id_map<tsubu::flat_storage<Id>>;               \
    template class tsubu::id_map<tsubu::paged_storage<Id>>
// NOLINTEND(bugprone-macro-parentheses)

TSUBU_TEST_ALL_POLICIES(std::int64_t);
TSUBU_TEST_ALL_POLICIES(std::uint64_t);
TSUBU_TEST_ALL_POLICIES(std::int32_t);
TSUBU_TEST_ALL_POLICIES(std::uint32_t);
