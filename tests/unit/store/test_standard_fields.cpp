// SPDX-License-Identifier: MIT
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <type_traits>

namespace {

template <auto Field>
using value_of = typename std::remove_cv_t<decltype(Field)>::value_type;

}  // namespace

TEST_CASE("in two dimensions a rotation is one number, and nothing has a third component", "[store]") {
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::position<2>>, tsubu::vec<2>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::velocity<2>>, tsubu::vec<2>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::force<2>>, tsubu::vec<2>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::angular_velocity<2>>, tsubu::vec<1>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::torque<2>>, tsubu::vec<1>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::torque<3>>, tsubu::vec<3>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::position<3, float>>, tsubu::vec<3, float>>);
    STATIC_REQUIRE(std::is_same_v<value_of<tsubu::id>, std::int64_t>);
}

TEST_CASE("what images do to a standard field, and when it travels", "[store]") {
    using tsubu::travels;
    using tsubu::under_image;
    STATIC_REQUIRE(decltype(tsubu::position<3>)::traits.image == under_image::translates);
    STATIC_REQUIRE(decltype(tsubu::velocity<3>)::rotates_with_images);
    STATIC_REQUIRE(decltype(tsubu::force<3>)::rotates_with_images);
    STATIC_REQUIRE(decltype(tsubu::force<3>)::traits.when == travels::never);
    STATIC_REQUIRE(decltype(tsubu::torque<3>)::traits.when == travels::never);
    STATIC_REQUIRE_FALSE(decltype(tsubu::radius)::rotates_with_images);
    STATIC_REQUIRE(decltype(tsubu::image<3>)::traits.when == travels::never);
    STATIC_REQUIRE(decltype(tsubu::radius)::traits.when == travels::on_creation);
}

TEST_CASE("of the standard fields ghosts give back force and torque only", "[store]") {
    using tsubu::ghosts_add;
    STATIC_REQUIRE(decltype(tsubu::force<3>)::traits.reverse == ghosts_add::sum);
    STATIC_REQUIRE(decltype(tsubu::torque<2>)::traits.reverse == ghosts_add::sum);
    STATIC_REQUIRE(decltype(tsubu::id)::traits.reverse == ghosts_add::nothing);
    STATIC_REQUIRE(decltype(tsubu::position<3>)::traits.reverse == ghosts_add::nothing);
    STATIC_REQUIRE(decltype(tsubu::velocity<3>)::traits.reverse == ghosts_add::nothing);
    STATIC_REQUIRE(decltype(tsubu::radius)::traits.reverse == ghosts_add::nothing);
    STATIC_REQUIRE(decltype(tsubu::image<3>)::traits.reverse == ghosts_add::nothing);
}
