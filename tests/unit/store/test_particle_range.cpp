// SPDX-License-Identifier: MIT
#if defined(__clang__)
// The stable algorithms of libstdc++ 12 call its std::get_temporary_buffer, which it calls deprecated.
#pragma clang diagnostic ignored "-Wdeprecated-declarations"
#endif

#include <tsubu/store/particle_range.hpp>

#include <tsubu/core/random.hpp>
#include <tsubu/store/aos.hpp>
#include <tsubu/store/aosoa.hpp>
#include <tsubu/store/particle_store.hpp>
#include <tsubu/store/standard_fields.hpp>

#include "support/catch.hpp"
#include "unit/last_words.hpp"
#include "unit/thrown.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

constexpr tsubu::field<"marks", tsubu::list_of<std::int64_t>> marks{};
using set = tsubu::fields<tsubu::species, tsubu::id, tsubu::position<2>, marks>;

/// A particle of which each value says which one it is.
template <class Store>
void add(Store& g, std::int64_t t, std::int32_t kind) {
    const auto i = static_cast<std::size_t>(
        g.push_back(tsubu::id = t, tsubu::species = kind, tsubu::position<2> = {static_cast<double>(t), 0.5}));
    for (std::int64_t k = 0; k < t % 4; ++k) g[marks][i].push_back(t);
}
template <class Reference>
bool is_whole(const Reference& grain) {
    const auto t = grain[tsubu::id];
    const auto list = grain[marks];
    return grain[tsubu::position<2>][0] == static_cast<double>(t) &&
           list.size() == static_cast<std::size_t>(t % 4) &&
           std::all_of(list.begin(), list.end(), [&](std::int64_t mark) { return mark == t; });
}
template <class Store>
bool are_whole(const Store& g) {
    bool all = true;
    for (const auto grain : g.all()) all = all && is_whole(grain);
    return all;
}
template <class Layout>
auto shuffled(std::int64_t count) {
    tsubu::particle_store<set, Layout> g;
    for (std::int64_t k = 0; k < count; ++k) add(g, k * 7919 % count, static_cast<std::int32_t>(k % 10));
    return g;
}

}  // namespace

TEMPLATE_TEST_CASE("std::sort sorts particles, all of each", "[store]", tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    auto g = shuffled<TestType>(1000);
    const auto mine = g.owned();
    std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(std::is_sorted(g[tsubu::id].begin(), g[tsubu::id].end()));
    CHECK(are_whole(g));
    std::sort(mine.begin() + 10, mine.begin() + 20,
              [](const auto& a, const auto& b) { return a[tsubu::id] > b[tsubu::id]; });
    CHECK(g[tsubu::id][9] == 9);
    CHECK(g[tsubu::id][10] == 19);
    CHECK(g[tsubu::id][20] == 20);
    CHECK(are_whole(g));
}

TEMPLATE_TEST_CASE("std::stable_sort keeps the order of equals", "[store]", tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    auto g = shuffled<TestType>(1000);
    const auto mine = g.owned();
    const auto by_id = [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; };
    std::sort(mine.begin(), mine.end(), by_id);
    std::stable_sort(mine.begin(), mine.end(),
                     [](const auto& a, const auto& b) { return a[tsubu::species] < b[tsubu::species]; });
    bool in_order = true;
    for (std::size_t i = 1; i < g.size(); ++i)
        in_order = in_order && std::pair(g[tsubu::species][i - 1], g[tsubu::id][i - 1]) <
                                   std::pair(g[tsubu::species][i], g[tsubu::id][i]);
    CHECK(in_order);
    CHECK(are_whole(g));
}

