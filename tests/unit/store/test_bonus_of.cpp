// SPDX-License-Identifier: MIT
#include <tsubu/store/bonus_of.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/last_words.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace {

using axes = std::array<double, 3>;
constexpr tsubu::field<"shape", tsubu::bonus_of<axes>> shape{};
using set = tsubu::fields<tsubu::id, shape>;

struct model_particle {
    std::int64_t t = 0;
    std::optional<axes> shape;
};

/// Values and owners that disagree with the model, or with each other.
template <class Store>
std::size_t wrong(const Store& g, const std::vector<model_particle>& model) {
    std::size_t sum = g.size() == model.size() ? 0 : 1;
    std::size_t held = 0;
    const auto shapes = g[shape];
    for (std::size_t i = 0; i < model.size() && sum == 0; ++i) {
        const auto one = shapes[i];
        held += model[i].shape ? 1U : 0U;
        sum += g[tsubu::id][i] == model[i].t && one.has_value() == model[i].shape.has_value() &&
                       (!one || *one == *model[i].shape)
                   ? 0U
                   : 1U;
    }
    sum += shapes.values().size() == held && shapes.owners().size() == held ? 0U : 1U;
    for (std::size_t k = 0; k < held && sum == 0; ++k)  // the back-pointer: bonus[place[i]].owner == i
        sum += &*shapes[static_cast<std::size_t>(shapes.owners()[k])] == &shapes.values()[k] ? 0U : 1U;
    return sum;
}

}  // namespace

TEMPLATE_TEST_CASE("what only some particles have stays theirs under 1e5 random operations", "[store]", tsubu::soa,
                   tsubu::aos, tsubu::aosoa<16>) {
    tsubu::particle_store<set, TestType> g;
    std::vector<model_particle> model;
    tsubu::random_stream random(99);
    std::int64_t next = 0;
    const auto add = [&] {
        g.push_back(tsubu::id = next);
        model.push_back({next++, {}});
    };
    for (int k = 0; k < 1000; ++k) add();
    for (int k = 0; k < 100'000; ++k) {
        const auto dice = random.below(1000);
        if (dice < 100 || model.empty()) {
            add();
            continue;
        }
        const auto i = dice % 7 == 0 ? model.size() - 1 : random.below(model.size());
        if (dice < 200) {
            g.swap_remove(i);
            model[i] = model.back();
            model.pop_back();
        } else if (dice < 201) {
            std::vector<tsubu::index_t> order(model.size());
            for (std::size_t j = 0; j < order.size(); ++j) order[j] = static_cast<tsubu::index_t>(j);
            for (std::size_t j = order.size(); j > 1; --j) std::swap(order[j - 1], order[random.below(j)]);
            g.permute(order);
            auto after = model;
            for (std::size_t j = 0; j < order.size(); ++j) after[j] = model[static_cast<std::size_t>(order[j])];
            model = after;
        } else if (dice < 202) {
            const auto mine = g.owned();
            std::sort(mine.begin(), mine.end(),
                      [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
            std::sort(model.begin(), model.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        } else if (dice < 203) {
            for (int n = 0; n < 20; ++n) {
                const auto ghost = static_cast<std::size_t>(g.push_back_ghost());
                if (n % 3 != 0) g[shape][ghost].emplace({7, 7, 7});
            }
            g.clear_ghosts();
        } else if (dice < 300) {
            const auto j = random.below(model.size());
            swap(g[i], g[j]);
            std::swap(model[i], model[j]);
        } else if (dice < 500) {
            g[shape][i].reset();
            model[i].shape.reset();
        } else {
            const axes value{random.unit(), random.unit(), static_cast<double>(k)};
            g[shape][i].emplace(value);
            model[i].shape = value;
        }
        if (k % 997 == 0) REQUIRE(wrong(g, model) == 0);
    }
    CHECK(wrong(g, model) == 0);
}

TEST_CASE("the first, the last and the only value are taken away alike", "[store]") {
    tsubu::particle_store<set> g;
    g.add_owned(3);
    for (std::size_t i = 0; i < 3; ++i) g[shape][i].emplace({static_cast<double>(i), 0, 0});
    g[shape][2].reset();
    g[shape][2].reset();  // again: nothing
    CHECK_FALSE(g[shape][2].has_value());
    g[shape][0].reset();
    CHECK((*g[shape][1])[0] == 1);
    g.swap_remove(1);
    CHECK(g[shape].values().empty());
    g[shape][1].emplace({5, 0, 0});
    CHECK(g[shape].owners()[0] == 1);
    CHECK(g[shape][1]->at(0) == 5);
    g.clear();
    CHECK(g[shape].values().empty());
}

TEST_CASE("a value that lies in the pool can be given to another particle, also where the pool grows", "[store]") {
    tsubu::particle_store<set> g;
    const std::size_t count = tsubu::bonus_block + 1;
    g.add_owned(count);
    g[shape][0].emplace({1, 2, 3});
    for (std::size_t i = 1; i < count; ++i) g[shape][i].emplace(*g[shape][i - 1]);
    CHECK(*g[shape][count - 1] == axes{1, 2, 3});
    CHECK(g[shape].values().size() == count);
}

TEST_CASE("memory for values comes in blocks of 8192", "[store][C2]") {
    tsubu::particle_store<set> g;
    g.push_back();
    const auto before = g.memory_bytes();
    g[shape][0].emplace({});
    CHECK(g.memory_bytes() - before == 8192 * (sizeof(axes) + sizeof(tsubu::index_t)));
}

TEST_CASE("values that only some have are walked particle by particle", "[store]") {
    tsubu::particle_store<set> g;
    g.add_owned(3);
    g[shape][tsubu::index_t{1}].emplace({1, 2, 3});
    std::vector<bool> found;
    for (const auto one : g[shape]) found.push_back(one.has_value());
    CHECK(found == std::vector<bool>{false, true, false});
    std::size_t count = 0;
    for (const auto one : std::as_const(g).all()[shape]) count += one ? 1U : 0U;
    CHECK(count == 1);
}

TEST_CASE("the values of ghosts are found through their range", "[store]") {
    tsubu::particle_store<set> g;
    g.add_owned(2);
    g.add_ghosts(2);
    g.ghosts()[shape][1].emplace({4, 4, 4});
    CHECK(g[shape][3].has_value());
    CHECK(g[shape].owners()[0] == 3);
    g.ghosts()[shape][1].reset();
    CHECK_FALSE(g[shape][3].has_value());
}

#if defined(__unix__) && !defined(NDEBUG)
TEST_CASE("a value that is not there is told in debug builds", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back();
    CHECK(says(last_words([&] { static_cast<void>(*g[shape][0]); }), "this particle has no value of the field"));
    CHECK(says(last_words([&] { static_cast<void>(g[shape][1]); }), "no particle with this index"));
    const auto all = g[shape];
    const auto one = all[0];
    g.reserve(20'000);
    const auto ends = [](auto&& call) { return says(last_words(call), "older than its memory"); };
    CHECK(ends([&] { static_cast<void>(all[0]); }));
    CHECK(ends([&] { static_cast<void>(all.values()); }));
    CHECK(ends([&] { static_cast<void>(all.owners()); }));
    CHECK(ends([&] { static_cast<void>(one.has_value()); }));
    CHECK(ends([&] { one.emplace({}); }));
    CHECK(ends([&] { one.reset(); }));
}
#endif
