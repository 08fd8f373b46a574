// SPDX-License-Identifier: MIT
// What a scene refuses: the message says where, what with the values, and the remedy; on all ranks or none.
#include <tsubu/dem/run.hpp>

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/dem/gravity.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/scenes/chain.hpp>
#include <tsubu/dem/stability.hpp>
#include <tsubu/dem/velocity_verlet.hpp>
#include <tsubu/dem/walls.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace tsubu::dem;
using tsubu::local_transport;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using scene = simulation<2, double, velocity_verlet, hooke_dashpot<>, walls, spheres>;
using run_type = run<scene, local_transport>;

/// What the input of a run is; one member at a time is wrong.
struct input {
    options how{.time_step = 1e-4, .skin = .1};
    hooke_dashpot<> law{{1e5, 10}};
    walls floor{{{.point = {0, 0}, .normal = {0, 1}}}};
    tsubu::vec<2> x{5, 5};
    tsubu::vec<2> v{.1, .1};
    double radius = .5;
    double mass = 1;
    std::int64_t id = 7;
    std::size_t steps = 0;
};
/// Nine sound particles, and one that the input describes; on its rank alone.
void put_particles(run_type& of, const input& given) {
    if (of.on().rank() + 1 != of.on().ranks()) return;
    auto& p = of.particles();
    for (std::int64_t n = 0; n < 9; ++n)
        p.push_back(tsubu::id = 100 + n, tsubu::position<2> = {1.0 + static_cast<double>(n), 2}, tsubu::radius = .5,
                    tsubu::mass = 1.0, tsubu::velocity<2> = {.1, 0});
    p.push_back(tsubu::id = given.id, tsubu::position<2> = given.x, tsubu::radius = given.radius,
                tsubu::mass = given.mass, tsubu::velocity<2> = given.v);
}
/// What each rank is told.
std::vector<std::string> messages(std::size_t ranks, const input& given) {
    std::vector<std::string> said(ranks);
    tsubu::run_ranks(ranks, [&](local_transport& on) {
        said[on.rank()] = thrown<tsubu::input_error>([&] {
            run_type of(scene::box_type({0, -1}, {10, 10}, {.periodic = {true, false}}), given.how, on, given.law,
                        given.floor, spheres{});
            put_particles(of, given);
            of.start();
            of.steps(given.steps);
        });
    });
    return said;
}
/// All ranks refuse, one or more of them with these words; the others say that another did.
void check_refused(const input& given, std::initializer_list<const char*> words) {
    for (const std::size_t ranks : {1U, 3U}) {
        std::size_t telling = 0;
        for (const auto& text : messages(ranks, given)) {
            INFO(ranks << " ranks: " << text);
            CHECK(text != "nothing was thrown");
            bool tells = true;
            for (const auto* word : words) tells = tells && says(text, word);
            telling += tells ? 1 : 0;
            if (ranks == 1) CHECK(tells);
        }
        CHECK(telling >= 1);
    }
}
input with(const std::function<void(input&)>& change) {
    input given;
    change(given);
    return given;
}

}  // namespace

