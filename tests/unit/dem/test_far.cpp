// SPDX-License-Identifier: MIT
// Far from the origin, and with great ids: what each number policy keeps.
#include <tsubu/dem/quantities.hpp>

#include <tsubu/comm/self_transport.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/references.hpp>
#include <tsubu/dem/scenes/pair.hpp>

#include "support/catch.hpp"
#include "unit/dem/exact_gas.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tsubu::dem;

constexpr double origins[] = {0, 1e3, 1e6, 1e9};
constexpr std::int64_t first_ids[] = {1, 2000000000, 9000000000000};

/// Velocities in the order of ids, after some collisions.
template <class Number>
std::vector<tsubu::vec<3>> velocities_of_gas(double origin, std::int64_t first_id) {
    tsubu::self_transport on;
    exact_gas<hooke<>, Number> scene{};
    scene.law = hooke<>{{2e4}};
    scene.time_step = 1e-3;
    scene.per_edge = 4;
    scene.origin = origin;
    scene.first_id = first_id;
    const auto gas = stage(scene, on);
    gas->steps(600);
    std::vector<std::pair<std::int64_t, tsubu::vec<3>>> rows;
    for (std::size_t i = 0; i < gas->particles().owned_count(); ++i) {
        tsubu::vec<3> v{};
        for (std::size_t k = 0; k < 3; ++k)
            v[k] = static_cast<double>(gas->particles()[decltype(scene)::simulation::quantities_type::velocity][i][k]);
        rows.emplace_back(gas->particles()[tsubu::id][i] - first_id, v);
    }
    std::sort(rows.begin(), rows.end());
    std::vector<tsubu::vec<3>> result;
    for (const auto& row : rows) result.push_back(row.second);
    return result;
}
double farthest(const std::vector<tsubu::vec<3>>& a, const std::vector<tsubu::vec<3>>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) most = std::fmax(most, std::abs(a[i][k] - b[i][k]));
    return most;
}

const double contact_time = pi / std::sqrt(2e5 / .5);

/// The restitution of a head-on impact.
template <class Number>
double restitution(double origin, std::int64_t first_id = 1, double phase = .5) {
    tsubu::self_transport on;
    const pair_scene<hooke<>, velocity_verlet, Number> scene{.law = hooke<>{{2e5}},
                                                             .time_step = contact_time / 50.37,
                                                             .phase = phase,
                                                             .origin = origin,
                                                             .first_id = first_id,
                                                             .is_watched = false};
    const auto pair = stage(scene, on);
    pair->steps(80);
    const auto v = pair->particles()[decltype(scene)::simulation::quantities_type::velocity];
    const double apart = static_cast<double>(v[1][0]) - static_cast<double>(v[0][0]);
    return pair->position(1)[0] > pair->position(0)[0] ? apart : -apart;
}

}  // namespace

TEMPLATE_TEST_CASE("on a lattice and in cells the origin does not matter, bit for bit", "[dem][far]",
                   tsubu::lattice<std::int64_t>, tsubu::lattice<std::int32_t>, in_cells<float>) {
    const auto near = velocities_of_gas<TestType>(0, 1);
    for (const double origin : origins)
        for (const auto first_id : first_ids) {
            INFO("origin " << origin << ", ids from " << first_id);
            CHECK(velocities_of_gas<TestType>(origin, first_id) == near);
        }
}
TEST_CASE("an offset in a cell that is no number is refused by the id", "[dem][far][bad_input]") {
    tsubu::self_transport on;
    exact_gas<hooke<>, in_cells<float>> scene{};
    scene.law = hooke<>{{2e4}};
    scene.time_step = 1e-3;
    scene.per_edge = 4;
    const auto gas = stage(scene, on);
    gas->particles()[decltype(scene)::simulation::quantities_type::offset][5][1] = NAN;
    const auto id = gas->particles()[tsubu::id][5];
    const auto said = thrown<tsubu::input_error>([&] { gas->start(); });
    INFO(said);
    CHECK(says(said, "particle " + std::to_string(id) + " has an offset of nan m; give finite numbers"));
}
TEST_CASE("ids do not matter, bit for bit", "[dem][far]") {
    const auto ordinary = velocities_of_gas<double>(0, 1);
    const double e = restitution<double>(0);
    for (const auto first_id : first_ids) {
        CHECK(velocities_of_gas<double>(0, first_id) == ordinary);
        CHECK(restitution<double>(0, first_id) == e);
    }
}
TEST_CASE("doubles are off by no more than five units in the last place in the greatest overlap", "[dem][far]") {
    const double greatest_overlap = 1 / std::sqrt(2e5 / .5);
    for (const double origin : {1e3, 1e6, 1e9}) {
        const double ulp = std::nextafter(origin, 2 * origin) - origin;
        double square = 0;
        constexpr int phases = 16;
        for (int p = 0; p < phases; ++p) {
            const double phase = (p + .5) / phases;
            square += std::pow(restitution<double>(origin, 1, phase) - restitution<double>(0, 1, phase), 2) / phases;
        }
        const double off = std::sqrt(square) / (ulp / greatest_overlap);
        INFO("origin " << origin << ": " << off << " units");
        CHECK(off < 5);
        CHECK(off > .05);  // noise of that size, not less: the origin does matter
    }
}
TEST_CASE("what numbers lose against doubles", "[dem][far]") {
    const double exact = restitution<double>(0);
    const auto is_off = [&](double e, double most) {
        INFO(e << " in place of " << exact);
        CHECK(std::abs(e - exact) < most);
    };
    is_off(restitution<mixed_precision<double, float>>(0), 3e-6);
    is_off(restitution<mixed_precision<double, float>>(1e6), 3e-6);
    const auto gas = velocities_of_gas<double>(0, 1);
    CHECK(farthest(velocities_of_gas<tsubu::lattice<std::int64_t>>(0, 1), gas) < 1e-9);
    CHECK(farthest(velocities_of_gas<tsubu::lattice<std::int32_t>>(0, 1), gas) < 1e-4);
    CHECK(farthest(velocities_of_gas<in_cells<float>>(0, 1), gas) < 1e-3);
}
