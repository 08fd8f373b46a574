// SPDX-License-Identifier: MIT
#include <tsubu/domain/points.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <vector>

using tsubu::points;
using tsubu::vec;

TEST_CASE("points: columns and rows answer alike", "[domain][batch]") {
    const std::vector<double> x = {1, 2};
    const std::vector<double> y = {3, 4};
    const std::vector<vec<2>> all = {{1, 3}, {2, 4}};
    const points<2> columns({x, y});
    const points<2> rows(all);
    REQUIRE((columns.size() == 2 && rows.size() == 2));
    CHECK((columns.are_columns() && !rows.are_columns()));
    for (const std::size_t i : {0U, 1U}) {
        CHECK((columns[i] == all[i] && rows[i] == all[i]));
        for (const std::size_t k : {0U, 1U}) {
            CHECK(columns.visit([&](auto at) { return at(i, k); }) == all[i][k]);
            CHECK(rows.visit([&](auto at) { return at(i, k); }) == all[i][k]);
        }
    }
}

TEST_CASE("points: what may be written can be read", "[domain][batch]") {
    std::vector<vec<2, float>> all = {{1, 3}, {2, 4}};
    std::vector<float> x = {1, 2};
    std::vector<float> y = {3, 4};
    for (const auto& writable : {points<2, float>(all), points<2, float>({x, y})}) {
        writable.set(1, {5, 6});
        const points<2, const float> readable = writable;
        CHECK(readable.size() == 2);
        CHECK((readable[0] == vec<2, float>{1, 3}));
        CHECK((readable[1] == vec<2, float>{5, 6}));
    }
    CHECK((all[1] == vec<2, float>{5, 6} && x[1] == 5 && y[1] == 6));
}

TEST_CASE("points: none are points too", "[domain][batch]") {
    CHECK(points<3>(std::vector<vec<3>>{}).size() == 0);
    CHECK(points<1>({std::vector<double>{}}).size() == 0);
}

TEST_CASE("points: columns of different length are refused", "[domain][batch][input]") {
    const std::vector<double> four(4);
    const std::vector<double> three(3);
    const auto text = thrown<tsubu::input_error>([&] { static_cast<void>(points<3>({four, three, four})); });
    INFO(text);
    CHECK(says(text, "tsubu::points: column 1 has 3 coordinates, column 0 has 4; give columns of equal length"));
}