TEST_CASE("other algorithms move particles too", "[store]") {
    auto g = shuffled<tsubu::soa>(100);
    const auto mine = g.owned();
    const auto first = g[tsubu::id][0];
    std::reverse(mine.begin(), mine.end());
    CHECK(g[tsubu::id][99] == first);
    std::rotate(mine.begin(), mine.begin() + 99, mine.end());
    CHECK(g[tsubu::id][0] == first);
    const auto middle = std::partition(mine.begin(), mine.end(), [](const auto& a) { return a[tsubu::id] < 50; });
    CHECK(middle - mine.begin() == 50);
    std::nth_element(mine.begin(), mine.begin() + 30, mine.end(),
                     [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(g[tsubu::id][30] == 30);
    std::make_heap(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
    CHECK(g[tsubu::id][0] == 99);
    CHECK(are_whole(g));
}

TEMPLATE_TEST_CASE("swapping references swaps particles, named or not", "[store]", tsubu::soa, tsubu::aos,
                   tsubu::aosoa<5>) {
    auto g = shuffled<TestType>(10);
    const auto t0 = g[tsubu::id][0];
    const auto t3 = g[tsubu::id][3];
    using std::swap;
    swap(g[0], g[3]);
    CHECK(g[tsubu::id][0] == t3);
    CHECK(g[tsubu::id][3] == t0);
    auto a = g[0];
    auto b = g[3];
    swap(a, b);
    CHECK(g[tsubu::id][0] == t0);
    CHECK(g[tsubu::id][3] == t3);
    const auto c = g[0];
    const auto d = g[3];
    swap(c, d);
    CHECK(g[tsubu::id][0] == t3);
    swap(c, c);
    CHECK(g[tsubu::id][0] == t3);
    const auto mine = g.owned();
    std::iter_swap(mine.begin(), mine.begin() + 3);
    CHECK(g[tsubu::id][0] == t0);
    CHECK(are_whole(g));
}

TEST_CASE("a reference reads and writes the fields of one particle", "[store]") {
    auto g = shuffled<tsubu::aos>(5);
    const auto grain = g[2];
    CHECK(grain.index() == 2);
    grain[tsubu::position<2>][1] = 8;
    CHECK(g[tsubu::position<2>][2][1] == 8);
    const auto& read = g;
    CHECK(read[2][tsubu::position<2>][1] == 8);
    STATIC_REQUIRE(std::is_same_v<decltype(read[2][tsubu::id]), const std::int64_t&>);
    const typename decltype(g)::record kept = g[2];
    CHECK(kept[tsubu::id] == g[tsubu::id][2]);
    CHECK(kept[tsubu::position<2>][1] == 8);
    tsubu::particle_store<tsubu::fields<tsubu::id, tsubu::radius>> plain;
    plain.push_back(tsubu::id = 1, tsubu::radius = 2.0);
    plain.push_back(tsubu::id = 3, tsubu::radius = 4.0);
    plain[0] = plain[1];
    CHECK(plain[tsubu::radius][0] == 4);
    CHECK(plain[tsubu::id][0] == 3);
}

TEST_CASE("ranges over owned, ghosts and all", "[store]") {
    tsubu::particle_store<set> g;
    add(g, 1, 0);
    add(g, 2, 0);
    g.push_back_ghost(tsubu::id = 8);
    CHECK(g.owned().size() == 2);
    CHECK(g.ghosts().size() == 1);
    CHECK(g.all().size() == 3);
    CHECK(g.ghosts()[0][tsubu::id] == 8);
    CHECK(g.ghosts()[tsubu::id][0] == 8);
    CHECK(g.ghosts()[0].index() == 2);
    CHECK(g.owned()[tsubu::id].size() == 2);
    CHECK_FALSE(g.ghosts().empty());
    g.clear_ghosts();
    CHECK(g.ghosts().empty());
    CHECK(g.ghosts().begin() == g.ghosts().end());
    const auto mine = std::as_const(g).owned();
    CHECK(mine.end() - mine.begin() == 2);
    CHECK((*(mine.begin() + 1))[tsubu::id] == 2);
    CHECK(mine.begin()[1][tsubu::id] == 2);
}

namespace {

constexpr tsubu::field<"charge", tsubu::bonus_of<double>> charge{};
constexpr tsubu::field<"weights", tsubu::list_of<float>> weights{};
using rich = tsubu::fields<tsubu::id, marks, charge, tsubu::radius, weights>;

struct model_particle {
    std::int64_t t = 0;
    std::vector<std::int64_t> marks;
    std::optional<double> charge;
    double radius = 0;
    std::vector<float> weights;

    /// What lies in pools goes, the rest stays.
    model_particle taken() {
        auto all = *this;
        marks.clear();
        charge.reset();
        weights.clear();
        return all;
    }
};
template <class Reference>
bool is_same(const Reference& grain, const model_particle& expected) {
    return grain[tsubu::id] == expected.t && grain[tsubu::radius] == expected.radius &&
           std::equal(grain[marks].begin(), grain[marks].end(), expected.marks.begin(), expected.marks.end()) &&
           std::equal(grain[weights].begin(), grain[weights].end(), expected.weights.begin(), expected.weights.end()) &&
           grain[charge].has_value() == expected.charge.has_value() &&
           (!expected.charge || *grain[charge] == *expected.charge);
}
/// Lists of the field that have an element in common, and values that are not their particle's.
template <class Store>
std::size_t shared(const Store& g) {
    std::vector<std::pair<const std::int64_t*, const std::int64_t*>> lists;
    for (const auto grain : g.all())
        if (!grain[marks].empty()) lists.emplace_back(grain[marks].begin(), grain[marks].end());
    std::sort(lists.begin(), lists.end());
    std::size_t sum = 0;
    for (std::size_t k = 1; k < lists.size(); ++k) sum += lists[k].first < lists[k - 1].second ? 1U : 0U;
    std::size_t held = 0;
    for (const auto grain : g.all()) held += grain[charge].has_value() ? 1U : 0U;
    const auto charges = g[charge];
    sum += charges.values().size() == held ? 0U : 1U;
    for (std::size_t k = 0; k < charges.values().size(); ++k)
        sum += &*charges[static_cast<std::size_t>(charges.owners()[k])] == &charges.values()[k] ? 0U : 1U;
    return sum;
}

/// A store and its model, to which the same is done; ids are all different.
template <class Layout>
class moving_twins {
public:
    explicit moving_twins(std::uint64_t seed) : random_(seed) {
        for (int k = 0; k < 60; ++k) add();
        other_ = g_;
        other_model_ = model_;
    }
    /// One random operation. The rows that it wrote to are compared at once.
    void step() {
        const auto count = model_.size();
        if (count < 40) return add();
        const auto i = random_.below(count);
        const auto j = random_.below(count);
        const auto mine = g_.owned();
        const auto at = [&](std::size_t k) { return mine.begin() + static_cast<std::ptrdiff_t>(k); };
        switch (random_.below(24)) {
            case 0:
                return add();
            case 1:
                if (random_.below(2) == 0) return remove_some();
                g_.swap_remove(i);
                model_[i] = model_.back();
                return model_.pop_back();
            case 2:
                g_[i] = g_[j];
                model_[i] = model_[j];
                break;
            case 3: {
                const auto a = g_[i];
                const auto b = g_[j];
                a = b;
                model_[i] = model_[j];
                break;
            }
            case 4:
                *at(i) = *at(j);
                model_[i] = model_[j];
                break;
            case 5:
                *at(i) = std::move(*at(j));
                if (i != j) model_[i] = model_[j].taken();
                break;
            case 6: {  // as an insertion sort holds one
                typename tsubu::particle_store<rich, Layout>::record held = std::move(*at(i));
                const auto model_held = model_[i].taken();
                wrong_ += is_same(held, model_held) && is_same(g_[i], model_[i]) ? 0U : 1U;
                *at(i) = std::move(*at(j));
                if (i != j) model_[i] = model_[j].taken();
                *at(j) = std::move(held);
                model_[j] = model_held;
                break;
            }
            case 7: {
                const typename tsubu::particle_store<rich, Layout>::record held = g_[i];
                *at(j) = held;
                model_[j] = model_[i];
                wrong_ += is_same(held, model_[i]) ? 0U : 1U;
                break;
            }
            case 8: {  // one that is never given back
                const typename tsubu::particle_store<rich, Layout>::record held = std::move(*at(i));
                wrong_ += is_same(held, model_[i].taken()) ? 0U : 1U;
                break;
            }
            case 9:
                g_[i] = other_[j % other_model_.size()];
                model_[i] = other_model_[j % other_model_.size()];
                break;
            case 10:
                g_[i] = std::as_const(other_)[j % other_model_.size()];
                model_[i] = other_model_[j % other_model_.size()];
                break;
            case 11:  // between stores std::move copies
                *at(i) = std::move(*(other_.owned().begin() + static_cast<std::ptrdiff_t>(j % other_model_.size())));
                model_[i] = other_model_[j % other_model_.size()];
                break;
            case 12:
                swap(g_[i], g_[j]);
                std::swap(model_[i], model_[j]);
                break;
            case 13:
                return algorithm(i, j);
            case 14:
                if (random_.below(20) == 0) g_.compact();
                return;
            case 15:
                if (random_.below(20) != 0) return;
                other_ = g_;
                other_model_ = model_;
                return;
            case 16:
                g_[charge][i].reset();
                model_[i].charge.reset();
                break;
            case 17:
            case 18:
                model_[i].charge = random_.unit();
                g_[charge][i].emplace(*model_[i].charge);
                break;
            case 19:
                g_[marks][i].clear();
                model_[i].marks.clear();
                break;
            default:
                model_[i].marks.push_back(static_cast<std::int64_t>(random_()));
                g_[marks][i].push_back(model_[i].marks.back());
                g_[weights][i].push_back(0.5F);
                model_[i].weights.push_back(0.5F);
        }
        for (const auto k : {i, j}) {
            wrong_ += is_same(g_[k], model_[k]) ? 0U : 1U;
            if (k == i) g_[i][tsubu::id] = model_[i].t = next_++;  // all different again
            if (k == j) g_[j][tsubu::id] = model_[j].t = next_++;
        }
    }
    std::size_t wrong() {
        wrong_ += g_.size() == model_.size() ? shared(g_) + shared(other_) : 1U;
        for (std::size_t k = 0; k < model_.size(); ++k) wrong_ += is_same(g_[k], model_[k]) ? 0U : 1U;
        return wrong_;
    }

private:
    void add() {
        g_.push_back(tsubu::id = next_, tsubu::radius = 0.25 * static_cast<double>(next_));
        model_.push_back({next_, {}, {}, 0.25 * static_cast<double>(next_), {}});
        ++next_;
    }
    void remove_some() {
        std::vector<tsubu::index_t> gone;
        for (std::size_t i = 0; i < model_.size(); ++i)
            if (random_.below(16) == 0) gone.push_back(static_cast<tsubu::index_t>(i));
        g_.remove(gone);
        const auto kept = model_.size() - gone.size();
        auto hole = gone.begin();
        for (auto from = kept; from < model_.size(); ++from)
            if (std::find(gone.begin(), gone.end(), static_cast<tsubu::index_t>(from)) == gone.end())
                model_[static_cast<std::size_t>(*hole++)] = model_[from];
        model_.resize(kept);
    }
    /// On the particles from the lesser index on up to the greater.
    void algorithm(std::size_t i, std::size_t j) {
        const auto first = static_cast<std::ptrdiff_t>((std::min)(i, j));
        const auto last = static_cast<std::ptrdiff_t>((std::max)(i, j));
        const auto steps = random_.below(static_cast<std::uint64_t>(last - first) + 1);
        const auto middle = first + static_cast<std::ptrdiff_t>(steps);
        const auto dice = random_.below(8);
        const auto divisor = static_cast<std::int64_t>(2 + random_.below(5));
        const auto is_in = [&](const auto& a) { return a % divisor == 0; };
        const auto on_both = [&](auto&& call) {
            const auto mine = g_.owned();
            call(mine.begin() + first, mine.begin() + middle, mine.begin() + last,
                 [](const auto& a) { return a[tsubu::id]; });
            call(model_.begin() + first, model_.begin() + middle, model_.begin() + last,
                 [](const auto& a) { return a.t; });
        };
        on_both([&](auto from, auto between, auto to, auto t) {
            const auto less = [&](const auto& a, const auto& b) { return t(a) < t(b); };
            const auto chosen = [&](const auto& a) { return is_in(t(a)); };
            const auto before = [&](const auto& a, const auto& b) { return is_in(t(a)) && !is_in(t(b)); };
            switch (dice) {
                case 0:
                    return std::sort(from, to, less);
                case 1:
                    return std::stable_sort(from, to, before);
                case 2:
                    return static_cast<void>(std::rotate(from, between, to));
                case 3:
                    return static_cast<void>(std::stable_partition(from, to, chosen));
                case 4:
                    return std::reverse(from, to);
                case 5:
                    std::sort(from, between, less);
                    std::sort(between, to, less);
                    return std::inplace_merge(from, between, to, less);
                case 6:
                    std::make_heap(from, to, less);
                    return std::sort_heap(from, to, less);
                default:
                    return std::partial_sort(from, to, to, less);
            }
        });
        wrong_ += shared(g_);
    }

    tsubu::random_stream random_;
    tsubu::particle_store<rich, Layout> g_;
    tsubu::particle_store<rich, Layout> other_;
    std::vector<model_particle> model_;
    std::vector<model_particle> other_model_;
    std::int64_t next_ = 0;
    std::size_t wrong_ = 0;
};

}  // namespace

TEMPLATE_TEST_CASE("no two particles share a list or a value, whatever is assigned, sorted or held", "[store]",
                   tsubu::soa, tsubu::aos, tsubu::aosoa<5>) {
    const std::uint64_t seed = 77;
    moving_twins<TestType> both(seed);
    for (int k = 0; k < 100'000; ++k) {
        both.step();
        if (k % 499 == 0 && both.wrong() != 0) break;
    }
    INFO("seed " << seed);
    CHECK(both.wrong() == 0);
}

TEST_CASE("assigning a particle copies its lists; std::move gives them away", "[store]") {
    tsubu::particle_store<rich> g;
    g.add_owned(3);
    for (int k = 0; k < 3; ++k) g[marks][0].push_back(k);
    g[charge][0].emplace(0.5);
    g[1] = g[0];
    REQUIRE(g[marks][1].size() == 3);
    g[marks][1].push_back(8);
    g[marks][0].push_back(9);
    CHECK(g[marks][0][3] == 9);
    CHECK(g[marks][1][3] == 8);
    *g[charge][1] = 4;
    CHECK(*g[charge][0] == 0.5);
    g[1] = g[1];
    CHECK(g[marks][1].size() == 4);
    const auto mine = g.owned();
    auto given = mine[1];
    *(mine.begin() + 2) = std::move(given);
    CHECK(g[marks][1].empty());
    CHECK_FALSE(g[charge][1].has_value());
    CHECK(g[marks][2][3] == 8);
    CHECK(*g[charge][2] == 4);
    auto same = mine[2];
    *(mine.begin() + 2) = std::move(same);
    CHECK(g[marks][2].size() == 4);
    std::copy(mine.begin(), mine.begin() + 1, mine.begin() + 1);
    CHECK(g[marks][0].size() == 4);
    CHECK(g[marks][1].size() == 4);
    const decltype(g)::record held = g[0];
    std::fill(mine.begin(), mine.end(), held);
    CHECK(g[marks][2][3] == 9);
    CHECK(held[marks][3] == 9);
    CHECK(shared(g) == 0);
    STATIC_REQUIRE_FALSE(std::is_copy_constructible_v<decltype(g)::record>);  // two would own one list
}

TEST_CASE("particles that std::remove_if drops leave no list behind", "[store]") {
    tsubu::particle_store<rich> g;
    for (std::int64_t t = 0; t < 100; ++t) {
        const auto i = static_cast<std::size_t>(g.push_back(tsubu::id = t));
        g[marks][i].push_back(t);
        if (t % 2 == 0) g[charge][i].emplace(static_cast<double>(t));
    }
    const auto mine = g.owned();
    const auto end = std::remove_if(mine.begin(), mine.end(), [](const auto& a) { return a[tsubu::id] % 3 == 0; });
    const auto left = static_cast<std::size_t>(end - mine.begin());
    CHECK(left == 66);
    CHECK(shared(g) == 0);
    while (g.size() > left) g.swap_remove(g.size() - 1);
    for (std::size_t i = 0; i < left; ++i) {
        const auto t = g[tsubu::id][i];
        CHECK(t == static_cast<std::int64_t>(i / 2 * 3 + i % 2 + 1));
        CHECK(g[marks][i].size() == 1);
        CHECK(g[marks][i][0] == t);
        CHECK(g[charge][i].has_value() == (t % 2 == 0));
    }
    CHECK(g[charge].values().size() == 33);
}

TEST_CASE("a comparison may read lists, and values that only some have", "[store]") {
    tsubu::particle_store<rich, tsubu::aos> g;
    for (std::size_t k = 0; k < 200; ++k) {
        g.push_back(tsubu::id = static_cast<std::int64_t>(k));
        for (std::size_t n = 0; n < k * 7 % 20; ++n) g[marks][k].push_back(static_cast<std::int64_t>(n));
        if (k % 3 == 0) g[charge][k].emplace(-static_cast<double>(k));
    }
    const auto mine = g.owned();
    std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) {
        const auto last = [](const auto& list) { return list.empty() ? -1 : list[list.size() - 1]; };
        return std::pair(a[marks].size(), last(a[marks])) < std::pair(b[marks].size(), last(b[marks]));
    });
    for (std::size_t k = 1; k < 200; ++k) CHECK(g[marks][k - 1].size() <= g[marks][k].size());
    std::stable_sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) {
        return (a[charge].has_value() ? *a[charge] : 1.0) < (b[charge].has_value() ? *b[charge] : 1.0);
    });
    CHECK(*g[charge][0] == -198);
    CHECK_FALSE(g[charge][67].has_value());
    CHECK(shared(g) == 0);
}

