// SPDX-License-Identifier: MIT
#include <tsubu/store/list_of.hpp>

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
#include <utility>
#include <vector>

namespace {

/// What a contact remembers: padded, and larger than a word.
struct contact {
    std::int64_t partner = 0;
    double overlap = 0;
    std::int32_t steps = 0;
    friend bool operator==(const contact&, const contact&) = default;
};
constexpr tsubu::field<"contacts", tsubu::list_of<contact>> contacts{};
constexpr tsubu::field<"marks", tsubu::list_of<unsigned char>> marks{};
using set = tsubu::fields<tsubu::id, contacts, tsubu::radius, marks>;

struct model_particle {
    std::int64_t t = 0;
    std::vector<contact> contacts;
    std::vector<unsigned char> marks;
};

template <class Reference, class Element>
bool same(const Reference& list, const std::vector<Element>& expected) {
    return list.size() == expected.size() && list.empty() == expected.empty() &&
           std::equal(list.begin(), list.end(), expected.begin());
}

/// A store and its model, to which the same is done.
template <class Layout>
class twins {
public:
    explicit twins(std::uint64_t seed) : random_(seed) {}

    void add() {
        g_.push_back(tsubu::id = next_, tsubu::radius = static_cast<double>(next_));
        model_.push_back({next_++, {}, {}});
    }
    /// One random operation; the list that it touched is compared at once.
    void step() {
        const auto dice = random_.below(1000);
        if (dice < 20 || model_.empty()) return add();
        const auto i = random_.below(model_.size());
        if (dice < 40) {
            g_.swap_remove(i);
            model_[i] = std::move(model_.back());
            model_.pop_back();
            return;
        }
        if (dice < 42) return permute();
        if (dice < 43) return sort();
        if (dice < 44) return g_.compact();
        if (dice < 46) return ghosts();
        if (dice < 47) return copy();
        const auto list = g_[contacts][i];
        auto& expected = model_[i].contacts;
        if (dice < 600) {
            const contact one{static_cast<std::int64_t>(random_()), random_.unit(), static_cast<std::int32_t>(dice)};
            list.push_back(one);
            expected.push_back(one);
        } else if (dice < 650 && !expected.empty()) {  // one that lies in the pool
            list.push_back(list[list.size() - 1]);
            expected.push_back(contact(expected.back()));
        } else if (dice < 800 && !expected.empty()) {
            const auto k = random_.below(expected.size());
            list.swap_remove(k);
            expected[k] = expected.back();
            expected.pop_back();
        } else if (dice < 820) {
            list.clear();
            expected.clear();
        } else if (dice < 840) {
            std::vector<contact> other(random_.below(9));
            for (auto& one : other) one.partner = static_cast<std::int64_t>(random_.below(99));
            list.assign(other);
            expected = other;
        } else if (dice < 860) {
            const auto before = expected.size();
            expected.resize(random_.below(9));
            list.resize(expected.size());
            for (std::size_t k = before; k < expected.size(); ++k) list[k] = expected[k];
        } else {
            const auto mark = static_cast<unsigned char>(random_());
            g_[marks][i].push_back(mark);
            model_[i].marks.push_back(mark);
        }
        wrong_ += same(g_[contacts][i], expected) && same(g_[marks][i], model_[i].marks) ? 0U : 1U;
    }
    /// Lists that are not what the model holds, up to now.
    std::size_t wrong() {
        wrong_ += g_.size() == model_.size() && g_.owned_count() == model_.size() ? 0U : 1U;
        if (wrong_ != 0) return wrong_;
        const auto& read = g_;
        for (std::size_t i = 0; i < model_.size(); ++i)
            wrong_ += read[tsubu::id][i] == model_[i].t &&
                              read[tsubu::radius][i] == static_cast<double>(model_[i].t) &&
                              same(read[contacts][i], model_[i].contacts) && same(read[marks][i], model_[i].marks)
                          ? 0U
                          : 1U;
        return wrong_;
    }
    [[nodiscard]] const auto& store() const { return g_; }
    [[nodiscard]] std::size_t elements() const {
        std::size_t sum = 0;
        for (const auto& one : model_) sum += one.contacts.size();
        return sum;
    }

private:
    void permute() {
        std::vector<tsubu::index_t> order(model_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<tsubu::index_t>(i);
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random_.below(i)]);
        g_.permute(order);
        std::vector<model_particle> after;
        for (const auto from : order) after.push_back(std::move(model_[static_cast<std::size_t>(from)]));
        model_ = std::move(after);
    }
    void sort() {
        const auto mine = g_.owned();
        std::sort(mine.begin(), mine.end(), [](const auto& a, const auto& b) { return a[tsubu::id] < b[tsubu::id]; });
        std::sort(model_.begin(), model_.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    }
    void ghosts() {
        for (std::size_t k = 0; k < 50; ++k) {
            const auto i = static_cast<std::size_t>(g_.push_back_ghost(tsubu::id = 7));
            wrong_ += g_[contacts][i].empty() ? 0U : 1U;
            for (std::size_t n = 0; n < k; ++n) g_[contacts][i].push_back({1, 2, 3});
        }
        g_.clear_ghosts();
    }
    void copy() {
        auto other = g_;
        for (std::size_t i = 0; i < g_.size(); i += 3) g_[contacts][i].push_back({-1, -1, -1});  // not in the copy
        g_ = std::move(other);
    }

    tsubu::random_stream random_;
    tsubu::particle_store<set, Layout> g_;
    std::vector<model_particle> model_;
    std::int64_t next_ = 0;
    std::size_t wrong_ = 0;
};

}  // namespace

