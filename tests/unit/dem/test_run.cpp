// SPDX-License-Identifier: MIT
// A run that is changed on its way: particles come and go, contacts go on.
#include <tsubu/dem/run.hpp>

#include <tsubu/comm/local_transport.hpp>
#include <tsubu/core/random.hpp>
#include <tsubu/dem/explicit_euler.hpp>
#include <tsubu/dem/laws/rolling_resistance.hpp>
#include <tsubu/dem/measure.hpp>
#include <tsubu/dem/pefrl.hpp>
#include <tsubu/dem/springs.hpp>
#include <tsubu/dem/stability.hpp>
#include <tsubu/dem/velocity_verlet.hpp>

#include "support/catch.hpp"
#include "unit/thrown.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace {

using namespace tsubu::dem;
using tsubu::local_transport;

using scene = simulation<2, double, velocity_verlet, hooke_dashpot<linear_history>, equal_spheres>;
using quantities_type = scene::quantities_type;
constexpr auto contacts = quantities_type::contacts<2>;
using places = std::map<std::int64_t, tsubu::vec<2>>;

// Without a dashpot along the normal: it sees velocities of the half step on the way, and of the full step at a start.
const hooke_dashpot<linear_history> law{{.k = 1e4, .gamma = 0}, {.k_t = 2e3, .mu = .6}};
constexpr options steady{.time_step = 1e-4, .skin = .05, .guard = no_guards};

auto empty_run(local_transport& on, const options& how = steady) {
    return make_run<scene>(scene::box_type({0, 0}, {12, 6}, {.periodic = {true, true}}), how, on, law,
                           equal_spheres{.radius = .5, .mass = 1});
}
template <class Store>
void add(Store& store, std::int64_t id, const tsubu::vec<2>& x, const tsubu::vec<2>& v) {
    store.push_back(tsubu::id = id, tsubu::position<2> = x, tsubu::velocity<2> = v);
}
/// Three in a row that touch, across the border of two ranks, and slide past each other; and two that are far from all.
template <class Store>
void add_row_and_bystanders(Store& store) {
    add(store, 1, {5.1, 3}, {0, .5});
    add(store, 2, {6.05, 3}, {0, 0});
    add(store, 3, {7, 3}, {0, .5});
    add(store, 8, {1, 1}, {0, 0});
    add(store, 9, {11, 5}, {0, 0});
}
/// Where particles are after 50 steps, `between` and 50 more, on so many ranks.
template <class Between>
places after(std::size_t ranks, Between&& between) {
    places result;
    std::mutex one_at_a_time;
    tsubu::run_ranks(ranks, [&](local_transport& on) {
        auto row = empty_run(on);
        if (on.rank() == 0) add_row_and_bystanders(row.particles());
        row.start();
        row.steps(50);
        between(row);
        row.steps(50);
        const std::lock_guard hold(one_at_a_time);
        for (std::size_t i = 0; i < row.particles().owned_count(); ++i)
            result[row.particles()[tsubu::id][i]] = row.position(static_cast<tsubu::index_t>(i));
    });
    return result;
}
template <class Store>
void take_away(Store& store, std::int64_t id) {
    for (std::size_t i = store.owned_count(); i-- > 0;)
        if (store[tsubu::id][i] == id) store.swap_remove(i);
}

}  // namespace

