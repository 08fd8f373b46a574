// SPDX-License-Identifier: MIT
#include <tsubu/core/error.hpp>

#include "support/catch.hpp"

#include <stdexcept>
#include <type_traits>

static_assert(std::is_base_of_v<std::runtime_error, tsubu::error>);
static_assert(std::is_base_of_v<tsubu::error, tsubu::input_error>);
static_assert(std::is_base_of_v<tsubu::error, tsubu::limit_error>);
static_assert(!std::is_base_of_v<tsubu::input_error, tsubu::limit_error>);

TEST_CASE("a message says where, what, and the remedy", "[core]") {
    try {
        tsubu::detail::raise<tsubu::limit_error>("place", "12 is too much", "take 11");
        FAIL("nothing was thrown");
    } catch (const tsubu::error& error) {
        CHECK(std::string(error.what()) == "tsubu::place: 12 is too much; take 11");
    }
}
