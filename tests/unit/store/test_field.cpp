// SPDX-License-Identifier: MIT
#include <tsubu/store/field.hpp>

#include <tsubu/store/standard_fields.hpp>
#include <tsubu/store/term.hpp>

#include "support/catch.hpp"

#include <string>
#include <type_traits>

namespace {

using tsubu::field;
using tsubu::fields;
using tsubu::force;
using tsubu::position;
using tsubu::velocity;

constexpr field<"temperature", double, "K"> temperature{};
constexpr field<"heat", double, "J",
                tsubu::field_traits{.when = tsubu::travels::never, .reverse = tsubu::ghosts_add::greatest}>
    heat{};

using grain = fields<tsubu::id, position<3>, velocity<3>, force<3>, tsubu::radius>;

}  // namespace

TEST_CASE("a field of one's own is one line", "[store]") {
    using field_type = std::remove_cv_t<decltype(temperature)>;
    STATIC_REQUIRE(tsubu::particle_field<field_type>);
    STATIC_REQUIRE_FALSE(tsubu::particle_field<int>);
    STATIC_REQUIRE(field_type::name == "temperature");
    STATIC_REQUIRE(field_type::unit == "K");
    STATIC_REQUIRE(field_type::traits.when == tsubu::travels::on_creation);
    STATIC_REQUIRE(field_type::traits.image == tsubu::under_image::invariant);
    STATIC_REQUIRE(field_type::traits.reverse == tsubu::ghosts_add::nothing);
    STATIC_REQUIRE(std::is_empty_v<field_type>);
    STATIC_REQUIRE(decltype(heat)::traits.when == tsubu::travels::never);
    STATIC_REQUIRE(decltype(heat)::traits.reverse == tsubu::ghosts_add::greatest);
    CHECK((temperature = 300).value == 300);
}

TEST_CASE("two fields are one if name, type, unit and traits are", "[store]") {
    constexpr field<"temperature", double, "K"> again{};
    constexpr field<"temperature", float, "K"> single{};
    STATIC_REQUIRE(fields<temperature>::has<decltype(again)>);
    STATIC_REQUIRE_FALSE(fields<temperature>::has<decltype(single)>);
    STATIC_REQUIRE_FALSE(fields<position<3>>::has<decltype(position<2>)>);
    STATIC_REQUIRE_FALSE(fields<position<3>>::has<decltype(position<3, float>)>);
}

TEST_CASE("a set knows its fields, their places, and calls a body for each", "[store]") {
    STATIC_REQUIRE(grain::count == 5);
    STATIC_REQUIRE(grain::has<decltype(tsubu::id)>);
    STATIC_REQUIRE_FALSE(grain::has<decltype(tsubu::mass)>);
    STATIC_REQUIRE(grain::place<decltype(tsubu::id)>() == 0);
    STATIC_REQUIRE(grain::place<decltype(velocity<3>)>() == 2);
    STATIC_REQUIRE(grain::place<std::remove_cv_t<decltype(tsubu::radius)>>() == 4);
    std::string names;
    grain::each([&](auto one) { names += std::string(one.name) + " [" + std::string(one.unit) + "] "; });
    CHECK(names == "id [] position [m] velocity [m/s] force [N] radius [m] ");
}

TEST_CASE("union, intersection and difference of sets keep the order of the first", "[store]") {
    using left = fields<tsubu::id, tsubu::radius, tsubu::mass>;
    using right = fields<tsubu::mass, temperature, tsubu::id>;
    STATIC_REQUIRE(
        std::is_same_v<tsubu::union_of<left, right>, fields<tsubu::id, tsubu::radius, tsubu::mass, temperature>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::intersection_of<left, right>, fields<tsubu::id, tsubu::mass>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::difference_of<left, right>, fields<tsubu::radius>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::union_of<fields<>, left>, left>);
    STATIC_REQUIRE(std::is_same_v<tsubu::union_of<left, fields<>>, left>);
    STATIC_REQUIRE(std::is_same_v<tsubu::union_of<left, left>, left>);
    STATIC_REQUIRE(std::is_same_v<tsubu::intersection_of<left, fields<>>, fields<>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::difference_of<left, left>, fields<>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::difference_of<left, fields<>>, left>);
}

TEST_CASE("what a new ghost gets, and what it gets every step, follows from the traits", "[store]") {
    STATIC_REQUIRE(std::is_same_v<tsubu::fields_on_creation<grain>,
                                  fields<tsubu::id, position<3>, velocity<3>, tsubu::radius>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::fields_every_step<grain>, fields<position<3>, velocity<3>>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::fields_every_step<fields<tsubu::id, heat>>, fields<>>);
    STATIC_REQUIRE(std::is_same_v<tsubu::fields_on_creation<fields<tsubu::id, heat>>, fields<tsubu::id>>);
}