TEST_CASE("contacts keep their history when others come or go", "[dem][run][history]") {
    for (const std::size_t ranks : {1U, 2U, 3U}) {
        INFO(ranks << " ranks");
        const auto undisturbed = after(ranks, [](auto&) {});
        const auto changed = after(ranks, [](auto& row) {
            row.change([&](auto& store) {
                take_away(store, 8);
                if (row.on().rank() == 0) add(store, 10, {3, 1}, {0, 0});
            });
        });
        CHECK(changed.size() == 5);
        CHECK(changed.count(8) == 0);
        for (const auto id : {1, 2, 3, 9}) CHECK(changed.at(id) == undisturbed.at(id));
        // A start is a new beginning: their springs are lost, and the row goes elsewhere.
        const auto begun_anew = after(ranks, [](auto& row) { row.start(); });
        CHECK(std::abs(begun_anew.at(1)[1] - undisturbed.at(1)[1]) > 1e-6);
    }
}
TEST_CASE("a contact ends with its particle, and others go on", "[dem][run][history]") {
    for (const std::size_t ranks : {1U, 2U, 3U}) {
        INFO(ranks << " ranks");
        const auto changed = after(ranks, [](auto& row) { row.change([](auto& store) { take_away(store, 3); }); });
        CHECK(changed.size() == 4);
        const auto on_one = after(1, [](auto& row) { row.change([](auto& store) { take_away(store, 3); }); });
        for (const auto& [id, x] : changed)
            for (std::size_t k = 0; k < 2; ++k) CHECK(x[k] == Approx(on_one.at(id)[k]).epsilon(1e-13));
    }
}
TEST_CASE("what a change throws is thrown on all ranks", "[dem][run]") {
    std::vector<std::string> said(2);
    tsubu::run_ranks(2, [&](local_transport& on) {
        auto row = empty_run(on);
        if (on.rank() == 0) add_row_and_bystanders(row.particles());
        row.start();
        said[on.rank()] = thrown<tsubu::input_error>([&] {
            row.change([&](auto&) {
                if (on.rank() == 1) throw tsubu::input_error("no more");
            });
        });
        row.start();
        row.steps(1);
    });
    CHECK(says(said[1], "no more"));
    CHECK(says(said[0], "dem::run::change"));
}
TEST_CASE("particles that were added behind the back of a run are refused", "[dem][run][bad_input]") {
    std::vector<std::string> said(2);
    tsubu::run_ranks(2, [&](local_transport& on) {
        auto row = empty_run(on);
        if (on.rank() == 0) add_row_and_bystanders(row.particles());
        row.start();
        row.particles().clear_ghosts();
        if (on.rank() == 0) add(row.particles(), 10, {3, 1}, {0, 0});
        said[on.rank()] = thrown<tsubu::input_error>([&] { row.steps(1); });
    });
    for (const auto& text : said) {
        CHECK(says(text, "dem::run::steps"));
        CHECK(says(text, "add and remove particles by run::change, or start again"));
    }
}
TEST_CASE("a history that was kept for a file is not taken up again later", "[dem][run][history]") {
    tsubu::run_ranks(1, [](local_transport& on) {
        auto row = empty_run(on);
        add_row_and_bystanders(row.particles());
        row.start();
        row.steps(20);
        row.keep_history();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < 5; ++i) kept += row.particles()[contacts][i].size();
        CHECK(kept == 4);
        row.steps(1);
        for (std::size_t i = 0; i < 5; ++i) CHECK(row.particles()[contacts][i].empty());
    });
}
TEST_CASE("contacts that part by more than the skin in a step end on any number of ranks", "[dem][run][history]") {
    for (const std::size_t ranks : {1U, 2U}) {
        INFO(ranks << " ranks");
        CHECK(after(ranks, [](auto& row) {
                  row.change([](auto& store) {
                      for (std::size_t i = 0; i < store.owned_count(); ++i)
                          store[tsubu::velocity<2>][i] = {2e4 * static_cast<double>(store[tsubu::id][i] - 2), 0};
                  });
                  row.steps(1);
                  row.change([](auto& store) {
                      for (std::size_t i = 0; i < store.owned_count(); ++i) store[tsubu::velocity<2>][i] = {0, 0};
                  });
              }).size() == 5);
    }
}
TEST_CASE("a guard sees ghosts where they are at the end of a step", "[dem][run][guards]") {
    // Two that fly into each other, all but without a force; pefrl ends its steps with a drift.
    using soft = simulation<1, double, pefrl, hooke<>, equal_spheres>;
    const auto refused = [](std::size_t ranks) {
        std::vector<std::string> said(ranks);
        tsubu::run_ranks(ranks, [&](local_transport& on) {
            auto pair = make_run<soft>(soft::box_type({0}, {10}, {.periodic = {false}}),
                                       {.time_step = .01, .skin = 1, .guard = {.every = 1}}, on, hooke<>{{1e-9}},
                                       equal_spheres{.radius = .5, .mass = 1});
            if (on.rank() == 0) {
                pair.particles().push_back(tsubu::id = 1, tsubu::position<1> = {4.503}, tsubu::velocity<1> = {1.0});
                pair.particles().push_back(tsubu::id = 2, tsubu::position<1> = {5.513}, tsubu::velocity<1> = {-1.0});
            }
            pair.start();
            said[on.rank()] = thrown<tsubu::input_error>([&] { pair.steps(100); });
        });
        return std::stod(said[0].substr(said[0].find("by ") + 3));  // the overlap
    };
    CHECK(refused(1) == Approx(.51).epsilon(1e-6));
    CHECK(refused(2) == Approx(.51).epsilon(1e-6));
}
TEST_CASE("the longest time step knows of friction that sticks, and of its dashpot", "[dem][run][guards]") {
    tsubu::run_ranks(1, [](local_transport& on) {
        auto row = make_run<scene>(scene::box_type({0, 0}, {12, 6}, {.periodic = {true, true}}), steady, on,
                                   hooke_dashpot<linear_history>{{1e4, 5}, {.k_t = 2e3, .mu = .6}},
                                   equal_spheres{.radius = .5, .mass = 1});
        add(row.particles(), 1, {5, 3}, {0, 0});
        add(row.particles(), 2, {5.99, 3}, {0, 0});
        row.start();
        const double omega = std::sqrt(2 * 1e4);
        const double ratio = 5 / (2 * omega);
        CHECK(greatest_frequency(row) == Approx(omega).epsilon(1e-12));
        CHECK(longest_time_step(row) == Approx(2 * (std::sqrt(1 + ratio * ratio) - ratio) / omega).epsilon(1e-12));
    });
    tsubu::run_ranks(1, [](local_transport& on) {
        auto stiff = make_run<scene>(scene::box_type({0, 0}, {12, 6}, {.periodic = {true, true}}), steady, on,
                                     hooke_dashpot<linear_history>{{1e4, 0}, {.k_t = 8e3, .mu = .6, .gamma_t = 300}},
                                     equal_spheres{.radius = .5, .mass = 1});
        add(stiff.particles(), 1, {5, 3}, {0, 0});
        add(stiff.particles(), 2, {5.99, 3}, {0, 0});
        stiff.start();
        // Along the surface: the slip of a solid sphere has the inertia m / (1 + 5/2).
        const double omega = std::sqrt(3.5 * 8e3 / .5);
        const double ratio = 3.5 * 300 / (2 * omega);
        CHECK(greatest_frequency(stiff) == Approx(omega).epsilon(1e-12));
        CHECK(longest_time_step(stiff) == Approx(2 * (std::sqrt(1 + ratio * ratio) - ratio) / omega).epsilon(1e-12));
    });
}
TEST_CASE("a stretched spring is stiff across its length too", "[dem][run][guards]") {
    // A cross: one mass in the middle of four that it is bound to. At rest two springs are stiff along each axis, and
    // four if they pull; twice that is the bound.
    using cross = simulation<2, double, velocity_verlet, springs, equal_spheres>;
    tsubu::run_ranks(1, [](local_transport& on) {
        const auto frequency = [&](double length) {
            auto of = make_run<cross>(cross::box_type({0, 0}, {12, 6}),
                                      {.time_step = 1e-4, .cutoff = 3, .guard = no_guards}, on,
                                      springs{{{.k = 100, .length = length}}}, equal_spheres{.radius = .5, .mass = 1});
            constexpr tsubu::vec<2> where[] = {{6, 3}, {7, 3}, {5, 3}, {6, 4}, {6, 2}};
            auto& store = of.particles();
            for (std::int64_t id = 0; id < 5; ++id) add(store, id, where[id], {0, 0});
            for (std::int64_t id = 1; id < 5; ++id)
                for (const auto end : {std::int64_t{0}, id})
                    store[tsubu::bonds][static_cast<std::size_t>(end)].push_back({.type = 1, .ids = {0, id}});
            of.start();
            return greatest_frequency(of);
        };
        CHECK(frequency(1) == Approx(std::sqrt(4 * 100.0)));
        CHECK(frequency(0) == Approx(std::sqrt(8 * 100.0)));
        CHECK(frequency(.5) == Approx(std::sqrt(6 * 100.0)));
    });
}
TEST_CASE("a packing that sticks and rolls is as stable as it is told to be", "[dem][run][guards]") {
    // A square lattice, periodic, all but at rest: its fastest mode has all spins alike, 20 k_t / m; or neighbours that
    // roll against each other.
    using bed =
        simulation<2, double, velocity_verlet, hooke_dashpot<linear_history, rolling_resistance>, equal_spheres>;
    const auto grows = [](const rolling_resistance& rolling, double k_t, double gamma_t, double share) {
        double energies[2] = {};
        tsubu::run_ranks(1, [&](local_transport& on) {
            const bed::contact_type of{{.k = 1e4, .gamma = 0}, {.k_t = k_t, .mu = 1e9, .gamma_t = gamma_t}, rolling};
            const auto made = [&](double time_step) {
                auto lattice = std::make_unique<run<bed, local_transport>>(
                    bed::box_type({0, 0}, {5.94, 5.94}, {.periodic = {true, true}}),
                    options{.time_step = time_step, .skin = .05, .guard = no_guards}, on, of,
                    equal_spheres{.radius = .5, .mass = 1});
                tsubu::random_stream random(5);
                for (int n = 0; n < 36; ++n)
                    lattice->particles().push_back(
                        tsubu::id = n, tsubu::position<2> = {.495 + .99 * (n % 6), .495 + .99 * (n / 6)},
                        tsubu::velocity<2> = {1e-6 * (random.unit() - .5), 1e-6 * (random.unit() - .5)},
                        tsubu::angular_velocity<2> = {1e-6 * (1 + random.unit())});
                lattice->start();
                return lattice;
            };
            const double limit = longest_time_step(*made(1e-9));
            if (gamma_t == 0 && rolling.mu_r < .1) CHECK(limit == Approx(2 / std::sqrt(20 * k_t)).epsilon(1e-3));
            const auto lattice = made(share * limit);
            for (double& energy : energies) {
                energy = kinetic_energy(*lattice) + rotational_energy(*lattice);
                lattice->steps(400);
            }
        });
        return !(energies[1] < 1e3 * energies[0]);
    };
    const rolling_resistance little{.mu_r = 1e-3};
    CHECK_FALSE(grows(little, 2e4 / 7, 0, .99));
    CHECK(grows(little, 2e4 / 7, 0, 1.01));
    CHECK_FALSE(grows(little, 2e4 / 7, 1e4, .99));
    CHECK(grows(little, 2e4 / 7, 1e4, 1.02));
    CHECK_FALSE(grows({.mu_r = 1}, 1e3, 0, .99));
    CHECK(grows({.mu_r = 1}, 1e3, 0, 1.25));
}
TEST_CASE("memory may be reserved while a run goes on", "[dem][run]") {
    tsubu::run_ranks(2, [](local_transport& on) {
        auto row = empty_run(on);
        if (on.rank() == 0) add_row_and_bystanders(row.particles());
        row.start();
        row.steps(10);
        row.particles().reserve(10000);
        row.steps(10);
        CHECK(particle_count(row) == 5);
        // Beside the particles: 8 bytes for each pair, and its history.
        const auto lists = row.memory_bytes() - row.particles().memory_bytes();
        CHECK(lists >= row.pairs().size() * (8 + sizeof(tsubu::vec<2>)));
        CHECK(lists < 100000);
    });
}
TEST_CASE("a history that cannot be is refused with both ids", "[dem][run][history][bad_input]") {
    const auto refusal = [](auto&& spoil) {
        std::string said;
        tsubu::run_ranks(1, [&](local_transport& on) {
            auto row = empty_run(on);
            add_row_and_bystanders(row.particles());
            row.start();
            row.keep_history();
            auto& store = row.particles();
            for (std::size_t i = 0; i < store.owned_count(); ++i)
                if (store[tsubu::id][i] == 3) spoil(*store[contacts][i].begin());
            said = thrown<tsubu::input_error>([&] { row.resume(); });
        });
        return said;
    };
    const auto no_number = refusal([](auto& contact) { contact.history[1] = NAN; });
    INFO(no_number);
    CHECK(says(no_number, "dem::run::start: particle 3 has a history of nan with 2; give finite numbers, or clear the "
                          "field"));
    const auto said = refusal([](auto& contact) { contact.partner = 77; });
    INFO(said);
    CHECK(says(said, "dem::run::start: particle 3 remembers a contact with 77, which is not near it on this rank"));
    CHECK(says(said, "insert both of them, or clear the field `contacts`"));
}
TEST_CASE("an id that two particles have, and a spin that is no number, are refused on all ranks",
          "[dem][run][bad_input]") {
    for (const bool is_twice : {true, false}) {
        std::vector<std::string> said(2);
        tsubu::run_ranks(2, [&](local_transport& on) {
            auto row = empty_run(on);
            if (on.rank() == 0) add_row_and_bystanders(row.particles());
            if (on.rank() == 1) add(row.particles(), is_twice ? 9 : 10, {3, 1}, {0, 0});
            if (on.rank() == 1 && !is_twice) row.particles()[quantities_type::angular_velocity][0][0] = NAN;
            said[on.rank()] = thrown<tsubu::input_error>([&] { row.start(); });
        });
        INFO(said[0] << '\n' << said[1]);
        if (is_twice) {
            CHECK(says(said[0] + said[1], "dem::run::start: ids that more than one particle has: 1, among them 9"));
            CHECK(says(said[0], "give each particle its own"));
            CHECK(says(said[1], "give each particle its own"));
        } else {
            CHECK(says(said[0], "rank 1 refused the input"));
            CHECK(says(said[1], "particle 10 has an angular velocity of nan rad/s; give finite numbers"));
        }
    }
}
TEST_CASE("a periodic box that leaves open which image is touched is refused", "[dem][run][history][bad_input]") {
    const auto said = [](double width) {
        std::string text;
        tsubu::run_ranks(1, [&](local_transport& on) {
            text = thrown<tsubu::input_error>([&] {
                auto row = make_run<scene>(scene::box_type({0, 0}, {width, 6}, {.periodic = {true, true}}), steady, on,
                                           law, equal_spheres{.radius = .5, .mass = 1});
                add(row.particles(), 1, {1, 3}, {0, 0});
                row.start();
            });
        });
        return text;
    };
    // Two diameters and two skins.
    CHECK(said(2.11) == "nothing was thrown");
    const auto text = said(2.1);
    INFO(text);
    CHECK(says(text, "dem::run: a periodic box of 2.1 m along axis 0, and neighbours up to 1.05 m"));
    CHECK(says(text, "take a box of more than twice that"));
}
TEST_CASE("an integrator that no time step makes stable is refused", "[dem][run][guards][bad_input]") {
    using growing = simulation<1, double, explicit_euler, hooke<>, equal_spheres>;
    std::string said;
    tsubu::run_ranks(1, [&](local_transport& on) {
        auto two = make_run<growing>(growing::box_type({0}, {12}, {.periodic = {true}}),
                                     {.time_step = 1e-9, .skin = .05, .guard = {.coordinates = false}}, on,
                                     hooke<>{{1e4}}, equal_spheres{.radius = .5, .mass = 1});
        two.particles().push_back(tsubu::id = 1, tsubu::position<1> = {5});
        two.particles().push_back(tsubu::id = 2, tsubu::position<1> = {5.9});
        said = thrown<tsubu::input_error>([&] { two.start(); });
    });
    INFO(said);
    CHECK(says(said, "no time step is stable with this integrator and contacts without damping"));
    CHECK(says(said, "take velocity_verlet"));
}