TEMPLATE_TEST_CASE("lists are what vectors would be, whatever happens to their particles", "[store]", tsubu::soa,
                   tsubu::aos, tsubu::aosoa<1>, tsubu::aosoa<5>, tsubu::aosoa<16>) {
    const std::uint64_t seed = 20'26;
    twins<TestType> both(seed);
    for (int k = 0; k < 1000; ++k) both.add();
    for (int k = 0; k < 100'000; ++k) {
        both.step();
        if (k % 997 == 0 && both.wrong() != 0) break;
    }
    INFO("seed " << seed);
    CHECK(both.wrong() == 0);
    // Garbage is dropped: 1e5 operations do not fill the pool beyond a few times what is held.
    const auto lists = both.store().memory_bytes() - both.store().capacity() * (both.store().bytes_per_particle + 8);
    CAPTURE(both.elements(), both.store().size());
    CHECK(lists < 12 * (both.elements() + 1000) * sizeof(contact));
}

TEST_CASE("ghosts that come and go with lists leave no garbage that stays", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back();
    std::size_t after_few = 0;
    for (int round = 0; round < 500; ++round) {
        for (int k = 0; k < 100; ++k) {
            const auto i = static_cast<std::size_t>(g.push_back_ghost());
            for (int n = 0; n < 9; ++n) g[contacts][i].push_back({});
        }
        g.clear_ghosts();
        if (round == 10) after_few = g.memory_bytes();
    }
    CHECK(g.memory_bytes() <= after_few);
    for (int round = 0; round < 500; ++round) {
        g.clear();
        g.add_owned(100);
        for (std::size_t i = 0; i < 100; ++i) g[contacts][i].resize(9);
    }
    CHECK(g.memory_bytes() <= after_few);
}

