// SPDX-License-Identifier: MIT
#include <tsubu/io/detail/hdf5_unit.hpp>

#include "support/catch.hpp"

#include <string>
#include <utility>

using tsubu::detail::h5md_unit;

TEST_CASE("a unit is written as H5MD writes it", "[io][h5md]") {
    const std::pair<const char*, const char*> units[] = {
        {"", ""},
        {"m", "m"},
        {"m/s", "m s-1"},
        {"rad/s", "rad s-1"},
        {"N m", "N m"},
        {"m^2", "m+2"},
        {"m/s^2", "m s-2"},
        {"J/kg/K", "J kg-1 K-1"},
        {"kg*m", "kg m"},
        {"m s-1", "m s-1"},
        {"1/s", "s-1"},
        {"/s", "s-1"},
        {"nm+3", "nm+3"},
        {"m^-1", "m-1"},
        {"kg m^2/s^2", "kg m+2 s-2"},
        {"s/m^-1", "s m"},
    };
    for (const auto& [unit, wanted] : units) {
        CAPTURE(unit);
        CHECK(h5md_unit(unit) == wanted);
    }
}
TEST_CASE("a unit that is no product of powers stays as it is", "[io][h5md]") {
    for (const std::string unit :
         {"<K>", "J/kg K", "J/(kg K)", "m^", "m  s", "m^0", "m m", "60 s", "1", "m/", "%", "m^a"}) {
        CAPTURE(unit);
        CHECK(h5md_unit(unit) == unit);
    }
}