#if defined(__unix__) && !defined(NDEBUG)
TEST_CASE("a reference to nothing, or swapped with another store's, is told in debug builds", "[store]") {
    auto g = shuffled<tsubu::soa>(3);
    auto h = shuffled<tsubu::soa>(3);
    CHECK(says(last_words([&] { static_cast<void>(g[3]); }), "no particle with this index"));
    CHECK(says(last_words([&] { static_cast<void>(g[-1]); }), "no particle with this index"));
    CHECK(says(last_words([&] { swap(g[0], h[0]); }), "particles of two stores do not swap"));
    CHECK(says(last_words([&] { static_cast<void>(g.owned()[3]); }), "no particle with this index"));
    const auto last = g[2];
    g.swap_remove(0);
    CHECK(says(last_words([&] { static_cast<void>(last[tsubu::id]); }), "no particle with this index"));
    CHECK(says(last_words([&] { last = g[0]; }), "no particle with this index"));
    CHECK(says(last_words([&] { g[0] = last; }), "no particle with this index"));
}

TEMPLATE_TEST_CASE("a range or a reference that is older than the memory says so in debug builds", "[store]",
                   tsubu::soa, tsubu::aos, tsubu::aosoa<16>) {
    auto g = shuffled<TestType>(3);
    const auto range = g.owned();
    const auto const_range = std::as_const(g).all();
    const auto grain = g[1];
    CHECK(grain[tsubu::id] == 2);
    g.reserve(g.capacity() + 1);
    const auto ends = [](auto&& call) {
        return says(last_words(call), "this view of a store is older than its memory");
    };
    CHECK(ends([&] { static_cast<void>(range.begin()); }));
    CHECK(ends([&] { static_cast<void>(range.end()); }));
    CHECK(ends([&] { static_cast<void>(range[0]); }));
    CHECK(ends([&] { static_cast<void>(range[tsubu::id]); }));
    CHECK(ends([&] { static_cast<void>(const_range[0]); }));
    CHECK(ends([&] { static_cast<void>(grain[tsubu::id]); }));
    CHECK(ends([&] { grain = g[0]; }));
    CHECK(ends([&] { g[0] = grain; }));
    CHECK(ends([&] { swap(grain, g[0]); }));
    const auto fresh = g[1];
    g.permute(std::vector<tsubu::index_t>{1, 0, 2});
    CHECK(ends([&] { static_cast<void>(fresh[tsubu::id]); }));
    CHECK(g[0][tsubu::id] == 2);
}

TEST_CASE("a list that is held while the store drops it is told in debug builds", "[store]") {
    tsubu::particle_store<rich> g;
    g.add_owned(2);
    g[marks][0].push_back(1);
    const auto mine = g.owned();
    auto first = mine[0];
    decltype(g)::record held = std::move(first);
    CHECK(held[marks][0] == 1);
    g.compact();
    CHECK(says(last_words([&] { static_cast<void>(held[marks][0]); }), "a list was held while the store dropped it"));
    CHECK(says(last_words([&] { *mine.begin() = std::move(held); }), "a list was held while the store dropped it"));
    CHECK(g[marks][0].empty());
    tsubu::particle_store<rich> h;
    h.add_owned(1);
    h[marks][0].push_back(1);
    auto only = h.owned()[0];
    const decltype(h)::record kept = std::move(only);
    h.clear();
    CHECK(says(last_words([&] { static_cast<void>(kept[marks][0]); }), "a list was held while the store dropped it"));
}
#endif
