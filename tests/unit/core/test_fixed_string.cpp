// SPDX-License-Identifier: MIT
#include <tsubu/core/fixed_string.hpp>

#include "support/catch.hpp"

#include <string_view>
#include <type_traits>

namespace {

template <tsubu::fixed_string Name>
struct named {
    static constexpr std::string_view name = Name.view();
};

}  // namespace

TEST_CASE("a text is a template argument, and equal texts are equal arguments", "[core]") {
    STATIC_REQUIRE(std::is_same_v<named<"mass">, named<"mass">>);
    STATIC_REQUIRE_FALSE(std::is_same_v<named<"mass">, named<"mass ">>);
    STATIC_REQUIRE_FALSE(std::is_same_v<named<"mass">, named<"Mass">>);
    STATIC_REQUIRE(named<"mass">::name == "mass");
    STATIC_REQUIRE(named<"">::name.empty());
    STATIC_REQUIRE(named<"N m">::name.size() == 3);
    STATIC_REQUIRE(tsubu::fixed_string("rad/s").view() == "rad/s");
}