TEST_CASE("sound input is not refused", "[dem][bad_input]") {
    for (const std::size_t ranks : {1U, 3U})
        for (const auto& text : messages(ranks, with([](input& of) { of.steps = 20; })))
            CHECK(text == "nothing was thrown");
    // An infinite mass holds a particle in place.
    for (const auto& text : messages(1, with([](input& of) { of.mass = infinity; })))
        CHECK(text == "nothing was thrown");
}
TEST_CASE("grains of infinite mass that touch each other and a wall stay where they are", "[dem]") {
    tsubu::run_ranks(1, [](local_transport& on) {
        run_type of(scene::box_type({0, -1}, {10, 10}, {.periodic = {true, false}}), {.time_step = 1e-4, .skin = .1}, on,
                    hooke_dashpot<>{{1e5, 10}}, walls{{{.point = {0, 0}, .normal = {0, 1}}}}, spheres{});
        const auto add = [&](std::int64_t id, double x, double y, double mass) {
            of.particles().push_back(tsubu::id = id, tsubu::position<2> = {x, y}, tsubu::radius = .5,
                                     tsubu::mass = mass);
        };
        add(1, 5, .4, infinity);
        add(2, 5.9, .4, infinity);
        add(3, 5.45, 1.25, 1);
        of.steps(100);
        for (tsubu::index_t i = 0; i < 3; ++i) {
            const auto at = of.position(i);
            const auto id = of.particles()[tsubu::id][static_cast<std::size_t>(i)];
            if (id == 3)
                CHECK(at[1] > 1.25);
            else
                CHECK((at[0] == (id == 1 ? 5 : 5.9) && at[1] == .4));
        }
        CHECK(std::isfinite(longest_time_step(of)));
    });
}
TEST_CASE("a particle that cannot be is refused by its id", "[dem][bad_input]") {
    check_refused(with([](input& of) { of.radius = -1; }),
                  {"dem::run::start", "particle 7 has a radius of -1 m", "give a finite length above 0"});
    check_refused(with([](input& of) { of.radius = 0; }), {"particle 7 has a radius of 0 m"});
    check_refused(with([](input& of) { of.radius = not_a_number; }), {"particle 7 has a radius of nan m"});
    check_refused(with([](input& of) { of.radius = infinity; }), {"particle 7 has a radius of inf m"});
    check_refused(with([](input& of) { of.mass = 0; }), {"dem::run::start", "particle 7 has a mass of 0 kg",
                                                         "give a mass above 0; an infinite one holds it in place"});
    check_refused(with([](input& of) { of.mass = -2; }), {"particle 7 has a mass of -2 kg"});
    check_refused(with([](input& of) { of.mass = not_a_number; }), {"particle 7 has a mass of nan kg"});
    check_refused(with([](input& of) { of.v[1] = not_a_number; }),
                  {"particle 7 has a velocity of nan m/s on axis 1", "give finite numbers"});
    check_refused(with([](input& of) { of.v[0] = -infinity; }), {"particle 7 has a velocity of -inf m/s on axis 0"});
    check_refused(with([](input& of) { of.x[0] = not_a_number; }),
                  {"particle 7 has a position of nan m on axis 0", "give finite numbers"});
    check_refused(with([](input& of) { of.id = -3; }),
                  {"particle -3 has a negative id", "ids of particles are 0 or greater"});
}
TEST_CASE("particles that overlap by more than a radius are refused", "[dem][bad_input][guards]") {
    check_refused(with([](input& of) {
                      of.x = {5, 2.5 - 0x1p-10};
                  }),
                  {"dem::run: step 0", "particle", "overlaps particle", "by 0.5", "more than a radius of 0.5 m",
                   "place them apart; or take a stiffer law, or a smaller time step"});
    check_refused(with([](input& of) {
                      of.x = {5, -.1};
                  }),
                  {"particle 7 overlaps wall 0 by 0.6", "more than a radius of 0.5 m"});
    check_refused(with([](input& of) { of.x = {5, 2}; }), {"overlaps particle", "by 1 m"});
    // Just less is none of its business; nor is more, where the guard is off.
    const auto is_taken = [](const input& given) { return messages(1, given)[0] == "nothing was thrown"; };
    CHECK(is_taken(with([](input& of) { of.x = {5, 2.55}; })));
    CHECK(is_taken(with([](input& of) {
        of.x = {5, 2.45};
        of.how.guard.overlap = false;
    })));
}
TEST_CASE("a particle that crosses the box in a step is refused", "[dem][bad_input][guards]") {
    check_refused(with([](input& of) { of.v = {1e20, 0}; }),
                  {"dem::run: step 0: particle 7 moves by 1e+16 m in a step, farther than the box of 10 m along axis 0",
                   "look where its velocity comes from"});
}
TEST_CASE("options that cannot be are refused", "[dem][bad_input]") {
    check_refused(with([](input& of) { of.how.time_step = 0; }),
                  {"dem::run", "a time step of 0 s", "give a finite time above 0"});
    check_refused(with([](input& of) { of.how.time_step = -1e-4; }), {"a time step of -1e-04 s"});
    check_refused(with([](input& of) { of.how.time_step = not_a_number; }), {"a time step of nan s"});
    check_refused(with([](input& of) { of.how.skin = -1; }),
                  {"skin_watch", "a skin of -1 m", "give a finite length of at least 0"});
    check_refused(with([](input& of) { of.how.skin = not_a_number; }), {"a skin of nan m"});
    check_refused(with([](input& of) { of.how.check_every = 0; }), {"every = 0", "give at least 1"});
    check_refused(with([](input& of) { of.how.cutoff = .9; }),
                  {"dem::run", "a cutoff of 0.9 m, but the two largest particles touch at 1 m, and the skin is 0.1 m",
                   "give a cutoff of at least their sum, or 0 for just that"});
    // The largest may be on another rank.
    check_refused(with([](input& of) {
                      of.how.cutoff = 1.15;
                      of.radius = .6;
                  }),
                  {"a cutoff of 1.15 m, but the two largest particles touch at 1.2 m"});
    check_refused(with([](input& of) {
                      of.floor.planes[0].normal = {0, 2};
                  }),
                  {"dem::walls", "the normal of wall 0 has the length 2", "give a unit vector"});
    check_refused(with([](input& of) {
                      of.floor.planes[0].normal = {0, .6, .8};
                  }),
                  {"dem::walls", "the normal of wall 0 has a component 0.8 along axis 2 of a scene in 2 dimensions",
                   "give a normal in the dimensions of the scene"});
    check_refused(with([](input& of) {
                      of.floor.planes.push_back({.point = {0, not_a_number}, .normal = {0, 1}});
                  }),
                  {"dem::walls", "the point of wall 1 has a coordinate nan m", "give finite numbers"});
    const auto falling = thrown<tsubu::input_error>([] { gravity{{0, -infinity}}.check(); });
    CHECK(says(falling, "dem::gravity: an acceleration of -inf m/s^2; give finite numbers"));
}
TEST_CASE("a time step past the limit is refused where contacts tell it", "[dem][bad_input][guards]") {
    // Two overlap by a little: 2 / sqrt(2 k / m), and of the walls none.
    const auto touching = [](double time_step, double gamma) {
        return with([=](input& of) {
            of.x = {5, 2.99};
            of.law = hooke_dashpot<>{{1e5, gamma}};
            of.how.time_step = time_step;
            of.how.guard.coordinates = false;
        });
    };
    // With the damping of the half step: omega^2 = 2 k / m, and gamma of the pair for a damping rate.
    const double omega = std::sqrt(2 * 1e5);
    for (const double ratio : {0.0, .1, 1.0}) {
        const double limit = 2 * (std::sqrt(1 + ratio * ratio) - ratio) / omega;
        const double gamma = 2 * ratio * omega;
        check_refused(touching(1.01 * limit, gamma),
                      {"dem::run: step 0: a time step of", "contacts that are stable up to",
                       tsubu::detail::shown(limit).substr(0, 7).c_str(), "take a smaller time step, softer contacts or",
                       "guards::time_step off"});
        CHECK(messages(1, touching(.99 * limit, gamma))[0] == "nothing was thrown");
    }
    auto unguarded = touching(1.01 * 2 / omega, 0);
    unguarded.how.guard = no_guards;
    CHECK(messages(1, unguarded)[0] == "nothing was thrown");
}
TEST_CASE("coordinates that freeze are refused, others are not", "[dem][bad_input][guards]") {
    // At x between 4 and 8 a unit in the last place is 2^-50; all others stand still.
    const double unit = 0x1p-50;
    const auto at_speed = [&](double units, bool is_guarded) {
        std::string said;
        tsubu::run_ranks(1, [&](local_transport& on) {
            said = thrown<tsubu::input_error>([&] {
                run_type of(scene::box_type({0, -1}, {10, 10}, {.periodic = {true, false}}),
                            {.time_step = 1e-4, .skin = .1, .guard = {.coordinates = is_guarded}}, on,
                            hooke_dashpot<>{{1e5, 10}}, walls{}, spheres{});
                of.particles().push_back(tsubu::id = 1, tsubu::position<2> = {5, 5}, tsubu::radius = .5,
                                         tsubu::mass = 1.0, tsubu::velocity<2> = {units * unit / 1e-4, 0});
                of.start();
                of.steps(1000);
                // It moves at all if it is not frozen.
                CHECK((of.position(0)[0] > 5) == (units > .5));
            });
        });
        return said;
    };
    const auto frozen = at_speed(.49, true);
    INFO(frozen);
    CHECK(says(frozen, "dem::run: step 0: frozen coordinates: a time step of 1e-04 s"));
    CHECK(says(frozen, "moves the fastest particle by 0.49"));
    CHECK(says(frozen, "units in the last place of its position, less than a half"));
    CHECK(says(frozen, "shift the origin to the particles, or take lattice<std::int64_t> or a longer time step"));
    CHECK(at_speed(.49, false) == "nothing was thrown");
    CHECK(at_speed(4.1, true) == "nothing was thrown");
}
TEST_CASE("a scene at rest that begins to move is refused, where that is watched", "[dem][bad_input][guards]") {
    // Above the limit of the time step, and with the guard of that off: a sphere between two walls, all but at rest.
    const auto after = [](double time_step, double floor) {
        std::string said;
        tsubu::run_ranks(1, [&](local_transport& on) {
            run_type of(scene::box_type({0, -1}, {10, 10}, {.periodic = {true, false}}),
                        {.time_step = time_step,
                         .skin = .1,
                         .guard = {.every = 10, .time_step = false, .energy_floor = floor}},
                        on, hooke_dashpot<>{{1, .01}},
                        walls{{{.point = {0, 0}, .normal = {0, 1}}, {.point = {0, .9}, .normal = {0, -1}}}}, spheres{});
            of.particles().push_back(tsubu::id = 1, tsubu::position<2> = {5, .4501}, tsubu::radius = .5,
                                     tsubu::mass = 1.0);
            of.start();
            said = thrown<tsubu::input_error>([&] { of.steps(400); });
        });
        return said;
    };
    const double limit = 2 / std::sqrt(2.0);
    const auto text = after(1.02 * limit, 1e-8);
    INFO(text);
    CHECK(says(text, "a kinetic energy of"));
    CHECK(says(text, "after it was below the floor of 1e-08 J"));
    CHECK(says(text, "take a smaller time step"));
    CHECK(after(.98 * limit, 1e-8) == "nothing was thrown");
    CHECK(after(1.02 * limit, 0) == "nothing was thrown");
}
TEST_CASE("what is not a number on the way is found at the next list", "[dem][bad_input]") {
    // Two at one place: there is no direction between them.
    check_refused(with([](input& of) {
                      of.x = {5, 2};
                      of.how.guard = no_guards;
                      of.steps = 3;
                  }),
                  {"nan"});
}
TEST_CASE("bonds without a spring, and springs that are out of reach, are refused", "[dem][bad_input]") {
    const auto said = [](double k, std::int64_t length, double cutoff, std::size_t kinds) {
        std::vector<std::string> texts(2);
        tsubu::run_ranks(2, [&](local_transport& on) {
            using chain = chain_scene<>::simulation;
            texts[on.rank()] = thrown<tsubu::input_error>([&] {
                springs law;
                for (std::size_t n = 0; n < kinds; ++n) law.kinds.push_back({.k = k, .length = 1});
                run<chain, local_transport> of(chain::box_type({0}, {10}),
                                               {.time_step = .1, .skin = .1, .cutoff = cutoff, .guard = no_guards}, on,
                                               law, spheres{});
                if (on.rank() == 0)
                    for (std::int64_t n = 0; n < 10; ++n) {
                        const auto i = of.particles().push_back(tsubu::id = n, tsubu::radius = .1, tsubu::mass = 1.0,
                                                                tsubu::position<1> = {.5 + static_cast<double>(n)});
                        for (const auto other : {n - length, n + length})
                            if (other >= 0 && other < 10)
                                of.particles()[tsubu::bonds][i].push_back({.type = 1, .ids = {n, other}});
                    }
                of.start();
            });
        });
        CHECK((texts[0] == "nothing was thrown") == (texts[1] == "nothing was thrown"));
        return texts[0];
    };
    CHECK(said(1, 1, 1.5, 1) == "nothing was thrown");
    CHECK(says(said(1, 0, 2, 1), "has a bond between 0 and 0"));
    CHECK(says(said(-1, 1, 1.5, 1),
               "dem::springs: springs of type 1 with k = -1 N/m and length 1 m; give finite numbers"));
    const auto unknown = said(1, 1, 1.5, 0);
    INFO(unknown);
    CHECK(says(unknown, "a bond of type 1, of 0 kinds of springs"));
    CHECK(says(unknown, "give a spring for each type of bond"));
    const auto far = said(1, 3, 1.5, 1);
    INFO(far);
    CHECK(says(far, "springs end at a particle that is not near this rank"));
    CHECK(says(far, "options::cutoff"));
}
TEST_CASE("bodies that are all alike are checked before any is there", "[dem][bad_input]") {
    const auto said = [](double radius, double mass) {
        return thrown<tsubu::input_error>([&] { equal_spheres{radius, mass}.check(); });
    };
    CHECK(said(.5, 1) == "nothing was thrown");
    CHECK(says(said(-1, 1), "dem::equal_spheres: radius = -1 m; give a finite number above 0"));
    CHECK(says(said(not_a_number, 1), "radius = nan m"));
    CHECK(says(said(infinity, 1), "radius = inf m"));
    CHECK(says(said(.5, 0),
               "dem::equal_spheres: mass = 0 kg; give a finite number above 0; to hold particles fast take spheres"));
    CHECK(says(said(.5, infinity), "mass = inf kg"));
}