TEST_CASE("compaction keeps each list and lays them in the order of the particles", "[store]") {
    tsubu::particle_store<set> g;
    g.add_owned(3);
    for (int round = 0; round < 20; ++round)
        for (std::size_t i = 0; i < 3; ++i) g[contacts][i].push_back({static_cast<std::int64_t>(i), 0, round});
    g[contacts][1].resize(5);
    g.permute(std::vector<tsubu::index_t>{2, 0, 1});
    g.compact();
    const auto lists = g[contacts];
    CHECK(lists[0].size() == 20);
    CHECK(lists[1].size() == 20);
    CHECK(lists[2].size() == 5);
    CHECK(lists[0][19] == contact{2, 0, 19});
    CHECK(lists[1][0] == contact{0, 0, 0});
    CHECK(lists[2][4] == contact{1, 0, 4});
    CHECK(lists[0].end() == lists[1].begin());
    CHECK(lists[1].end() == lists[2].begin());
    lists[0].push_back({9, 9, 9});  // its room was full: it moves
    CHECK(lists[1][0] == contact{0, 0, 0});
    CHECK(lists[0][20] == contact{9, 9, 9});
}

TEST_CASE("a list takes what fits 31 bits, and says so", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back();
    g[marks][0].push_back(7);
    const auto text = thrown<tsubu::limit_error>([&] { g[marks][0].resize(std::size_t{1} << 31); });
    CHECK(says(text, "tsubu::list_of: 2147483648 values of one particle; a particle holds fewer than 2^31"));
    CHECK(g[marks][0].size() == 1);
    CHECK(g[marks][0][0] == 7);
}

TEST_CASE("lists are walked particle by particle", "[store]") {
    tsubu::particle_store<set> g;
    for (auto list : g[marks]) list.push_back(9);
    g.add_owned(2);
    g.add_ghosts(1);
    unsigned char next = 0;
    for (auto list : g[marks]) list.push_back(next++);
    CHECK(next == 3);
    std::size_t sum = 0;
    for (const auto list : std::as_const(g)[marks]) sum += list[0];
    CHECK(sum == 3);
    for (const auto list : g.ghosts()[marks]) CHECK(list[0] == 2);
    CHECK(std::next(g[marks].begin(), 2) != g[marks].end());
    CHECK(g[marks][tsubu::index_t{1}][0] == 1);
}

TEST_CASE("the lists of a range are those of its particles", "[store]") {
    tsubu::particle_store<set> g;
    g.add_owned(2);
    g.add_ghosts(2);
    g[marks][3].push_back(5);
    CHECK(g.ghosts()[marks].size() == 2);
    CHECK(g.ghosts()[marks][1][0] == 5);
    CHECK(g.ghosts()[1][marks].size() == 1);
    const auto& read = g;
    CHECK(read.ghosts()[marks][1].span()[0] == 5);
    CHECK(read.all()[3][marks][0] == 5);
}

#if defined(__unix__) && !defined(NDEBUG)
TEST_CASE("lists say in debug builds what is wrong", "[store]") {
    tsubu::particle_store<set> g;
    g.push_back();
    const auto old = g[marks];
    CHECK(says(last_words([&] { static_cast<void>(old[0][0]); }), "no element with this number in the list"));
    CHECK(says(last_words([&] { old[0].swap_remove(0); }), "no element with this number in the list"));
    CHECK(says(last_words([&] { static_cast<void>(old[1]); }), "no particle with this index"));
    const auto list = g[marks][0];
    const auto const_list = std::as_const(g)[marks][0];
    g.reserve(20'000);
    CHECK(says(last_words([&] { static_cast<void>(old[0]); }), "older than its memory"));
    CHECK(says(last_words([&] { static_cast<void>(list.size()); }), "older than its memory"));
    CHECK(says(last_words([&] { static_cast<void>(list.begin()); }), "older than its memory"));
    CHECK(says(last_words([&] { list.push_back(1); }), "older than its memory"));
    CHECK(says(last_words([&] { list.resize(3); }), "older than its memory"));
    CHECK(says(last_words([&] { list.reserve(3); }), "older than its memory"));
    CHECK(says(last_words([&] { list.clear(); }), "older than its memory"));
    CHECK(says(last_words([&] { static_cast<void>(const_list.span()); }), "older than its memory"));
    g[marks][0].push_back(1);
    CHECK(g[marks][0].size() == 1);
}
#endif
